#include "tests/core/io/meshes.h"

#include <unistd.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "kinemesh/orient.h"

namespace kinemesh {
namespace {

using Random = std::mt19937_64;

int pick(Random& random, int below) {
  return static_cast<int>(random() % static_cast<unsigned>(below));
}

double random_coordinate(Random& random) {
  constexpr double special[] = {0.0,
                                -0.0,
                                0.1,
                                1.0 / 3,
                                -1e-300,
                                5e-324,
                                -2.2250738585072014e-308,
                                1e300,
                                -1e308,
                                1e16 + 2,
                                123456789.123456789,
                                1.7976931348623157e308};
  switch (pick(random, 4)) {
    case 0:
      return special[pick(random, std::size(special))];
    case 1:
      return pick(random, 9) - 4;
    case 2:
      return std::uniform_real_distribution<double>(-1, 1)(random);
    default:
      break;
  }
  const double any = std::bit_cast<double>(random());
  return std::isfinite(any) ? any : 1.0;
}

void add_faces(MeshData& mesh, Random& random, int columns, int rows) {
  for (int j = 0; j + 1 < rows; ++j) {
    for (int i = 0; i + 1 < columns; ++i) {
      const int v = j * columns + i;
      if (pick(random, 8) > 0) mesh.triangles.push_back({v, v + 1, v + columns});
      if (pick(random, 8) > 0) mesh.triangles.push_back({v + columns, v + 1, v + columns + 1});
    }
  }
  if (mesh.triangles.empty()) mesh.triangles.push_back({0, 1, columns});
  for (Triangle& t : mesh.triangles) {
    std::rotate(t.begin(), t.begin() + pick(random, 3), t.end());
    if (pick(random, 4) == 0) std::swap(t[1], t[2]);
  }
}

void add_labels(MeshData& mesh, Random& random) {
  if (pick(random, 3) == 0) return;
  mesh.labels.resize(mesh.triangles.size());
  for (int& label : mesh.labels) {
    label = pick(random, 4);
    if (pick(random, 9) == 0) label = std::max(static_cast<int>(random()), padding_label + 1);
  }
  if (pick(random, 2) == 0) mesh.label_names[1] = "steel & \xC3\xA4ther";
  if (pick(random, 2) == 0) mesh.label_names[-7] = "<nowhere>";
}

void add_markers(MeshData& mesh, Random& random) {
  for (const char* name : {"airfoil", "far field", "a=b & <c>", "7"}) {
    if (pick(random, 2) == 0) continue;
    mesh.markers.push_back({name, {}});
    for (int n = pick(random, 4); n > 0; --n) {
      const int a = pick(random, mesh.n_vertices()), b = pick(random, mesh.n_vertices());
      if (a != b) mesh.markers.back().edges.push_back({a, b});
    }
  }
}

std::string at(const char* what, std::size_t i) {
  return std::string(what) + " " + std::to_string(i) + " differs";
}

bool same_bits(const Point& a, const Point& b) {
  return std::bit_cast<std::uint64_t>(a.x) == std::bit_cast<std::uint64_t>(b.x) &&
         std::bit_cast<std::uint64_t>(a.y) == std::bit_cast<std::uint64_t>(b.y);
}

::testing::AssertionResult same_shape(const MeshData& a, const MeshData& b) {
  if (a.points.size() != b.points.size()) return ::testing::AssertionFailure() << "numbers of points differ";
  if (a.triangles.size() != b.triangles.size())
    return ::testing::AssertionFailure() << "numbers of faces differ";
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    if (!same_bits(a.points[i], b.points[i])) return ::testing::AssertionFailure() << at("point", i);
  }
  for (std::size_t i = 0; i < a.triangles.size(); ++i) {
    if (a.triangles[i] != b.triangles[i]) return ::testing::AssertionFailure() << at("face", i);
  }
  return ::testing::AssertionSuccess();
}

::testing::AssertionResult same_labels(const MeshData& a, const MeshData& b) {
  for (int i = 0; i < a.n_faces(); ++i) {
    if (a.label(i) != b.label(i)) return ::testing::AssertionFailure() << at("label", i);
  }
  if (a.label_names != b.label_names) return ::testing::AssertionFailure() << "names of labels differ";
  return ::testing::AssertionSuccess();
}

::testing::AssertionResult same_markers(const MeshData& a, const MeshData& b) {
  if (a.markers.size() != b.markers.size())
    return ::testing::AssertionFailure() << "numbers of markers differ";
  for (std::size_t i = 0; i < a.markers.size(); ++i) {
    if (a.markers[i].name != b.markers[i].name)
      return ::testing::AssertionFailure() << at("marker's name", i);
    if (a.markers[i].edges != b.markers[i].edges) return ::testing::AssertionFailure() << at("marker", i);
  }
  return ::testing::AssertionSuccess();
}

}  // namespace

MeshData square() {
  MeshData mesh;
  mesh.points = {{0.1, -0.0}, {1.0 / 3 + 1, 1e-17}, {1, 1 + 0x1p-52}, {5e-324, 0.7}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.labels = {3, 0};
  mesh.label_names = {{3, "inner"}};
  mesh.markers = {{"bottom", {{0, 1}}}, {"rest", {{1, 2}, {2, 3}, {3, 0}}}, {"empty", {}}};
  return mesh;
}

MeshData random_mesh(std::uint64_t seed) {
  Random random(seed);
  MeshData mesh;
  const int columns = 2 + pick(random, 6), rows = 2 + pick(random, 6);
  for (int i = 0; i < columns * rows; ++i) {
    const double x = random_coordinate(random), y = random_coordinate(random);
    mesh.points.emplace_back(x, y);
  }
  add_faces(mesh, random, columns, rows);
  add_labels(mesh, random);
  add_markers(mesh, random);
  make_consistent(mesh);
  return mesh;
}

::testing::AssertionResult same(const MeshData& a, const MeshData& b, Format keeping) {
  if (const auto result = same_shape(a, b); !result) return result;
  if (const auto result = same_labels(as_kept(a, keeping), as_kept(b, keeping)); !result) return result;
  return same_markers(as_kept(a, keeping), as_kept(b, keeping));
}

MeshData as_kept(MeshData mesh, Format format) {
  if (!keeps_labels(format)) mesh.labels.clear();
  if (!keeps_labels(format)) mesh.label_names.clear();
  if (!keeps_markers(format)) mesh.markers.clear();
  return mesh;
}

ReadResult parse(std::string_view text, Format format, bool split_quads) {
  return parse_mesh(text, format, "test", {.split_quads = split_quads});
}

void expect_refused(std::string_view text, Format format, int line, std::string_view what, bool split_quads) {
  try {
    parse(text, format, split_quads);
    ADD_FAILURE() << "not refused:\n" << text;
  } catch (const InputError& error) {
    const std::string message = error.what();
    const std::string place = line > 0 ? "test:" + std::to_string(line) + ": " : "test: ";
    EXPECT_TRUE(message.starts_with(place)) << message << "\nfor\n" << text;
    EXPECT_NE(message.find(what), std::string::npos) << message << "\nlacks " << what << "\nfor\n" << text;
    EXPECT_EQ(error.line(), line);
  }
}

TemporaryFolder::TemporaryFolder() {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  folder_ = std::filesystem::temp_directory_path() /
            ("kinemesh-" + std::to_string(::getpid()) + "-" + test->test_suite_name() + "-" + test->name());
  std::filesystem::create_directories(folder_);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

}  // namespace kinemesh
