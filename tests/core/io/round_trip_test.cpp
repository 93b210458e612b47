#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <locale>

#include "core/io/atomic_file.h"
#include "kinemesh/svg.h"
#include "tests/core/io/meshes.h"

namespace kinemesh {
namespace {

using MeshFiles = TemporaryFolder;

constexpr Format all[] = {Format::Off, Format::Obj, Format::Ply, Format::Su2, Format::Gmsh, Format::Vtu};

std::string name_of(Format format) {
  const auto is_it = [&](const FormatInfo& f) { return f.format == format; };
  return std::string(std::find_if(formats().begin(), formats().end(), is_it)->extension);
}

TEST(RoundTrip, EveryFormatKeepsEveryBit) {
  for (Format format : all) {
    EXPECT_TRUE(rc::check(name_of(format), [format](std::uint64_t seed) {
      const MeshData mesh = random_mesh(seed);
      const ReadResult back = parse(format_mesh(mesh, format), format);
      RC_ASSERT(same(mesh, back.mesh, format));
      RC_ASSERT(back.notes.empty());
    }));
  }
}

TEST(RoundTrip, EveryPairOfFormatsKeepsWhatBothKeep) {
  for (Format first : all) {
    for (Format second : all) {
      EXPECT_TRUE(rc::check(name_of(first) + name_of(second), [=](std::uint64_t seed) {
        const MeshData mesh = as_kept(random_mesh(seed), first);
        const MeshData through = parse(format_mesh(mesh, first), first).mesh;
        RC_ASSERT(same(mesh, parse(format_mesh(through, second), second).mesh, second));
      }));
    }
  }
}

TEST(RoundTrip, WritingTwiceGivesTheSameBytes) {
  for (Format format : all) {
    EXPECT_TRUE(rc::check(name_of(format), [format](std::uint64_t seed) {
      const std::string text = format_mesh(random_mesh(seed), format);
      RC_ASSERT(format_mesh(parse(text, format).mesh, format) == text);
    }));
  }
}

TEST(RoundTrip, CarriageReturnsAndMissingLastLineEndsChangeNothing) {
  for (Format format : {Format::Off, Format::Obj, Format::Ply, Format::Su2, Format::Gmsh}) {
    const MeshData mesh = square();
    std::string text = format_mesh(mesh, format);
    EXPECT_TRUE(same(mesh, parse(text.substr(0, text.size() - 1), format).mesh, format)) << name_of(format);
    for (std::size_t i = 0; (i = text.find('\n', i)) != std::string::npos; i += 2) text.insert(i, 1, '\r');
    EXPECT_TRUE(same(mesh, parse(text, format).mesh, format)) << name_of(format);
    EXPECT_TRUE(same(mesh, parse("\xEF\xBB\xBF" + text, format).mesh, format)) << name_of(format);
  }
}

struct CommaForPoint : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(RoundTrip, LocaleDoesNotMatter) {
  const std::locale before = std::locale::global(std::locale(std::locale(), new CommaForPoint));
  for (Format format : all) {
    EXPECT_TRUE(same(square(), parse(format_mesh(square(), format), format).mesh, format)) << name_of(format);
  }
  EXPECT_EQ(format_svg(square()).find("0,0"), std::string::npos);
  std::locale::global(before);
}

TEST(RoundTrip, IsolatedVerticesKeepTheirNumbers) {
  MeshData mesh = square();
  mesh.points.insert(mesh.points.begin(), Point(7, 7));
  mesh.points.emplace_back(-7, 7);
  for (Triangle& t : mesh.triangles) {
    for (int& v : t) ++v;
  }
  mesh.markers.clear();
  for (Format format : all) {
    EXPECT_TRUE(same(mesh, parse(format_mesh(mesh, format), format).mesh, format)) << name_of(format);
  }
}

TEST_F(MeshFiles, FilesAreChosenByTheirExtension) {
  for (const FormatInfo& f : formats()) {
    const auto path = folder() / ("mesh" + std::string(f.extension));
    write_mesh(path, square());
    if (!f.can_read) continue;
    EXPECT_TRUE(same(square(), read_mesh(path).mesh, f.format)) << path;
    EXPECT_EQ(read_file(path), format_mesh(square(), f.format)) << path;
  }
  EXPECT_EQ(format_of("a/MESH.SU2"), Format::Su2);
  EXPECT_EQ(format_of("mesh.stl"), std::nullopt);
  EXPECT_EQ(format_of(".off"), std::nullopt);
}

void expect_error(const std::function<void()>& action, const std::string& what) {
  try {
    action();
    ADD_FAILURE() << "no error, expected " << what;
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr(what));
  }
}

TEST_F(MeshFiles, WhatIsNoMeshFileIsRefusedByName) {
  const std::string stl = (folder() / "mesh.stl").string(), none_at_all = (folder() / "mesh").string();
  expect_error([&] { read_mesh(stl); },
               stl + ": has the extension '.stl', expected one of .off .obj .ply .su2 .msh .vtu");
  expect_error([&] { write_mesh(none_at_all, square()); }, none_at_all + ": has no extension");
  expect_error([&] { read_mesh(folder() / "mesh.svg"); }, "extension '.svg'");
  expect_error([&] { read_mesh(folder() / "missing.off"); }, "missing.off: cannot be opened: No such file");
  std::filesystem::create_directory(folder() / "folder.off");
  expect_error([&] { read_mesh(folder() / "folder.off"); }, "folder.off: is a directory");
  write_file_atomically(folder() / "empty.off", "");
  expect_error([&] { read_mesh(folder() / "empty.off"); }, "empty.off: is empty");
  write_file_atomically(folder() / "line.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 oops\n3 0 1 2\n");
  expect_error([&] { read_mesh(folder() / "line.off"); }, "line.off:5: 'oops' is not a number");
}

TEST_F(MeshFiles, WhatNoReaderWouldTakeBackIsNotWritten) {
  const auto refused = [&](const std::string& what, Format format,
                           const std::function<void(MeshData&)>& spoil) {
    MeshData mesh = square();
    spoil(mesh);
    const auto path = folder() / ("mesh" + name_of(format));
    expect_error([&] { write_mesh(path, mesh); }, path.string() + ": " + what);
    EXPECT_TRUE(std::filesystem::is_empty(folder()));
  };
  refused("vertex 1 is not at a finite place", Format::Off, [](MeshData& m) { m.points[1].y = INFINITY; });
  refused("vertex 2 is not at a finite place", Format::Vtu, [](MeshData& m) { m.points[2].x = NAN; });
  refused("face 1: vertex 4 does not exist", Format::Obj, [](MeshData& m) { m.triangles[1][2] = 4; });
  refused("face 0: vertex -1 does not exist", Format::Ply, [](MeshData& m) { m.triangles[0][0] = -1; });
  refused("1 labels, expected 2", Format::Gmsh, [](MeshData& m) { m.labels.pop_back(); });
  refused("face 1 has the reserved label", Format::Gmsh, [](MeshData& m) { m.labels[1] = padding_label; });
  refused("marker bottom: vertex 9", Format::Su2, [](MeshData& m) { m.markers[0].edges[0][1] = 9; });
  refused("the name is empty", Format::Su2, [](MeshData& m) { m.markers[0].name = ""; });
  refused("the name 'a\\x0ab' has control characters", Format::Gmsh,
          [](MeshData& m) { m.markers[0].name = "a\nb"; });
  refused("marker '50%' cannot be named in SU2", Format::Su2, [](MeshData& m) { m.markers[0].name = "50%"; });
  refused("marker 'x ' cannot be named in SU2", Format::Su2, [](MeshData& m) { m.markers[0].name = "x "; });
  refused("the name 'a\"b' has quotes", Format::Gmsh, [](MeshData& m) { m.markers[0].name = "a\"b"; });
}

TEST(Formats, TellWhatTheyKeep) {
  for (Format format : all) {
    EXPECT_EQ(keeps_labels(format), format == Format::Gmsh || format == Format::Vtu);
    EXPECT_EQ(keeps_markers(format),
              format == Format::Su2 || format == Format::Gmsh || format == Format::Vtu);
  }
  EXPECT_EQ(formats().size(), 7u);
  for (const FormatInfo& f : formats()) EXPECT_EQ(format_of("x" + std::string(f.extension)), f.format);
}

}  // namespace
}  // namespace kinemesh
