#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>

#include "core/io/text_buffer.h"
#include "core/io/vtu_names.h"
#include "core/io/writable.h"
#include "core/io/xml.h"
#include "kinemesh/error.h"
#include "kinemesh/vtu.h"

namespace kinemesh {
namespace {

using io::TextBuffer;

static_assert(std::endian::native == std::endian::little,
              "VTU data is read and written as it lies in memory");

template <class Value>
void append_value(std::string& out, Value value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}
template <class Range>
void append_all(std::string& out, const Range& range) {
  if (std::size(range) == 0) return;
  out.append(reinterpret_cast<const char*>(std::data(range)), std::size(range) * sizeof *std::data(range));
}
void append_points(std::string& out, std::span<const Point> points) {
  for (const Point& p : points) {
    const double x[3] = {p.x, p.y, 0.0};
    append_all(out, x);
  }
}
void append_integer(std::string& out, long long value, std::size_t n_bytes) {
  out.append(reinterpret_cast<const char*>(&value), n_bytes);  // the lower bytes come first
}

struct Array {
  const char* name;
  const char* type;
  int components;
  std::size_t bytes;                         // of the data, without its header
  std::function<void(std::string&)> append;  // the data
};

struct Section {
  const char* element;
  std::vector<Array> arrays;
};

// What the format leaves open: bytes of the integers that describe the cells, and what comes first.
struct Layout {
  bool cells_first;
  std::size_t connectivity, offsets, types;
};

const char* integer_type(std::size_t n_bytes) {
  return n_bytes == 8 ? "Int64" : n_bytes == 4 ? "Int32" : "UInt8";
}

class VtuWriter {
 public:
  VtuWriter(const MeshData& mesh, const VtuFields& fields) : mesh_(mesh), fields_(fields) { choose_layout(); }

  std::string write() {
    TextBuffer head;
    write_head(head);
    std::string out = head.take();
    const std::size_t padding = padding_behind(out.size());
    out.reserve(out.size() + padding + 64 + data_bytes());
    out.append(padding, ' ');
    out += '_';
    for (const Section& section : sections_) {
      for (const Array& array : section.arrays) {
        append_value(out, static_cast<std::uint64_t>(array.bytes));
        array.append(out);
      }
    }
    return out + "\n</AppendedData>\n</VTKFile>\n";
  }

 private:
  // meshio finds arrays by the text of their offset, while it replaces the offsets by those of its own base64
  // copy, one after the other: where one of its offsets happens to equal a later one of ours, it mixes the
  // two arrays up. Another layout then moves the offsets apart.
  void choose_layout() {
    for (bool cells_first : {false, true}) {
      for (std::size_t types : {1, 4, 8}) {
        for (std::size_t offsets : {4, 8}) {
          for (std::size_t connectivity : {4, 8}) {
            list_sections({cells_first, connectivity, offsets, types});
            if (!confuses_meshio()) return;
          }
        }
      }
    }
  }
  bool confuses_meshio() const {
    std::vector<std::size_t> replaced;
    std::size_t ours = 0, theirs = 0;
    for (const Section& section : sections_) {
      for (const Array& array : section.arrays) {
        if (std::find(replaced.begin(), replaced.end(), ours) != replaced.end()) return true;
        replaced.push_back(theirs);
        ours += 8 + array.bytes;
        theirs += (8 + array.bytes + 2) / 3 * 4;
      }
    }
    return false;
  }

  void list_sections(const Layout& layout) {
    const Section points{"Points", {point_array("Points", mesh_.points)}};
    if (layout.cells_first) {
      sections_ = {cells(layout), points, point_data(), cell_data()};
    } else {
      sections_ = {point_data(), cell_data(), points, cells(layout)};
    }
    std::erase_if(sections_, [](const Section& section) { return section.arrays.empty(); });
  }

  Section point_data() const {
    Section section{"PointData", {}};
    if (!fields_.displacement.empty())
      section.arrays.push_back(point_array("displacement", fields_.displacement));
    return section;
  }

  Section cell_data() const {
    const std::size_t n = mesh_.triangles.size();
    Section section{"CellData", {}};
    section.arrays.push_back({io::label_name, "Int32", 1, 4 * n, [this, n](std::string& out) {
                                mesh_.labels.empty() ? void(out.append(4 * n, '\0'))
                                                     : append_all(out, mesh_.labels);
                              }});
    if (!fields_.replaced.empty())
      section.arrays.push_back(flat_array("replaced", "UInt8", fields_.replaced));
    if (!fields_.region.empty()) section.arrays.push_back(flat_array("region", "Int32", fields_.region));
    return section;
  }

  Section cells(const Layout& layout) const {
    const std::size_t n = mesh_.triangles.size();
    constexpr int triangle = 5;
    const auto corner = [this](std::size_t i) { return mesh_.triangles[i / 3][i % 3]; };
    const auto end = [](std::size_t i) { return static_cast<long long>(3 * i + 3); };
    const auto type = [](std::size_t) { return triangle; };
    return {
        "Cells",
        {integer_array("connectivity", 3 * n, layout.connectivity, corner),
         integer_array("offsets", n, layout.offsets, end), integer_array("types", n, layout.types, type)}};
  }

  static Array point_array(const char* name, std::span<const Point> points) {
    return {name, "Float64", 3, 24 * points.size(),
            [points](std::string& out) { append_points(out, points); }};
  }
  template <class Values>
  static Array flat_array(const char* name, const char* type, Values values) {
    return {name, type, 1, values.size_bytes(), [values](std::string& out) { append_all(out, values); }};
  }
  template <class Value>
  static Array integer_array(const char* name, std::size_t count, std::size_t width, Value value) {
    return {name, integer_type(width), 1, width * count, [=](std::string& out) {
              for (std::size_t i = 0; i < count; ++i) append_integer(out, value(i), width);
            }};
  }

  std::size_t data_bytes() const {
    std::size_t sum = 0;
    for (const Section& section : sections_) {
      for (const Array& array : section.arrays) sum += 8 + array.bytes;
    }
    return sum;
  }

  void write_head(TextBuffer& head) const {
    head << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
            "byte_order=\"LittleEndian\" "
            "header_type=\"UInt64\">\n<UnstructuredGrid>\n";
    write_field_data(head);
    head << "<Piece NumberOfPoints=\"" << mesh_.points.size() << "\" NumberOfCells=\""
         << mesh_.triangles.size() << "\">\n";
    std::size_t offset = 0;
    for (const Section& section : sections_) {
      head << '<' << section.element << ">\n";
      for (const Array& array : section.arrays) {
        write_array(head, array, offset);
        offset += 8 + array.bytes;
      }
      head << "</" << section.element << ">\n";
    }
    head << "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n";
  }

  // Older VTKs read XML in blocks of 4096 bytes. A recent libexpat tells of a tag not before it has seen
  // twice as much; so such a VTK (that of Debian 12's ParaView among them) hands it the block of the last tag
  // and the one behind it before it knows that data follow. With spaces there it does not take data for XML.
  static std::size_t padding_behind(std::size_t head) {
    constexpr std::size_t block = 4096;
    return (head + block - 1) / block * block + block - head;
  }

  static void write_array(TextBuffer& head, const Array& array, std::size_t offset) {
    head << "<DataArray type=\"" << array.type << "\" Name=\"" << array.name << '"';
    if (array.components != 1) head << " NumberOfComponents=\"" << array.components << '"';
    head << " format=\"appended\" offset=\"" << offset << "\"/>\n";
  }

  // Short, and in ASCII: they are for people too.
  void write_field_data(TextBuffer& head) const {
    if (!fields_.time && mesh_.markers.empty() && mesh_.label_names.empty()) return;
    head << "<FieldData>\n";
    if (fields_.time) {
      begin_field(head, "Float64", "TimeValue", 1, 1);
      head << *fields_.time << "\n</DataArray>\n";
    }
    for (const Marker& marker : mesh_.markers) {
      begin_field(head, "Int32", std::string(io::marker_prefix) + marker.name, 2, marker.edges.size());
      for (const Edge& e : marker.edges) head << e[0] << ' ' << e[1] << '\n';
      head << "</DataArray>\n";
    }
    for (const auto& [label, name] : mesh_.label_names) {
      begin_field(head, "Int32", std::string(io::label_name_prefix) + name, 1, 1);
      head << label << "\n</DataArray>\n";
    }
    head << "</FieldData>\n";
  }
  static void begin_field(TextBuffer& head, const char* type, const std::string& name, int components,
                          std::size_t n) {
    head << "<DataArray type=\"" << type << "\" Name=\"" << io::xml_text(name) << '"';
    if (components != 1) head << " NumberOfComponents=\"" << components << '"';
    head << " NumberOfTuples=\"" << n << "\" format=\"ascii\">\n";
  }

  const MeshData& mesh_;
  const VtuFields& fields_;
  std::vector<Section> sections_;  // in the order of the document and of the data
};

void check_fields(const MeshData& mesh, const VtuFields& fields) {
  io::check_length(fields.displacement.size(), mesh.points.size(), "displacements");
  io::check_length(fields.replaced.size(), mesh.triangles.size(), "flags of replaced faces");
  io::check_length(fields.region.size(), mesh.triangles.size(), "regions of faces");
  if (fields.time && !std::isfinite(*fields.time)) throw InputError("the time is not finite");
  for (const Point& d : fields.displacement) {
    if (!is_finite(d)) throw InputError("a displacement is not finite");
  }
}

// XML holds all characters of names but two.
void check_xml_name(const std::string& name) {
  for (const char* character : {"\xef\xbf\xbe", "\xef\xbf\xbf"}) {
    if (name.find(character) != std::string::npos)
      throw InputError("the name \"" + name + "\" has a character that XML cannot hold");
  }
}

void check_names(const MeshData& mesh) {
  for (const Marker& marker : mesh.markers) check_xml_name(marker.name);
  for (const auto& [label, name] : mesh.label_names) check_xml_name(name);
}

}  // namespace

std::string format_vtu(const MeshData& mesh, const VtuFields& fields) {
  io::check_writable(mesh);
  check_fields(mesh, fields);
  check_names(mesh);
  return VtuWriter(mesh, fields).write();
}

void write_vtu(const std::filesystem::path& path, const MeshData& mesh, const VtuFields& fields) {
  io::write_content(path, [&] { return format_vtu(mesh, fields); });
}

void write_pvd(const std::filesystem::path& path, std::span<const PvdEntry> entries) {
  TextBuffer text;
  text << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
          "byte_order=\"LittleEndian\">\n"
          "<Collection>\n";
  for (const PvdEntry& entry : entries) {
    text << "<DataSet timestep=\"" << entry.time << "\" part=\"0\" file=\"" << io::xml_text(entry.file)
         << "\"/>\n";
  }
  text << "</Collection>\n</VTKFile>\n";
  io::write_content(path, [&] { return text.take(); });
}

}  // namespace kinemesh
