// Vertices that follow positions recorded in a file, by another program or by a run of ours.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "kinemesh/field.h"
#include "motion/fields/time_range.h"

namespace kinemesh {

// d(X, t) = p(t) - X of the vertex that begins at X, where p is linear between the recorded times. Not a
// number for an X where no vertex begins, and for times outside the record.
class RecordedPositions final : public DisplacementField {
 public:
  // A table (.csv) or a series of meshes (.pvd), see docs/formats.md. Throws InputError with file and line:
  // unreadable, another extension, times that do not ascend, other numbers of vertices at some time, two
  // vertices that begin at the same place.
  explicit RecordedPositions(const std::filesystem::path& file);

  std::string_view name() const override { return "recorded"; }
  Point displacement(const Point& initial, double t) const override;

  // Throw InputError that names the file: the record does not begin at these positions, bit by bit; it does
  // not reach from one time to the other; at some of these positions no vertex begins.
  void require_initial(std::span<const Point> positions) const;
  void require_times(double from, double to) const;
  void require_all(std::span<const Point> positions) const;  // begin there, whatever else there is

  const std::vector<double>& times() const { return times_; }  // ascending

 private:
  struct Hash {
    std::size_t operator()(const Point& p) const;
  };

  void read_table(std::string text);
  void read_series();
  std::shared_ptr<const std::vector<Point>> read_points(const std::filesystem::path& mesh_file) const;
  void number_vertices();
  int number(int vertex) const;
  TimeRange range() const { return {times_.front(), times_.back()}; }
  Point position(int vertex, double t) const;

  std::string file_;
  std::vector<int> numbers_;  // of its vertices, in a table
  std::vector<double> times_;
  std::vector<std::shared_ptr<const std::vector<Point>>> positions_;  // at each time, the user's order
  std::unordered_map<Point, int, Hash> vertex_at_;
};

}  // namespace kinemesh
