#include "kinemesh/svg.h"

#include <gmock/gmock.h>

#include <limits>
#include <pugixml.hpp>

#include "core/io/atomic_file.h"
#include "tests/core/io/meshes.h"

namespace kinemesh {
namespace {

using SvgFiles = TemporaryFolder;

// A fan around the middle of the unit square; its middle vertex can be pushed out.
MeshData fan(Point middle) {
  MeshData mesh;
  mesh.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, middle};
  mesh.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  return mesh;
}

pugi::xml_document parsed(const std::string& svg) {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(svg.c_str())) << svg;
  return document;
}

// Number of sub-paths of the path whose `attribute` is `colour`.
std::ptrdiff_t pieces(const std::string& svg, const char* attribute, const char* colour) {
  const pugi::xml_document document = parsed(svg);
  const pugi::xml_node path =
      document.child("svg").child("g").find_child_by_attribute("path", attribute, colour);
  const std::string d = path.attribute("d").as_string();
  return std::count(d.begin(), d.end(), 'M');
}

constexpr const char *red = "#e02f36", *amber = "#ffcf5c", *dark = "#1d2733", *plain = "#7d8ea3",
                     *first = "#e6edf5", *second = "#dcebdf";

TEST(Svg, UprightFacesAreLightAndBordersDark) {
  const std::string svg = format_svg(fan({0.5, 0.5}));
  EXPECT_EQ(pieces(svg, "fill", first), 4);
  EXPECT_EQ(pieces(svg, "stroke", dark), 4);
  EXPECT_EQ(pieces(svg, "stroke", plain), 4);
  EXPECT_EQ(pieces(svg, "fill", red), 0);
  EXPECT_EQ(svg.find("<text"), std::string::npos);
}

TEST(Svg, InvertedFlatAndReplacedFacesAreMarked) {
  const std::vector<std::uint8_t> replaced{0, 1, 1, 0};
  const std::string inverted = format_svg(fan({0.5, -0.5}), {.replaced = replaced});
  EXPECT_EQ(pieces(inverted, "fill", red), 1);
  EXPECT_EQ(pieces(inverted, "fill", amber), 2);
  EXPECT_EQ(pieces(inverted, "fill", first), 1);
  EXPECT_THAT(inverted, ::testing::HasSubstr("1 inverted"));
  EXPECT_THAT(inverted, ::testing::HasSubstr("2 replaced"));
  const std::string flat = format_svg(fan({0.5, 0}));
  EXPECT_EQ(pieces(flat, "stroke", red), 1);
  EXPECT_EQ(pieces(flat, "fill", red), 0);
  EXPECT_THAT(flat, ::testing::HasSubstr("1 degenerate"));
}

TEST(Svg, InterfacesAndMarkersAreDark) {
  MeshData mesh = fan({0.5, 0.5});
  mesh.labels = {0, 0, 9, 9};
  mesh.markers = {{"spoke", {{1, 4}}}};
  const std::string svg = format_svg(mesh);
  EXPECT_EQ(pieces(svg, "fill", first), 2);
  EXPECT_EQ(pieces(svg, "fill", second), 2);
  EXPECT_EQ(pieces(svg, "stroke", dark), 4 + 2 + 1);
  EXPECT_EQ(pieces(svg, "stroke", plain), 1);
}

TEST(Svg, YPointsUp) {
  const std::string svg = format_svg(fan({0.5, 0.5}), {.width = 100, .view = ViewBox{{0, 0}, {1, 1}}});
  EXPECT_THAT(svg, ::testing::HasSubstr("M0 100L100 100L50 50Z"));
}

TEST(Svg, FacesOutsideTheViewAreLeftOut) {
  const std::string svg =
      format_svg(fan({0.5, 0.5}), {.width = 100, .view = ViewBox{{0.4, -0.1}, {0.6, 0.1}}});
  EXPECT_EQ(pieces(svg, "fill", first), 3);  // those whose box meets the view
  EXPECT_EQ(pieces(svg, "stroke", dark), 1);
}

TEST(Svg, TitlesAreText) {
  const std::string svg = format_svg(fan({0.5, 0.5}), {.title = "a < b & \"c\"\n\x01"});
  EXPECT_EQ(std::string(parsed(svg).child("svg").child("g").next_sibling("g").child("text").text().get()),
            "a < b & \"c\"\\n\\x01");
}

TEST(Svg, ExtremeCoordinatesStayOnThePage) {
  const double huge = std::numeric_limits<double>::max();
  MeshData mesh = fan({0, 0});
  mesh.points = {{-huge, -huge}, {huge, -huge}, {huge, huge}, {-huge, huge}, {0, 0}};
  const std::string svg = format_svg(mesh);
  EXPECT_EQ(pieces(svg, "fill", first), 4);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  for (Point& p : mesh.points) p = {3, 3};
  EXPECT_EQ(format_svg(mesh).find("nan"), std::string::npos);
  EXPECT_EQ(pieces(format_svg(random_mesh(1)), "stroke", "none"), 0);
}

TEST_F(SvgFiles, WrongOptionsAreRefused) {
  const std::vector<std::uint8_t> replaced{0, 1};
  const auto path = folder() / "a.svg";
  EXPECT_THROW(write_svg(path, fan({0.5, 0.5}), {.replaced = replaced}), InputError);
  EXPECT_THROW(write_svg(path, fan({0.5, 0.5}), {.width = 0}), InputError);
  EXPECT_THROW(write_svg(path, fan({0.5, 0.5}), {.view = ViewBox{{0, 0}, {0, 1}}}), InputError);
  write_svg(path, fan({0.5, 0.5}));
  EXPECT_EQ(read_file(path), format_svg(fan({0.5, 0.5})));
}

}  // namespace
}  // namespace kinemesh
