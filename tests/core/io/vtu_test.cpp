#include "kinemesh/vtu.h"

#include <gmock/gmock.h>
#include <rapidcheck.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "core/io/atomic_file.h"
#include "tests/core/io/meshes.h"

namespace kinemesh {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using VtuFiles = TemporaryFolder;

void refused(const std::string& text, int line, std::string_view what) {
  expect_refused(text, Format::Vtu, line, what);
}

struct File {
  std::string attributes = "type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\"";
  std::string field;
  std::string piece = "NumberOfPoints=\"3\" NumberOfCells=\"1\"";
  std::string points =
      R"(<DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray>)";
  std::string connectivity =
      R"(<DataArray type="Int32" Name="connectivity" format="ascii">0 1 2</DataArray>)";
  std::string offsets = R"(<DataArray type="Int32" Name="offsets" format="ascii">3</DataArray>)";
  std::string types = R"(<DataArray type="UInt8" Name="types" format="ascii">5</DataArray>)";
  std::string cell_data;

  // Points are in line 5, connectivity, offsets and types in 7 to 9, cell data in 11.
  std::string text() const {
    return "<VTKFile " + attributes + ">\n<UnstructuredGrid>" + field + "\n<Piece " + piece +
           ">\n<Points>\n" + points + "\n</Points><Cells>\n" + connectivity + "\n" + offsets + "\n" + types +
           "\n</Cells><CellData>\n" + cell_data + "\n</CellData></Piece></UnstructuredGrid></VTKFile>\n";
  }
};

MeshData read(const File& file) {
  return parse(file.text(), Format::Vtu).mesh;
}

TEST(Vtu, Ascii) {
  EXPECT_THAT(read({}).triangles, ElementsAre(Triangle{0, 1, 2}));
  File file;
  file.cell_data = R"(<DataArray type="Int64" Name="label" format="ascii"> -4 </DataArray>)";
  EXPECT_THAT(read(file).labels, ElementsAre(-4));
}

TEST(Vtu, LineAndVertexCellsAreLeftOutWithANote) {
  File file;
  file.piece = "NumberOfPoints=\"3\" NumberOfCells=\"3\"";
  file.connectivity =
      R"(<DataArray type="Int32" Name="connectivity" format="ascii">0 1  0 1 2  2</DataArray>)";
  file.offsets = R"(<DataArray type="Int32" Name="offsets" format="ascii">2 5 6</DataArray>)";
  file.types = R"(<DataArray type="Int32" Name="types" format="ascii">3 5 1</DataArray>)";
  file.cell_data = R"(<DataArray type="Int32" Name="label" format="ascii">7 8 9</DataArray>)";
  const ReadResult result = parse(file.text(), Format::Vtu);
  EXPECT_THAT(result.mesh.labels, ElementsAre(8));
  EXPECT_THAT(result.notes, ElementsAre("vertex and line cells left out: 2"));
}

TEST(Vtu, OtherLabelsAreLeftOutWithANote) {
  File file;
  file.cell_data = R"(<DataArray type="Float64" Name="label" format="ascii">0.5</DataArray>)";
  EXPECT_THAT(parse(file.text(), Format::Vtu).notes,
              ElementsAre("cell data 'label' was left out, it is not of whole numbers"));
}

TEST(Vtu, Quadrilaterals) {
  File file;
  file.piece = "NumberOfPoints=\"4\" NumberOfCells=\"1\"";
  file.points = R"(<DataArray type="Float32" NumberOfComponents="3" format="ascii">)"
                "0 0 0 1 0 0 1 1 0 0 1 0</DataArray>";
  file.connectivity = R"(<DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3</DataArray>)";
  file.offsets = R"(<DataArray type="Int64" Name="offsets" format="ascii">4</DataArray>)";
  file.types = R"(<DataArray type="UInt8" Name="types" format="ascii">9</DataArray>)";
  refused(file.text(), 7, "--split-quads");
  EXPECT_EQ(parse(file.text(), Format::Vtu, true).mesh.n_faces(), 2);
}

// The header and the data of connectivity 0 1 2 as UInt32 each, encoded together and apart.
TEST(Vtu, Base64InOnePieceOrTwo) {
  File file;
  for (const char* data :
       {"DAAAAAAAAAABAAAAAgAAAA==", "DAAAAA==AAAAAAEAAAACAAAA", "DAAA\n  AA==\nAAAA AAEAAAACAAAA"}) {
    file.connectivity = std::string(R"(<DataArray type="UInt32" Name="connectivity" format="binary">)") +
                        data + "</DataArray>";
    EXPECT_THAT(read(file).triangles, ElementsAre(Triangle{0, 1, 2})) << data;
  }
}

TEST(Vtu, AppendedBase64) {
  File file;
  file.connectivity = R"(<DataArray type="UInt32" Name="connectivity" format="appended" offset="8"/>)";
  file.offsets = R"(<DataArray type="Int32" Name="offsets" format="appended" offset="32"/>)";
  std::string text = file.text();
  const std::string data =
      "\n<AppendedData encoding=\"base64\">\n _"
      "AAAAAAAADAAAAA==AAAAAAEAAAACAAAABAAAAA==AwAAAA==\n</AppendedData>";
  text.insert(text.find("</VTKFile>"), data);
  EXPECT_THAT(parse(text, Format::Vtu).mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
}

TEST(Vtu, RefusesFilesItCannotRead) {
  refused("hello", 1, "not well-formed XML");
  refused("<VTKFile><UnstructuredGrid></VTKFile>", 1, "not well-formed XML");
  refused("<other/>", 0, "no element VTKFile");
  const auto with_attributes = [](const std::string& attributes) {
    File file;
    file.attributes = attributes;
    return file.text();
  };
  refused(with_attributes("type=\"PolyData\""), 1, "type 'PolyData', expected UnstructuredGrid");
  refused(with_attributes("type=\"UnstructuredGrid\" byte_order=\"BigEndian\""), 1,
          "byte order 'BigEndian', expected LittleEndian");
  refused(with_attributes("type=\"UnstructuredGrid\" header_type=\"UInt16\""), 1, "header type 'UInt16'");
  refused(with_attributes("type=\"UnstructuredGrid\" compressor=\"vtkLZ4DataCompressor\""), 1,
          "compressed by 'vtkLZ4DataCompressor', expected vtkZLibDataCompressor or none");
  File two_pieces;
  two_pieces.cell_data = "</CellData></Piece><Piece><CellData>";
  refused(two_pieces.text(), 11, "a second piece, expected one");
}

// Found by fuzzing: taken for UTF-16, the place of the error lay behind the end of the text.
TEST(Vtu, RefusesWhatLooksLikeUtf16) {
  refused(std::string("<\0DKTK=\"PolyData\"/=\"\xe4\xe4\xe4\"/>", 26), 1, "not well-formed XML");
  refused(std::string("\xff\xfe<\0V\0T\0K\0", 10), 1, "not well-formed XML");
}

TEST(Vtu, RefusesWrongPoints) {
  File file;
  const auto points = [](const std::string& attributes, const std::string& data) {
    File f;
    f.points = "<DataArray " + attributes + ">" + data + "</DataArray>";
    return f.text();
  };
  const std::string usual = R"(type="Float64" NumberOfComponents="3" format="ascii")";
  refused(points(usual, "0 0 0 1 0 nan 0 1 0"), 5, "'nan' is not finite");
  refused(points(usual, "0 0 0\n1 0 x\n0 1 0"), 6, "'x' is not a number, expected coordinate");
  refused(points(usual, "0 0 0 1 0 1 0 1 0"), 5, "vertex 1 has z = 1, expected 0");
  refused(points(usual, "0 0 0 1 0 0 0 1"), 5, "the coordinates are no multiple of 3");
  refused(points(usual, "0 0 0 1 0 0"), 5, "2 points, expected 3");
  refused(points(R"(type="Int32" NumberOfComponents="3")", "0 0 0 1 0 0 0 1 0"), 5,
          "array is of type 'Int32', expected Float32 or Float64");
  refused(points(R"(type="Float64" NumberOfComponents="2")", "0 0 1 0 0 1"), 5,
          "points need NumberOfComponents=\"3\"");
  refused(points(R"(type="Float64" NumberOfComponents="3" format="hex")", ""), 5,
          "format 'hex', expected ascii, binary or appended");
  file.points = "";
  refused(file.text(), 4, "no element DataArray in Points");
  file = {};
  file.piece = "NumberOfCells=\"1\"";
  refused(file.text(), 3, "'' is not a whole number, expected NumberOfPoints");
}

TEST(Vtu, RefusesWrongCells) {
  const auto cells = [](const std::string& connectivity, const std::string& offsets,
                        const std::string& types) {
    File f;
    f.connectivity = "<DataArray type=\"Int64\" Name=\"connectivity\">" + connectivity + "</DataArray>";
    f.offsets = "<DataArray type=\"Int64\" Name=\"offsets\">" + offsets + "</DataArray>";
    f.types = "<DataArray type=\"UInt8\" Name=\"types\">" + types + "</DataArray>";
    return f.text();
  };
  refused(cells("0 1 3", "3", "5"), 7,
          "cell 0: point 3 does not exist, expected a number from 0 and below 3");
  refused(cells("0 1 -1", "3", "5"), 7, "cell 0: point -1 does not exist");
  refused(cells("0 1 1", "3", "5"), 7, "face 0: vertex 1 is there twice");
  refused(cells("0 1 2", "4", "5"), 7, "cell 0: its offsets are wrong");
  refused(cells("0 1 2", "-1", "5"), 7, "cell 0: its offsets are wrong");
  refused(cells("0 1 2", "2", "5"), 7, "cell 0: 2 corners, expected 3");
  refused(cells("0 1 2", "3", "10"), 7, "cell 0: it is of type 10, expected triangles (5)");
  refused(cells("0 1 2", "3 3", "5"), 6, "2 offsets, expected 1");
  refused(cells("0 1 2", "3", ""), 6, "0 types, expected 1");
  refused(cells("0 1 2.5", "3", "5"), 7, "'2.5' is not a whole number");
}

TEST(Vtu, RefusesWrongLabelsAndMarkers) {
  const auto label = [](const std::string& value) {
    File f;
    f.cell_data = "<DataArray type=\"Int64\" Name=\"label\">" + value + "</DataArray>";
    return f.text();
  };
  refused(label("2147483648"), 11, "label 2147483648 is out of range");
  refused(label("1 2"), 11, "2 labels, expected 1");
  refused(label("-2147483648"), 7, "label -2147483648 is reserved");
  const auto field = [](const std::string& name, const std::string& value) {
    File f;
    f.field =
        "<FieldData><DataArray type=\"Int32\" Name=\"" + name + "\">" + value + "</DataArray></FieldData>";
    return f.text();
  };
  refused(field("marker:w", "0 1 2"), 2, "an odd number of vertices, expected pairs");
  refused(field("marker:w", "0 3"), 2, "marker w, edge 0: vertex 3 does not exist");
  refused(field("marker:", "0 1"), 2, "marker: the name is empty");
  refused(field("marker:a&#10;b", "0 1"), 2, "has control characters");
  refused(field("marker:a\xff", "0 1"), 2, "the name 'marker:a\\xff' is not UTF-8");
  refused(field("label_name:", "1"), 2, "the name is empty");
}

TEST(Vtu, RefusesDamagedBinaryData) {
  const auto inline_data = [](const std::string& data) {
    File f;
    f.connectivity =
        "<DataArray type=\"UInt32\" Name=\"connectivity\" format=\"binary\">" + data + "</DataArray>";
    return f.text();
  };
  refused(inline_data(""), 7, "array 'connectivity': the data ends early");
  refused(inline_data("DAAAAAAAAAABAAAA"), 7, "the data ends early");
  refused(inline_data("DAAAAAAAAAABAAAAAg"), 7, "the data ends early");
  refused(inline_data("DAAAAA==A?AAAAEAAAACAAAA"), 7, "'?' is not a base64 digit");
  refused(inline_data("DAAAAA=AAAAAAAEAAAACAAAA"), 7, "wrong padding");
  refused(inline_data("CgAAAA==AAAAAAEAAAACAAAA"), 7, "not a whole number of values");
}

TEST(Vtu, RefusesHostileCompression) {
  File file;
  file.attributes += " compressor=\"vtkZLibDataCompressor\"";
  // One block that says it holds 0x7fffffff bytes; 2^32 - 1 blocks; a block that is no zlib stream.
  for (const char* data :
       {"AQAAAP///38AAAAABAAAAA==AAAAAA==", "/////wAAAAAAAAAA", "AQAAAAwAAAAMAAAABAAAAA==AAAAAA=="}) {
    file.connectivity = std::string(R"(<DataArray type="Int32" Name="connectivity" format="binary">)") +
                        data + "</DataArray>";
    refused(file.text(), 7, "array 'connectivity': ");
  }
}

TEST(Vtu, RefusesTruncatedAppendedData) {
  const std::string whole = format_vtu(square());
  const std::size_t begin = whole.find("<AppendedData");
  for (std::size_t n = begin; n + 2 < whole.size(); ++n) {
    EXPECT_THROW(parse(whole.substr(0, n), Format::Vtu), InputError) << n;
  }
  std::string wrong = whole;
  wrong.replace(wrong.find("offset=\"0\""), 10, "offset=\"9999\"");
  EXPECT_THROW(parse(wrong, Format::Vtu), InputError);
  refused(whole.substr(0, whole.size() - 12) + "</VTKFil>\n", 0, "the file ends, expected </VTKFile>");
}

constexpr std::string_view tag_of_data = "<AppendedData encoding=\"raw\">";

// Where the first block starts, behind an underscore.
std::size_t data_of(const std::string& text) {
  return text.find('_', text.find(tag_of_data) + tag_of_data.size()) + 1;
}

// What VTK reads before it knows of the data: the block with the tag's end, and the next. Markers of all
// lengths bring that end to every place in a block.
TEST(Vtu, NoDataComeInTheBlocksThatVtkMayTakeForXml) {
  MeshData mesh = square();
  mesh.markers = {{"", {{0, 1}}}};
  for (int length = 1; length <= 4100; ++length) {
    mesh.markers[0].name += 'm';
    const std::string text = format_vtu(mesh);
    const std::size_t end = text.find(tag_of_data) + tag_of_data.size(), data = data_of(text);
    ASSERT_EQ(text.find_first_not_of(" \n", end), data - 1);
    ASSERT_GE(data - 1, (end - 1) / 4096 * 4096 + 2 * 4096);
    if (length % 100 == 0) {
      ASSERT_TRUE(same(mesh, parse(text, Format::Vtu).mesh, Format::Vtu));
    }
  }
}

// The contract: version, header type, no gaps, offsets in order, a line end before the end tag.
TEST(Vtu, BlocksFollowEachOtherInTheOrderOfTheirOffsets) {
  EXPECT_TRUE(rc::check("layout", [](std::uint64_t seed) {
    const MeshData mesh = random_mesh(seed);
    const std::vector<int> region(mesh.triangles.size(), none);
    const std::vector<std::uint8_t> replaced(mesh.triangles.size(), 1);
    const std::string text =
        format_vtu(mesh, {.time = 0.5, .displacement = mesh.points, .replaced = replaced, .region = region});
    RC_ASSERT(text.find("version=\"1.0\"") != std::string::npos);
    RC_ASSERT(text.find("header_type=\"UInt64\"") != std::string::npos);
    const std::size_t data = data_of(text);
    std::size_t offset = 0;
    for (std::size_t at = 0; (at = text.find(" offset=\"", at)) < data; at += 9) {
      RC_ASSERT(std::stoull(text.substr(at + 9)) == offset);
      std::uint64_t size = 0;
      std::memcpy(&size, text.data() + data + offset, 8);
      offset += 8 + size;
    }
    RC_ASSERT(text.substr(data + offset) == "\n</AppendedData>\n</VTKFile>\n");
  }));
}

// meshio looks arrays up by their offsets while it overwrites them by 4/3 of the bytes before, in whole
// groups of three.
bool confuses_meshio(const std::string& text) {
  const std::size_t data = data_of(text);
  std::vector<std::size_t> replaced;
  std::size_t theirs = 0;
  for (std::size_t at = 0; (at = text.find(" offset=\"", at)) < data; at += 9) {
    const std::size_t ours = std::stoull(text.substr(at + 9));
    if (std::find(replaced.begin(), replaced.end(), ours) != replaced.end()) return true;
    replaced.push_back(theirs);
    std::uint64_t size = 0;
    std::memcpy(&size, text.data() + data + ours, 8);
    theirs += (8 + size + 2) / 3 * 4;
  }
  return false;
}

TEST(Vtu, SomeLayoutSuitsMeshioWhateverTheSizes) {
  for (std::size_t n_vertices = 3; n_vertices < 40; ++n_vertices) {
    for (std::size_t n_faces = 1; n_faces < 2 * n_vertices; ++n_faces) {
      MeshData mesh;
      mesh.points.resize(n_vertices);
      mesh.triangles.assign(n_faces, Triangle{0, 1, 2});
      const std::vector<int> region(n_faces);
      const std::vector<std::uint8_t> replaced(n_faces);
      for (int fields = 0; fields < 8; ++fields) {
        VtuFields some;
        if (fields & 1) some.displacement = mesh.points;
        if (fields & 2) some.replaced = replaced;
        if (fields & 4) some.region = region;
        ASSERT_FALSE(confuses_meshio(format_vtu(mesh, some)))
            << n_vertices << ' ' << n_faces << ' ' << fields;
      }
    }
  }
}

TEST(Vtu, ExtraFieldsDoNotDisturbReading) {
  const MeshData mesh = square();
  const std::vector<int> region{-1, 4};
  const std::vector<std::uint8_t> replaced{0, 1};
  const std::string text =
      format_vtu(mesh, {.time = 2.5, .displacement = mesh.points, .replaced = replaced, .region = region});
  EXPECT_TRUE(same(mesh, parse(text, Format::Vtu).mesh));
  for (const char* name :
       {"TimeValue", "displacement", "replaced", "region", "label", "marker:bottom", "label_name:inner"}) {
    EXPECT_THAT(text, HasSubstr("Name=\"" + std::string(name) + "\""));
  }
}

TEST(Vtu, NamesAreSpeltInXml) {
  MeshData mesh = square();
  mesh.markers[0].name = "a<b> & \"c\" 'd'";
  EXPECT_EQ(parse(format_vtu(mesh), Format::Vtu).mesh.markers[0].name, mesh.markers[0].name);
  mesh.markers[0].name = "Z\xFCrich";  // Latin-1
  EXPECT_EQ(parse(format_vtu(mesh), Format::Vtu).mesh.markers[0].name, "Z\xC3\xBCrich");
}

TEST_F(VtuFiles, FieldsOfAnotherLengthAreRefused) {
  const auto path = folder() / "a.vtu";
  const std::vector<int> region{1, 2, 3};
  const std::vector<Point> far{{NAN, 0}, {0, 0}, {0, 0}, {0, 0}};
  EXPECT_THROW(write_vtu(path, square(), {.displacement = std::span(far).first(3)}), InputError);
  EXPECT_THROW(write_vtu(path, square(), {.displacement = far}), InputError);
  EXPECT_THROW(write_vtu(path, square(), {.region = region}), InputError);
  EXPECT_THROW(write_vtu(path, square(), {.time = INFINITY}), InputError);
  EXPECT_TRUE(std::filesystem::is_empty(folder()));
}

TEST_F(VtuFiles, Series) {
  const std::vector<PvdEntry> entries{{0.0, "mesh_000000.vtu"}, {0.1, "a&b.vtu"}};
  write_pvd(folder() / "mesh.pvd", entries);
  EXPECT_EQ(read_file(folder() / "mesh.pvd"),
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
            "byte_order=\"LittleEndian\">\n<Collection>\n"
            "<DataSet timestep=\"0\" part=\"0\" file=\"mesh_000000.vtu\"/>\n"
            "<DataSet timestep=\"0.1\" part=\"0\" file=\"a&amp;b.vtu\"/>\n</Collection>\n</VTKFile>\n");
}

}  // namespace
}  // namespace kinemesh
