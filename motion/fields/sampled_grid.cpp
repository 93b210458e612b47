#include "motion/fields/sampled_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <tuple>
#include <utility>

#include "core/io/atomic_file.h"
#include "core/io/scanner.h"
#include "motion/fields/csv.h"

namespace kinemesh {
namespace {

struct Row {
  double t, y, x;
  Point velocity;
  int line;
  auto place() const { return std::tie(t, y, x); }
};

constexpr const char* expected_names = "the names t,x,y,u,v or x,y,u,v expected";

class GridReader {
 public:
  GridReader(std::string_view text, const std::string& file)
      : file_(file), text_(without_commas(std::string(text))), scanner_(text_, file, '#') {}

  GridSamples read() {
    read_names();
    while (!scanner_.at_end()) rows_.push_back(next_row());
    if (rows_.empty()) throw InputError(file_, 0, "no samples, rows t,x,y,u,v or x,y,u,v expected");
    std::stable_sort(rows_.begin(), rows_.end(),
                     [](const Row& a, const Row& b) { return a.place() < b.place(); });
    refuse_repeated();
    GridSamples samples{axis(&Row::t), axis(&Row::x), axis(&Row::y), {}};
    refuse_missing(samples);
    for (const Row& row : rows_) samples.velocity.push_back(row.velocity);
    return samples;
  }

 private:
  // Columns are five or four: with a line of names as that says, else as the first row has.
  void read_names() {
    if (scanner_.at_end() || !starts_with_letter()) return;
    std::string names;
    while (!scanner_.at_line_end()) names += std::string(scanner_.word("a name")) + ",";
    if (names != "t,x,y,u,v," && names != "x,y,u,v,") scanner_.fail(expected_names);
    columns_ = names[0] == 't' ? 5 : 4;
  }

  bool starts_with_letter() const {
    return std::isalpha(static_cast<unsigned char>(text_[text_.size() - scanner_.bytes_left()])) != 0;
  }

  Row next_row() {
    double values[5] = {};
    int n = 0;
    do {
      values[n++] = scanner_.number_here("one of t,x,y,u,v");
    } while (n < 5 && !scanner_.at_line_end());
    if (n == 5) scanner_.expect_line_end("t,x,y,u,v");
    if (columns_ == 0 && n >= 4) columns_ = n;
    if (n != columns_) scanner_.fail(fmt::format("{} numbers, {} expected", n, expected_columns()));
    const double* place = values + (n - 4);
    return {n == 5 ? values[0] : 0.0, place[1], place[0], {place[2], place[3]}, scanner_.line()};
  }

  const char* expected_columns() const {
    return columns_ == 5 ? "5, t,x,y,u,v," : columns_ == 4 ? "4, x,y,u,v," : "t,x,y,u,v or x,y,u,v";
  }

  void refuse_repeated() const {
    const auto twice = std::adjacent_find(rows_.begin(), rows_.end(),
                                          [](const Row& a, const Row& b) { return a.place() == b.place(); });
    if (twice != rows_.end())
      throw InputError(file_, twice[1].line,
                       "a second sample at " + describe(twice->t, twice->x, twice->y) +
                           ", the first is in line " + std::to_string(twice->line));
  }

  std::vector<double> axis(double Row::*coordinate) const {
    std::vector<double> values;
    for (const Row& row : rows_) values.push_back(row.*coordinate);
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
  }

  // Rows are sorted and differ: the first that is not where a full grid has it tells which one is missing.
  void refuse_missing(const GridSamples& grid) const {
    std::size_t i = 0;
    for (const double t : grid.t)
      for (const double y : grid.y)
        for (const double x : grid.x) {
          if (i == rows_.size() || rows_[i].place() != std::tie(t, y, x))
            throw InputError(
                file_, 0,
                fmt::format("no sample at {}; all combinations of {} times, {} x and {} y expected",
                            describe(t, x, y), grid.t.size(), grid.x.size(), grid.y.size()));
          ++i;
        }
  }

  std::string describe(double t, double x, double y) const {
    return columns_ == 5 ? fmt::format("t = {}, x = {}, y = {}", t, x, y)
                         : fmt::format("x = {}, y = {}", x, y);
  }

  std::string file_, text_;
  io::Scanner scanner_;
  int columns_ = 0;
  std::vector<Row> rows_;
};

// Where a value lies between two samples: at the first, with weight 1 - share, and at the next.
struct Between {
  std::size_t first, next;
  double share;
};

Between locate(const std::vector<double>& axis, double value) {
  const auto above = std::upper_bound(axis.begin(), axis.end(), value);
  if (above == axis.begin()) return {0, 0, 0.0};
  const auto first = static_cast<std::size_t>(above - axis.begin()) - 1;
  if (above == axis.end()) return {first, first, 0.0};
  return {first, first + 1, (value - axis[first]) / (axis[first + 1] - axis[first])};
}

Point mix(const Point& a, const Point& b, double share) {
  return share == 0.0 ? a : (1.0 - share) * a + share * b;
}

}  // namespace

GridSamples parse_grid(std::string_view text, const std::string& file) {
  return GridReader(text, file).read();
}

SampledGrid::SampledGrid(const std::filesystem::path& file)
    : SampledGrid(parse_grid(read_file(file), file.string())) {}

Point SampledGrid::velocity(const Point& x, double t) const {
  const Between at_t = locate(samples_.t, t), at_x = locate(samples_.x, x.x), at_y = locate(samples_.y, x.y);
  const auto along_x = [&](std::size_t time, std::size_t row) {
    const Point* samples = &samples_.velocity[(time * samples_.y.size() + row) * samples_.x.size()];
    return mix(samples[at_x.first], samples[at_x.next], at_x.share);
  };
  const auto in_plane = [&](std::size_t time) {
    return mix(along_x(time, at_y.first), along_x(time, at_y.next), at_y.share);
  };
  return mix(in_plane(at_t.first), in_plane(at_t.next), at_t.share);
}

}  // namespace kinemesh
