// What a sweep over the faces does to 64 of them. Includes nothing that leaves code behind: one of the
// sources is compiled for machines that not everybody has, and the linker may keep any of several copies.
#pragma once

#include <cstdint>

namespace kinemesh {

inline constexpr int stretch_faces = 64;

// Of a stretch of faces.
struct Sight {
  std::uint64_t doubtful;  // bit i: the filter of orientation() does not prove face i upright
  // The smallest of all, as twice_area and tangent_of_smallest_angle have them; infinite if not measured.
  double twice_area, tangent;
};

enum class Look { Judge, JudgeAndMeasure };

// positions: x, y, x, y, ...; triangles: 64, of three numbers of positions each; ahead: as many, to be on
// their way from memory meanwhile. The same bits from both, two or four faces at a time.
using SweepKernel = Sight(const double* positions, const int* triangles, const int* ahead);
SweepKernel* sweep_by_two(Look look);
SweepKernel* sweep_by_four(Look look);  // null where compiler or machine have no AVX

}  // namespace kinemesh
