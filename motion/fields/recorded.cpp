#include "motion/fields/recorded.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <system_error>

#include "core/io/atomic_file.h"
#include "core/io/pvd.h"
#include "core/io/scanner.h"
#include "kinemesh/mesh_io.h"
#include "motion/fields/csv.h"

namespace kinemesh {
namespace {

struct Row {
  double time;
  int vertex;
  Point position;
};

Row read_row(io::Scanner& in) {
  Row row{};
  row.time = in.number("a time");
  row.vertex = in.integer_here("the number of a vertex");
  row.position.x = in.number_here("x");
  row.position.y = in.number_here("y");
  in.expect_line_end("four columns");
  return row;
}

void read_header(io::Scanner& in) {
  for (const char* column : {"time", "vertex", "x", "y"})
    if (in.word("the header time,vertex,x,y") != column) in.fail("the header time,vertex,x,y expected");
  in.expect_line_end("four columns");
}

// Rows of a table, which has the same vertices at each time, ascending.
class TableReader {
 public:
  TableReader(io::Scanner& in, std::vector<int>& numbers, std::vector<double>& times,
              std::vector<std::vector<Point>>& positions)
      : in_(in), numbers_(numbers), times_(times), positions_(positions) {}

  void read() {
    read_header(in_);
    while (!in_.at_end()) add(read_row(in_));
    if (times_.empty()) in_.fail("the file ends, at least one time expected");
    require_complete();
  }

 private:
  void add(const Row& row) {
    if (numbers_.empty() || row.vertex == numbers_.front()) begin(row.time);
    if (row.time != times_.back())
      in_.fail(
          fmt::format("time {}, expected {} as of vertex {}", row.time, times_.back(), numbers_.front()));
    if (times_.size() == 1)
      add_number(row.vertex);
    else
      check_number(row.vertex);
    positions_.back().push_back(row.position);
  }

  void add_number(int vertex) {
    if (vertex < 0 || (!numbers_.empty() && vertex <= numbers_.back()))
      in_.fail(fmt::format("vertex {}, ascending numbers from 0 on expected", vertex));
    numbers_.push_back(vertex);
  }

  void check_number(int vertex) const {
    const std::size_t n = positions_.back().size();
    if (n == numbers_.size())
      in_.fail(fmt::format("vertex {}, but the first time has {} vertices", vertex, n));
    if (vertex != numbers_[n])
      in_.fail(fmt::format("vertex {}, expected {} as at the first time", vertex, numbers_[n]));
  }

  void begin(double time) {
    if (!times_.empty() && time <= times_.back())
      in_.fail(fmt::format("time {} after {}, ascending times expected", time, times_.back()));
    require_complete();
    times_.push_back(time);
    positions_.emplace_back();
  }

  void require_complete() const {
    if (!times_.empty() && positions_.back().size() < positions_.front().size())
      in_.fail(fmt::format("{} vertices at time {}, expected {} as at the first time",
                           positions_.back().size(), times_.back(), positions_.front().size()));
  }

  io::Scanner& in_;
  std::vector<int>& numbers_;
  std::vector<double>& times_;
  std::vector<std::vector<Point>>& positions_;
};

}  // namespace

RecordedPositions::RecordedPositions(const std::filesystem::path& file) : file_(file.string()) {
  if (file.extension() == ".csv")
    read_table(read_file(file));
  else if (file.extension() == ".pvd")
    read_series();
  else
    throw InputError(file_, 0, "a record of positions is a table (.csv) or a series of meshes (.pvd)");
  number_vertices();
}

void RecordedPositions::read_table(std::string text) {
  text = without_commas(std::move(text));
  io::Scanner in(text, file_, '#');
  std::vector<std::vector<Point>> positions;
  TableReader(in, numbers_, times_, positions).read();
  for (auto& points : positions)
    positions_.push_back(std::make_shared<const std::vector<Point>>(std::move(points)));
}

// A file that is named at several times is read once, whatever the names.
void RecordedPositions::read_series() {
  std::map<std::filesystem::path, std::shared_ptr<const std::vector<Point>>> known;
  for (const PvdEntry& entry : read_pvd(file_)) {
    const auto mesh_file = std::filesystem::path(file_).parent_path() / entry.file;
    std::error_code error;  // of a file that is not there, which reading it tells of
    auto& points = known[std::filesystem::weakly_canonical(mesh_file, error)];
    if (!points) points = read_points(mesh_file);
    times_.push_back(entry.time);
    positions_.push_back(points);
  }
}

std::shared_ptr<const std::vector<Point>> RecordedPositions::read_points(
    const std::filesystem::path& mesh_file) const {
  auto points = std::make_shared<const std::vector<Point>>(read_mesh(mesh_file).mesh.points);
  if (!positions_.empty() && points->size() != positions_.front()->size())
    throw InputError(mesh_file.string(), 0,
                     fmt::format("{} vertices, expected {} as at the first time of {}", points->size(),
                                 positions_.front()->size(), file_));
  return points;
}

void RecordedPositions::number_vertices() {
  const auto& first = *positions_.front();
  for (int v = 0; v < static_cast<int>(first.size()); ++v)
    if (const auto [other, is_new] = vertex_at_.emplace(first[v], v); !is_new)
      throw InputError(
          file_, 0,
          fmt::format("vertices {} and {} begin at the same place", number(other->second), number(v)));
}

int RecordedPositions::number(int vertex) const {
  return numbers_.empty() ? vertex : numbers_[vertex];
}

void RecordedPositions::require_initial(std::span<const Point> positions) const {
  const auto& first = *positions_.front();
  if (first.size() != positions.size())
    throw InputError(file_, 0,
                     fmt::format("{} vertices, expected {} as in the mesh", first.size(), positions.size()));
  for (std::size_t v = 0; v < first.size(); ++v)
    if (first[v] != positions[v])
      throw InputError(file_, 0,
                       fmt::format("vertex {} begins at ({}, {}), expected ({}, {}) as in the mesh", v,
                                   first[v].x, first[v].y, positions[v].x, positions[v].y));
}

void RecordedPositions::require_all(std::span<const Point> positions) const {
  for (const Point& p : positions)
    if (!vertex_at_.contains(p))
      throw InputError(file_, 0,
                       fmt::format("no vertex begins at ({}, {}), where the body has one", p.x, p.y));
}

void RecordedPositions::require_times(double from, double to) const {
  range().require(from, to, file_, "positions");
}

std::size_t RecordedPositions::Hash::operator()(const Point& p) const {
  const std::hash<double> hash;
  return hash(p.x) * 31 + hash(p.y);
}

Point RecordedPositions::displacement(const Point& initial, double t) const {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto vertex = vertex_at_.find(initial);
  return vertex == vertex_at_.end() || !range().covers(t, t) ? Point(nan, nan)
                                                             : position(vertex->second, t) - initial;
}

Point RecordedPositions::position(int vertex, double t) const {
  const auto next = static_cast<std::size_t>(std::ranges::upper_bound(times_, t) - times_.begin());
  if (next == 0) return (*positions_.front())[vertex];
  if (next == times_.size()) return (*positions_.back())[vertex];
  const double s = (t - times_[next - 1]) / (times_[next] - times_[next - 1]);
  const Point& before = (*positions_[next - 1])[vertex];
  return before + s * ((*positions_[next])[vertex] - before);
}

}  // namespace kinemesh
