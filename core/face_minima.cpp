#include "core/face_minima.h"

#include <algorithm>
#include <new>

#include "core/face_sweep.h"
#include "core/measure.h"
#include "core/parallel.h"

namespace kinemesh {
namespace {

constexpr int grain = 256;  // stretches that are worth a task

Minima smaller(const Minima& a, const Minima& b) {
  return {std::min(a.twice_area, b.twice_area), std::min(a.tangent, b.tangent)};
}

struct Faces {
  int begin, end;
};

Faces faces_of(int stretch, const Mesh& mesh) {
  const int begin = stretch * stretch_faces;
  return {begin, std::min(begin + stretch_faces, mesh.n_faces())};
}

bool has_padding(const Mesh& mesh, const Faces& faces) {
  int n = 0;  // counted to the end: the compiler takes several at a time
  for (int f = faces.begin; f < faces.end; ++f) n += mesh.is_padding(f);
  return n > 0;
}

Minima without_padding(const Mesh& mesh, const Faces& faces) {
  Minima minima;
  for (int f = faces.begin; f < faces.end; ++f) {
    if (mesh.is_padding(f)) continue;
    const auto corners = mesh.corners(f);
    minima = smaller(minima, {twice_area(corners), tangent_of_smallest_angle(corners)});
  }
  return minima;
}

}  // namespace

void FaceMinima::reset(int n_faces) {
  const int n = n_stretches(n_faces);
  minima_.resize(n);
  is_known_.assign(n, false);
  unknown_.reserve(n);
}

void FaceMinima::set(int stretch, const Minima& seen, const Mesh& mesh) {
  const Faces faces = faces_of(stretch, mesh);
  minima_[stretch] = has_padding(mesh, faces) ? without_padding(mesh, faces) : seen;
  is_known_[stretch] = true;
}

void FaceMinima::outdate(std::span<const int> faces) {
  for (const int face : faces) is_known_[face / stretch_faces] = false;
}

Minima FaceMinima::update(const Mesh& mesh) {
  unknown_.clear();
  for (std::size_t s = 0; s < is_known_.size(); ++s)
    if (!is_known_[s]) unknown_.push_back(static_cast<int>(s));
  const int n = static_cast<int>(unknown_.size());
  const auto measure = [&](int, int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const Sight sight = look_at_stretch(mesh, unknown_[i]);
      set(unknown_[i], {sight.twice_area, sight.tangent}, mesh);
    }
  };
  try {
    parallel_parts(n, grain, measure);
  } catch (const std::bad_alloc&) {  // of TBB
    measure(0, 0, n);
  }
  Minima all;
  for (const Minima& minima : minima_) all = smaller(all, minima);
  return all;
}

}  // namespace kinemesh
