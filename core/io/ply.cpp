#include <algorithm>
#include <array>
#include <unordered_map>

#include "core/io/assembler.h"
#include "core/io/codecs.h"
#include "core/io/scanner.h"
#include "core/io/text_buffer.h"

namespace kinemesh::io {
namespace {

constexpr std::array<std::string_view, 12> integer_types{
    "char", "uchar", "short", "ushort", "int", "uint", "int8", "uint8", "int16", "uint16", "int32", "uint32"};
constexpr std::array<std::string_view, 4> real_types{"float", "double", "float32", "float64"};

template <class List>
bool contains(const List& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

// What a property's value is used for.
enum class Use { Skip, X, Y, Z, Corners };

struct Property {
  std::string name;
  bool is_list;
  Use use = Use::Skip;
};

struct Element {
  std::string name;
  int count;
  std::vector<Property> properties;
};

class PlyReader {
 public:
  PlyReader(std::string_view text, const std::string& file, const ReadOptions& options)
      : scanner_(text, file), mesh_(file, options) {}

  ReadResult read() {
    read_header();
    for (const Element& element : elements_) read_element(element);
    scanner_.expect_end("the last element");
    return mesh_.finish();
  }

 private:
  void read_header() {
    const std::string_view first = scanner_.word("ply");
    if (first != "ply") scanner_.fail(in_quotes(first) + " begins the file, expected ply");
    while (read_header_line()) {
    }
    if (!has_format_) scanner_.fail("the header ends, expected a line 'format ascii 1.0'");
    require_element("vertex", {Use::X, Use::Y});
    require_element("face", {Use::Corners});
  }

  bool read_header_line() {
    const std::string_view keyword = scanner_.word("end_header");
    if (keyword == "end_header") {
      scanner_.expect_line_end("end_header");
      return false;
    }
    if (keyword == "format") {
      read_format();
    } else if (keyword == "element") {
      read_element_line();
    } else if (keyword == "property") {
      read_property_line();
    } else if (keyword == "comment" || keyword == "obj_info") {
      scanner_.skip_line();
    } else {
      scanner_.fail("unknown keyword " + in_quotes(keyword) + " in the header");
    }
    return true;
  }

  void read_format() {
    const std::string_view encoding = word_here("ascii");
    if (encoding != "ascii") scanner_.fail("the format is " + in_quotes(encoding) + ", expected ascii");
    if (const std::string_view version = word_here("1.0"); version != "1.0") {
      scanner_.fail("the version is " + in_quotes(version) + ", expected 1.0");
    }
    scanner_.expect_line_end("the format");
    has_format_ = true;
  }

  void read_element_line() {
    const std::string name(word_here("name of an element"));
    if (find_element(name) != nullptr) scanner_.fail("a second element " + in_quotes(name));
    const long long count = scanner_.long_integer("number of elements");
    // A property takes two bytes; without one, an element takes none.
    scanner_.check_count(count, "number of elements", 2);
    scanner_.expect_line_end("an element");
    element_of_name_.emplace(name, elements_.size());
    elements_.push_back({name, static_cast<int>(count), {}});
  }

  void read_property_line() {
    if (elements_.empty()) scanner_.fail("a property before the first element");
    const std::string_view type = word_here("type of a property");
    const bool is_list = type == "list";
    if (is_list) require_type(word_here("type of a list's length"), false);
    require_type(is_list ? word_here("type of a list's items") : type, true);
    const std::string name(word_here("name of a property"));
    scanner_.expect_line_end("a property");
    Element& element = elements_.back();
    element.properties.push_back({name, is_list, use_of(element.name, name)});
    check_property(element);
  }

  void require_type(std::string_view type, bool may_be_real) const {
    if (contains(integer_types, type) || (may_be_real && contains(real_types, type))) return;
    scanner_.fail("unknown type " + in_quotes(type));
  }

  static Use use_of(std::string_view element, std::string_view property) {
    if (element == "vertex" && property == "x") return Use::X;
    if (element == "vertex" && property == "y") return Use::Y;
    if (element == "vertex" && property == "z") return Use::Z;
    if (element == "face" && (property == "vertex_indices" || property == "vertex_index"))
      return Use::Corners;
    return Use::Skip;
  }

  // The newest property.
  void check_property(const Element& element) const {
    const Property& added = element.properties.back();
    if (added.use == Use::Skip) return;
    if (added.is_list != (added.use == Use::Corners)) {
      scanner_.fail("property " + in_quotes(added.name) + (added.is_list ? " is a list" : " is not a list"));
    }
    const auto uses_same = [&](const Property& p) { return p.use == added.use; };
    if (std::count_if(element.properties.begin(), element.properties.end(), uses_same) > 1) {
      scanner_.fail("a second property " + in_quotes(added.name));
    }
  }

  void require_element(std::string_view name, const std::vector<Use>& uses) const {
    const Element* element = find_element(name);
    if (element == nullptr) scanner_.fail("the header ends, expected an element " + std::string(name));
    for (Use use : uses) {
      const auto has_use = [&](const Property& p) { return p.use == use; };
      if (std::none_of(element->properties.begin(), element->properties.end(), has_use)) {
        scanner_.fail("the header ends, element " + std::string(name) + " lacks " +
                      (use == Use::Corners ? "vertex_indices" : "x or y"));
      }
    }
  }
  const Element* find_element(std::string_view name) const {
    const auto at = element_of_name_.find(std::string(name));
    return at == element_of_name_.end() ? nullptr : &elements_[at->second];
  }

  std::string_view word_here(const char* what) {
    if (scanner_.at_line_end()) scanner_.fail(std::string("the line ends, expected ") + what);
    return scanner_.word(what);
  }

  void read_element(const Element& element) {
    if (element.properties.empty()) return;
    for (int i = 0; i < element.count; ++i) {
      double coordinates[3] = {0, 0, 0};
      for (const Property& property : element.properties) read_property(property, coordinates);
      if (element.name == "vertex") {
        mesh_.add_point(coordinates[0], coordinates[1], coordinates[2], scanner_.line());
      } else if (element.name == "face") {
        mesh_.add_face(corners_, scanner_.line());
      }
    }
  }

  void read_property(const Property& property, double (&coordinates)[3]) {
    switch (property.use) {
      case Use::X:
        coordinates[0] = scanner_.number("x of a vertex");
        break;
      case Use::Y:
        coordinates[1] = scanner_.number("y of a vertex");
        break;
      case Use::Z:
        coordinates[2] = scanner_.number("z of a vertex");
        break;
      case Use::Corners:
        read_corners();
        break;
      case Use::Skip:
        skip_value(property);
        break;
    }
  }
  void read_corners() {
    corners_.clear();
    const int n = scanner_.count("number of a face's corners", 2);
    for (int i = 0; i < n; ++i) corners_.push_back(scanner_.integer("vertex number"));
  }
  void skip_value(const Property& property) {
    const int n = property.is_list ? scanner_.count("length of a list", 2) : 1;
    for (int i = 0; i < n; ++i) scanner_.word("value of a property");
  }

  Scanner scanner_;
  Assembler mesh_;
  bool has_format_ = false;
  std::vector<Element> elements_;
  std::unordered_map<std::string, std::size_t> element_of_name_;
  std::vector<int> corners_;
};

}  // namespace

ReadResult read_ply(std::string_view text, const std::string& file, const ReadOptions& options) {
  return PlyReader(text, file, options).read();
}

std::string write_ply(const MeshData& mesh) {
  TextBuffer text(48 * mesh.points.size() + 32 * mesh.triangles.size() + 256);
  text << "ply\nformat ascii 1.0\nelement vertex " << mesh.n_vertices()
       << "\nproperty double x\nproperty double y\nproperty double z\nelement face " << mesh.n_faces()
       << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Point& p : mesh.points) text << p.x << ' ' << p.y << " 0\n";
  for (const Triangle& t : mesh.triangles) text << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  return text.take();
}

}  // namespace kinemesh::io
