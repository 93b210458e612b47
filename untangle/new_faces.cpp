#include "untangle/new_faces.h"

#include <algorithm>
#include <iterator>
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
  std::optional<Defect> run(const Mesh& mesh, NewFaces& faces) {
    start(mesh, faces);
    for (int t = 0; t < faces.size(); ++t) {
      for (int k = 0; k < 3; ++k) {
        if (faces.neighbours[t][k] < 0) enter(t, ~faces.neighbours[t][k]);
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
  void start(const Mesh& mesh, NewFaces& faces) {
    mesh_ = &mesh;
    faces_ = &faces;
    faces.labels.assign(faces.size(), 0);
    source_.assign(faces.size(), Edge{none, none});
    has_label_.assign(faces.size(), false);
    pending_.clear();
    defect_.reset();
  }

  // From the face that has been inside the border so far.
  void enter(int t, int halfedge) {
    set(t, mesh_->label(mesh_->face_of(halfedge)),
        user_ends(*mesh_, mesh_->from(halfedge), mesh_->to(halfedge)));
  }

  void spread(int t, int k) {
    const int across = faces_->neighbours[t][k];
    if (across < 0) return;
    const int number = faces_->constraints[t][k];
    if (number == none) {
      set(across, faces_->labels[t], source_[t]);
      return;
    }
    const auto& constraint = mesh_->constraints()[number];
    const bool on_left = faces_->triangles[t][k] == constraint.from;
    const Edge ends = user_ends(*mesh_, constraint.from, constraint.to);
    set(t, on_left ? constraint.left : constraint.right, ends);
    set(across, on_left ? constraint.right : constraint.left, ends);
  }

  void set(int t, int label, const Edge& source) {
    if (!has_label_[t]) {
      has_label_[t] = true;
      faces_->labels[t] = label;
      source_[t] = source;
      pending_.push_back(t);
    } else if (faces_->labels[t] != label && !defect_) {
      defect_ = Defect{.kind = DefectKind::LabelsMeet,
                       .edges = {source_[t], source},
                       .where = mesh_->position(faces_->triangles[t][0])};
    }
  }

  const Mesh* mesh_ = nullptr;
  NewFaces* faces_ = nullptr;
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
  void build(const Mesh& mesh, const FaceSets& sets, int set, const NewFaces& faces, Patch& patch) {
    mesh_ = &mesh;
    sets_ = &sets;
    set_ = set;
    faces_ = &faces;
    patch_ = &patch;
    if (faces.size() != static_cast<int>(sets.faces(set).size()))
      throw std::logic_error("a region changed its size");
    order();
    assign_slots();
    collect_free_edges();
    connect();
    certify();
    patch.outgoing.clear();
  }

 private:
  // By label and corners: independent of how the triangulation was found, and close to memory order.
  void order() {
    shift_.resize(faces_->size());
    keys_.resize(faces_->size());
    for (int t = 0; t < faces_->size(); ++t) {
      auto corners = faces_->triangles[t];
      const auto smallest = std::min_element(corners.begin(), corners.end());
      shift_[t] = static_cast<int>(smallest - corners.begin());
      std::rotate(corners.begin(), smallest, corners.end());
      keys_[t] = {faces_->labels[t], corners};
    }
    order_.resize(faces_->size());
    std::iota(order_.begin(), order_.end(), 0);
    std::sort(order_.begin(), order_.end(), [&](int t, int u) { return keys_[t] < keys_[u]; });
    patch_->labels.clear();
    patch_->triangles.clear();
    for (const int t : order_) {
      patch_->labels.push_back(keys_[t].first);
      patch_->triangles.push_back(keys_[t].second);
    }
  }

  void assign_slots() {
    slots_ = sets_->faces(set_);
    const auto key = [&](int f) { return std::pair(mesh_->label(f), f); };
    std::sort(slots_.begin(), slots_.end(), [&](int f, int g) { return key(f) < key(g); });
    const std::size_t n = slots_.size();
    spare_faces_.clear();
    spare_slots_.clear();
    patch_->faces.assign(n, none);
    for (std::size_t i = 0, j = 0; i < n || j < n;) {
      if (j == n || (i < n && mesh_->label(slots_[i]) < patch_->labels[j]))
        spare_slots_.push_back(slots_[i++]);
      else if (i == n || patch_->labels[j] < mesh_->label(slots_[i]))
        spare_faces_.push_back(j++);
      else
        patch_->faces[j++] = slots_[i++];
    }
    for (std::size_t i = 0; i < spare_faces_.size(); ++i) patch_->faces[spare_faces_[i]] = spare_slots_[i];
  }

  // The edges between two faces of the set.
  void collect_free_edges() {
    patch_->edges.clear();
    old_constraints_.clear();
    for (const int face : sets_->faces(set_)) {
      for (const int side : mesh_->sides(face)) {
        const int across = mesh_->face_of(Mesh::opposite(side));
        const bool inner = across != none && sets_->set_of(across) == set_;
        if (!inner || side > Mesh::opposite(side)) continue;
        const int edge = Mesh::edge_of(side);
        patch_->edges.push_back(edge);
        if (mesh_->constraint_of(edge) != none) old_constraints_.push_back(mesh_->constraint_of(edge));
      }
    }
    std::sort(patch_->edges.begin(), patch_->edges.end());
  }

  int& halfedge_along(int t, int k) { return patch_->halfedges[place_[t]][(k - shift_[t] + 3) % 3]; }

  // Every side gets its half-edge: on the border the one that stays, inside the next of the edges set free.
  void connect() {
    place_.resize(faces_->size());
    for (int i = 0; i < faces_->size(); ++i) place_[order_[i]] = i;
    patch_->constraints.clear();
    patch_->halfedges.assign(faces_->size(), {none, none, none});
    for (const int t : order_) {
      for (int j = 0; j < 3; ++j) connect(t, (j + shift_[t]) % 3);
    }
    if (patch_->constraints.size() != patch_->edges.size()) throw std::logic_error("a region lost an edge");
  }

  void connect(int t, int k) {
    const int across = faces_->neighbours[t][k];
    if (across < 0) halfedge_along(t, k) = ~across;
    if (halfedge_along(t, k) != none) return;
    if (patch_->constraints.size() == patch_->edges.size()) throw std::logic_error("a region gained an edge");
    const int edge = patch_->edges[patch_->constraints.size()];
    patch_->constraints.push_back(faces_->constraints[t][k]);
    halfedge_along(t, k) = 2 * edge;
    halfedge_along(across, side_back(t, k)) = 2 * edge + 1;
  }

  // The side of the neighbour that lies on side k of t.
  int side_back(int t, int k) const {
    const int across = faces_->neighbours[t][k];
    for (int j = 0; j < 3; ++j) {
      if (faces_->neighbours[across][j] == t &&
          faces_->triangles[across][j] == faces_->triangles[t][(k + 1) % 3])
        return j;
    }
    throw std::logic_error("new faces do not agree on their neighbours");
  }

  // Each constrained edge is there again, once.
  void certify_constraints() {
    new_constraints_.clear();
    std::copy_if(patch_->constraints.begin(), patch_->constraints.end(), std::back_inserter(new_constraints_),
                 [](int constraint) { return constraint != none; });
    std::sort(old_constraints_.begin(), old_constraints_.end());
    std::sort(new_constraints_.begin(), new_constraints_.end());
    if (new_constraints_ != old_constraints_) throw std::logic_error("a region lost a constrained edge");
  }

  void certify() {
    certify_constraints();

    for (const auto& [a, b, c] : patch_->triangles) {
      const auto turn = orientation(mesh_->position(a), mesh_->position(b), mesh_->position(c));
      if (turn != Orientation::CounterClockwise) throw std::logic_error("a new face is not upright");
    }
  }

  const Mesh* mesh_ = nullptr;
  const FaceSets* sets_ = nullptr;
  int set_ = none;
  const NewFaces* faces_ = nullptr;
  Patch* patch_ = nullptr;
  std::vector<int> shift_;  // per new face: its smallest corner, which comes first in the patch
  std::vector<int> order_;  // new faces by place in the patch
  std::vector<int> place_;  // and back
  std::vector<std::pair<int, Triangle>> keys_;          // per new face: label, corners from the smallest on
  std::vector<int> old_constraints_, new_constraints_;  // of the edges inside
  std::vector<int> slots_, spare_slots_;                // faces of the mesh
  std::vector<std::size_t> spare_faces_;                // places in the patch
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

struct Finisher::Scratch {
  LabelFlood labels;
  PatchBuilder patch;
};

Finisher::Finisher() : scratch_(std::make_unique<Scratch>()) {}
Finisher::~Finisher() = default;
Finisher::Finisher(Finisher&&) noexcept = default;
Finisher& Finisher::operator=(Finisher&&) noexcept = default;

std::optional<Defect> Finisher::run(const Mesh& mesh, const FaceSets& sets, int set, NewFaces& faces,
                                    bool allow_escaped, Patch& patch) {
  if (auto defect = scratch_->labels.run(mesh, faces)) return defect;
  if (const int first = allow_escaped ? none : first_escaped(mesh, faces); first != none) {
    return Defect{
        .kind = DefectKind::Escaped, .vertices = {mesh.user_vertex(first)}, .where = mesh.position(first)};
  }
  scratch_->patch.build(mesh, sets, set, faces, patch);
  return std::nullopt;
}

}  // namespace kinemesh
