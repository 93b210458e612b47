// For a solver whose mesh is an OpenMesh::TriMesh_ArrayKernelT, of any traits: taken from there, given there,
// and each step done to it in place, so that its handles and properties stay.
//
//   Stepper stepper(build_mesh(open_mesh));
//   stepper.observe([&](const StepChanges& changes) { apply(changes, open_mesh); });
//
// Vertex k and face k of the OpenMesh mesh are the user's vertex k and face k, and its corners are in the
// order of fv_range. Points have two or three coordinates, float or double; a third one means nothing.
// Besides, by name and where they are there:
//   "label"        face property, int       the face's label
//   "marker:NAME"  edge property, bool      whether marker NAME holds the edge
//   status         of vertices, locked()    a fixed vertex (BuildOptions::fixed)
//
// The only public header that needs OpenMesh, from version 9 on.
#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "kinemesh/build.h"
#include "kinemesh/error.h"
#include "kinemesh/mesh.h"
#include "kinemesh/mesh_data.h"
#include "kinemesh/step_changes.h"
#include "kinemesh/types.h"

#pragma GCC visibility push(default)
namespace kinemesh {

// The mesh as plain arrays. An edge of a marker has the domain to its left. Throws InputError for deleted
// elements, for points whose third coordinates differ, for a domain that touches itself in a vertex, and for
// a property above of another type.
template <class Traits>
MeshData from_openmesh(const OpenMesh::TriMesh_ArrayKernelT<Traits>& open);

// build_mesh (kinemesh/build.h) of that, with what it throws, and locked vertices fixed besides.
template <class Traits>
Mesh build_mesh(const OpenMesh::TriMesh_ArrayKernelT<Traits>& open, const BuildOptions& options = {});

// The domain as a new OpenMesh mesh, with the properties above; a third coordinate is 0. Faces as in
// Mesh::domain. Throws InputError for a domain that touches itself in a vertex, and for a position too large
// for OpenMeshT's coordinates.
template <class OpenMeshT>
OpenMeshT to_openmesh(const Mesh& mesh);

// Does to `open` what a step has done to the stepper's mesh, in place. Vertices and faces keep their handles,
// and so do all edges but those that a patch no longer has: their handles, with what the properties of edges
// and halfedges hold, go to the edges that come to the patch. All points are set to the new positions,
// rounded to their type: of float, a thin face may then be flat or inverted. Their third coordinates stay.
// Faces that change their label, which only escaped vertices bring about, change it in the property, too.
//
// To be called by an observer of the stepper, the last one. Throws InputError for a mesh that is not the
// stepper's before the step (other counts, deleted elements, other corners of faces that the step has
// rewritten or of their neighbours), for steps in which vertices have escaped, and for a position too large;
// then the step is vetoed, and `open` is as it was. Cost: O(m log m) for m rewritten faces, and O(n) for
// their numbers and the points.
template <class Traits>
void apply(const StepChanges& changes, OpenMesh::TriMesh_ArrayKernelT<Traits>& open);

// From here on details.
namespace openmesh {

using OpenMesh::EdgeHandle;
using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;
using Kernel = OpenMesh::ArrayKernel;  // connectivity and status of any mesh
using Halfedges =
    std::array<HalfedgeHandle, 3>;  // of a face; the k-th runs from its corner k to the next one

inline const std::string label_property = "label", marker_prefix = "marker:";

inline std::string about(const char* what, int number) {
  return std::string(what) + " " + std::to_string(number) + " of the OpenMesh mesh";
}

template <class Handle>
void check_none_deleted(const Kernel& open, bool has_status, std::size_t n, const char* what) {
  for (int i = 0; has_status && i < static_cast<int>(n); ++i)
    if (open.status(Handle(i)).deleted())
      throw InputError(about(what, i) + " is deleted, garbage_collection() expected before");
}

inline void check_none_deleted(const Kernel& open) {
  check_none_deleted<VertexHandle>(open, open.has_vertex_status(), open.n_vertices(), "vertex");
  check_none_deleted<EdgeHandle>(open, open.has_edge_status(), open.n_edges(), "edge");
  check_none_deleted<FaceHandle>(open, open.has_face_status(), open.n_faces(), "face");
}

// OpenMesh's halfedge of a vertex can say where one gap between the faces around it is.
inline void check_touches_nowhere(const Kernel& open) {
  std::vector<bool> has_gap(open.n_vertices(), false);
  for (int i = 0; i < static_cast<int>(open.n_halfedges()); ++i) {
    if (!open.is_boundary(HalfedgeHandle(i))) continue;
    const int v = open.from_vertex_handle(HalfedgeHandle(i)).idx();
    if (has_gap[v])
      throw InputError("the domain touches itself in vertex " + std::to_string(v) +
                       ", which an OpenMesh mesh cannot follow");
    has_gap[v] = true;
  }
}

template <class Open>
using Scalar = typename OpenMesh::vector_traits<typename Open::Point>::value_type;

template <class Open>
inline constexpr int dimension = static_cast<int>(OpenMesh::vector_traits<typename Open::Point>::size_);

template <class Open>
constexpr void check_type() {
  static_assert(dimension<Open> == 2 || dimension<Open> == 3, "points of two or three coordinates");
  static_assert(std::is_floating_point_v<Scalar<Open>>, "coordinates that are float or double");
}

template <class Open>
void check_flat(const Open& open) {
  if constexpr (dimension<Open> == 3) {
    for (int v = 1; v < static_cast<int>(open.n_vertices()); ++v)
      if (open.point(VertexHandle(v))[2] != open.point(VertexHandle(0))[2])
        throw InputError(about("vertex", v) + " has another third coordinate than vertex 0");
  }
}

template <class Open>
void check_fits(const Point& p, int vertex) {
  constexpr double most = std::numeric_limits<Scalar<Open>>::max();
  if (!(std::abs(p.x) <= most && std::abs(p.y) <= most))
    throw InputError(about("vertex", vertex) + " has a position too large for its coordinates");
}

template <class Open>
void place(Open& open, int vertex, const Point& p) noexcept {
  auto& point = open.point(VertexHandle(vertex));
  point[0] = static_cast<Scalar<Open>>(p.x);
  point[1] = static_cast<Scalar<Open>>(p.y);
}

inline Halfedges halfedges_of(const Kernel& open, int face) {
  const HalfedgeHandle last = open.halfedge_handle(FaceHandle(face));  // ends where fv_range begins
  const HalfedgeHandle first = open.next_halfedge_handle(last);
  return {first, open.next_halfedge_handle(first), last};
}

inline Triangle corners_of(const Kernel& open, int face) {
  const auto [a, b, c] = halfedges_of(open, face);
  return {open.to_vertex_handle(c).idx(), open.to_vertex_handle(a).idx(), open.to_vertex_handle(b).idx()};
}

// The halfedges' opposites are not touched, and vertices with a halfedge on the border keep it.
inline void write_face(Kernel& open, FaceHandle face, const Halfedges& halfedges,
                       const Triangle& corners) noexcept {
  for (int k = 0; k < 3; ++k) {
    const VertexHandle from(corners[k]), to(corners[(k + 1) % 3]);
    open.set_vertex_handle(halfedges[k], to);
    open.set_face_handle(halfedges[k], face);
    open.set_next_halfedge_handle(halfedges[k], halfedges[(k + 1) % 3]);
    if (const auto out = open.halfedge_handle(from); !out.is_valid() || !open.is_boundary(out))
      open.set_halfedge_handle(from, halfedges[k]);
  }
  open.set_halfedge_handle(face, halfedges[2]);
}

// What lies across from faces on the border, once all faces are written.
inline void write_border(Kernel& open) {
  std::vector<HalfedgeHandle> border;
  for (int i = 0; i < static_cast<int>(open.n_halfedges()); ++i)
    if (open.is_boundary(HalfedgeHandle(i))) border.push_back(HalfedgeHandle(i));
  for (const HalfedgeHandle h : border) {
    const auto before = open.prev_halfedge_handle(open.opposite_halfedge_handle(h));
    open.set_vertex_handle(h, open.to_vertex_handle(before));
  }
  check_touches_nowhere(open);
  for (const HalfedgeHandle h : border) {  // turns about the end of h, through all of its faces
    auto next = open.opposite_halfedge_handle(h);
    do {
      next = open.opposite_halfedge_handle(open.prev_halfedge_handle(next));
    } while (!open.is_boundary(next));
    open.set_next_halfedge_handle(h, next);
    open.set_halfedge_handle(open.to_vertex_handle(h), next);
  }
}

template <class Open>
std::vector<int> labels_of(const Open& open) {
  OpenMesh::FPropHandleT<int> label;
  if (!open.get_property_handle(label, label_property)) {
    if (open._get_fprop(label_property))
      throw InputError("face property 'label' of the OpenMesh mesh is not of int");
    return {};
  }
  std::vector<int> labels;
  for (int f = 0; f < static_cast<int>(open.n_faces()); ++f)
    labels.push_back(open.property(label, FaceHandle(f)));
  return labels;
}

template <class Open>
Marker marker_of(const Open& open, const std::string& property) {
  OpenMesh::EPropHandleT<bool> holds;
  if (!open.get_property_handle(holds, property))
    throw InputError("edge property '" + property + "' of the OpenMesh mesh is not of bool");
  Marker marker{property.substr(marker_prefix.size()), {}};
  for (int e = 0; e < static_cast<int>(open.n_edges()); ++e) {
    if (!open.property(holds, EdgeHandle(e))) continue;
    const auto first = open.halfedge_handle(EdgeHandle(e), 0);
    const auto left = open.is_boundary(first) ? open.opposite_halfedge_handle(first) : first;
    marker.edges.push_back({open.from_vertex_handle(left).idx(), open.to_vertex_handle(left).idx()});
  }
  return marker;
}

// Where the edges of a mesh's constraints are, by their ends in the user's numbering, lower one first.
using ConstrainedEdges = std::map<Edge, EdgeHandle>;

template <class Open>
void add_marker(Open& open, const Marker& marker, const ConstrainedEdges& constrained) {
  OpenMesh::EPropHandleT<bool> holds;
  open.add_property(holds, marker_prefix + marker.name);
  for (const auto& [a, b] : marker.edges) {
    const auto found = constrained.find({std::min(a, b), std::max(a, b)});
    if (found != constrained.end())
      open.property(holds, found->second) = true;  // or padding is on both sides
  }
}

// A mesh's domain as half-edges: which of an OpenMesh mesh its sides are to be.
class Numbering {
 public:
  explicit Numbering(const Mesh& mesh) : faces(mesh.faces_in_user_order()), halfedges(mesh.n_faces()) {
    for (const auto face : faces)
      for (const Side side : Mesh::sides(face))
        if (!at(side).is_valid()) number(mesh, side);
  }

  std::vector<Face> faces;           // the domain's, in the user's order
  std::vector<Halfedges> halfedges;  // per face of the mesh
  int n_edges = 0;
  ConstrainedEdges constrained;

 private:
  HalfedgeHandle& at(Side side) { return halfedges[Mesh::face_of(side)][Mesh::corner_of(side)]; }

  void number(const Mesh& mesh, Side side) {
    const auto across = mesh.opposite(side);
    at(side) = HalfedgeHandle(2 * n_edges);
    if (across != none) at(across) = HalfedgeHandle(2 * n_edges + 1);  // of padding it means nothing
    if (mesh.has_constraint(side)) {
      const int a = mesh.user_vertex(mesh.from(side)), b = mesh.user_vertex(mesh.to(side));
      constrained.emplace(Edge{std::min(a, b), std::max(a, b)}, EdgeHandle(n_edges));
    }
    ++n_edges;
  }
};

// The faces a step has rewritten, with the halfedges of an OpenMesh mesh they get: found and checked first,
// then written without fail. The edges of the rewritten faces are of three kinds:
// - An unchanged face lies across, after and before: its halfedge says which edge that is.
// - It is on the domain's border, after and before.
// - A rewritten face lies across, after or before. If the patch has one with these ends before, that is kept;
//   of the others a patch has as many before as after, by Euler's formula.
class Rewriting {
 public:
  Rewriting(const StepChanges& changes, const Kernel& open)
      : mesh_(changes.mesh), open_(open), place_(open.n_faces(), none) {
    const auto mesh_faces = check_numbers(changes);
    std::size_t n_faces = 0;
    for (const auto& patch : changes.patches) n_faces += patch.faces.size();
    faces_.reserve(n_faces);
    for (const auto& patch : changes.patches) {
      for (const auto& change : patch.faces) {
        check_corners(change);
        place_[change.face] = static_cast<int>(faces_.size());
        faces_.push_back({&change, mesh_faces[change.face], patch.faces.front().face, Halfedges()});
      }
    }
    hand_over(edges_before(), edges_after());
  }

  void write(Kernel& open) const noexcept {
    for (const auto& [change, mesh_face, patch, halfedges] : faces_)
      write_face(open, FaceHandle(change->face), halfedges, numbers_of(change->after));
  }

  template <class Visit>
  void visit(const Visit& visit) const noexcept {
    for (const auto& face : faces_) visit(*face.change);
  }

 private:
  struct RewrittenFace {
    const FaceChange* change = nullptr;
    Face mesh_face;
    int patch = none;  // its smallest face
    Halfedges halfedges;
  };

  // An edge that runs from the smaller to the larger of its vertices, or on the border with its face to the
  // left. Between two patches it is counted to that with the smaller number, before and after.
  struct SharedEdge {
    int patch = none, from = none, to = none;
    bool is_border = false;
    int number = none;  // of the halfedge before, of the side after

    auto key() const { return std::tuple(patch, is_border, from, to); }
    bool operator<(const SharedEdge& other) const { return key() < other.key(); }
  };
  using SharedEdges = std::vector<SharedEdge>;

  // The mesh's faces by the user's numbers.
  std::vector<Face> check_numbers(const StepChanges& changes) const {
    const auto differ = [](std::size_t open, int ours, const char* what) {
      if (static_cast<int>(open) != ours)
        throw InputError("the OpenMesh mesh has " + std::to_string(open) + " " + what + ", the stepper's " +
                         std::to_string(ours));
    };
    differ(open_.n_vertices(), mesh_.n_user_vertices(), "vertices");
    for (const auto& patch : changes.patches)
      for (const auto& change : patch.faces)
        if (change.label_before == padding_label || change.label_after == padding_label)
          throw InputError("a vertex has escaped, and face " + std::to_string(change.face) +
                           (change.label_after == padding_label ? " has left" : " has entered") +
                           " the domain, which an OpenMesh mesh cannot follow");
    differ(open_.n_faces(), mesh_.n_user_faces(), "faces");
    auto faces = mesh_.faces_in_user_order();
    if (mesh_.user_face(faces.back()) + 1 != mesh_.n_user_faces())
      throw InputError("the numbers of the stepper's faces have gaps since vertices have escaped");
    return faces;
  }

  void check_corners(const FaceChange& change) const {
    const auto& [a, b, c] = corners_of(open_, change.face);
    const Triangle before = numbers_of(change.before);
    if (before != Triangle{a, b, c} && before != Triangle{b, c, a} && before != Triangle{c, a, b})
      refuse(change.face);
  }

  [[noreturn]] void refuse(int face) const {
    const auto& [a, b, c] = corners_of(open_, face);
    throw InputError(about("face", face) + " with the corners " + std::to_string(a) + " " +
                     std::to_string(b) + " " + std::to_string(c) +
                     " or a neighbour of it is not as in the stepper's mesh before the step");
  }

  bool is_rewritten(int face) const { return place_[face] != none; }
  int patch_of(int face) const { return faces_[place_[face]].patch; }

  SharedEdges edges_before() const {
    SharedEdges edges;
    edges.reserve(2 * faces_.size());
    for (const auto& face : faces_)
      for (const auto h : halfedges_of(open_, face.change->face)) {
        const int from = open_.from_vertex_handle(h).idx(), to = open_.to_vertex_handle(h).idx();
        add(edges, face.patch, from, to, open_.face_handle(open_.opposite_halfedge_handle(h)).idx(), h.idx());
      }
    return edges;
  }

  // Besides takes those halfedges over that unchanged faces know.
  SharedEdges edges_after() {
    SharedEdges edges;
    edges.reserve(2 * faces_.size());
    for (auto& face : faces_)
      for (const Side side : Mesh::sides(face.mesh_face)) {
        const int from = mesh_.user_vertex(mesh_.from(side)), to = mesh_.user_vertex(mesh_.to(side));
        const int across = face_across(side);
        if (across != none && !is_rewritten(across))
          face.halfedges[Mesh::corner_of(side)] = opposite_of_unchanged(across, to, from);
        add(edges, face.patch, from, to, across, side);
      }
    return edges;
  }

  void add(SharedEdges& edges, int patch, int from, int to, int across, int number) const {
    const bool is_border = across == none;
    if (!is_border && (!is_rewritten(across) || to < from)) return;
    edges.push_back({is_border ? patch : std::min(patch, patch_of(across)), from, to, is_border, number});
  }

  int face_across(Side side) const {  // the user's number
    const Face across = mesh_.face_across(side);
    return across == none ? none : int{mesh_.user_face(across)};
  }

  HalfedgeHandle opposite_of_unchanged(int face, int from, int to) const {
    for (const auto h : halfedges_of(open_, face)) {
      if (open_.from_vertex_handle(h).idx() != from || open_.to_vertex_handle(h).idx() != to) continue;
      const auto opposite = open_.opposite_halfedge_handle(h);
      if (open_.is_boundary(opposite) || !is_rewritten(open_.face_handle(opposite).idx())) break;
      return opposite;
    }
    refuse(face);
  }

  void hand_over(SharedEdges before, SharedEdges after) {
    std::sort(before.begin(), before.end());
    std::sort(after.begin(), after.end());
    SharedEdges gone, come;
    auto next = before.begin();
    for (const auto& edge : after) {
      while (next != before.end() && *next < edge) gone.push_back(*next++);
      if (next != before.end() && !(edge < *next))
        hand_over(*next++, edge);
      else
        come.push_back(edge);
    }
    gone.insert(gone.end(), next, before.end());
    for (std::size_t i = 0; i < std::max(gone.size(), come.size()); ++i) {
      const auto& some = i < gone.size() ? gone[i] : come[i];
      if (i >= gone.size() || i >= come.size() || gone[i].patch != come[i].patch || gone[i].is_border ||
          come[i].is_border)
        refuse(some.patch);
      hand_over(gone[i], come[i]);
    }
  }

  void hand_over(const SharedEdge& before, const SharedEdge& after) {
    const HalfedgeHandle h(before.number);
    const Side side(after.number);
    faces_[place_of(side)].halfedges[Mesh::corner_of(side)] = h;
    if (after.is_border) return;
    const auto across = mesh_.opposite(side);
    faces_[place_of(across)].halfedges[Mesh::corner_of(across)] = open_.opposite_halfedge_handle(h);
  }

  int place_of(Side side) const { return place_[mesh_.user_face(Mesh::face_of(side))]; }

  const Mesh& mesh_;
  const Kernel& open_;
  std::vector<int> place_;  // per face: in faces_, or none
  std::vector<RewrittenFace> faces_;
};

}  // namespace openmesh

template <class Traits>
MeshData from_openmesh(const OpenMesh::TriMesh_ArrayKernelT<Traits>& open) {
  openmesh::check_type<OpenMesh::TriMesh_ArrayKernelT<Traits>>();
  openmesh::check_none_deleted(open);
  openmesh::check_touches_nowhere(open);
  openmesh::check_flat(open);
  MeshData data;
  for (int v = 0; v < static_cast<int>(open.n_vertices()); ++v) {
    const auto& point = open.point(OpenMesh::VertexHandle(v));
    data.points.emplace_back(point[0], point[1]);
  }
  for (int f = 0; f < static_cast<int>(open.n_faces()); ++f)
    data.triangles.push_back(openmesh::corners_of(open, f));
  data.labels = openmesh::labels_of(open);
  for (auto property = open.eprops_begin(); property != open.eprops_end(); ++property)
    if (*property && (*property)->name().starts_with(openmesh::marker_prefix))
      data.markers.push_back(openmesh::marker_of(open, (*property)->name()));
  return data;
}

template <class Traits>
Mesh build_mesh(const OpenMesh::TriMesh_ArrayKernelT<Traits>& open, const BuildOptions& options) {
  const MeshData data = from_openmesh(open);
  BuildOptions with_locked = options;
  for (int v = 0; open.has_vertex_status() && v < data.n_vertices(); ++v)
    if (open.status(OpenMesh::VertexHandle(v)).locked()) with_locked.fixed.push_back(v);
  return build_mesh(data, with_locked);
}

template <class OpenMeshT>
OpenMeshT to_openmesh(const Mesh& mesh) {
  openmesh::check_type<OpenMeshT>();
  const openmesh::Numbering numbering(mesh);
  OpenMeshT open;
  open.resize(mesh.n_user_vertices(), numbering.n_edges, numbering.faces.size());
  for (const UserVertex v : Numbers<UserVertex>(mesh.n_user_vertices())) {
    const Vertex vertex = mesh.vertex_of_user(v);
    openmesh::check_fits<OpenMeshT>(mesh.position(vertex), v);
    open.set_point(OpenMesh::VertexHandle(v), typename OpenMeshT::Point(0));
    openmesh::place(open, v, mesh.position(vertex));
    if (open.has_vertex_status()) open.status(OpenMesh::VertexHandle(v)).set_locked(mesh.is_fixed(vertex));
  }
  OpenMesh::FPropHandleT<int> label;
  open.add_property(label, openmesh::label_property);
  for (int f = 0; f < static_cast<int>(numbering.faces.size()); ++f) {
    const Face face = numbering.faces[f];
    const auto& [a, b, c] = mesh.triangles()[face];
    openmesh::write_face(open, OpenMesh::FaceHandle(f), numbering.halfedges[face],
                         {mesh.user_vertex(a), mesh.user_vertex(b), mesh.user_vertex(c)});
    open.property(label, OpenMesh::FaceHandle(f)) = mesh.label(face);
  }
  openmesh::write_border(open);
  for (const auto& marker : mesh.markers()) openmesh::add_marker(open, marker, numbering.constrained);
  return open;
}

template <class Traits>
void apply(const StepChanges& changes, OpenMesh::TriMesh_ArrayKernelT<Traits>& open) {
  using Open = OpenMesh::TriMesh_ArrayKernelT<Traits>;
  openmesh::check_type<Open>();
  openmesh::check_none_deleted(open);
  const openmesh::Rewriting rewriting(changes, open);
  const int n = changes.mesh.n_user_vertices();
  for (const UserVertex v : Numbers<UserVertex>(n)) openmesh::check_fits<Open>(changes.after(v), v);
  OpenMesh::FPropHandleT<int> label;
  open.get_property_handle(label, openmesh::label_property);
  rewriting.write(open);  // from here on nothing throws
  if (label.is_valid())
    rewriting.visit([&](const FaceChange& change) {
      open.property(label, OpenMesh::FaceHandle(change.face)) = change.label_after;
    });
  for (const UserVertex v : Numbers<UserVertex>(n)) openmesh::place(open, v, changes.after(v));
}

}  // namespace kinemesh
#pragma GCC visibility pop
