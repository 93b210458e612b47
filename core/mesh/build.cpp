#include "kinemesh/build.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <unordered_set>

#include "core/base/parallel.h"
#include "core/mesh/curve.h"
#include "core/mesh/frame.h"
#include "core/mesh/padding.h"
#include "core/mesh/sides.h"
#include "kinemesh/orient.h"
#include "kinemesh/validate.h"

namespace kinemesh {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

class MeshBuilder {
 public:
  // mesh: empty, and where it stays: OpenMesh's connectivity does not move, it copies.
  MeshBuilder(const MeshData& data, const BuildOptions& options, Mesh& mesh)
      : data_(data), options_(options), mesh_(mesh) {}

  void build() {
    check_input();
    place_vertices();
    place_faces();
    embed();
    connect();
    constrain();
    if (auto defect = validate_connectivity(mesh_)) throw NoEmbedding(std::move(*defect));
  }

 private:
  void check_input() const;
  bool is_proper(int face) const;
  [[noreturn]] void refuse_face(int face) const;
  std::vector<int> order_on_curve(std::span<const Point> points) const;
  std::array<Point, 4> frame_corners() const;
  void place_vertices();
  void place_faces();
  void embed();
  void add_padding(std::span<const Triangle> padding);
  void connect();
  std::vector<int> number_halfedges();
  void label_vertices();
  void link_face(int face);
  void link_border(const std::vector<int>& border);
  void constrain();
  void constrain_edge(int edge, int marker);
  void constrain_markers();
  int find_edge(int user_a, int user_b) const;
  int following(int halfedge, int first) const;
  bool is_in_domain(int halfedge) const;
  int label_beside(int halfedge) const;

  const MeshData& data_;
  const BuildOptions& options_;
  Mesh& mesh_;
  std::vector<int> opposite_;  // per side, padding included; until all is connected
  std::vector<int> halfedge_;  // per side; likewise
};

namespace {

constexpr int grain = 16384;  // vertices or faces that are worth a task

// Counting sort of faces by their lowest vertices; stable.
std::vector<int> order_by(std::span<const int> lowest, int n_vertices) {
  std::vector<int> start(n_vertices + 1, 0), order(lowest.size());
  for (const int v : lowest) ++start[v + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  for (int f = 0; f < static_cast<int>(lowest.size()); ++f) order[start[lowest[f]]++] = f;
  return order;
}

bool is_finite(const Point& p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
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
  const int n = data_.n_vertices();
  if (data_.triangles.empty()) throw InputError("the mesh has no faces");
  if (!data_.labels.empty() && data_.labels.size() != data_.triangles.size()) {
    throw InputError("there must be one label per face, or none");
  }
  const int strange_vertex = find_first(n, grain, [&](int v) { return !is_finite(data_.points[v]); });
  if (strange_vertex != none)
    throw InputError("vertex " + std::to_string(strange_vertex) + " has a position that is not finite");
  const int wrong_face = find_first(data_.n_faces(), grain, [&](int f) { return !is_proper(f); });
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

std::array<Point, 4> MeshBuilder::frame_corners() const {
  std::vector<Point> used;
  for (const auto& t : data_.triangles) {
    for (const int v : t) used.push_back(data_.points[v]);
  }
  const auto corners = frame_around(used, options_.frame);
  if (!is_finite(corners[0]) || !is_finite(corners[2]))
    throw InputError("the frame's corners are not finite, a smaller frame or smaller coordinates expected");
  return corners;
}

// The square that it fills is that of the domain; vertices in no face need not be near.
std::vector<int> MeshBuilder::order_on_curve(std::span<const Point> points) const {
  std::array<Box, most_parts> boxes;
  boxes.fill(nowhere);
  parallel_parts(data_.n_faces(), grain, [&](int part, int begin, int end) {
    for (int f = begin; f < end; ++f)
      for (const int v : data_.triangles[f]) boxes[part] = hull_of(boxes[part], data_.points[v]);
  });
  return order_along_curve(points, std::accumulate(boxes.begin(), boxes.end(), nowhere,
                                                   [](const Box& a, const Box& b) { return hull_of(a, b); }));
}

// The user's vertices and the corners of the frame, along the curve.
void MeshBuilder::place_vertices() {
  std::vector<Point> framed;
  if (options_.frame > 0.0) {
    const auto corners = frame_corners();
    framed = data_.points;
    framed.insert(framed.end(), corners.begin(), corners.end());
  }
  const std::span<const Point> points = framed.empty() ? data_.points : framed;
  const auto order = order_on_curve(points);
  const int n = static_cast<int>(points.size());
  mesh_.n_user_vertices_ = data_.n_vertices();
  mesh_.frame_margin_ = options_.frame;
  mesh_.vertex_of_user_.resize(n);
  mesh_.positions_.resize(n);
  mesh_.user_vertex_.resize(n);
  parallel_parts(n, grain, [&](int, int begin, int end) {
    for (int v = begin; v < end; ++v) {
      mesh_.positions_[v] = points[order[v]];
      mesh_.user_vertex_[v] = order[v] < data_.n_vertices() ? order[v] : none;
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
  parallel_parts(n, grain, [&](int, int begin, int end) {
    for (int f = begin; f < end; ++f) lowest[f] = std::ranges::min(renumbered(f));
  });
  mesh_.n_user_faces_ = n;
  mesh_.user_face_ = order_by(lowest, mesh_.n_vertices());
  mesh_.triangles_.resize(n);
  mesh_.labels_.resize(n);
  parallel_parts(n, grain, [&](int, int begin, int end) {
    for (int f = begin; f < end; ++f) {
      mesh_.triangles_[f] = renumbered(mesh_.user_face_[f]);
      mesh_.labels_[f] = data_.label(mesh_.user_face_[f]);
    }
  });
}

void MeshBuilder::embed() {
  auto pairs = pair_sides(mesh_.triangles_, mesh_.n_vertices());
  if (pairs.conflict != none) {
    throw FaceError(mesh_.user_face_[pairs.conflict],
                    "an edge has more than two faces, or two wound the same way");
  }
  opposite_ = std::move(pairs.opposite);
  std::vector<Edge> border;
  for (int s = 0; s < static_cast<int>(opposite_.size()); ++s) {
    if (opposite_[s] == none) border.push_back(ends_of_side(mesh_.triangles_, s));
  }
  if (border.empty()) {
    throw NoEmbedding({.kind = DefectKind::NotPlanar, .detail = "there is no border, the surface is closed"});
  }
  add_padding(pad(mesh_.positions_, border, mesh_.frame_, mesh_.user_vertex_));
}

// Sides of padding meet each other or the border; an interior edge of a tangled domain may have the same ends
// as an edge of the padding, so the two must not be paired by their ends.
void MeshBuilder::add_padding(std::span<const Triangle> padding) {
  const int first_side = static_cast<int>(opposite_.size());
  auto inner = pair_sides(padding, mesh_.n_vertices());
  for (int& s : inner.opposite) s = s == none ? none : s + first_side;
  opposite_.insert(opposite_.end(), inner.opposite.begin(), inner.opposite.end());
  const std::size_t n_faces = mesh_.triangles_.size() + padding.size();
  mesh_.triangles_.reserve(n_faces);
  mesh_.labels_.reserve(n_faces);
  mesh_.user_face_.reserve(n_faces);
  mesh_.triangles_.insert(mesh_.triangles_.end(), padding.begin(), padding.end());
  mesh_.labels_.resize(mesh_.triangles_.size(), padding_label);
  for (int f = mesh_.n_user_faces_; f < mesh_.n_faces(); ++f) mesh_.user_face_.push_back(f);

  std::vector<std::pair<Edge, int>> border;  // of the domain, by ends as the padding sees them
  for (int s = 0; s < first_side; ++s) {
    if (opposite_[s] != none) continue;
    const auto [a, b] = ends_of_side(mesh_.triangles_, s);
    border.push_back({{b, a}, s});
  }
  std::sort(border.begin(), border.end());
  for (int s = first_side; s < static_cast<int>(opposite_.size()); ++s) {
    if (opposite_[s] != none) continue;
    const auto ends = ends_of_side(mesh_.triangles_, s);
    const auto found = std::lower_bound(border.begin(), border.end(), std::pair(ends, 0));
    if (found == border.end() || found->first != ends) continue;  // the hull
    opposite_[s] = found->second;
    opposite_[found->second] = s;
  }
}

void MeshBuilder::connect() {
  const int n_sides = 3 * mesh_.n_faces();
  const auto n_hull = std::count(opposite_.begin(), opposite_.end(), none);
  const auto n_edges = (n_sides + n_hull) / 2;
  std::vector<int> hull;
  parallel_pair([&] { mesh_.topology_.resize(mesh_.n_vertices(), n_edges, mesh_.n_faces()); },
                [&] {
                  hull = number_halfedges();
                  label_vertices();
                });
  parallel_parts(mesh_.n_faces(), grain, [&](int, int begin, int end) {
    for (int f = begin; f < end; ++f) link_face(f);
  });
  for (int s = 0; s < n_sides; s += 3) {
    const auto& [a, b, c] = mesh_.triangles_[s / 3];
    mesh_.topology_.set_halfedge_handle(VertexHandle(a), HalfedgeHandle(halfedge_[s]));
    mesh_.topology_.set_halfedge_handle(VertexHandle(b), HalfedgeHandle(halfedge_[s + 1]));
    mesh_.topology_.set_halfedge_handle(VertexHandle(c), HalfedgeHandle(halfedge_[s + 2]));
  }
  link_border(hull);
  opposite_ = std::vector<int>();
  halfedge_ = std::vector<int>();
  mesh_.edge_constraint_.assign(n_edges, none);
}

// Along each side, in pairs; returns the sides that nothing lies across.
std::vector<int> MeshBuilder::number_halfedges() {
  std::vector<int> hull;
  halfedge_.assign(opposite_.size(), none);
  int n_edges = 0;
  for (int s = 0; s < static_cast<int>(opposite_.size()); ++s) {
    if (halfedge_[s] != none) continue;
    halfedge_[s] = 2 * n_edges++;
    if (opposite_[s] != none)
      halfedge_[opposite_[s]] = halfedge_[s] + 1;
    else
      hull.push_back(s);
  }
  return hull;
}

void MeshBuilder::label_vertices() {
  mesh_.home_label_.assign(mesh_.n_vertices(), 0);
  for (int f = 0; f < mesh_.n_faces(); ++f) {
    for (const int v : mesh_.triangles_[f]) mesh_.home_label_[v] = mesh_.labels_[f];
  }
}

void MeshBuilder::link_face(int face) {
  auto& topology = mesh_.topology_;
  for (int k = 0; k < 3; ++k) {
    const HalfedgeHandle side(halfedge_[3 * face + k]);
    topology.set_face_handle(side, FaceHandle(face));
    topology.set_vertex_handle(side, VertexHandle(mesh_.triangles_[face][(k + 1) % 3]));
    topology.set_next_halfedge_handle(side, HalfedgeHandle(halfedge_[3 * face + (k + 1) % 3]));
  }
  topology.set_halfedge_handle(FaceHandle(face), HalfedgeHandle(halfedge_[3 * face]));
}

// The outer half-edges, one loop around the whole.
void MeshBuilder::link_border(const std::vector<int>& sides) {
  auto& topology = mesh_.topology_;
  std::vector<std::pair<int, int>> leaving;  // vertex, outer half-edge that starts there
  for (const int s : sides) {
    const HalfedgeHandle outer(Mesh::opposite(halfedge_[s]));
    const auto [a, b] = ends_of_side(mesh_.triangles_, s);
    topology.set_vertex_handle(outer, VertexHandle(a));
    topology.set_face_handle(outer, FaceHandle());
    topology.set_halfedge_handle(VertexHandle(b), outer);
    leaving.emplace_back(b, outer.idx());
  }
  std::sort(leaving.begin(), leaving.end());
  for (const int s : sides) {
    const int a = ends_of_side(mesh_.triangles_, s)[0];
    const auto following = std::lower_bound(leaving.begin(), leaving.end(), std::pair(a, 0));
    topology.set_next_halfedge_handle(HalfedgeHandle(Mesh::opposite(halfedge_[s])),
                                      HalfedgeHandle(following->second));
  }
  const int first = leaving.front().second;
  int h = first;
  do {
    mesh_.hull_.push_back(mesh_.to(h));
    h = mesh_.next(h);
  } while (h != first && mesh_.hull_.size() <= sides.size());
  std::reverse(mesh_.hull_.begin(), mesh_.hull_.end());  // outer half-edges run clockwise
}

int MeshBuilder::label_beside(int halfedge) const {
  const int f = mesh_.face_of(halfedge);
  return f == none ? padding_label : mesh_.labels_[f];
}

void MeshBuilder::constrain() {
  mesh_.on_constraint_.assign(mesh_.n_vertices(), false);
  std::array<std::vector<int>, most_parts> interfaces;
  parallel_parts(mesh_.n_edges(), grain, [&](int part, int begin, int end) {
    for (int e = begin; e < end; ++e)
      if (label_beside(2 * e) != label_beside(2 * e + 1)) interfaces[part].push_back(e);
  });
  for (const auto& edges : interfaces)
    for (const int e : edges) constrain_edge(e, none);
  constrain_markers();
  mesh_.label_names_ = data_.label_names;
}

void MeshBuilder::constrain_edge(int edge, int marker) {
  if (const int known = mesh_.edge_constraint_[edge]; known != none) {
    if (mesh_.constraints_[known].marker == none) mesh_.constraints_[known].marker = marker;
    return;
  }
  int h = 2 * edge;
  if (label_beside(h) == padding_label) h = Mesh::opposite(h);  // the domain to the left
  mesh_.edge_constraint_[edge] = static_cast<int>(mesh_.constraints_.size());
  mesh_.constraints_.push_back(
      {mesh_.from(h), mesh_.to(h), label_beside(h), label_beside(Mesh::opposite(h)), marker});
  mesh_.on_constraint_[mesh_.from(h)] = true;
  mesh_.on_constraint_[mesh_.to(h)] = true;
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
      const int edge = find_edge(ends[0], ends[1]);
      if (edge == none)
        throw InputError("marker " + marker.name + ": " + name_of(ends) + " is not an edge of a face");
      constrain_edge(edge, m);
    }
  }
}

// Turns about both ends at the same time until the first one has come around: summed over the edges of a planar
// graph this is in proportion to their number, however many meet in a vertex [Chiba 1985].
int MeshBuilder::find_edge(int user_a, int user_b) const {
  const int n = data_.n_vertices();
  if (user_a < 0 || user_a >= n || user_b < 0 || user_b >= n) return none;
  const int a = mesh_.vertex_of_user_[user_a], b = mesh_.vertex_of_user_[user_b];
  const int first_a = mesh_.outgoing(a), first_b = mesh_.outgoing(b);
  int from_a = first_a, from_b = first_b;
  while (from_a != none) {
    if (mesh_.to(from_a) == b && is_in_domain(from_a)) return Mesh::edge_of(from_a);
    if (from_b != none && mesh_.to(from_b) == a && is_in_domain(from_b)) return Mesh::edge_of(from_b);
    from_a = following(from_a, first_a);
    from_b = following(from_b, first_b);
  }
  return none;
}

// The next one that leaves the same vertex; none after the last.
int MeshBuilder::following(int halfedge, int first) const {
  if (halfedge == none) return none;
  const int next = mesh_.next(Mesh::opposite(halfedge));
  return next == first ? none : next;
}

bool MeshBuilder::is_in_domain(int halfedge) const {
  const int f = mesh_.face_of(halfedge);
  return mesh_.constraint_of(Mesh::edge_of(halfedge)) != none || (f != none && !mesh_.is_padding(f));
}

Mesh build_mesh(const MeshData& data, const BuildOptions& options) {
  Mesh mesh;
  MeshBuilder(data, options, mesh).build();
  return mesh;
}

}  // namespace kinemesh
