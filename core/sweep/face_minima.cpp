#include "core/sweep/face_minima.h"

#include <algorithm>
#include <bit>
#include <new>

#include "core/base/parallel.h"
#include "core/sweep/face_sweep.h"
#include "kinemesh/measure.h"

namespace kinemesh {
namespace {

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
  for (Face f{faces.begin}; f < faces.end; ++f) n += mesh.is_padding(f);
  return n > 0;
}

Minima without_padding(const Mesh& mesh, const Faces& faces) {
  Minima minima;
  for (Face f{faces.begin}; f < faces.end; ++f) {
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
  known_.assign(n, Known::Nothing);
  corners_.clear();
  unknown_.reserve(n);
}

void FaceMinima::outdate_moved(const Mesh& mesh, const MovedBlocks* moved) {
  const int n = n_stretches(mesh.n_faces());
  if (!moved || n != static_cast<int>(known_.size()) || moved->contain_all()) return reset(mesh.n_faces());
  corners_.resize(n);
  parallel_parts(n, grain::stretches, [&](int, int begin, int end) {
    for (int s = begin; s < end; ++s)
      if (known_[s] != Known::Nothing && has_moved(s, mesh, *moved)) known_[s] = Known::Nothing;
  });
}

bool FaceMinima::has_moved(int stretch, const Mesh& mesh, const MovedBlocks& moved) {
  const Vertex first = mesh.triangles()[faces_of(stretch, mesh).begin][0];
  if (moved.contains(MovedBlocks::block_of(first))) return true;
  Corners& corners = corners_[stretch];
  if (corners.near == 0) corners = corners_of(stretch, mesh);
  if (corners.n_others > Corners::most_others) return true;
  for (auto near = corners.near; near != 0; near &= near - 1)
    if (moved.contains(corners.first + std::countr_zero(near))) return true;
  const auto others = std::span(corners.others).first(corners.n_others);
  return std::ranges::any_of(others, [&](int block) { return moved.contains(block); });
}

FaceMinima::Corners FaceMinima::corners_of(int stretch, const Mesh& mesh) {
  const Faces faces = faces_of(stretch, mesh);
  Corners found;
  found.first = std::max(0, MovedBlocks::block_of(mesh.triangles()[faces.begin][0]) - 16);
  const auto add_other = [&](int block) {
    const auto end = found.others.begin() + std::min(found.n_others, Corners::most_others);
    if (std::find(found.others.begin(), end, block) != end) return;
    if (found.n_others < Corners::most_others) *end = block;
    ++found.n_others;
  };
  for (Face f{faces.begin}; f < faces.end; ++f) {
    for (const Vertex vertex : mesh.triangles()[f]) {
      const auto block = static_cast<unsigned>(MovedBlocks::block_of(vertex) - found.first);
      if (block < 64)
        found.near |= std::uint64_t{1} << block;
      else
        add_other(MovedBlocks::block_of(vertex));
    }
  }
  return found;
}

void FaceMinima::set(int stretch, const Sight& seen, const Mesh& mesh) {
  const Faces faces = faces_of(stretch, mesh);
  minima_[stretch] =
      has_padding(mesh, faces) ? without_padding(mesh, faces) : Minima{seen.twice_area, seen.tangent};
  known_[stretch] = seen.doubtful == 0 ? Known::Upright : Known::Minima;
}

void FaceMinima::outdate(std::span<const Face> faces) {
  for (const Face face : faces) {
    const int stretch = face / stretch_faces;
    known_[stretch] = Known::Nothing;
    if (!corners_.empty()) corners_[stretch].near = 0;
  }
}

Minima FaceMinima::update(const Mesh& mesh) {
  unknown_.clear();
  for (std::size_t s = 0; s < known_.size(); ++s)
    if (known_[s] == Known::Nothing) unknown_.push_back(static_cast<int>(s));
  const int n = static_cast<int>(unknown_.size());
  const auto measure = [&](int, int begin, int end) {
    for (int i = begin; i < end; ++i) set(unknown_[i], look_at_stretch(mesh, unknown_[i]), mesh);
  };
  try {
    parallel_parts(n, grain::stretches, measure);
  } catch (const std::bad_alloc&) {  // of TBB
    measure(0, 0, n);
  }
  Minima all;
  for (const Minima& minima : minima_) all = smaller(all, minima);
  return all;
}

}  // namespace kinemesh
