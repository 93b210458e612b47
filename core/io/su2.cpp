#include <algorithm>
#include <limits>

#include "core/io/assembler.h"
#include "core/io/codecs.h"
#include "core/io/pieces.h"
#include "core/io/scanner.h"
#include "core/io/text_buffer.h"

namespace kinemesh::io {
namespace {

// SU2 numbers element types as VTK does.
enum ElementType { line_type = 3, triangle_type = 5, quad_type = 9 };

std::string name_of_type(long long type) {
  switch (type) {
    case 1:
      return "a vertex";
    case line_type:
      return "a line";
    case triangle_type:
      return "a triangle";
    case quad_type:
      return "a quadrilateral";
    case 10:
      return "a tetrahedron";
    case 12:
      return "a hexahedron";
    case 13:
      return "a prism";
    case 14:
      return "a pyramid";
    default:
      return "unknown";
  }
}

constexpr std::string_view halo_tag = "SEND_RECEIVE";

class Su2Reader {
 public:
  Su2Reader(std::string_view text, const std::string& file, const ReadOptions& options)
      : scanner_(text, file, '%'), mesh_(file, options) {}

  ReadResult read() {
    while (!scanner_.at_end()) read_statement();
    if (!has_dimension_) scanner_.fail("the file ends, expected NDIME=");
    if (!has_elements_) scanner_.fail("the file ends, expected NELEM=");
    if (!has_points_) scanner_.fail("the file ends, expected NPOIN=");
    if (markers_announced_ >= 0 && markers_announced_ != markers_found_) {
      scanner_.fail("the file ends after " + std::to_string(markers_found_) +
                    " of the NMARK= " + std::to_string(markers_announced_) + " markers");
    }
    add_notes();
    return mesh_.finish();
  }

 private:
  // "KEY= value" with any blanks; what is left of the line is the value.
  void read_statement() {
    const std::string_view line = scanner_.rest_of_line();
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) scanner_.fail(in_quotes(line) + " where KEYWORD= was expected");
    key_ = line.substr(0, equals);
    key_.remove_suffix(key_.size() - (key_.find_last_not_of(" \t") + 1));
    value_ = line.substr(equals + 1);
    value_.remove_prefix(std::min(value_.find_first_not_of(" \t"), value_.size()));
    read_value();
  }

  void read_value() {
    if (key_ == "NDIME") return read_dimension();
    if (key_ == "NELEM") return read_elements();
    if (key_ == "NPOIN") return read_points();
    if (key_ == "NMARK") return void(markers_announced_ = count_value(1));
    if (key_ == "MARKER_TAG") return read_marker();
    if (key_ == "SEND_RECV") return;  // of a halo marker
    if (key_ == "NZONE") return expect_value(1, "one zone");
    if (key_ == "IZONE") return;
    if (key_.starts_with("NPERIODIC") || key_.starts_with("PERIODIC_")) return void(has_periodicity_ = true);
    if (key_.starts_with("FFD_")) return skip_deformation_box();
    scanner_.fail("unknown keyword " + in_quotes(key_));
  }

  long long integer_value() {
    const std::string_view first = value_.substr(0, value_.find_first_of(" \t"));
    try {
      return to_integer(first, ("a number after " + std::string(key_) + "=").c_str());
    } catch (const InputError& error) {
      scanner_.fail(error.what());
    }
  }
  int count_value(std::size_t bytes_each) {
    const long long n = integer_value();
    scanner_.check_count(n, ("number after " + std::string(key_) + "=").c_str(), bytes_each);
    return static_cast<int>(n);
  }
  void expect_value(long long expected, const char* what) {
    if (integer_value() != expected)
      scanner_.fail(std::string(key_) + "= " + std::string(value_) + ", expected " + what);
  }

  void read_dimension() {
    expect_value(2, "2: only meshes in the plane are read");
    has_dimension_ = true;
  }

  void read_elements() {
    only_once(has_elements_);
    const int n = count_value(8);
    if (read_triangles(n)) return;
    for (int i = 0; i < n; ++i) read_element();
  }
  // All of them, where nothing but triangles is there, one to a line.
  bool read_triangles(int n) {
    const int line = scanner_.line();
    std::vector<Triangle> triangles(n);
    const auto read = [&](Scanner& scanner, int i) {
      if (scanner.integer("a type") != triangle_type) scanner.fail("no triangle");
      for (int& v : triangles[i]) v = scanner.integer_here("vertex number");
      skip_numbers(scanner, "an element");
    };
    if (!read_lines(scanner_, n, read)) return false;
    mesh_.add_triangles(std::move(triangles), line + 1);
    return true;
  }
  void read_element() {
    const int type = scanner_.integer("type of an element");
    const int line = scanner_.line();
    if (type == triangle_type) {
      mesh_.add_triangle({vertex(), vertex(), vertex()}, line);
    } else if (type == quad_type) {
      mesh_.add_quad({vertex(), vertex(), vertex(), vertex()}, line);
    } else {
      refuse_type(type, "triangles (5)");
    }
    skip_numbers(scanner_, "an element");
  }
  int vertex() { return scanner_.integer_here("vertex number"); }
  [[noreturn]] void refuse_type(int type, const char* expected) const {
    scanner_.fail("element type " + std::to_string(type) + " is " + name_of_type(type) + ", expected " +
                  expected);
  }

  // "NPOIN= total [without halo]"
  void read_points() {
    only_once(has_points_);
    const int n = count_value(4);
    auto& points = mesh_.mesh().points;
    points.resize(n);
    const auto read = [&](Scanner& scanner, int i) {
      points[i].x = scanner.number("x of a point");
      points[i].y = scanner.number_here("y of a point");
      skip_numbers(scanner, "a point");
    };
    if (read_lines(scanner_, n, read)) return;
    for (int i = 0; i < n; ++i) read(scanner_, i);
  }

  void read_marker() {
    const int line = scanner_.line();
    ++markers_found_;
    const bool is_halo = value_ == halo_tag;
    const int marker = is_halo ? none : mesh_.marker(value_, line);
    if (scanner_.at_end()) scanner_.fail("the file ends, expected MARKER_ELEMS=");
    const std::string_view next = scanner_.rest_of_line();
    const std::size_t equals = next.find('=');
    if (!next.starts_with("MARKER_ELEMS") || equals == std::string_view::npos) {
      scanner_.fail(in_quotes(next) + " where MARKER_ELEMS= was expected");
    }
    key_ = "MARKER_ELEMS";
    value_ = next.substr(std::min(next.find_first_not_of(" \t", equals + 1), next.size()));
    const int n = count_value(is_halo ? 1 : 5);
    is_halo ? skip_halo(n) : read_marker_edges(marker, n);
  }
  void read_marker_edges(int marker, int n) {
    for (int i = 0; i < n; ++i) {
      const int type = scanner_.integer("type of a marker's element");
      if (type != line_type) refuse_type(type, "lines (3)");
      mesh_.add_marker_edge(marker, {vertex(), vertex()}, scanner_.line());
      skip_numbers(scanner_, "a line");
    }
  }
  void skip_halo(int n) {
    has_halo_ = true;
    while (n > 0) {
      if (scanner_.at_end()) scanner_.fail("the file ends among the elements of a marker");
      if (scanner_.rest_of_line().find('=') == std::string_view::npos) --n;  // SEND_RECV= comes in between
    }
  }

  // "FFD_CONTROL_POINTS= n" and its like are followed by n lines.
  void skip_deformation_box() {
    has_deformation_box_ = true;
    if (!key_.ends_with("_POINTS")) return;
    for (int n = count_value(1); n > 0; --n) {
      if (scanner_.at_end()) scanner_.fail("the file ends among the points of a deformation box");
      scanner_.skip_line();
    }
  }

  // Elements and points may carry their numbers, which say nothing: their order counts.
  static void skip_numbers(Scanner& scanner, const char* what) {
    for (int i = 0; i < 2 && !scanner.at_line_end(); ++i)
      scanner.long_integer("number of the point or element");
    scanner.expect_line_end(what);
  }

  void only_once(bool& seen) {
    if (seen) scanner_.fail("a second " + std::string(key_) + "=, expected one zone");
    seen = true;
  }

  void add_notes() {
    if (has_halo_) mesh_.note("markers SEND_RECEIVE were left out");
    if (has_periodicity_) mesh_.note("periodicity was left out");
    if (has_deformation_box_) mesh_.note("deformation boxes (FFD) were left out");
  }

  Scanner scanner_;
  Assembler mesh_;
  std::string_view key_, value_;
  bool has_dimension_ = false, has_elements_ = false, has_points_ = false;
  bool has_halo_ = false, has_periodicity_ = false, has_deformation_box_ = false;
  int markers_announced_ = -1;
  int markers_found_ = 0;
};

void check_tag(const std::string& name) {
  const bool has_blank_end = name.front() == ' ' || name.back() == ' ';
  if (name.find('%') != std::string::npos || has_blank_end || name == halo_tag) {
    throw InputError("marker " + in_quotes(name) + " cannot be named in SU2");
  }
}

}  // namespace

ReadResult read_su2(std::string_view text, const std::string& file, const ReadOptions& options) {
  return Su2Reader(text, file, options).read();
}

std::string write_su2(const MeshData& mesh) {
  for (const Marker& marker : mesh.markers) check_tag(marker.name);
  TextBuffer text(56 * mesh.points.size() + 40 * mesh.triangles.size());
  text << "NDIME= 2\nNELEM= " << mesh.n_faces() << '\n';
  for (int i = 0; i < mesh.n_faces(); ++i) {
    const Triangle& t = mesh.triangles[i];
    text << "5 " << t[0] << ' ' << t[1] << ' ' << t[2] << ' ' << i << '\n';
  }
  text << "NPOIN= " << mesh.n_vertices() << '\n';
  for (int i = 0; i < mesh.n_vertices(); ++i)
    text << mesh.points[i].x << ' ' << mesh.points[i].y << ' ' << i << '\n';
  text << "NMARK= " << mesh.markers.size() << '\n';
  for (const Marker& marker : mesh.markers) {
    text << "MARKER_TAG= " << marker.name << "\nMARKER_ELEMS= " << marker.edges.size() << '\n';
    for (const Edge& e : marker.edges) text << "3 " << e[0] << ' ' << e[1] << '\n';
  }
  return text.take();
}

}  // namespace kinemesh::io
