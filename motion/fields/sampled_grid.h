// A velocity field sampled on a rectilinear grid, from a table that anybody can write.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "kinemesh/field.h"

namespace kinemesh {

// Velocities at all combinations of some times, abscissae and ordinates.
struct GridSamples {
  std::vector<double> t, x, y;  // ascending, at least one each
  std::vector<Point> velocity;  // by time, then y, then x
};

// One row per sample: t,x,y,u,v or, for a steady field, x,y,u,v; see docs/formats.md. Throws InputError
// naming file and line: not a row of numbers, a row of another length, two rows for one place and time, one
// missing.
GridSamples parse_grid(std::string_view text, const std::string& file);

// Bilinear between the four samples around a place, linear between two times: continuous, and exact for
// velocities that are so. Outside the grid that of its nearest place, before and after its times that of the
// first and of the last. O(log n).
class SampledGrid final : public VelocityField {
 public:
  explicit SampledGrid(GridSamples samples) : samples_(std::move(samples)) {}
  explicit SampledGrid(const std::filesystem::path& file);  // throws InputError
  std::string_view name() const override { return "grid"; }
  Point velocity(const Point& x, double t) const override;

 private:
  GridSamples samples_;
};

}  // namespace kinemesh
