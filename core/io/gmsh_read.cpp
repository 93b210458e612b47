#include <span>

#include "core/io/assembler.h"
#include "core/io/codecs.h"
#include "core/io/gmsh_groups.h"
#include "core/io/gmsh_nodes.h"
#include "core/io/scanner.h"

namespace kinemesh::io {
namespace {

enum ElementType { line_type = 1, triangle_type = 2, quad_type = 3, point_type = 15 };

std::string name_of_type(int type) {
  switch (type) {
    case 4:
      return "a tetrahedron";
    case 5:
      return "a hexahedron";
    case 6:
      return "a prism";
    case 7:
      return "a pyramid";
    case 8:
      return "a second-order line";
    case 9:
      return "a second-order triangle";
    case 10:
      return "a second-order quadrilateral";
    case 16:
      return "a second-order quadrilateral with 8 nodes";
    case 20:
    case 21:
      return "a third-order triangle";
    default:
      return "of a kind that is not read";
  }
}

class GmshReader {
 public:
  GmshReader(std::string_view text, const std::string& file, const ReadOptions& options)
      : scanner_(text, file), mesh_(file, options), file_size_(text.size()) {}

  ReadResult read() {
    while (!scanner_.at_end()) read_section();
    if (!has_elements_)
      scanner_.fail(std::string("the file ends, expected ") + (has_nodes_ ? "$Elements" : "$Nodes"));
    if (has_several_labels_) mesh_.note("faces in several physical surfaces keep the first as their label");
    return mesh_.finish();
  }

 private:
  void read_section() {
    const std::string_view word = scanner_.word("a section");
    if (word.size() < 2 || word[0] != '$' || word.starts_with("$End")) {
      scanner_.fail(in_quotes(word) + " where a section such as $Nodes was expected");
    }
    const std::string_view name = word.substr(1);
    if (name != "MeshFormat" && name != "Comments" && version_ == 0)
      scanner_.fail("expected $MeshFormat first");
    if (!read_content(name)) return skip_content(name);
    const std::string_view end = scanner_.word("the end of a section");
    if (end.substr(0, 4) != "$End" || end.substr(4) != name) {
      scanner_.fail(in_quotes(end) + " where $End" + std::string(name) + " was expected");
    }
  }

  // False if the section has nothing we keep.
  bool read_content(std::string_view name) {
    if (name == "MeshFormat") return read_format(), true;
    if (name == "PhysicalNames") return read_physical_names(), true;
    if (name == "Nodes") return read_nodes(), true;
    if (name == "Elements") return read_elements(), true;
    if (name == "Entities" && version_ == 4) return groups_.read_entities(), true;
    if (name == "PartitionedEntities") scanner_.fail("the mesh is partitioned, expected it whole");
    if (name == "ParametricNodes") scanner_.fail("section $ParametricNodes, expected $Nodes");
    return false;
  }

  void skip_content(std::string_view name) {
    scanner_.skip_line();
    while (!scanner_.at_end()) {
      const std::string_view word = scanner_.word("a line");
      scanner_.skip_line();
      if (word.substr(0, 4) == "$End" && word.substr(4) == name) return;
    }
    scanner_.fail("the file ends, expected $End" + std::string(name));
  }

  void read_format() {
    const std::string version(scanner_.word("version"));
    if (version == "4.1") {
      version_ = 4;
    } else if (version == "2.2" || version == "2.1" || version == "2.0" || version == "2") {
      version_ = 2;
    } else {
      scanner_.fail("version " + in_quotes(version) + " of the format, expected 2.2 or 4.1");
    }
    if (scanner_.integer_here("file type") != 0) scanner_.fail("a binary file, expected ASCII");
    scanner_.integer_here("data size");
  }

  void read_physical_names() {
    if (has_elements_) scanner_.fail("$PhysicalNames after $Elements, expected it before");
    groups_.read_names();
  }

  void read_nodes() {
    only_once(has_nodes_, "$Nodes");
    version_ == 2 ? read_nodes_2() : read_nodes_4();
    if (const auto twice = nodes_.finish())
      scanner_.fail("node " + std::to_string(*twice) + " is there twice");
  }
  void read_nodes_2() {
    const int n = scanner_.count("number of nodes", 8);
    mesh_.mesh().points.reserve(n);
    for (int i = 0; i < n; ++i) {
      add_node();
      read_coordinates();
    }
  }
  void add_node() {
    const long long tag = scanner_.long_integer("number of a node");
    if (tag < 1) scanner_.fail("node number " + std::to_string(tag) + ", expected numbers from 1");
    nodes_.add(tag);
  }
  void read_coordinates() {
    const double x = scanner_.number("x of a node");
    const double y = scanner_.number_here("y of a node");
    const double z = scanner_.number_here("z of a node");
    mesh_.add_point(x, y, z, scanner_.line());
  }
  void read_nodes_4() {
    const int n_blocks = scanner_.count("number of node blocks", 8);
    const int n = scanner_.count("number of nodes", 8);
    scanner_.long_integer("smallest node number");
    scanner_.long_integer("largest node number");
    mesh_.mesh().points.reserve(n);
    for (int i = 0; i < n_blocks; ++i) read_node_block();
    if (nodes_.size() != static_cast<std::size_t>(n)) {
      scanner_.fail(std::to_string(nodes_.size()) + " nodes in the blocks, expected " + std::to_string(n));
    }
  }
  void read_node_block() {
    const int dimension = scanner_.integer("dimension of an entity");
    scanner_.integer("number of an entity");
    const bool is_parametric = scanner_.integer("0 or 1") != 0;
    const int n = scanner_.count("number of nodes in a block", 8);
    for (int i = 0; i < n; ++i) add_node();
    for (int i = 0; i < n; ++i) {
      read_coordinates();
      for (int k = 0; is_parametric && k < dimension; ++k) scanner_.number_here("parameter of a node");
    }
  }

  void read_elements() {
    if (!has_nodes_) scanner_.fail("$Elements before $Nodes, expected it after");
    only_once(has_elements_, "$Elements");
    version_ == 2 ? read_elements_2() : read_elements_4();
  }
  void read_elements_2() {
    const int n = scanner_.count("number of elements", 8);
    for (int i = 0; i < n; ++i) {
      scanner_.long_integer("number of an element");
      const int type = scanner_.integer_here("type of an element");
      const int group = read_tags();
      read_element(type, {&group, 1});
    }
  }
  // "number-of-tags physical elementary partitions..."
  int read_tags() {
    const int n = scanner_.integer_here("number of tags");
    int group = 0;
    for (int i = 0; i < n; ++i) {
      const int tag = scanner_.integer_here("tag of an element");
      if (i == 0) group = tag;
      if (i == 2 && tag > 0) scanner_.fail("the mesh is partitioned, expected it whole");
    }
    return group;
  }

  void read_elements_4() {
    const int n_blocks = scanner_.count("number of element blocks", 8);
    const int n = scanner_.count("number of elements", 4);
    scanner_.long_integer("smallest element number");
    scanner_.long_integer("largest element number");
    long long n_read = 0;
    for (int i = 0; i < n_blocks; ++i) n_read += read_element_block();
    if (n_read != n) {
      scanner_.fail(std::to_string(n_read) + " elements in the blocks, expected " + std::to_string(n));
    }
  }
  int read_element_block() {
    const int dimension = scanner_.integer("dimension of an entity");
    const int tag = scanner_.integer("number of an entity");
    const int type = scanner_.integer("type of elements");
    const int n = scanner_.count("number of elements in a block", 4);
    const std::span<const int> groups = groups_.of_entity(dimension, tag);
    for (int i = 0; i < n; ++i) {
      scanner_.long_integer("number of an element");
      read_element(type, groups);
    }
    return n;
  }

  // The nodes of an element, the last things in its line.
  void read_element(int type, std::span<const int> groups) {
    const int line = scanner_.line();
    const int label = groups.empty() ? 0 : groups.front();
    if (groups.size() > 1 && type != line_type) has_several_labels_ = true;
    if (type == line_type) {
      add_line({node(), node()}, groups);
    } else if (type == triangle_type) {
      mesh_.add_triangle({node(), node(), node()}, line, label);
    } else if (type == quad_type) {
      mesh_.add_quad({node(), node(), node(), node()}, line, label);
    } else if (type == point_type) {
      node();
    } else {
      scanner_.fail("element type " + std::to_string(type) + " is " + name_of_type(type) +
                    ", expected triangles (2), lines (1) or points (15)");
    }
    scanner_.expect_line_end("an element");
  }
  int node() {
    if (scanner_.at_line_end()) scanner_.fail("the line ends, expected the number of a node");
    const long long tag = scanner_.long_integer("number of a node");
    const int vertex = nodes_.find(tag);
    if (vertex == none) scanner_.fail("node " + std::to_string(tag) + " does not exist");
    return vertex;
  }
  void add_line(const Edge& edge, std::span<const int> groups) {
    repeated_ += groups.size() - !groups.empty();
    if (repeated_ > file_size_)
      scanner_.fail("lines in several physical groups make more edges of markers than the file has bytes");
    for (int group : groups) {
      if (group == 0) continue;
      const int marker = groups_.marker_of(groups_.without_direction(group));
      mesh_.add_marker_edge(marker, edge, scanner_.line());
    }
  }

  void only_once(bool& seen, const char* section) {
    if (seen) scanner_.fail(std::string("a second section ") + section);
    seen = true;
  }

  Scanner scanner_;
  Assembler mesh_;
  GmshGroups groups_{scanner_, mesh_};
  int version_ = 0;
  NodeNumbers nodes_;
  std::size_t file_size_;
  std::size_t repeated_ = 0;  // edges of lines that are in another group, too
  bool has_nodes_ = false, has_elements_ = false, has_several_labels_ = false;
};

}  // namespace

ReadResult read_gmsh(std::string_view text, const std::string& file, const ReadOptions& options) {
  return GmshReader(text, file, options).read();
}

}  // namespace kinemesh::io
