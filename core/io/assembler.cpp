#include "core/io/assembler.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "core/base/shortest_text.h"
#include "core/io/scanner.h"
#include "kinemesh/orient.h"

namespace kinemesh::io {
namespace {

double twice_area(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool is_control(char c) {
  return (c >= 0 && c < ' ') || c == 0x7f;
}

}  // namespace

void check_name(std::string_view name) {
  if (name.empty()) throw InputError("the name is empty");
  if (std::any_of(name.begin(), name.end(), is_control)) {
    throw InputError("the name " + in_quotes(name) + " has control characters");
  }
}

void Assembler::add_point(double x, double y, double z, int line) {
  if (z != 0.0) {
    fail(line, "vertex " + std::to_string(mesh_.points.size()) + " has z = " + shortest_text(z) +
                   ", expected 0: only meshes in the plane are read");
  }
  mesh_.points.emplace_back(x, y);
}

void Assembler::add_triangle(const Triangle& corners, int line, int label) {
  if (mesh_.triangles.size() >= static_cast<std::size_t>(most_items)) fail(line, "too many faces");
  if (label == padding_label) fail(line, "label " + std::to_string(label) + " is reserved");
  if (label != 0 && mesh_.labels.empty()) mesh_.labels.assign(mesh_.triangles.size(), 0);
  mesh_.triangles.push_back(corners);
  face_line_.push_back(line);
  if (label != 0 || !mesh_.labels.empty()) mesh_.labels.push_back(label);
}

void Assembler::add_triangles(std::vector<Triangle> triangles, int first_line) {
  if (!mesh_.triangles.empty()) throw std::logic_error("triangles before those of the whole file");
  mesh_.triangles = std::move(triangles);
  face_line_.resize(mesh_.triangles.size());
  std::iota(face_line_.begin(), face_line_.end(), first_line);
}

void Assembler::add_quad(const std::array<int, 4>& c, int line, int label) {
  if (!options_.split_quads) {
    fail(line, "face " + std::to_string(mesh_.triangles.size()) +
                   " is a quadrilateral, expected triangles; --split-quads divides it");
  }
  quads_.push_back({mesh_.n_faces(), c});
  add_triangle({c[0], c[1], c[2]}, line, label);
  add_triangle({c[0], c[2], c[3]}, line, label);
}

void Assembler::add_face(const std::vector<int>& c, int line) {
  if (c.size() == 3) return add_triangle({c[0], c[1], c[2]}, line);
  if (c.size() == 4) return add_quad({c[0], c[1], c[2], c[3]}, line);
  fail(line, "face " + std::to_string(mesh_.triangles.size()) + " has " + std::to_string(c.size()) +
                 " corners, expected 3");
}

int Assembler::marker(std::string_view name, int line) {
  try {
    check_name(name);
  } catch (const InputError& error) {
    fail(line, "marker: " + std::string(error.what()));
  }
  const auto n = static_cast<int>(mesh_.markers.size());
  const auto [at, is_new] = marker_of_name_.try_emplace(std::string(name), n);
  if (is_new) {
    mesh_.markers.push_back({at->first, {}});
    marker_line_.emplace_back();
  }
  return at->second;
}

void Assembler::reserve_marker(int marker, std::size_t n_more) {
  auto& edges = mesh_.markers[marker].edges;
  if (!edges.empty()) return;  // exact sizes, one after the other, would copy all before each time
  edges.reserve(n_more);
  marker_line_[marker].reserve(n_more);
}

void Assembler::add_marker_edge(int marker, const Edge& edge, int line) {
  mesh_.markers[marker].edges.push_back(edge);
  marker_line_[marker].push_back(line);
}

void Assembler::check_markers() const {
  for (std::size_t m = 0; m < mesh_.markers.size(); ++m) {
    for (std::size_t i = 0; i < mesh_.markers[m].edges.size(); ++i) check_marker_edge(static_cast<int>(m), i);
  }
}

void Assembler::check_marker_edge(int marker, std::size_t edge) const {
  const auto [a, b] = mesh_.markers[marker].edges[edge];
  const int n = mesh_.n_vertices();
  const auto exists = [n](int v) { return v >= 0 && v < n; };
  if (a != b && exists(a) && exists(b)) return;
  const std::string vertex = "marker " + mesh_.markers[marker].name + ", edge " + std::to_string(edge) +
                             ": vertex " + std::to_string(exists(a) ? b : a);
  const int line = marker_line_[marker][edge];
  if (a == b) fail(line, vertex + " is there twice");
  fail(line, vertex + " does not exist, expected a number from 0 and below " + std::to_string(n));
}

// Of the two diagonals the one whose smaller triangle, in the quadrilateral's own sense of rotation, is
// larger; the first on a tie. So one with a reflex corner is divided into triangles of the same sign.
void Assembler::choose_diagonals() {
  const auto exists = [&](int v) { return v >= 0 && v < mesh_.n_vertices(); };
  for (const auto& [face, c] : quads_) {
    if (!std::all_of(c.begin(), c.end(), exists)) continue;  // refused a little later
    const auto& p = mesh_.points;
    const double first[2] = {twice_area(p[c[0]], p[c[1]], p[c[2]]), twice_area(p[c[0]], p[c[2]], p[c[3]])};
    const double second[2] = {twice_area(p[c[0]], p[c[1]], p[c[3]]), twice_area(p[c[1]], p[c[2]], p[c[3]])};
    const double sign = first[0] + first[1] < 0 ? -1.0 : 1.0;
    if (std::min(sign * second[0], sign * second[1]) > std::min(sign * first[0], sign * first[1])) {
      mesh_.triangles[face] = {c[0], c[1], c[3]};
      mesh_.triangles[face + 1] = {c[1], c[2], c[3]};
    }
  }
}

void Assembler::check_and_wind() {
  try {
    for (std::string& text : make_consistent(mesh_)) note(std::move(text));
  } catch (const FaceError& error) {
    fail(face_line_[error.face()], error.what());
  }
}

ReadResult Assembler::finish() {
  if (mesh_.triangles.empty()) fail(0, "no triangles, expected at least one");
  choose_diagonals();
  check_and_wind();
  check_markers();
  if (!quads_.empty()) note("quadrilaterals split in two: " + std::to_string(quads_.size()));
  return {std::move(mesh_), std::move(notes_)};
}

}  // namespace kinemesh::io
