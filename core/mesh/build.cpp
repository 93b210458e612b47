#include "kinemesh/build.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include "core/base/parallel.h"
#include "core/mesh/around.h"
#include "core/mesh/curve.h"
#include "core/mesh/frame.h"
#include "core/mesh/ordered_build.h"
#include "core/mesh/padding.h"
#include "core/mesh/sides.h"
#include "kinemesh/orient.h"
#include "kinemesh/validate.h"

namespace kinemesh {

class MeshBuilder {
 public:
  // order: of the vertices, or nothing for that along the curve.
  MeshBuilder(const MeshData& data, const BuildOptions& options, std::optional<std::span<const int>> order)
      : data_(data), options_(options), order_(order) {}

  Mesh build() {
    check_input();
    place_vertices();
    place_faces();
    embed();
    connect();
    constrain();
    if (auto defect = validate_connectivity(mesh_)) throw NoEmbedding(std::move(*defect));
    return std::move(mesh_);
  }

 private:
  void check_input() const;
  bool is_proper(int face) const;
  [[noreturn]] void refuse_face(int face) const;
  void check_order(const std::vector<int>& order, std::size_t n) const;
  Box domain_box() const;
  std::array<Point, 4> frame_corners(const Box& domain) const;
  void place_vertices();
  void place_faces();
  void embed();
  void add_padding(std::span<const Triangle> padding);
  void connect();
  void label_vertices();
  void constrain();
  void constrain_edge(Side side, int marker);
  void constrain_markers();
  void number_constraints();
  Side find_edge(const Edge& ends) const;
  bool is_in_domain(Side side) const;
  int label_beside(Side side) const;

  const MeshData& data_;
  const BuildOptions& options_;
  std::optional<std::span<const int>> order_;
  Mesh mesh_;
  // Until all is connected, padding included: faces in the mesh's numbers, and per side 3 f + k the one on
  // the same edge.
  std::vector<Triangle> triangles_;
  std::vector<int> opposite_;
  std::unordered_map<int, int> constraint_;  // by lower side
};

namespace {

// Counting sort of faces by their lowest vertices; stable.
std::vector<int> order_by(std::span<const int> lowest, int n_vertices) {
  std::vector<int> start(n_vertices + 1, 0), order(lowest.size());
  for (const int v : lowest) ++start[v + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  for (int f = 0; f < static_cast<int>(lowest.size()); ++f) order[start[lowest[f]]++] = f;
  return order;
}

std::uint64_t key_of(const Edge& edge) {
  const auto [low, high] = std::minmax(edge[0], edge[1]);
  return std::uint64_t{static_cast<std::uint32_t>(low)} << 32 | static_cast<std::uint32_t>(high);
}

std::string name_of(const Edge& edge) {
  return std::to_string(edge[0]) + "-" + std::to_string(edge[1]);
}

}  // namespace

void MeshBuilder::check_input() const {
  check_size(data_.points.size(), "vertices");
  check_size(data_.triangles.size(), "faces");
  const int n = data_.n_vertices();
  if (data_.triangles.empty()) throw InputError("the mesh has no faces");
  if (!data_.labels.empty() && data_.labels.size() != data_.triangles.size()) {
    throw InputError("there must be one label per face, or none");
  }
  const int strange_vertex = find_first(n, grain::items, [&](int v) { return !is_finite(data_.points[v]); });
  if (strange_vertex != none)
    throw InputError("vertex " + std::to_string(strange_vertex) + " has a position that is not finite");
  const int wrong_face = find_first(data_.n_faces(), grain::items, [&](int f) { return !is_proper(f); });
  if (wrong_face != none) refuse_face(wrong_face);
  for (const int v : options_.fixed) {
    if (v < 0 || v >= n) throw InputError("fixed vertex " + std::to_string(v) + " does not exist");
  }
  if (!(options_.frame >= 0.0) || !std::isfinite(options_.frame))
    throw InputError("the frame must be finite, 0 or more");
}

bool MeshBuilder::is_proper(int face) const {
  const auto exists = [n = data_.n_vertices()](int v) { return v >= 0 && v < n; };
  const auto& [a, b, c] = data_.triangles[face];
  return exists(a) && exists(b) && exists(c) && a != b && b != c && c != a &&
         data_.label(face) != padding_label;
}

void MeshBuilder::refuse_face(int face) const {
  const auto& [a, b, c] = data_.triangles[face];
  for (const int v : {a, b, c}) {
    if (v < 0 || v >= data_.n_vertices()) throw FaceError(face, "no vertex has number " + std::to_string(v));
  }
  if (a == b || b == c || c == a) throw FaceError(face, "two corners are the same vertex");
  throw FaceError(face, "this label is reserved");
}

// Around the vertices that are in a face.
Box MeshBuilder::domain_box() const {
  std::array<Box, most_parts> boxes;
  boxes.fill(nowhere);
  parallel_parts(data_.n_faces(), grain::items, [&](int part, int begin, int end) {
    Box box = nowhere;
    for (int f = begin; f < end; ++f)
      for (const int v : data_.triangles[f]) box = hull_of(box, data_.points[v]);
    boxes[part] = box;
  });
  return std::accumulate(boxes.begin(), boxes.end(), nowhere,
                         [](const Box& a, const Box& b) { return hull_of(a, b); });
}

std::array<Point, 4> MeshBuilder::frame_corners(const Box& domain) const {
  const auto corners = frame_around(domain, options_.frame);
  if (!is_finite(corners[0]) || !is_finite(corners[2]))
    throw InputError("the frame's corners are not finite, a smaller frame or smaller coordinates expected");
  return corners;
}

void MeshBuilder::check_order(const std::vector<int>& order, std::size_t n) const {
  std::vector<char> is_there(n, false);
  for (const int i : order) {
    if (i < 0 || i >= static_cast<int>(n) || is_there[i])
      throw InputError("the order of the vertices is none");
    is_there[i] = true;
  }
  if (order.size() != n) throw InputError("the order of the vertices leaves some out");
}

// The user's vertices and the corners of the frame, in their order.
void MeshBuilder::place_vertices() {
  const Box domain = domain_box();  // vertices in no face need not be near
  std::vector<Point> framed;
  if (options_.frame > 0.0) {
    const auto corners = frame_corners(domain);
    framed = data_.points;
    framed.insert(framed.end(), corners.begin(), corners.end());
  }
  const std::span<const Point> points = framed.empty() ? data_.points : framed;
  const std::vector<int> order =
      order_ ? std::vector(order_->begin(), order_->end()) : order_along_curve(points, domain);
  if (order_) check_order(order, points.size());
  const int n = static_cast<int>(points.size());
  mesh_.n_user_vertices_ = data_.n_vertices();
  mesh_.frame_margin_ = options_.frame;
  mesh_.vertex_of_user_.resize(n);
  mesh_.positions_.resize(n);
  mesh_.user_vertex_.resize(n);
  parallel_parts(n, grain::items, [&](int, int begin, int end) {
    for (Vertex v(begin); v < end; ++v) {
      mesh_.positions_[v] = points[order[v]];
      mesh_.user_vertex_[v] = order[v] < data_.n_vertices() ? UserVertex(order[v]) : none;
      mesh_.vertex_of_user_[order[v]] = v;
    }
  });
  mesh_.frame_.assign(mesh_.vertex_of_user_.begin() + data_.n_vertices(), mesh_.vertex_of_user_.end());
  mesh_.vertex_of_user_.resize(data_.n_vertices());
  mesh_.fixed_.assign(n, false);
  for (const int v : options_.fixed) mesh_.fixed_[mesh_.vertex_of_user_[v]] = true;
}

void MeshBuilder::place_faces() {
  const int n = data_.n_faces();
  const auto renumbered = [&](int user_face) {
    const auto& [a, b, c] = data_.triangles[user_face];
    return Triangle{mesh_.vertex_of_user_[a], mesh_.vertex_of_user_[b], mesh_.vertex_of_user_[c]};
  };
  std::vector<int> lowest(n);
  parallel_parts(n, grain::items, [&](int, int begin, int end) {
    for (int f = begin; f < end; ++f) lowest[f] = std::ranges::min(renumbered(f));
  });
  mesh_.n_user_faces_ = n;
  const std::vector<int> order = order_by(lowest, mesh_.n_vertices());
  mesh_.user_face_.resize(n);
  triangles_.resize(n);
  mesh_.labels_.resize(n);
  parallel_parts(n, grain::items, [&](int, int begin, int end) {
    for (int f = begin; f < end; ++f) {
      mesh_.user_face_[f] = UserFace(order[f]);
      triangles_[f] = renumbered(order[f]);
      mesh_.labels_[f] = data_.label(order[f]);
    }
  });
}

void MeshBuilder::embed() {
  auto pairs = pair_sides(triangles_, mesh_.n_vertices());
  if (pairs.conflict != none) {
    throw FaceError(mesh_.user_face_[pairs.conflict],
                    "an edge has more than two faces, or two wound the same way");
  }
  opposite_ = std::move(pairs.opposite);
  std::vector<Edge> border;
  for (int s = 0; s < static_cast<int>(opposite_.size()); ++s) {
    if (opposite_[s] == none) border.push_back(ends_of_side(triangles_, s));
  }
  if (border.empty()) {
    throw NoEmbedding({.kind = DefectKind::NotPlanar, .detail = "there is no border, the surface is closed"});
  }
  add_padding(pad(mesh_.positions_, border, mesh_.frame_, mesh_.user_vertex_));
}

// Sides of padding meet each other or the border; an interior edge of a tangled domain may have the same ends
// as an edge of the padding, so the two must not be paired by their ends.
void MeshBuilder::add_padding(std::span<const Triangle> padding) {
  check_size(triangles_.size() + padding.size(), "faces with the padding around the domain");
  const int first_side = static_cast<int>(opposite_.size());
  auto inner = pair_sides(padding, mesh_.n_vertices());
  for (int& s : inner.opposite) s = s == none ? none : s + first_side;
  opposite_.insert(opposite_.end(), inner.opposite.begin(), inner.opposite.end());
  const std::size_t n_faces = triangles_.size() + padding.size();
  triangles_.reserve(n_faces);
  mesh_.labels_.reserve(n_faces);
  mesh_.user_face_.reserve(n_faces);
  triangles_.insert(triangles_.end(), padding.begin(), padding.end());
  mesh_.labels_.resize(triangles_.size(), padding_label);
  for (UserFace f(mesh_.n_user_faces_); f < static_cast<int>(n_faces); ++f) mesh_.user_face_.push_back(f);

  std::vector<std::pair<Edge, int>> border;  // of the domain, by ends as the padding sees them
  for (int s = 0; s < first_side; ++s) {
    if (opposite_[s] != none) continue;
    const auto [a, b] = ends_of_side(triangles_, s);
    border.push_back({{b, a}, s});
  }
  std::sort(border.begin(), border.end());
  for (int s = first_side; s < static_cast<int>(opposite_.size()); ++s) {
    if (opposite_[s] != none) continue;
    const auto ends = ends_of_side(triangles_, s);
    const auto found = std::lower_bound(border.begin(), border.end(), std::pair(ends, 0));
    if (found == border.end() || found->first != ends) continue;  // the hull
    opposite_[s] = found->second;
    opposite_[found->second] = s;
  }
}

void MeshBuilder::connect() {
  const int n = static_cast<int>(triangles_.size());
  mesh_.triangles_.resize(n);
  parallel_parts(n, grain::items, [&](int, int begin, int end) {
    for (int f = begin; f < end; ++f) mesh_.triangles_[f] = mesh_triangle(triangles_[f]);
  });
  parallel_pair([&] { mesh_.connect(opposite_); }, [&] { label_vertices(); });
  opposite_ = {};
  triangles_ = {};
}

void MeshBuilder::label_vertices() {
  mesh_.home_label_.assign(mesh_.n_vertices(), 0);
  for (const Face f : mesh_.faces()) {
    for (const Vertex v : mesh_.triangles_[f]) mesh_.home_label_[v] = mesh_.labels_[f];
  }
}

int MeshBuilder::label_beside(Side side) const {
  return side == none ? padding_label : mesh_.labels_[Mesh::face_of(side)];
}

void MeshBuilder::constrain() {
  mesh_.on_constraint_.assign(mesh_.n_vertices(), false);
  std::array<std::vector<Side>, most_parts> interfaces;
  parallel_parts(mesh_.n_faces(), grain::items, [&](int part, int begin, int end) {
    for (Face f(begin); f < end; ++f)
      for (const Side s : Mesh::sides(f))
        if (mesh_.is_lower(s) && label_beside(s) != label_beside(mesh_.opposite(s)))
          interfaces[part].push_back(s);
  });
  for (const auto& sides : interfaces)
    for (const Side s : sides) constrain_edge(s, none);
  constrain_markers();
  number_constraints();
  mesh_.label_names_ = data_.label_names;
}

void MeshBuilder::constrain_edge(Side side, int marker) {
  const auto [known, is_new] =
      constraint_.try_emplace(mesh_.lower(side), static_cast<int>(mesh_.constraints_.size()));
  if (!is_new) {
    int& marker_there = mesh_.constraints_[known->second].marker;
    if (marker_there == none) marker_there = marker;
    return;
  }
  const Side lower = mesh_.lower(side), across = mesh_.opposite(lower);
  const bool is_turned = label_beside(lower) == padding_label && across != none;  // the domain to the left
  const Side left = is_turned ? across : lower, right = is_turned ? lower : across;
  const Vertex a = mesh_.from(left), b = mesh_.to(left);
  mesh_.constraints_.push_back({a, b, label_beside(left), label_beside(right), marker});
  for (const Vertex v : {a, b}) {
    mesh_.on_constraint_[v] = true;
    mesh_.home_label_[v] = 0;
  }
}

void MeshBuilder::number_constraints() {
  mesh_.side_of_constraint_.resize(mesh_.constraints_.size());
  mesh_.constraint_at_.reset(mesh_.constraints_.size());
  for (const auto& [on, number] : constraint_) {
    const Side side(on);
    mesh_.link(side, mesh_.word(side) | 1);
    mesh_.remember_constraint(number, side);
  }
}

// An edge that is there again has its constraint already.
void MeshBuilder::constrain_markers() {
  mesh_.markers_ = data_.markers;
  std::unordered_set<std::uint64_t> seen;
  for (int m = 0; m < static_cast<int>(data_.markers.size()); ++m) {
    const auto& marker = data_.markers[m];
    mesh_.marker_names_.push_back(marker.name);
    for (const auto& ends : marker.edges) {
      if (!seen.insert(key_of(ends)).second) continue;
      const Side side = find_edge(ends);
      if (side == none)
        throw InputError("marker " + marker.name + ": " + name_of(ends) + " is not an edge of a face");
      constrain_edge(side, m);
    }
  }
}

// Turns about both ends at the same time until the first one has come around: summed over the edges of a
// planar graph this is in proportion to their number, however many meet in a vertex [Chiba 1985].
Side MeshBuilder::find_edge(const Edge& ends) const {
  for (const int end : ends)
    if (end < 0 || end >= data_.n_vertices()) return none;
  const Vertex a = mesh_.vertex_of_user_[ends[0]], b = mesh_.vertex_of_user_[ends[1]];
  Spokes from_a(mesh_, a), from_b(mesh_, b);
  for (; !from_a.is_done(); from_a.advance()) {
    if (from_a.end() == b && is_in_domain(from_a.side())) return from_a.side();
    if (from_b.is_done()) continue;
    if (from_b.end() == a && is_in_domain(from_b.side())) return from_b.side();
    from_b.advance();
  }
  return none;
}

bool MeshBuilder::is_in_domain(Side side) const {
  return constraint_.contains(mesh_.lower(side)) || label_beside(side) != padding_label;
}

Mesh build_mesh(const MeshData& data, const BuildOptions& options) {
  return MeshBuilder(data, options, std::nullopt).build();
}

Mesh build_mesh(const MeshData& data, const BuildOptions& options, std::span<const int> order) {
  return MeshBuilder(data, options, order).build();
}

}  // namespace kinemesh
