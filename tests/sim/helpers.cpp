#include "tests/sim/helpers.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace kinemesh::test {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

}  // namespace

MeshData grid_with_hole(int n, int from, int to) {
  MeshData data;
  const auto vertex = [n](int i, int j) { return j * (n + 1) + i; };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      data.points.push_back({static_cast<double>(i) / n, static_cast<double>(j) / n});
  const auto in_hole = [&](int i, int j) { return from <= i && i < to && from <= j && j < to; };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      if (in_hole(i, j)) continue;
      data.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      data.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  data.markers = {{"bottom", {}}, {"right", {}}, {"top", {}}, {"left", {}}};
  for (int i = 0; i < n; ++i) {
    data.markers[0].edges.push_back({vertex(i, 0), vertex(i + 1, 0)});
    data.markers[1].edges.push_back({vertex(n, i), vertex(n, i + 1)});
    data.markers[2].edges.push_back({vertex(i + 1, n), vertex(i, n)});
    data.markers[3].edges.push_back({vertex(0, i + 1), vertex(0, i)});
  }
  if (from < to) data.markers.push_back({"hole", {}});
  for (int i = from; i < to; ++i) {
    data.markers[4].edges.push_back({vertex(i + 1, from), vertex(i, from)});
    data.markers[4].edges.push_back({vertex(to, i + 1), vertex(to, i)});
    data.markers[4].edges.push_back({vertex(i, to), vertex(i + 1, to)});
    data.markers[4].edges.push_back({vertex(from, i), vertex(from, i + 1)});
  }
  return data;
}

MeshData grid(int n) {
  return grid_with_hole(n, 0, 0);
}

Snapshot snapshot(const Mesh& mesh) {
  Snapshot s;
  s.positions.assign(mesh.positions().begin(), mesh.positions().end());
  s.triangles.assign(mesh.triangles().begin(), mesh.triangles().end());
  for (const Face f : mesh.faces()) s.labels.push_back(mesh.label(f));
  for (const Face f : mesh.faces()) {
    s.faces.push_back(mesh.user_face(f));
    for (const Side side : Mesh::sides(f))
      s.sides.insert(s.sides.end(), {mesh.opposite(side), mesh.constraint_of(side)});
  }
  return s;
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "kinemesh-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder " + name);
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

void TemporaryFolder::write(const std::string& name, const std::string& content) const {
  std::ofstream(path_ / name, std::ios::binary) << content;
}

std::vector<std::string> TemporaryFolder::names() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path_))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

double Csv::sum(const std::string& column) const {
  double total = 0.0;
  for (const auto& row : rows) total += std::stod(row.at(column));
  return total;
}

Csv read_csv(const std::filesystem::path& file) {
  std::istringstream in(content_of(file));
  Csv csv;
  std::getline(in, csv.header);
  const auto names = split(csv.header);
  for (std::string line; std::getline(in, line);) {
    const auto cells = split(line);
    if (cells.size() != names.size())
      throw std::runtime_error(file.string() + ": a row of another length: " + line);
    auto& row = csv.rows.emplace_back();
    for (size_t i = 0; i < names.size(); ++i) row[names[i]] = cells[i];
  }
  return csv;
}

std::string without_times(const std::string& csv) {
  std::istringstream lines(csv);
  std::string result, line;
  std::vector<std::string> names;
  while (std::getline(lines, line)) {
    const auto cells = split(line);
    if (names.empty()) names = cells;
    for (size_t i = 0; i < cells.size(); ++i)
      if (i >= names.size() || !names[i].ends_with("_ms")) result += cells[i] + ",";
    result += '\n';
  }
  return result;
}

std::map<std::string, std::string> results_in(const std::filesystem::path& directory) {
  std::map<std::string, std::string> results;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    const auto name = entry.path().filename().string();
    if (name != "run.json" && !name.starts_with("checkpoint")) results[name] = content_of(entry.path());
  }
  if (const auto steps = results.find("steps.csv"); steps != results.end())
    steps->second = without_times(steps->second);
  return results;
}

}  // namespace kinemesh::test
