// The physical groups of a Gmsh file: curves that become markers, surfaces that become labels.
#pragma once

#include <map>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "core/io/assembler.h"
#include "core/io/scanner.h"

namespace kinemesh::io {

// Reads from the scanner and tells the mesh of markers and names. All throw InputError with file and line.
class GmshGroups {
 public:
  GmshGroups(Scanner& scanner, Assembler& mesh) : scanner_(scanner), mesh_(mesh) {}

  void read_names();     // the content of $PhysicalNames
  void read_entities();  // the content of $Entities, which only version 4 has

  std::span<const int> of_entity(int dimension, int tag) const;  // empty for one that is not known
  int marker_of(int group);                // a curve's; called by its number if it has no name
  int without_direction(int group) const;  // a group's sign only says which way its curve or surface is seen

 private:
  std::string_view unquoted(std::string_view name) const;
  void add_name(int dimension, int group, std::string_view name, int line);
  void add_label_name(int label, std::string_view name);
  void read_entity(int dimension);

  Scanner& scanner_;
  Assembler& mesh_;
  std::map<int, int> marker_of_group_;
  std::map<std::pair<int, int>, std::vector<int>> groups_of_entity_;  // by dimension and tag
};

}  // namespace kinemesh::io
