#include "core/io/gmsh_groups.h"

#include <cstdlib>
#include <limits>
#include <string>

namespace kinemesh::io {

void GmshGroups::read_names() {
  const int n = scanner_.count("number of physical names", 7);
  for (int i = 0; i < n; ++i) {
    const int dimension = scanner_.integer("dimension of a physical group");
    const int group = scanner_.integer_here("number of a physical group");
    const int line = scanner_.line();
    add_name(dimension, group, unquoted(scanner_.rest_of_line()), line);
  }
}

std::string_view GmshGroups::unquoted(std::string_view name) const {
  if (name.size() < 2 || name.front() != '"' || name.back() != '"') {
    scanner_.fail("expected the name of a physical group in double quotes");
  }
  if (name.find('"', 1) != name.size() - 1) scanner_.fail("quotes within the name of a physical group");
  return name.substr(1, name.size() - 2);
}

void GmshGroups::add_name(int dimension, int group, std::string_view name, int line) {
  if (dimension == 1) marker_of_group_[group] = mesh_.marker(name, line);
  if (dimension == 2) add_label_name(group, name);
}

void GmshGroups::add_label_name(int label, std::string_view name) {
  try {
    check_name(name);
  } catch (const InputError& error) {
    scanner_.fail(error.what());
  }
  mesh_.mesh().label_names[label] = name;
}

void GmshGroups::read_entities() {
  int n[4];
  for (int& count : n) count = scanner_.count("number of entities", 8);
  for (int dimension = 0; dimension < 4; ++dimension) {
    for (int i = 0; i < n[dimension]; ++i) read_entity(dimension);
  }
}

void GmshGroups::read_entity(int dimension) {
  const int tag = scanner_.integer("number of an entity");
  const int n_coordinates = dimension == 0 ? 3 : 6;
  for (int i = 0; i < n_coordinates; ++i) scanner_.word("bounding box of an entity");
  std::vector<int>& groups = groups_of_entity_[{dimension, tag}];
  groups.clear();
  const int n_groups = scanner_.count("number of physical groups", 2);
  for (int i = 0; i < n_groups; ++i)
    groups.push_back(without_direction(scanner_.integer("number of a physical group")));
  if (dimension == 0) return;
  const int n_bounding = scanner_.count("number of bounding entities", 2);
  for (int i = 0; i < n_bounding; ++i) scanner_.integer("number of a bounding entity");
}

std::span<const int> GmshGroups::of_entity(int dimension, int tag) const {
  const auto at = groups_of_entity_.find({dimension, tag});
  return at == groups_of_entity_.end() ? std::span<const int>{} : at->second;
}

int GmshGroups::marker_of(int group) {
  const auto [at, is_new] = marker_of_group_.try_emplace(group, none);
  if (is_new) at->second = mesh_.marker(std::to_string(group), scanner_.line());
  return at->second;
}

int GmshGroups::without_direction(int group) const {
  if (group == std::numeric_limits<int>::min())
    scanner_.fail(std::to_string(group) + " is no physical group");
  return std::abs(group);
}

}  // namespace kinemesh::io
