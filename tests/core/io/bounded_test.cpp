// What a file can make a reader do is in proportion to the file: memory by its size, time by its length,
// whatever its counts say and however often it names one thing.
#include <gmock/gmock.h>
#include <zlib.h>

#include <chrono>
#include <cstring>
#include <functional>

#include "kinemesh/shapes.h"
#include "tests/core/io/meshes.h"
#include "tests/fuzz/memory_meter.h"

namespace kinemesh {
namespace {

using ::testing::HasSubstr;

constexpr int many = 80'000;
constexpr std::size_t mebibyte = 1 << 20;

// What takes a tenth of it here; what is quadratic takes many times as long.
void expect_quick(const std::function<void()>& work) {
  const auto before = std::chrono::steady_clock::now();
  work();
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(5));
}

std::string error_of(const std::string& text, Format format) {
  try {
    parse(text, format);
    return "none";
  } catch (const InputError& error) {
    return error.what();
  }
}

// The error of a text that must be refused before it takes memory.
std::string error_without_memory(const std::string& text, Format format) {
  memory_meter::start();
  const std::string error = error_of(text, format);
  EXPECT_LT(memory_meter::peak(), 40 * text.size() + mebibyte) << error;
  return error;
}

template <class Number>
std::string bytes_of(const std::vector<Number>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)};
}

// A compressed block of VTK's: so many bytes, of which the first are given and the others 0.
std::string deflated(std::string bytes, std::size_t size = 0) {
  bytes.resize(std::max(size, bytes.size()), '\0');
  uLongf packed = ::compressBound(bytes.size());
  std::string out(packed, '\0');
  ::compress(reinterpret_cast<Bytef*>(out.data()), &packed, reinterpret_cast<const Bytef*>(bytes.data()),
             bytes.size());
  return bytes_of(std::vector<std::uint64_t>{1, bytes.size(), 0, packed}) + out.substr(0, packed);
}

std::string plain(const std::string& bytes) {
  return bytes_of(std::vector<std::uint64_t>{bytes.size()}) + bytes;
}

// One face, with an array of one's own appended.
struct AppendedFile {
  bool is_compressed = true;
  std::string points = "format=\"ascii\">0 0 0 1 0 0 0 1 0</DataArray>";
  std::string connectivity = "format=\"ascii\">0 1 2</DataArray>";
  std::string offsets = "format=\"ascii\">3</DataArray>";
  std::string types = "format=\"ascii\">5</DataArray>";
  std::string label = "format=\"ascii\">7</DataArray>";
  std::string fields;
  std::string data;  // appended

  std::string text() const {
    const std::string begin = "<DataArray type=\"UInt8\" Name=\"";
    return std::string(
               "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\" header_type=\"UInt64\"") +
           (is_compressed ? " compressor=\"vtkZLibDataCompressor\"" : "") +
           ">\n<UnstructuredGrid>\n<FieldData>" + fields +
           "</FieldData>\n<Piece NumberOfPoints=\"3\" NumberOfCells=\"1\">\n<Points>\n"
           "<DataArray type=\"Float64\" NumberOfComponents=\"3\" " +
           points + "\n</Points><Cells>\n" + begin + "connectivity\" " + connectivity + "\n" + begin +
           "offsets\" " + offsets + "\n" + begin + "types\" " + types + "\n</Cells><CellData>\n" + begin +
           "label\" " + label +
           "\n</CellData></Piece></UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_" + data +
           "\n</AppendedData>\n</VTKFile>\n";
  }
};

const std::string appended = "format=\"appended\" offset=\"0\"/>";

std::string field(const std::string& name, const std::string& rest) {
  return "<DataArray type=\"UInt8\" Name=\"" + name + "\" " + rest;
}

TEST(Bounded, CompressedArraysAreInflatedOnlyIfTheCountsNeedThem) {
  const std::string bomb = deflated({}, 16 * mebibyte);
  for (std::string AppendedFile::*array :
       {&AppendedFile::points, &AppendedFile::connectivity, &AppendedFile::offsets, &AppendedFile::types,
        &AppendedFile::label}) {
    AppendedFile file;
    file.*array = appended;
    file.data = bomb;
    EXPECT_THAT(error_without_memory(file.text(), Format::Vtu),
                HasSubstr("16777216 bytes of data, expected no more than "));
  }
}

TEST(Bounded, CompressedFieldsAreInflatedOnlyIfTheCountsNeedThem) {
  const std::string bomb = deflated({}, 16 * mebibyte);
  for (const char* name : {"marker:a", "label_name:a"}) {
    for (const char* counts : {"", "NumberOfTuples=\"2\" ", "NumberOfTuples=\"1\" NumberOfComponents=\"2\" ",
                               "NumberOfTuples=\"-1\" ", "NumberOfTuples=\"2\" NumberOfComponents=\"-1\" "}) {
      AppendedFile file;
      file.fields = field(name, counts + appended);
      file.data = bomb;
      EXPECT_THAT(error_without_memory(file.text(), Format::Vtu),
                  HasSubstr("16777216 bytes of data, expected"))
          << counts;
    }
  }
}

TEST(Bounded, InlineArraysAreInflatedOnlyIfTheCountsNeedThem) {
  // One block of 1000 bytes, of which three would do.
  AppendedFile file;
  file.connectivity =
      "format=\"binary\">AQAAAAAAAADoAwAAAAAAAAAAAAAAAAAAEQAAAAAAAAA=eJxjYBgFo2AUDHcAAAPoAAE=</DataArray>";
  EXPECT_THAT(error_of(file.text(), Format::Vtu), HasSubstr("1000 bytes of data, expected no more than 3"));
}

TEST(Bounded, ArraysAtOneOffsetAreReadOnce) {
  for (const bool is_compressed : {true, false}) {
    AppendedFile file;
    file.is_compressed = is_compressed;
    file.data = is_compressed ? deflated({"\0\1", 2}) : plain({"\0\1", 2});
    for (int i = 0; i < 1000; ++i) file.fields += field("marker:" + std::to_string(i), appended);
    const MeshData mesh = parse(file.text(), Format::Vtu).mesh;
    ASSERT_EQ(mesh.markers.size(), 1000u);
    for (const Marker& marker : mesh.markers) EXPECT_EQ(marker.edges, (std::vector<Edge>{{0, 1}}));
  }
}

TEST(Bounded, ArraysThatRepeatALongOneAreRefused) {
  std::string ends;
  for (int i = 0; i < 50'000; ++i) ends += {0, 1};
  for (const bool is_compressed : {true, false}) {
    AppendedFile file;
    file.is_compressed = is_compressed;
    file.data = is_compressed ? deflated(ends) : plain(ends);
    for (int i = 0; i < 5000; ++i)
      file.fields += field("marker:" + std::to_string(i), "NumberOfTuples=\"100000\" " + appended);
    const std::string text = file.text();
    expect_quick([&] {
      EXPECT_THAT(error_without_memory(text, Format::Vtu), HasSubstr("too many arrays share their data"));
    });
  }
}

TEST(Bounded, ArraysThatOverlapAreRefused) {
  constexpr std::uint64_t n = 4000;
  AppendedFile file;
  file.is_compressed = false;
  for (std::uint64_t i = 0; i < n; ++i) {
    file.data += bytes_of(std::vector<std::uint64_t>{8 * (n - 1 - i)});  // each with all that follow
    file.fields += field("marker:" + std::to_string(i),
                         "format=\"appended\" offset=\"" + std::to_string(8 * i) + "\"/>");
  }
  file.data.append(8, '\0');
  EXPECT_THAT(error_without_memory(file.text(), Format::Vtu),
              HasSubstr("arrays overlap in the appended data"));
}

TEST(Bounded, ALongNameOfManyLabelsIsRefused) {
  AppendedFile file;
  std::string labels;
  for (int i = 0; i < 200; ++i) labels += std::to_string(i) + " ";
  file.fields =
      field("label_name:" + std::string(100'000, 'a'), "format=\"ascii\">" + labels + "</DataArray>");
  EXPECT_THAT(error_without_memory(file.text(), Format::Vtu), HasSubstr("expected one array for each label"));
}

const std::string gmsh_head = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
const std::string gmsh_nodes = "$Nodes\n1 3 1 3\n2 1 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n";

std::string curve_in_groups(int n_groups) {
  std::string entities = "$Entities\n0 1 0 0\n1 0 0 0 1 1 0 " + std::to_string(n_groups);
  for (int i = 1; i <= n_groups; ++i) entities += " " + std::to_string(i);
  return entities + " 0\n$EndEntities\n";
}

std::string lines_and_a_face(int n_lines) {
  std::string elements =
      "$Elements\n2 " + std::to_string(n_lines + 1) + " 1 1\n1 1 1 " + std::to_string(n_lines) + "\n";
  for (int i = 0; i < n_lines; ++i) elements += "1 1 2\n";
  return elements + "2 1 2 1\n1 1 2 3\n$EndElements\n";
}

TEST(Bounded, LinesInManyGroupsAreRefused) {
  EXPECT_EQ(parse(gmsh_head + curve_in_groups(9) + gmsh_nodes + lines_and_a_face(2), Format::Gmsh)
                .mesh.markers.size(),
            9u);
  const std::string text = gmsh_head + curve_in_groups(5000) + gmsh_nodes + lines_and_a_face(5000);
  EXPECT_THAT(
      error_without_memory(text, Format::Gmsh),
      HasSubstr("lines in several physical groups make more edges of markers than the file has bytes"));
}

TEST(Bounded, ManyBlocksOfACurveInManyGroupsAreQuick) {
  std::string text =
      gmsh_head + curve_in_groups(many) + gmsh_nodes + "$Elements\n" + std::to_string(many + 1) + " 1 1 1\n";
  for (int i = 0; i < many; ++i) text += "1 1 1 0\n";
  text += "2 1 2 1\n1 1 2 3\n$EndElements\n";
  expect_quick([&] { EXPECT_EQ(parse(text, Format::Gmsh).mesh.n_faces(), 1); });
}

// Every marker has one edge, the same one.
MeshData many_markers() {
  MeshData mesh = make_grid(1, 1);
  mesh.markers.clear();
  for (int i = 0; i < many; ++i) mesh.markers.push_back({"wall " + std::to_string(i), {{0, 1}}});
  for (int i = 0; i < many; ++i) mesh.label_names[i] = "body " + std::to_string(i);
  return mesh;
}

TEST(Bounded, ManyNamesAreReadInTheirOrder) {
  const MeshData mesh = many_markers();
  for (const Format format : {Format::Su2, Format::Gmsh, Format::Vtu}) {
    expect_quick([&] { EXPECT_TRUE(same(parse(format_mesh(mesh, format), format).mesh, mesh, format)); });
  }
}

TEST(Bounded, ManyNamelessGroupsAreQuick) {
  const std::string text = gmsh_head + curve_in_groups(many) + gmsh_nodes + lines_and_a_face(1);
  expect_quick([&] {
    const auto markers = parse(text, Format::Gmsh).mesh.markers;
    ASSERT_EQ(markers.size(), static_cast<std::size_t>(many));
    EXPECT_EQ(markers.back().name, std::to_string(many));
  });
}

TEST(Bounded, ManyGroupsOfAnObjAreQuick) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  for (int i = 0; i < many; ++i) text += "g group" + std::to_string(i) + "\n";
  expect_quick([&] { EXPECT_EQ(parse(text, Format::Obj).mesh.n_faces(), 1); });
}

const std::string ply_end = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

TEST(Bounded, ManyPlyElementsAreQuick) {
  std::string head = "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n";
  std::string more;
  for (int i = 0; i < many; ++i) more += "element e" + std::to_string(i) + " 1\nproperty int a\n";
  std::string values = "3 0 1 2\n";
  for (int i = 0; i < many; ++i) values += "7\n";
  const std::string text = head + "element face 1\nproperty list uchar int vertex_indices\n" + more +
                           "end_header\n0 0\n1 0\n0 1\n" + values;
  expect_quick([&] { EXPECT_EQ(parse(text, Format::Ply).mesh.n_vertices(), 3); });
}

TEST(Bounded, ManyPlyPropertiesAreQuick) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n";
  for (int i = 0; i < many; ++i) text += "property int p" + std::to_string(i) + "\n";
  text += ply_end;
  for (const char* place : {"0 0", "1 0", "0 1"}) {
    text += place;
    for (int i = 0; i < many; ++i) text += " 7";
    text += "\n";
  }
  expect_quick([&] { EXPECT_EQ(parse(text + "3 0 1 2\n", Format::Ply).mesh.n_vertices(), 3); });
}

TEST(Bounded, ManyVtuArraysAreQuick) {
  AppendedFile file;
  for (int i = 0; i < many; ++i)
    file.fields += "\n" + field("marker:" + std::to_string(i), "format=\"ascii\">0 1</DataArray>");
  expect_quick([&] { EXPECT_EQ(parse(file.text(), Format::Vtu).mesh.markers.size(), std::size_t{many}); });
  file.fields = {};
  for (int i = 0; i < many; ++i) file.label += "\n" + field("a" + std::to_string(i), appended);
  expect_quick([&] { EXPECT_EQ(parse(file.text(), Format::Vtu).mesh.n_faces(), 1); });
}

TEST(Bounded, DeepXmlIsQuick) {
  std::string text;
  for (int i = 0; i < many; ++i) text += "<a>";
  expect_quick([&] { EXPECT_THAT(error_of(text, Format::Vtu), HasSubstr("not well-formed XML")); });
  for (int i = 0; i < many; ++i) text += "</a>";
  expect_quick([&] { EXPECT_THAT(error_of(text, Format::Vtu), HasSubstr("no element VTKFile")); });
}

// Numbers that are counts, and more of them than the file can hold.
TEST(Bounded, CountsTakeNoMemoryBeforeTheFileProvesThem) {
  const std::vector<std::pair<Format, std::string>> heads{
      {Format::Off, "OFF\n200000000 1 0\n"},
      {Format::Off, "OFF\n1 200000000 0\n"},
      {Format::Ply,
       "ply\nformat ascii 1.0\nelement vertex 200000000\nproperty double x\nproperty double y\n" + ply_end},
      {Format::Su2, "NDIME= 2\nNELEM= 200000000\n"},
      {Format::Su2, "NDIME= 2\nNPOIN= 200000000\n"},
      {Format::Gmsh, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n200000000\n"},
      {Format::Gmsh, gmsh_head + "$Nodes\n1 200000000 1 200000000\n"},
      {Format::Gmsh, gmsh_head + gmsh_nodes + "$Elements\n1 200000000 1 1\n1 1 1 200000000\n"}};
  for (const auto& [format, text] : heads)
    EXPECT_THAT(error_without_memory(text, format), HasSubstr("more than the rest of the file can hold"));
}

// The dearest texts per byte: short lines, one vertex with all faces.
TEST(Bounded, MemoryOfReadingIsInProportion) {
  std::string faces;
  constexpr int n = 100'000;
  for (int i = 2; i < n; ++i) faces += "3 0 " + std::to_string(i - 1) + " " + std::to_string(i) + "\n";
  std::string off = "OFF\n" + std::to_string(n) + " " + std::to_string(n - 2) + " 0\n0 0 0\n";
  for (int i = 1; i < n; ++i) off += "1 " + std::to_string(i) + " 0\n";
  const std::string text = off + faces;
  memory_meter::start();
  EXPECT_EQ(parse(text, Format::Off).mesh.n_faces(), n - 2);
  EXPECT_LT(memory_meter::peak(), 40 * text.size());
}

}  // namespace
}  // namespace kinemesh
