#include "kinemesh/mesh.h"

#include <algorithm>

#include "core/mesh/patch.h"
#include "core/mesh/sides.h"

namespace kinemesh {

std::vector<Face> Mesh::faces_in_user_order() const {
  // Numbers of padding faces lie behind the user's unless faces have changed sides; bucket, then close the
  // gaps.
  std::vector<Face> by_number(triangles_.size());
  for (const Face f : faces()) {
    if (!is_padding(f)) by_number[user_face_[f]] = f;
  }
  std::erase(by_number, none);
  return by_number;
}

std::vector<Point> Mesh::in_user_order(std::span<const Point> positions) const {
  std::vector<Point> points(n_user_vertices_);
  for (int u = 0; u < n_user_vertices_; ++u) points[u] = positions[vertex_of_user_[u]];
  return points;
}

MeshData Mesh::domain() const {
  MeshData data;
  data.points = user_positions();
  data.markers = markers_;
  data.label_names = label_names_;
  const auto faces = faces_in_user_order();
  data.triangles.reserve(faces.size());
  for (const Face f : faces) {
    const auto& t = triangles_[f];
    data.triangles.push_back({user_vertex_[t[0]], user_vertex_[t[1]], user_vertex_[t[2]]});
  }
  if (std::any_of(faces.begin(), faces.end(), [&](Face f) { return labels_[f] != 0; })) {
    for (const Face f : faces) data.labels.push_back(labels_[f]);
  }
  return data;
}

// opposite: per side 3 f + k the other one on the same edge, or none. Pre: vertices and corners are there, no
// edge is constrained.
void Mesh::connect(std::span<const int> opposite) {
  across_.resize(triangles_.size());
  side_from_.assign(positions_.size(), none);
  for (const Face f : faces()) {
    for (int k = 0; k < 3; ++k) {
      across_[f][k] = 2 * side_of_pair(opposite[3 * f + k]);
      side_from_[triangles_[f][k]] = side(f, k);
    }
  }
  trace_hull(opposite);
}

// One loop, from its lowest vertex on; any list of vertices, or none, where the sides make no loop.
void Mesh::trace_hull(std::span<const int> opposite) {
  std::vector<std::pair<Vertex, Side>> leaving;  // the side on the hull that starts there
  for (int s = 0; s < static_cast<int>(opposite.size()); ++s)
    if (opposite[s] == none) leaving.emplace_back(from(side_of_pair(s)), side_of_pair(s));
  std::sort(leaving.begin(), leaving.end());
  for (auto at = leaving.begin(); at != leaving.end() && hull_.size() < leaving.size();) {
    const Vertex v = to(at->second);
    hull_.push_back(at->first);
    if (v == leaving.front().first) return;
    at = std::lower_bound(leaving.begin(), leaving.end(), std::pair(v, Side(0)));
  }
}

// Both ways. The word of a side on the hull leads nowhere, but says whether it is constrained.
void Mesh::link(Side side, int word) noexcept {
  this->word(side) = word;
  if (const Side across(word >> 1); across != none) this->word(across) = side << 1 | (word & 1);
}

void Mesh::write(Face face, int label, const MeshTriangle& corners, const Triangle& words) noexcept {
  n_user_faces_ += (label != padding_label) - !is_padding(face);
  labels_[face] = label;
  set_corners(face, corners);
  for (int k = 0; k < 3; ++k) link(side(face, k), words[k]);
}

void Mesh::set_corners(Face face, const MeshTriangle& corners) noexcept {
  triangles_[face] = corners;
  for (int k = 0; k < 3; ++k) side_from_[corners[k]] = side(face, k);
}

void Mesh::forget_constraint(int number) noexcept {
  const Side side = side_of_constraint_[number];
  if (constraint_at_.find(side) == number) constraint_at_.erase(side);
}

void Mesh::remember_constraint(int number, Side side) noexcept {
  side_of_constraint_[number] = lower(side);
  constraint_at_.insert(lower(side), number);
}

// The border is read before anything is written: its sides may be sides of the new faces.
void Mesh::splice(Patch& patch) noexcept {
  const auto written = [&](Side side) { return Mesh::side(patch.faces[face_of(side)], corner_of(side)); };
  for (const auto& line : patch.lines) forget_constraint(line.constraint);
  for (auto& across : patch.across)
    for (int& side : across) side = side < 0 ? word(Side(~side)) : written(Side(side)) << 1;
  for (std::size_t i = 0; i < patch.faces.size(); ++i)
    write(patch.faces[i], patch.labels[i], patch.triangles[i], patch.across[i]);
  for (const auto& [on, number] : patch.lines) {
    const Side side = written(on);
    link(side, word(side) | 1);
    remember_constraint(number, side);
  }
}

// From its lowest corner on. Returns where side 0 has gone.
Side Mesh::rewrite_from_lowest(Face face, MeshTriangle corners) noexcept {
  const int lowest = static_cast<int>(std::min_element(corners.begin(), corners.end()) - corners.begin());
  std::rotate(corners.begin(), corners.begin() + lowest, corners.end());
  set_corners(face, corners);
  return side(face, (3 - lowest) % 3);
}

Side Mesh::flip(Side side) noexcept {
  const Side h = lower(side), o = opposite(h);
  const Vertex a = from(h), b = to(h), c = apex(h), d = apex(o);
  const std::array<Side, 4> outer{prev(o), next(h), prev(h), next(o)};  // db, bc, ca, ad
  std::array<int, 4> words, numbers;
  for (int i = 0; i < 4; ++i) {
    words[i] = word(outer[i]);
    numbers[i] = constraint_of(outer[i]);
  }
  for (const int number : numbers)
    if (number != none) forget_constraint(number);
  const Side db = rewrite_from_lowest(face_of(h), {d, b, c}), ca = rewrite_from_lowest(face_of(o), {c, a, d});
  const std::array<Side, 4> now{db, next(db), ca, next(ca)};
  for (int i = 0; i < 4; ++i) link(now[i], words[i]);
  link(prev(db), prev(ca) << 1);
  for (int i = 0; i < 4; ++i)
    if (numbers[i] != none) remember_constraint(numbers[i], now[i]);
  return prev(db);
}

FaceState Mesh::save(Face face) const {
  FaceState state{face, labels_[face], triangles_[face], across_[face], {}};
  for (int k = 0; k < 3; ++k) state.constraints[k] = constraint_of(side(face, k));
  return state;
}

// The oldest come last. What a state says of its neighbours holds once these have been written, too: a face
// that is not restored has not changed.
template <class At>
void Mesh::restore(std::size_t n, const At& at) noexcept {
  const auto for_each_line = [&](const auto& visit) {
    for (std::size_t i = n; i-- > 0;)
      for (int k = 0; k < 3; ++k)
        if (at(i).constraints[k] != none) visit(at(i).constraints[k], side(at(i).face, k));
  };
  for_each_line([&](int number, int) { forget_constraint(number); });
  for (std::size_t i = n; i-- > 0;) {
    const FaceState& state = at(i);
    write(state.face, state.label, state.corners, state.across);
  }
  for_each_line([&](int number, Side side) { side_of_constraint_[number] = lower(side); });
  for_each_line([&](int number, int) {
    const Side side = side_of_constraint_[number];
    if (constraint_at_.find(side) != number) constraint_at_.insert(side, number);
  });
}

void Mesh::restore(std::span<const FaceState> saved) noexcept {
  restore(saved.size(), [&](std::size_t i) -> const FaceState& { return saved[i]; });
}

void Mesh::restore(std::span<const FaceState> saved, std::span<const Face> faces) noexcept {
  restore(faces.size(), [&](std::size_t i) -> const FaceState& { return saved[faces[i]]; });
}

}  // namespace kinemesh
