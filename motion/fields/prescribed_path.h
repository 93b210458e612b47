// The field `rigid`: a turn about a centre and a shift, as given functions of time.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kinemesh/field.h"
#include "kinemesh/registry.h"
#include "motion/fields/expression.h"
#include "motion/fields/time_range.h"

namespace kinemesh {

// d(X, t) = c + R(angle(t))(X - c) + (x(t), y(t)) - X.
class PrescribedPath : public DisplacementField, public RigidPath {
 public:
  explicit PrescribedPath(const Point& center) : center_(center) {}
  std::string_view name() const override { return "rigid"; }
  Point displacement(const Point& initial, double t) const override;
  std::optional<Point> center() const override { return center_; }

 private:
  Point center_;
};

// By formulas of t. Does not turn if the angle is "0".
class FormulaPath final : public PrescribedPath {
 public:
  FormulaPath(const Point& center, const std::string& x, const std::string& y, const std::string& angle);
  Pose pose(double t) const override;
  std::optional<Point> center() const override;

 private:
  Formula x_, y_, angle_;  // throw ParameterError
  bool turns_;
};

// By a table of t,x,y,angle, linear between its rows; not a number outside of it.
class TablePath final : public PrescribedPath {
 public:
  // Throws InputError with file and line: other columns, times that do not ascend, no row.
  TablePath(const Point& center, const std::string& file);
  Pose pose(double t) const override;

  // Throws InputError that names the file: it does not reach from one time to the other.
  void require_times(double from, double to) const;

 private:
  struct Row {
    double time, x, y, angle;
  };

  TimeRange range() const { return {rows_.front().time, rows_.back().time}; }

  std::string file_;
  std::vector<Row> rows_;
};

// From the parameters of the field `rigid`. Throws ParameterError where both formulas and a file are given.
AnyField prescribed_path(const CheckedParameters& parameters);

}  // namespace kinemesh
