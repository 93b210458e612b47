#include "core/face_sweep.h"

#include <array>

namespace kinemesh {
namespace {

static_assert(sizeof(Point) == 2 * sizeof(double) && sizeof(Triangle) == 3 * sizeof(int));

SweepKernel* widest_kernel() {
  SweepKernel* const wide = sweep_by_four();
  return wide ? wide : sweep_by_two;
}

Sight look(const Mesh& mesh, const Triangle* triangles, const Triangle* ahead) {
  static SweepKernel* const kernel = widest_kernel();
  return kernel(&mesh.positions().data()->x, triangles->data(), ahead->data());
}

// Filled up with the last face.
Sight look_at_rest(const Mesh& mesh, std::span<const Triangle> rest) {
  std::array<Triangle, stretch_faces> triangles;
  triangles.fill(rest.back());
  std::copy(rest.begin(), rest.end(), triangles.begin());
  Sight sight = look(mesh, triangles.data(), triangles.data());
  sight.doubtful &= (std::uint64_t{1} << rest.size()) - 1;
  return sight;
}

}  // namespace

Sight look_at_stretch(const Mesh& mesh, int stretch) {
  const auto all = mesh.triangles();
  const auto first = static_cast<std::size_t>(stretch) * stretch_faces;
  if (first + stretch_faces > all.size()) return look_at_rest(mesh, all.subspan(first));
  const bool is_next_whole = first + 2 * stretch_faces <= all.size();
  const Triangle* const triangles = &all[first];
  return look(mesh, triangles, is_next_whole ? triangles + stretch_faces : triangles);
}

}  // namespace kinemesh
