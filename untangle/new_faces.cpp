#include "untangle/new_faces.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "core/predicates.h"

namespace kinemesh {
namespace {

Edge user_ends(const Mesh& mesh, int from, int to) {
  return {mesh.user_vertex(from), mesh.user_vertex(to)};
}

class LabelFlood {
 public:
  LabelFlood(const Mesh& mesh, NewFaces& faces)
      : mesh_(mesh), faces_(faces), source_(faces.size(), Edge{none, none}) {
    faces_.labels.assign(faces.size(), 0);
    has_label_.assign(faces.size(), false);
  }

  std::optional<Defect> run() {
    for (int t = 0; t < faces_.size(); ++t) {
      for (int k = 0; k < 3; ++k) {
        if (faces_.neighbours[t][k] < 0) enter(t, ~faces_.neighbours[t][k]);
      }
    }
    while (!pending_.empty() && !defect_) {
      const int t = pending_.back();
      pending_.pop_back();
      for (int k = 0; k < 3; ++k) spread(t, k);
    }
    return std::move(defect_);
  }

 private:
  // From the face that has been inside the border so far.
  void enter(int t, int halfedge) {
    set(t, mesh_.label(mesh_.face_of(halfedge)), user_ends(mesh_, mesh_.from(halfedge), mesh_.to(halfedge)));
  }

  void spread(int t, int k) {
    const int across = faces_.neighbours[t][k];
    if (across < 0) return;
    const int number = faces_.constraints[t][k];
    if (number == none) {
      set(across, faces_.labels[t], source_[t]);
      return;
    }
    const auto& constraint = mesh_.constraints()[number];
    const bool on_left = faces_.triangles[t][k] == constraint.from;
    const Edge ends = user_ends(mesh_, constraint.from, constraint.to);
    set(t, on_left ? constraint.left : constraint.right, ends);
    set(across, on_left ? constraint.right : constraint.left, ends);
  }

  void set(int t, int label, const Edge& source) {
    if (!has_label_[t]) {
      has_label_[t] = true;
      faces_.labels[t] = label;
      source_[t] = source;
      pending_.push_back(t);
    } else if (faces_.labels[t] != label && !defect_) {
      defect_ = Defect{.kind = DefectKind::LabelsMeet,
                       .edges = {source_[t], source},
                       .where = mesh_.position(faces_.triangles[t][0])};
    }
  }

  const Mesh& mesh_;
  NewFaces& faces_;
  std::vector<Edge> source_;  // per face: where its label came from
  std::vector<bool> has_label_;
  std::vector<int> pending_;
  std::optional<Defect> defect_;
};

// The vertex with the smallest number of those that have, or none.
int first_escaped(const Mesh& mesh, const NewFaces& faces) {
  int first = none;
  for (int t = 0; t < faces.size(); ++t) {
    for (const int v : faces.triangles[t]) {
      const bool escaped = !mesh.is_constrained(v) && mesh.home_label(v) != faces.labels[t];
      if (escaped && (first == none || mesh.user_vertex(v) < mesh.user_vertex(first))) first = v;
    }
  }
  return first;
}

class PatchBuilder {
 public:
  PatchBuilder(const Mesh& mesh, const FaceSets& sets, int set, const NewFaces& faces)
      : mesh_(mesh), sets_(sets), set_(set), faces_(faces) {}

  Patch build() {
    if (faces_.size() != static_cast<int>(sets_.faces(set_).size()))
      throw std::logic_error("a region changed its size");
    order();
    assign_slots();
    collect_free_edges();
    connect();
    certify();
    return std::move(patch_);
  }

 private:
  // By label and corners: independent of how the triangulation was found, and close to memory order.
  void order() {
    shift_.resize(faces_.size());
    std::vector<std::pair<int, Triangle>> keys(faces_.size());
    for (int t = 0; t < faces_.size(); ++t) {
      auto corners = faces_.triangles[t];
      const auto smallest = std::min_element(corners.begin(), corners.end());
      shift_[t] = static_cast<int>(smallest - corners.begin());
      std::rotate(corners.begin(), smallest, corners.end());
      keys[t] = {faces_.labels[t], corners};
    }
    order_.resize(faces_.size());
    std::iota(order_.begin(), order_.end(), 0);
    std::sort(order_.begin(), order_.end(), [&](int t, int u) { return keys[t] < keys[u]; });
    for (const int t : order_) {
      patch_.labels.push_back(keys[t].first);
      patch_.triangles.push_back(keys[t].second);
    }
  }

  void assign_slots() {
    std::vector<int> slots = sets_.faces(set_);
    const auto key = [&](int f) { return std::pair(mesh_.label(f), f); };
    std::sort(slots.begin(), slots.end(), [&](int f, int g) { return key(f) < key(g); });
    const std::size_t n = slots.size();
    std::vector<std::size_t> spare_faces;
    std::vector<int> spare_slots;
    patch_.faces.assign(n, none);
    for (std::size_t i = 0, j = 0; i < n || j < n;) {
      if (j == n || (i < n && mesh_.label(slots[i]) < patch_.labels[j]))
        spare_slots.push_back(slots[i++]);
      else if (i == n || patch_.labels[j] < mesh_.label(slots[i]))
        spare_faces.push_back(j++);
      else
        patch_.faces[j++] = slots[i++];
    }
    for (std::size_t i = 0; i < spare_faces.size(); ++i) patch_.faces[spare_faces[i]] = spare_slots[i];
  }

  // The edges between two faces of the set.
  void collect_free_edges() {
    for (const int face : sets_.faces(set_)) {
      for (const int side : mesh_.sides(face)) {
        const int across = mesh_.face_of(Mesh::opposite(side));
        const bool inner = across != none && sets_.set_of(across) == set_;
        if (inner && side < Mesh::opposite(side)) patch_.edges.push_back(Mesh::edge_of(side));
      }
    }
    std::sort(patch_.edges.begin(), patch_.edges.end());
  }

  int& halfedge_along(int t, int k) { return patch_.halfedges[place_[t]][(k - shift_[t] + 3) % 3]; }

  // Every side gets its half-edge: on the border the one that stays, inside the next of the edges set free.
  void connect() {
    place_.resize(faces_.size());
    for (int i = 0; i < faces_.size(); ++i) place_[order_[i]] = i;
    patch_.halfedges.assign(faces_.size(), {none, none, none});
    for (const int t : order_) {
      for (int j = 0; j < 3; ++j) connect(t, (j + shift_[t]) % 3);
    }
    if (patch_.constraints.size() != patch_.edges.size()) throw std::logic_error("a region lost an edge");
  }

  void connect(int t, int k) {
    const int across = faces_.neighbours[t][k];
    if (across < 0) halfedge_along(t, k) = ~across;
    if (halfedge_along(t, k) != none) return;
    if (patch_.constraints.size() == patch_.edges.size()) throw std::logic_error("a region gained an edge");
    const int edge = patch_.edges[patch_.constraints.size()];
    patch_.constraints.push_back(faces_.constraints[t][k]);
    halfedge_along(t, k) = 2 * edge;
    halfedge_along(across, side_back(t, k)) = 2 * edge + 1;
  }

  // The side of the neighbour that lies on side k of t.
  int side_back(int t, int k) const {
    const int across = faces_.neighbours[t][k];
    for (int j = 0; j < 3; ++j) {
      if (faces_.neighbours[across][j] == t &&
          faces_.triangles[across][j] == faces_.triangles[t][(k + 1) % 3])
        return j;
    }
    throw std::logic_error("new faces do not agree on their neighbours");
  }

  void certify() const {
    for (const auto& [a, b, c] : patch_.triangles) {
      const auto turn = orientation(mesh_.position(a), mesh_.position(b), mesh_.position(c));
      if (turn != Orientation::CounterClockwise) throw std::logic_error("a new face is not upright");
    }
  }

  const Mesh& mesh_;
  const FaceSets& sets_;
  int set_;
  const NewFaces& faces_;
  std::vector<int> shift_;  // per new face: its smallest corner, which comes first in the patch
  std::vector<int> order_;  // new faces by place in the patch
  std::vector<int> place_;  // and back
  Patch patch_;
};

}  // namespace

void NewFaces::clear() {
  triangles.clear();
  neighbours.clear();
  constraints.clear();
  labels.clear();
}

void NewFaces::add(const Triangle& corners, const Triangle& neighbours_of, const Triangle& constraints_of) {
  triangles.push_back(corners);
  neighbours.push_back(neighbours_of);
  constraints.push_back(constraints_of);
}

Finished finish(const Mesh& mesh, const FaceSets& sets, int set, NewFaces faces, bool allow_escaped) {
  Finished result;
  result.defect = LabelFlood(mesh, faces).run();
  if (result.defect) return result;
  if (const int first = allow_escaped ? none : first_escaped(mesh, faces); first != none) {
    result.defect = Defect{
        .kind = DefectKind::Escaped, .vertices = {mesh.user_vertex(first)}, .where = mesh.position(first)};
    return result;
  }
  result.patch = PatchBuilder(mesh, sets, set, faces).build();
  return result;
}

}  // namespace kinemesh
