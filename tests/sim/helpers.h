// Meshes, folders and tables the tests of sim/ share.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "kinemesh/mesh.h"
#include "kinemesh/mesh_data.h"

namespace kinemesh::test {

// n x n squares on [0,1]^2, each cut by its rising diagonal; markers bottom, right, top, left. Vertex (i, j)
// has the number j (n + 1) + i.
MeshData grid(int n);

// The same with the squares whose lower left corner is in [from, to) x [from, to) left out: a hole with
// marker "hole".
MeshData grid_with_hole(int n, int from, int to);

// Everything about a mesh that a step may change, for bitwise comparison.
struct Snapshot {
  std::vector<Point> positions;
  std::vector<MeshTriangle> triangles;
  std::vector<int> labels;
  std::vector<int> sides;       // opposite and constraint of each
  std::vector<UserFace> faces;  // user's number of each
  bool operator==(const Snapshot&) const = default;
};
Snapshot snapshot(const Mesh& mesh);

inline Triangle numbers_of(const std::array<UserVertex, 3>& t) {
  return {t[0], t[1], t[2]};
}

// Removed with all its files at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }
  void write(const std::string& name, const std::string& content) const;
  std::vector<std::string> names() const;  // of the files, sorted

 private:
  std::filesystem::path path_;
};

std::string content_of(const std::filesystem::path& file);

struct Csv {
  std::string header;
  std::vector<std::map<std::string, std::string>> rows;
  double sum(const std::string& column) const;
  double number(size_t row, const std::string& column) const { return std::stod(rows.at(row).at(column)); }
};
Csv read_csv(const std::filesystem::path& file);

// A CSV text without the columns whose names end in _ms.
std::string without_times(const std::string& csv);

// Name and content of all that a run writes and that has to be the same however often it was interrupted: all
// files but run.json and checkpoints, times left out of steps.csv.
std::map<std::string, std::string> results_in(const std::filesystem::path& directory);

}  // namespace kinemesh::test
