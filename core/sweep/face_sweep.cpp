#include "core/sweep/face_sweep.h"

#include <array>

namespace kinemesh {
namespace {

static_assert(sizeof(Point) == 2 * sizeof(double) && sizeof(MeshTriangle) == 3 * sizeof(int));

// An Id is an int.
const int* numbers_of(const MeshTriangle* triangles) {
  return reinterpret_cast<const int*>(triangles);
}

template <Look look>
Sight sweep(const Mesh& mesh, const MeshTriangle* triangles, const MeshTriangle* ahead) {
  static SweepKernel* const wide = sweep_by_four(look);
  static SweepKernel* const kernel = wide ? wide : sweep_by_two(look);
  return kernel(&mesh.positions().data()->x, numbers_of(triangles), numbers_of(ahead));
}

// Filled up with the last face.
template <Look look>
Sight sweep_rest(const Mesh& mesh, std::span<const MeshTriangle> rest) {
  std::array<MeshTriangle, stretch_faces> triangles;
  triangles.fill(rest.back());
  std::copy(rest.begin(), rest.end(), triangles.begin());
  Sight sight = sweep<look>(mesh, triangles.data(), triangles.data());
  sight.doubtful &= (std::uint64_t{1} << rest.size()) - 1;
  return sight;
}

template <Look look>
Sight sweep_stretch(const Mesh& mesh, int stretch) {
  const auto all = mesh.triangles();
  const auto first = static_cast<std::size_t>(stretch) * stretch_faces;
  if (first + stretch_faces > all.size()) return sweep_rest<look>(mesh, all.subspan(first));
  constexpr std::size_t ahead = 4 * stretch_faces;  // the nearer ones come too late
  const bool goes_on = first + ahead + stretch_faces <= all.size();
  const MeshTriangle* const triangles = &all[first];
  return sweep<look>(mesh, triangles, goes_on ? triangles + ahead : triangles);
}

}  // namespace

Sight look_at_stretch(const Mesh& mesh, int stretch) {
  return sweep_stretch<Look::JudgeAndMeasure>(mesh, stretch);
}

std::uint64_t doubtful_in_stretch(const Mesh& mesh, int stretch) {
  return sweep_stretch<Look::Judge>(mesh, stretch).doubtful;
}

}  // namespace kinemesh
