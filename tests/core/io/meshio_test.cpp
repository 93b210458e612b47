// Our writers against a reader, and our readers against writers, that we did not write: meshio.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>

#include "core/io/atomic_file.h"
#include "kinemesh/vtu.h"
#include "tests/core/io/meshes.h"

namespace kinemesh {
namespace {

const std::string python = "/usr/bin/python3";

bool has_meshio() {
  return std::system((python + " -c 'import meshio' >/dev/null 2>&1").c_str()) == 0;
}

// What meshio saw, coordinates with their z.
struct Seen {
  std::vector<std::array<double, 3>> points;
  std::vector<Triangle> triangles;
  std::vector<Edge> lines;
  std::map<std::string, std::vector<double>> point_data, cell_data, field_data;
};

double hexadecimal(std::istream& in) {
  std::string word;
  in >> word;
  return std::strtod(word.c_str(), nullptr);
}

std::vector<double> values(std::istream& in) {
  std::size_t n = 0;
  in >> n;
  std::vector<double> result(n);
  for (double& x : result) x = hexadecimal(in);
  return result;
}

template <class Cell>
void read_cells(std::istream& in, std::size_t n, std::vector<Cell>& cells) {
  for (; n > 0; --n) {
    Cell cell;
    for (int& v : cell) in >> v;
    cells.push_back(cell);
  }
}

Seen seen_in(const std::string& text) {
  std::istringstream in(text);
  Seen seen;
  std::string kind, name;
  std::size_t n = 0;
  while (in >> kind) {
    if (kind == "points") {
      in >> n;
      for (; n > 0; --n) {
        const double x = hexadecimal(in), y = hexadecimal(in);
        seen.points.push_back({x, y, hexadecimal(in)});
      }
    } else if (kind == "cells") {
      in >> name >> n;
      name == "line" ? read_cells(in, n, seen.lines) : read_cells(in, n, seen.triangles);
    } else {
      in >> name;
      auto& data = kind == "point_data"  ? seen.point_data
                   : kind == "cell_data" ? seen.cell_data
                                         : seen.field_data;
      data[name] = values(in);
    }
  }
  return seen;
}

class Meshio : public TemporaryFolder {
 protected:
  void SetUp() override {
    if (!has_meshio()) GTEST_SKIP() << python << " does not know meshio (package python3-meshio)";
  }

  ::testing::AssertionResult run(const std::string& arguments) const {
    const std::string script = std::string(KINEMESH_SOURCE_DIR) + "/tests/core/io/read_with_meshio.py ";
    const std::string command =
        python + " " + script + arguments + " >" + output() + " 2>" + (folder() / "err").string();
    if (std::system(command.c_str()) == 0) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << command << "\n" << read_file(folder() / "err");
  }

  Seen read_with_meshio(const std::filesystem::path& path) const {
    EXPECT_TRUE(run(path.string()));
    return seen_in(read_file(output()));
  }

  std::string output() const { return (folder() / "out").string(); }
};

// Equal bits, or for -0 at least equal values: meshio's text readers may drop the sign.
void expect_same_shape(const Seen& seen, const MeshData& mesh) {
  ASSERT_EQ(seen.points.size(), mesh.points.size());
  for (std::size_t i = 0; i < seen.points.size(); ++i) {
    EXPECT_EQ(seen.points[i][0], mesh.points[i].x) << i;
    EXPECT_EQ(seen.points[i][1], mesh.points[i].y) << i;
    EXPECT_EQ(seen.points[i][2], 0.0) << i;
  }
  EXPECT_EQ(seen.triangles, mesh.triangles);
}

std::vector<double> as_doubles(const std::vector<Edge>& edges) {
  std::vector<double> numbers;
  for (const Edge& e : edges) numbers.insert(numbers.end(), e.begin(), e.end());
  return numbers;
}

// meshio 5.0 fails on SU2 files that have one.
MeshData without_empty_markers(MeshData mesh) {
  std::erase_if(mesh.markers, [](const Marker& m) { return m.edges.empty(); });
  return mesh;
}

TEST_F(Meshio, ReadsOurTextFormats) {
  for (const char* name : {"a.off", "a.obj", "a.ply", "a.su2", "a.msh"}) {
    SCOPED_TRACE(name);
    const MeshData mesh = without_empty_markers(random_mesh(3));
    write_mesh(folder() / name, mesh);
    expect_same_shape(read_with_meshio(folder() / name), mesh);
  }
}

TEST_F(Meshio, ReadsOurMarkersAndLabels) {
  const MeshData mesh = square();
  write_mesh(folder() / "a.msh", mesh);
  const Seen gmsh = read_with_meshio(folder() / "a.msh");
  EXPECT_THAT(gmsh.lines, ::testing::ElementsAre(Edge{0, 1}, Edge{1, 2}, Edge{2, 3}, Edge{3, 0}));
  EXPECT_THAT(gmsh.cell_data.at("gmsh:physical"), ::testing::ElementsAre(1, 2, 2, 2, 3, 0));
  EXPECT_THAT(gmsh.field_data.at("bottom"), ::testing::ElementsAre(1, 1));
  EXPECT_THAT(gmsh.field_data.at("inner"), ::testing::ElementsAre(3, 2));
  write_mesh(folder() / "a.su2", without_empty_markers(mesh));
  EXPECT_EQ(read_with_meshio(folder() / "a.su2").lines.size(), 4u);
}

void expect_same_fields(const Seen& seen, const MeshData& mesh, const VtuFields& fields) {
  expect_same_shape(seen, mesh);
  std::vector<double> labels;
  for (int i = 0; i < mesh.n_faces(); ++i) labels.push_back(mesh.label(i));
  EXPECT_EQ(seen.cell_data.at("label"), labels);
  EXPECT_EQ(seen.cell_data.at("replaced"),
            std::vector<double>(fields.replaced.begin(), fields.replaced.end()));
  EXPECT_EQ(seen.cell_data.at("region"), std::vector<double>(fields.region.begin(), fields.region.end()));
  EXPECT_THAT(seen.field_data.at("TimeValue"), ::testing::ElementsAre(*fields.time));
  std::vector<double> displacement;
  for (const Point& d : fields.displacement) displacement.insert(displacement.end(), {d.x, d.y, 0.0});
  EXPECT_EQ(seen.point_data.at("displacement"), displacement);
  for (const Marker& marker : mesh.markers) {
    std::string name = "marker:" + marker.name;
    std::replace(name.begin(), name.end(), ' ', '_');
    EXPECT_EQ(seen.field_data.at(name), as_doubles(marker.edges)) << name;
  }
}

TEST_F(Meshio, ReadsOurVtuWithAllFields) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const MeshData mesh = seed == 0 ? square() : random_mesh(seed);
    std::vector<int> region(mesh.triangles.size(), none);
    std::vector<std::uint8_t> replaced(mesh.triangles.size(), 0);
    region.back() = 7;
    replaced.back() = 1;
    const VtuFields fields{.time = 0.1, .displacement = mesh.points, .replaced = replaced, .region = region};
    write_vtu(folder() / "a.vtu", mesh, fields);
    expect_same_fields(read_with_meshio(folder() / "a.vtu"), mesh, fields);
  }
}

// One triangle with its centre: with 4-byte integers throughout, meshio takes the offset it gave one array
// for that of another.
TEST_F(Meshio, IsNotConfusedByOffsetsThatCoincide) {
  for (int n_isolated = 0; n_isolated < 12; ++n_isolated) {
    MeshData mesh;
    mesh.points = {{0, 0}, {4, 0}, {0, 4}, {1, 1}};
    mesh.points.resize(4 + static_cast<std::size_t>(n_isolated), Point(9, 9));
    mesh.triangles = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    const std::vector<std::uint8_t> replaced{0, 1, 0};
    const std::vector<int> region{-1, 2, -1};
    const VtuFields fields{.time = 1.0, .displacement = mesh.points, .replaced = replaced, .region = region};
    write_vtu(folder() / "a.vtu", mesh, fields);
    expect_same_fields(read_with_meshio(folder() / "a.vtu"), mesh, fields);
  }
}

struct Writer {
  const char *file, *format, *options;
};

TEST_F(Meshio, WritesFilesWeRead) {
  const MeshData mesh = as_kept(random_mesh(11), Format::Off);
  write_mesh(folder() / "in.vtu", mesh);
  for (const Writer& writer :
       {Writer{"a.vtu", "vtu", ""}, Writer{"a.vtu", "vtu", "compression=None"},
        Writer{"a.vtu", "vtu", "header_type=UInt64"}, Writer{"a.msh", "gmsh22", "binary=False"},
        Writer{"a.msh", "gmsh", "binary=False"}, Writer{"a.ply", "ply", "binary=False"},
        Writer{"a.off", "off", ""}, Writer{"a.obj", "obj", ""}}) {
    SCOPED_TRACE(std::string(writer.format) + " " + writer.options);
    const std::filesystem::path out = folder() / writer.file;
    ASSERT_TRUE(run((folder() / "in.vtu").string() + " " + out.string() + " " + writer.format + " " +
                    writer.options));
    EXPECT_TRUE(same(mesh, read_mesh(out).mesh, Format::Off));
  }
}

TEST_F(Meshio, WritesAsciiVtuWithTwelveDigits) {
  MeshData mesh = as_kept(square(), Format::Off);
  for (Point& p : mesh.points) p = {std::round(p.x * 1e6) / 1e6, std::round(p.y * 1e6) / 1e6};
  write_mesh(folder() / "in.vtu", mesh);
  ASSERT_TRUE(
      run((folder() / "in.vtu").string() + " " + (folder() / "a.vtu").string() + " vtu binary=False"));
  EXPECT_TRUE(same(mesh, read_mesh(folder() / "a.vtu").mesh, Format::Off));
}

}  // namespace
}  // namespace kinemesh
