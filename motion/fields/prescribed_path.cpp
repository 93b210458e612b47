#include "motion/fields/prescribed_path.h"

#include <algorithm>
#include <limits>

#include "core/io/atomic_file.h"
#include "core/io/scanner.h"
#include "motion/fields/csv.h"
#include "motion/fields/rigid.h"

namespace kinemesh {

Point PrescribedPath::displacement(const Point& initial, double t) const {
  const Pose at = pose(t);
  return turned_minus_self(initial - center_, static_cast<double>(at.angle)) +
         Point(static_cast<double>(at.x), static_cast<double>(at.y));
}

FormulaPath::FormulaPath(const Point& center, const std::string& x, const std::string& y,
                         const std::string& angle)
    : PrescribedPath(center),
      x_("x", x, FormulaIn::Time),
      y_("y", y, FormulaIn::Time),
      angle_("angle", angle, FormulaIn::Time),
      turns_(angle != "0") {}

Pose FormulaPath::pose(double t) const {
  const Point nowhere{0.0, 0.0};
  return {angle_(nowhere, t), x_(nowhere, t), y_(nowhere, t)};
}

std::optional<Point> FormulaPath::center() const {
  return turns_ ? PrescribedPath::center() : std::nullopt;
}

TablePath::TablePath(const Point& center, const std::string& file) : PrescribedPath(center), file_(file) {
  const std::string text = without_commas(read_file(file));
  io::Scanner in(text, file, '#');
  for (const char* column : {"t", "x", "y", "angle"})
    if (in.word("the header t,x,y,angle") != column) in.fail("the header t,x,y,angle expected");
  in.expect_line_end("four columns");
  while (!in.at_end()) {
    Row row{};
    row.time = in.number("a time");
    for (double* value : {&row.x, &row.y, &row.angle}) *value = in.number_here("one of x,y,angle");
    in.expect_line_end("four columns");
    if (!rows_.empty() && row.time <= rows_.back().time)
      in.fail("a later time than in the row before expected");
    rows_.push_back(row);
  }
  if (rows_.empty()) in.fail("the file ends, at least one row t,x,y,angle expected");
}

void TablePath::require_times(double from, double to) const {
  range().require(from, to, file_, "rows");
}

Pose TablePath::pose(double t) const {
  constexpr long double nan = std::numeric_limits<long double>::quiet_NaN();
  if (!range().covers(t, t)) return {nan, nan, nan};
  const auto next = std::ranges::upper_bound(rows_, t, {}, &Row::time);
  if (next == rows_.begin() || next == rows_.end()) {
    const Row& row = next == rows_.begin() ? rows_.front() : rows_.back();
    return {row.angle, row.x, row.y};
  }
  const Row& before = *(next - 1);
  const long double s = (static_cast<long double>(t) - before.time) / (next->time - before.time);
  const auto between = [s](long double a, long double b) { return a + s * (b - a); };
  return {between(before.angle, next->angle), between(before.x, next->x), between(before.y, next->y)};
}

AnyField prescribed_path(const CheckedParameters& parameters) {
  const std::string& file = parameters.text("file");
  const Point center = parameters.point("center");
  if (file.empty())
    return std::make_shared<FormulaPath>(center, parameters.text("x"), parameters.text("y"),
                                         parameters.text("angle"));
  for (const char* formula : {"x", "y", "angle"})
    if (parameters.text(formula) != "0")
      throw ParameterError(formula,
                           std::string("field \"rigid\": ") + formula + " and file: one of them expected");
  return std::make_shared<TablePath>(center, file);
}

}  // namespace kinemesh
