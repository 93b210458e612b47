// Names of markers and labels with any byte in them: what is written reads back as it was, or is refused.
#include <gtest/gtest.h>

#include "core/base/printable.h"
#include "core/base/utf8.h"
#include "kinemesh/error.h"
#include "tests/core/io/meshes.h"

namespace kinemesh {
namespace {

constexpr Format keeping[] = {Format::Su2, Format::Gmsh, Format::Vtu};

std::string content_with(const std::string& name, Format format) {
  MeshData mesh = square();
  mesh.markers.front().name = name;
  if (format != Format::Su2) mesh.label_names = {{mesh.labels.front(), name}};
  return format_mesh(mesh, format);
}

void expect_kept_or_refused(const std::string& name) {
  for (const Format format : keeping) {
    SCOPED_TRACE(printable(name) + " in format " + std::to_string(static_cast<int>(format)));
    std::string content;
    try {
      content = content_with(name, format);
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()), "");
      continue;
    }
    const MeshData mesh = parse(content, format).mesh;
    const bool is_changed = format == Format::Vtu && !is_utf8(name);  // XML is UTF-8: taken for Latin-1
    ASSERT_EQ(mesh.markers.size(), square().markers.size());
    EXPECT_TRUE(is_changed || mesh.markers.front().name == name) << printable(mesh.markers.front().name);
  }
}

TEST(Names, WithAnyByteAreKeptOrRefused) {
  for (int byte = 0; byte < 256; ++byte) {
    const std::string one(1, static_cast<char>(byte));
    for (const std::string& name : {one, "a" + one + "b", one + "b", "a" + one}) expect_kept_or_refused(name);
  }
}

TEST(Names, WithMarkupAreKeptOrRefused) {
  for (const char* name : {"<b>",
                           "]]>",
                           "&amp;",
                           "&#0;",
                           "\"",
                           "'",
                           "a\"b",
                           "\\",
                           "%",
                           "$EndPhysicalNames",
                           "MARKER_TAG= x",
                           "marker:",
                           "\xe2\x80\xa8",
                           "\xe2\x80\xae",
                           "\xef\xbf\xbe",
                           "\xef\xbf\xbf",
                           "\xc2\x85",
                           "",
                           " ",
                           "a ",
                           " a"})
    expect_kept_or_refused(name);
}

TEST(Names, ThatXmlHasNoPlaceForAreRefused) {
  for (const char* name : {"a\xef\xbf\xbe", "\xef\xbf\xbf"})
    EXPECT_THROW(content_with(name, Format::Vtu), InputError);
}

}  // namespace
}  // namespace kinemesh
