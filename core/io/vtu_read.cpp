#include <algorithm>
#include <pugixml.hpp>

#include "core/io/assembler.h"
#include "core/io/codecs.h"
#include "core/io/scanner.h"
#include "core/io/vtu_array.h"
#include "core/io/vtu_names.h"
#include "core/io/xml.h"

namespace kinemesh::io {
namespace {

enum CellType { vertex_cell = 1, line_cell = 3, triangle_cell = 5, quad_cell = 9 };

// VTK's appended raw data makes a file no XML: it is cut out here, and the rest parsed.
struct Parts {
  std::string_view whole;
  std::string without_appended;  // empty where nothing is appended
  std::string_view appended;     // from behind the underscore; reaches beyond its end, blocks know their size

  std::string_view xml() const { return without_appended.empty() ? whole : without_appended; }
};

Parts take_apart(std::string_view text, const std::string& file) {
  const std::size_t tag = text.find("<AppendedData");
  if (tag == std::string_view::npos) return {text, {}, {}};
  const std::size_t tag_end = text.find('>', tag);
  const std::size_t underscore = text.find_first_not_of(" \t\r\n", std::min(tag_end, text.size() - 1) + 1);
  if (underscore == std::string_view::npos || text[underscore] != '_') {
    throw InputError(file, 0, "the appended data does not begin with an underscore");
  }
  const std::size_t last = text.find_last_not_of(" \t\r\n");
  constexpr std::string_view end = "</VTKFile>";
  if (!text.substr(0, last + 1).ends_with(end))
    throw InputError(file, 0, "the file ends, expected </VTKFile>");
  std::string xml(text.substr(0, tag_end + 1));
  return {text, xml + "</AppendedData></VTKFile>",
          text.substr(underscore + 1, last + 1 - end.size() - underscore)};
}

class VtuReader {
 public:
  VtuReader(const std::string& file, const ReadOptions& options, VtuArrays& arrays,
            const pugi::xml_node& root, std::size_t file_size)
      : arrays_(arrays), root_(root), mesh_(file, options), file_size_(file_size) {}

  ReadResult read() {
    const pugi::xml_node grid = require_grid();
    const pugi::xml_node piece = require_piece(grid);
    read_points(piece);
    read_cells(piece);
    for (const pugi::xml_node& array : grid.child("FieldData").children("DataArray")) read_field(array);
    if (n_skipped_ > 0) mesh_.note("vertex and line cells left out: " + std::to_string(n_skipped_));
    return mesh_.finish();
  }

 private:
  pugi::xml_node require_grid() const {
    const std::string_view type = root_.attribute("type").as_string();
    if (type != "UnstructuredGrid")
      arrays_.fail(root_, "type " + in_quotes(type) + ", expected UnstructuredGrid");
    return require_child(root_, "UnstructuredGrid");
  }
  pugi::xml_node require_child(const pugi::xml_node& parent, const char* name) const {
    const pugi::xml_node child = parent.child(name);
    if (!child) arrays_.fail(parent, std::string("no element ") + name + " in " + parent.name());
    return child;
  }
  pugi::xml_node require_piece(const pugi::xml_node& grid) const {
    const pugi::xml_node piece = require_child(grid, "Piece");
    if (const pugi::xml_node second = piece.next_sibling("Piece"))
      arrays_.fail(second, "a second piece, expected one");
    return piece;
  }
  pugi::xml_node require_array(const pugi::xml_node& parent, const char* name) const {
    const pugi::xml_node array = parent.find_child_by_attribute("DataArray", "Name", name);
    if (!array) arrays_.fail(parent, std::string("no DataArray ") + name);
    return array;
  }
  long long count_of(const pugi::xml_node& piece, const char* name) const {
    try {
      return to_integer(piece.attribute(name).as_string(), name);
    } catch (const InputError& error) {
      arrays_.fail(piece, error.what());
    }
  }
  // As many things as a count may stand for.
  static std::uint64_t most(long long count) {
    return static_cast<std::uint64_t>(std::clamp<long long>(count, 0, 4LL * most_items));
  }
  void require_size(const pugi::xml_node& array, std::size_t size, long long expected,
                    const char* what) const {
    if (expected >= 0 && size == static_cast<std::size_t>(expected)) return;
    arrays_.fail(array, std::to_string(size) + " " + what + ", expected " + std::to_string(expected));
  }

  void read_points(const pugi::xml_node& piece) {
    const pugi::xml_node array = require_child(require_child(piece, "Points"), "DataArray");
    if (array.attribute("NumberOfComponents").as_string() != std::string_view("3")) {
      arrays_.fail(array, "points need NumberOfComponents=\"3\"");
    }
    const long long n = count_of(piece, "NumberOfPoints");
    const std::vector<double> x = arrays_.reals(array, 3 * most(n));
    if (x.size() % 3 != 0) arrays_.fail(array, "the coordinates are no multiple of 3");
    require_size(array, x.size() / 3, n, "points");
    if (n > most_items) arrays_.fail(array, "too many points");
    mesh_.mesh().points.reserve(x.size() / 3);
    const int line = arrays_.line_of(array);
    for (std::size_t i = 0; i < x.size(); i += 3) mesh_.add_point(x[i], x[i + 1], x[i + 2], line);
  }

  void read_cells(const pugi::xml_node& piece) {
    const pugi::xml_node cells = require_child(piece, "Cells");
    connectivity_ = require_array(cells, "connectivity");
    line_ = arrays_.line_of(connectivity_);
    const long long n = count_of(piece, "NumberOfCells");
    const auto offsets = arrays_.integers(require_array(cells, "offsets"), most(n));
    const auto types = arrays_.integers(require_array(cells, "types"), most(n));
    require_size(cells, offsets.size(), n, "offsets");
    require_size(cells, types.size(), n, "types");
    corners_ = arrays_.integers(connectivity_, offsets.empty() ? 0 : most(offsets.back()));
    const std::vector<int> labels = read_labels(piece, offsets.size());
    long long begin = 0;
    for (std::size_t i = 0; i < offsets.size(); ++i) {
      read_cell(i, types[i], begin, offsets[i], labels.empty() ? 0 : labels[i]);
      begin = offsets[i];
    }
  }

  void read_cell(std::size_t cell, long long type, long long begin, long long end, int label) {
    if (begin > end || end > static_cast<long long>(corners_.size()))
      fail_cell(cell, "its offsets are wrong");
    const auto require_corners = [&](long long n) {
      if (end - begin != n)
        fail_cell(cell, std::to_string(end - begin) + " corners, expected " + std::to_string(n));
    };
    const auto corner = [&](int k) { return vertex(cell, corners_[static_cast<std::size_t>(begin) + k]); };
    if (type == triangle_cell) {
      require_corners(3);
      mesh_.add_triangle({corner(0), corner(1), corner(2)}, line_, label);
    } else if (type == quad_cell) {
      require_corners(4);
      mesh_.add_quad({corner(0), corner(1), corner(2), corner(3)}, line_, label);
    } else if (type == line_cell || type == vertex_cell) {
      ++n_skipped_;
    } else {
      fail_cell(cell, "it is of type " + std::to_string(type) + ", expected triangles (5)");
    }
  }
  int vertex(std::size_t cell, long long number) const {
    if (number < 0 || number >= mesh_.n_vertices()) {
      fail_cell(cell, "point " + std::to_string(number) +
                          " does not exist, expected a number from 0 and below " +
                          std::to_string(mesh_.n_vertices()));
    }
    return static_cast<int>(number);
  }
  [[noreturn]] void fail_cell(std::size_t cell, const std::string& what) const {
    arrays_.fail(connectivity_, "cell " + std::to_string(cell) + ": " + what);
  }

  // Somebody else's `label` may be anything: only whole numbers are taken for ours.
  std::vector<int> read_labels(const pugi::xml_node& piece, std::size_t n_cells) {
    const pugi::xml_node array =
        piece.child("CellData").find_child_by_attribute("DataArray", "Name", label_name);
    if (!array) return {};
    if (!VtuArrays::is_integer(array)) {
      mesh_.note("cell data 'label' was left out, it is not of whole numbers");
      return {};
    }
    std::vector<int> labels;
    for (long long label : arrays_.integers(array, n_cells)) labels.push_back(narrow(array, label, "label"));
    require_size(array, labels.size(), static_cast<long long>(n_cells), "labels");
    return labels;
  }
  int narrow(const pugi::xml_node& array, long long value, const char* what) const {
    if (value == static_cast<int>(value)) return static_cast<int>(value);
    arrays_.fail(array, std::string(what) + " " + std::to_string(value) + " is out of range");
  }

  // Where a field does not say how many values it has, they are no more than the file has bytes.
  std::uint64_t most_values(const pugi::xml_node& array) const {
    if (!array.attribute("NumberOfTuples")) return file_size_;
    const std::uint64_t components = most(array.attribute("NumberOfComponents").as_llong(1));
    return most(count_of(array, "NumberOfTuples")) * components;
  }
  void read_field(const pugi::xml_node& array) {
    const std::string_view name = array.attribute("Name").as_string();
    if (!is_utf8(name)) arrays_.fail(array, "the name " + in_quotes(name) + " is not UTF-8");
    if (name.starts_with(marker_prefix)) read_marker(array, name.substr(marker_prefix.size()));
    if (name.starts_with(label_name_prefix)) name_labels(array, name.substr(label_name_prefix.size()));
  }
  void read_marker(const pugi::xml_node& array, std::string_view name) {
    const std::vector<long long> ends = arrays_.integers(array, most_values(array));
    if (ends.size() % 2 != 0) arrays_.fail(array, "an odd number of vertices, expected pairs");
    const int line = arrays_.line_of(array);
    const int marker = mesh_.marker(name, line);
    mesh_.reserve_marker(marker, ends.size() / 2);
    for (std::size_t i = 0; i < ends.size(); i += 2) {
      mesh_.add_marker_edge(marker, {narrow(array, ends[i], "vertex"), narrow(array, ends[i + 1], "vertex")},
                            line);
    }
  }
  void name_labels(const pugi::xml_node& array, std::string_view name) {
    try {
      check_name(name);
    } catch (const InputError& error) {
      arrays_.fail(array, error.what());
    }
    const std::vector<long long> labels = arrays_.integers(array, most_values(array));
    named_ += name.size() * labels.size();
    if (named_ > file_size_)
      arrays_.fail(array, "the names of labels are longer than the file, expected one array for each label");
    for (long long label : labels) mesh_.mesh().label_names[narrow(array, label, "label")] = name;
  }

  VtuArrays& arrays_;
  pugi::xml_node root_;
  Assembler mesh_;
  pugi::xml_node connectivity_;
  std::vector<long long> corners_;  // of all cells
  int line_ = 0;                    // of connectivity_
  std::size_t n_skipped_ = 0;
  std::size_t file_size_;
  std::size_t named_ = 0;  // bytes of the names of labels, one for each label
};

}  // namespace

ReadResult read_vtu(std::string_view text, const std::string& file, const ReadOptions& options) {
  const Parts parts = take_apart(text, file);
  const std::string_view xml = parts.xml();
  pugi::xml_document document;
  // Without a given encoding a zero byte makes it UTF-16, and all offsets refer to a converted text.
  const pugi::xml_parse_result parsed =
      document.load_buffer(xml.data(), xml.size(), pugi::parse_default, pugi::encoding_utf8);
  if (!parsed) {
    const auto before = xml.begin() + std::min<std::ptrdiff_t>(parsed.offset, std::ssize(xml));
    const int line = 1 + static_cast<int>(std::count(xml.begin(), before, '\n'));
    throw InputError(file, line, std::string("not well-formed XML: ") + parsed.description());
  }
  const pugi::xml_node root = document.child("VTKFile");
  if (!root) throw InputError(file, 0, "no element VTKFile");
  VtuArrays arrays(file, xml, root, parts.appended);
  return VtuReader(file, options, arrays, root, text.size()).read();
}

}  // namespace kinemesh::io
