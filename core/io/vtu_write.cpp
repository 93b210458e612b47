#include <bit>
#include <cmath>
#include <functional>
#include <set>

#include "core/error.h"
#include "core/io/text_buffer.h"
#include "core/io/vtu.h"
#include "core/io/vtu_names.h"
#include "core/io/writable.h"
#include "core/io/xml.h"

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
void append_integers(std::string& out, long long value, std::size_t n_bytes) {
  out.append(reinterpret_cast<const char*>(&value), n_bytes);  // the lower bytes come first
}

enum class Section { Field, Point, Cell, Points, Cells };

struct Array {
  Section section;
  std::string name;
  const char* type;
  int components;
  std::size_t tuples;
  std::size_t bytes;                         // of the data, without its header
  std::function<void(std::string&)> append;  // the data
};

// Bytes of the integers in the arrays of the cells, for which the format leaves a choice.
struct Widths {
  std::size_t connectivity, offsets, types;
};

const char* integer_type(std::size_t n_bytes) {
  return n_bytes == 8 ? "Int64" : n_bytes == 4 ? "Int32" : "UInt8";
}

class VtuWriter {
 public:
  VtuWriter(const MeshData& mesh, const VtuFields& fields) : mesh_(mesh), fields_(fields) { choose_arrays(); }

  std::string write() {
    TextBuffer head;
    write_head(head);
    std::string out = head.take();
    out.reserve(out.size() + 64 + data_bytes());
    for (const Array& array : arrays_) {
      append_value(out, static_cast<std::uint64_t>(array.bytes));
      array.append(out);
    }
    return out + "\n</AppendedData>\n</VTKFile>\n";
  }

 private:
  // meshio finds arrays by the text of their offset, while it replaces the offsets by those of its own base64
  // copy, one after the other: where one of its offsets happens to equal a later one of ours, it mixes the
  // two arrays up. Other widths of the integers then move the offsets apart.
  void choose_arrays() {
    for (std::size_t types : {1, 4, 8}) {
      for (std::size_t offsets : {4, 8}) {
        for (std::size_t connectivity : {4, 8}) {
          list_arrays({connectivity, offsets, types});
          if (!confuses_meshio()) return;
        }
      }
    }
  }
  bool confuses_meshio() const {
    std::set<std::size_t> replaced;
    std::size_t ours = 0, theirs = 0;
    for (const Array& array : arrays_) {
      if (replaced.count(ours) > 0) return true;
      replaced.insert(theirs);
      ours += 8 + array.bytes;
      theirs += (8 + array.bytes + 2) / 3 * 4;
    }
    return false;
  }

  void list_arrays(const Widths& widths) {
    arrays_.clear();
    list_field_data();
    list_point_data();
    list_cell_data();
    add(Section::Points, "Points", "Float64", 3, mesh_.points.size(), 24 * mesh_.points.size(),
        [this](std::string& out) { append_points(out, mesh_.points); });
    list_cells(widths);
  }

  void list_field_data() {
    if (fields_.time) {
      add(Section::Field, "TimeValue", "Float64", 1, 1, 8,
          [this](std::string& out) { append_value(out, *fields_.time); });
    }
    for (const Marker& marker : mesh_.markers) {
      add(Section::Field, std::string(io::marker_prefix) + marker.name, "Int32", 2, marker.edges.size(),
          8 * marker.edges.size(), [&marker](std::string& out) { append_all(out, marker.edges); });
    }
    for (const auto& entry : mesh_.label_names) {
      add(Section::Field, std::string(io::label_name_prefix) + entry.second, "Int32", 1, 1, 4,
          [&entry](std::string& out) { append_value(out, entry.first); });
    }
  }

  void list_point_data() {
    const auto& d = fields_.displacement;
    if (d.empty()) return;
    add(Section::Point, "displacement", "Float64", 3, d.size(), 24 * d.size(),
        [d](std::string& out) { append_points(out, d); });
  }

  void list_cell_data() {
    const std::size_t n = mesh_.triangles.size();
    add(Section::Cell, io::label_name, "Int32", 1, n, 4 * n, [this, n](std::string& out) {
      mesh_.labels.empty() ? void(out.append(4 * n, '\0')) : append_all(out, mesh_.labels);
    });
    if (!fields_.replaced.empty()) {
      add(Section::Cell, "replaced", "UInt8", 1, n, n,
          [this](std::string& out) { append_all(out, fields_.replaced); });
    }
    if (!fields_.region.empty()) {
      add(Section::Cell, "region", "Int32", 1, n, 4 * n,
          [this](std::string& out) { append_all(out, fields_.region); });
    }
  }

  void list_cells(const Widths& widths) {
    const std::size_t n = mesh_.triangles.size();
    const auto add_integers = [&](const char* name, std::size_t count, std::size_t width, auto value) {
      add(Section::Cells, name, integer_type(width), 1, count, width * count, [=](std::string& out) {
        for (std::size_t i = 0; i < count; ++i) append_integers(out, value(i), width);
      });
    };
    add_integers("connectivity", 3 * n, widths.connectivity,
                 [this](std::size_t i) { return mesh_.triangles[i / 3][i % 3]; });
    add_integers("offsets", n, widths.offsets,
                 [](std::size_t i) { return static_cast<long long>(3 * i + 3); });
    constexpr int triangle = 5;
    add_integers("types", n, widths.types, [](std::size_t) { return triangle; });
  }

  void add(Section section, std::string name, const char* type, int components, std::size_t tuples,
           std::size_t bytes, std::function<void(std::string&)> append) {
    arrays_.push_back({section, std::move(name), type, components, tuples, bytes, std::move(append)});
  }

  std::size_t data_bytes() const {
    std::size_t sum = 0;
    for (const Array& array : arrays_) sum += 8 + array.bytes;
    return sum;
  }

  void write_head(TextBuffer& head) {
    head << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
            "byte_order=\"LittleEndian\" "
            "header_type=\"UInt64\">\n<UnstructuredGrid>\n";
    std::size_t offset = 0;
    write_section(head, Section::Field, "FieldData", offset);
    head << "<Piece NumberOfPoints=\"" << mesh_.points.size() << "\" NumberOfCells=\""
         << mesh_.triangles.size() << "\">\n";
    write_section(head, Section::Point, "PointData", offset);
    write_section(head, Section::Cell, "CellData", offset);
    write_section(head, Section::Points, "Points", offset);
    write_section(head, Section::Cells, "Cells", offset);
    head << "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  }

  void write_section(TextBuffer& head, Section section, const char* element, std::size_t& offset) const {
    bool is_open = false;
    for (const Array& array : arrays_) {
      if (array.section != section) continue;
      if (!is_open) head << '<' << element << ">\n";
      is_open = true;
      write_array(head, array, offset);
      offset += 8 + array.bytes;
    }
    if (is_open) head << "</" << element << ">\n";
  }

  static void write_array(TextBuffer& head, const Array& array, std::size_t offset) {
    head << "<DataArray type=\"" << array.type << "\" Name=\"" << io::xml_text(array.name) << '"';
    if (array.components != 1) head << " NumberOfComponents=\"" << array.components << '"';
    if (array.section == Section::Field) head << " NumberOfTuples=\"" << array.tuples << '"';
    head << " format=\"appended\" offset=\"" << offset << "\"/>\n";
  }

  const MeshData& mesh_;
  const VtuFields& fields_;
  std::vector<Array> arrays_;  // by section, in the order of their data
};

void check_fields(const MeshData& mesh, const VtuFields& fields) {
  io::check_length(fields.displacement.size(), mesh.points.size(), "displacements");
  io::check_length(fields.replaced.size(), mesh.triangles.size(), "flags of replaced faces");
  io::check_length(fields.region.size(), mesh.triangles.size(), "regions of faces");
  if (fields.time && !std::isfinite(*fields.time)) throw InputError("the time is not finite");
  for (const Point& d : fields.displacement) {
    if (!std::isfinite(d.x) || !std::isfinite(d.y)) throw InputError("a displacement is not finite");
  }
}

}  // namespace

std::string format_vtu(const MeshData& mesh, const VtuFields& fields) {
  io::check_writable(mesh);
  check_fields(mesh, fields);
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
