#include "untangle/fill/new_faces.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>

#include "kinemesh/predicates.h"

namespace kinemesh {
namespace {

UserEdge user_ends(const Mesh& mesh, Vertex from, Vertex to) {
  return {mesh.user_vertex(from), mesh.user_vertex(to)};
}

class LabelFlood {
 public:
  std::optional<Defect> run(const Mesh& mesh, NewFaces& faces) {
    start(mesh, faces);
    for (int t = 0; t < faces.size(); ++t) {
      for (int k = 0; k < 3; ++k) {
        if (faces.neighbours[t][k] < 0) enter(t, Side(~faces.neighbours[t][k]));
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
    source_.assign(faces.size(), {});
    has_label_.assign(faces.size(), false);
    pending_.clear();
    defect_.reset();
  }

  // From the face that has been inside the border so far.
  void enter(int t, Side side) {
    set(t, mesh_->label(Mesh::face_of(side)), user_ends(*mesh_, mesh_->from(side), mesh_->to(side)));
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
    const UserEdge ends = user_ends(*mesh_, constraint.from, constraint.to);
    set(t, on_left ? constraint.left : constraint.right, ends);
    set(across, on_left ? constraint.right : constraint.left, ends);
  }

  void set(int t, int label, const UserEdge& source) {
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
  std::vector<UserEdge> source_;  // per face: where its label came from
  std::vector<bool> has_label_;
  std::vector<int> pending_;
  std::optional<Defect> defect_;
};

// What nearly every region has: then there is nothing to spread.
bool has_one_label(const Mesh& mesh, const Hole& hole, const NewFaces& faces) {
  const int label = mesh.label(hole.faces.front());
  return std::ranges::all_of(hole.faces, [&](Face face) { return mesh.label(face) == label; }) &&
         std::ranges::all_of(faces.constraints, [](const Triangle& c) {
           return c == Triangle{none, none, none};
         });
}

// The vertex with the smallest number of those that have, or none.
Vertex first_escaped(const Mesh& mesh, const NewFaces& faces) {
  Vertex first;
  for (int t = 0; t < faces.size(); ++t) {
    for (const Vertex v : faces.triangles[t]) {
      const bool escaped = !mesh.is_constrained(v) && mesh.home_label(v) != faces.labels[t];
      if (escaped && (first == none || mesh.user_vertex(v) < mesh.user_vertex(first))) first = v;
    }
  }
  return first;
}

double squared_distance(const Point& p, const Point& a, const Point& b) {
  const Point way = b - a, from_a = p - a;
  const double length = glm::dot(way, way);
  const double share = length > 0.0 ? std::clamp(glm::dot(from_a, way) / length, 0.0, 1.0) : 0.0;
  const Point off = from_a - share * way;
  return glm::dot(off, off);
}

std::string name_of(const UserEdge& edge) {
  return "edge " + std::to_string(edge[0]) + "-" + std::to_string(edge[1]);
}

std::string name_of(const Mesh& mesh, const Constraint& c) {
  const bool is_interface = !c.is_border() && c.left != c.right;
  const std::string line =
      c.is_border()  ? "the border"
      : is_interface ? "the interface of labels " + std::to_string(c.left) + " and " + std::to_string(c.right)
                     : "the line";
  return c.marker == none ? line : line + " of marker \"" + mesh.marker_names()[c.marker] + "\"";
}

// The border or interface the vertex has crossed: of those of the label it comes from, the nearest one.
std::string crossed_by(const Mesh& mesh, Vertex vertex) {
  const int home = mesh.home_label(vertex);
  const Constraint* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const Constraint& c : mesh.constraints()) {
    if (c.left == c.right || (c.left != home && c.right != home)) continue;
    const double d = squared_distance(mesh.position(vertex), mesh.position(c.from), mesh.position(c.to));
    if (d < least) {
      least = d;
      nearest = &c;
    }
  }
  if (!nearest) return {};
  return "it has crossed " + name_of(mesh, *nearest) + " near " +
         name_of(user_ends(mesh, nearest->from, nearest->to));
}

class PatchBuilder {
 public:
  void build(const Mesh& mesh, const Hole& hole, const NewFaces& faces, Patch& patch) {
    mesh_ = &mesh;
    hole_ = &hole;
    faces_ = &faces;
    patch_ = &patch;
    if (faces.size() != hole.size()) throw std::logic_error("a region changed its size");
    order();
    place();
    assign_slots();
    connect();
    certify();
  }

 private:
  // A new face by its label and the side from its smallest corner, which is no other's.
  struct Key {
    int label;
    Vertex first, second;
    int face;
    auto operator<=>(const Key&) const = default;
  };

  // Independent of how the triangulation was found, and close to memory order.
  void order() {
    keys_.clear();
    for (int face = 0; face < faces_->size(); ++face) {
      const auto& corners = faces_->triangles[face];
      const int k = smallest(corners);
      keys_.push_back({faces_->labels[face], corners[k], corners[following(k)], face});
    }
    std::sort(keys_.begin(), keys_.end());
  }

  // Writes the new faces in their order, each from its smallest corner on.
  void place() {
    const std::size_t n = keys_.size();
    patch_->labels.resize(n);
    patch_->triangles.resize(n);
    across_.resize(n);
    constraints_.resize(n);
    place_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      const int face = keys_[i].face, k = smallest(faces_->triangles[face]);
      patch_->labels[i] = keys_[i].label;
      patch_->triangles[i] = turned(faces_->triangles[face], k);
      across_[i] = turned(faces_->neighbours[face], k);
      constraints_[i] = turned(faces_->constraints[face], k);
      place_[face] = static_cast<int>(i);
    }
  }

  void assign_slots() {
    slots_ = hole_->faces;
    const auto by_label = [&](Face f, Face g) { return mesh_->label(f) < mesh_->label(g); };
    if (!std::is_sorted(slots_.begin(), slots_.end(), by_label))
      std::stable_sort(slots_.begin(), slots_.end(), by_label);
    const std::size_t n = slots_.size();
    spare_faces_.clear();
    spare_slots_.clear();
    patch_->faces.assign(n, Face());
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

  void connect() {
    const int n = static_cast<int>(keys_.size());
    n_border_ = 0;
    patch_->lines.clear();
    patch_->across.resize(keys_.size());
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < 3; ++k) patch_->across[i][k] = connect(i, k);
    if (n_border_ != hole_->border.size()) throw std::logic_error("a region's border changed its size");
  }

  // What lies beyond; of a constrained edge the first side to come notes it.
  int connect(int i, int k) {
    const int beyond = across_[i][k];
    const Side here = Mesh::side(Face(i), k);
    if (beyond < 0) {
      ++n_border_;
      const Side border(~beyond);
      if (mesh_->has_constraint(border)) patch_->lines.push_back({here, mesh_->constraint_of(border)});
      return beyond;
    }
    const Face place(place_[beyond]);
    const Side back = Mesh::side(place, side_back(i, k, place));
    if (constraints_[i][k] != none && here < back) patch_->lines.push_back({here, constraints_[i][k]});
    return back;
  }

  // The side of the face beyond that lies on side k of the one at place i.
  int side_back(int i, int k, int beyond) const {
    const int face = keys_[i].face;
    const Vertex start = patch_->triangles[i][following(k)];
    for (int j = 0; j < 3; ++j) {
      if (across_[beyond][j] == face && patch_->triangles[beyond][j] == start) return j;
    }
    throw std::logic_error("new faces do not agree on their neighbours");
  }

  void certify() {
    certify_constraints();
    for (const auto& [a, b, c] : patch_->triangles) {
      const auto turn = orientation(mesh_->position(a), mesh_->position(b), mesh_->position(c));
      if (turn != Orientation::CounterClockwise) throw std::logic_error("a new face is not upright");
    }
  }

  // Each constrained edge is there again, once.
  void certify_constraints() {
    old_constraints_.clear();
    for (const auto& edge : hole_->border) note_old(edge.side);
    for (const Side side : hole_->inner_constraints) note_old(side);
    new_constraints_.clear();
    for (const auto& line : patch_->lines) new_constraints_.push_back(line.constraint);
    std::sort(old_constraints_.begin(), old_constraints_.end());
    std::sort(new_constraints_.begin(), new_constraints_.end());
    if (new_constraints_ != old_constraints_) throw std::logic_error("a region lost a constrained edge");
  }
  void note_old(Side side) {
    if (mesh_->has_constraint(side)) old_constraints_.push_back(mesh_->constraint_of(side));
  }

  static int following(int k) { return k == 2 ? 0 : k + 1; }
  static int smallest(const MeshTriangle& t) {
    const int k = t[1] < t[0] ? 1 : 0;
    return t[2] < t[k] ? 2 : k;
  }
  template <class T>
  static std::array<T, 3> turned(const std::array<T, 3>& t, int k) {
    const int l = following(k);
    return {t[k], t[l], t[following(l)]};
  }

  const Mesh* mesh_ = nullptr;
  const Hole* hole_ = nullptr;
  const NewFaces* faces_ = nullptr;
  Patch* patch_ = nullptr;
  std::vector<Key> keys_;              // of the new faces in the patch's order, by which what follows goes
  std::vector<Triangle> across_;       // per face and side as in NewFaces, by its numbers
  std::vector<Triangle> constraints_;  // likewise
  std::vector<int> place_;             // of each new face in the patch
  std::vector<Face> slots_, spare_slots_;
  std::vector<std::size_t> spare_faces_;  // places in the patch
  std::size_t n_border_ = 0;              // sides on the border
  std::vector<int> old_constraints_, new_constraints_;
};

}  // namespace

std::string lines_of(const Mesh& mesh, const Defect& defect) {
  std::string lines;
  const auto add = [&](const std::string& culprit, const auto& is_of) {
    std::set<std::string> names;  // two at a corner
    for (const Constraint& c : mesh.constraints())
      if (is_of(user_ends(mesh, c.from, c.to))) names.insert(name_of(mesh, c));
    for (const std::string& name : names)
      lines += (name != *names.begin() ? " and " : (lines.empty() ? "" : ", ") + culprit + " is of ") + name;
  };
  for (const UserVertex v : defect.vertices)
    add("vertex " + std::to_string(v), [v](const UserEdge& ends) { return ends[0] == v || ends[1] == v; });
  for (const UserEdge& edge : defect.edges)
    add(name_of(edge), [&](const UserEdge& ends) {
      return ends == edge || ends == UserEdge{edge[1], edge[0]};
    });
  return lines;
}

void NewFaces::clear() {
  triangles.clear();
  neighbours.clear();
  constraints.clear();
  labels.clear();
}

void NewFaces::add(const MeshTriangle& corners, const Triangle& neighbours_of,
                   const Triangle& constraints_of) {
  triangles.push_back(corners);
  neighbours.push_back(neighbours_of);
  constraints.push_back(constraints_of);
}

bool fit(const NewFaces& faces, const Hole& hole) {
  std::size_t on_border = 0;
  for (const Triangle& neighbours : faces.neighbours)
    on_border += std::ranges::count_if(neighbours, [](int neighbour) { return neighbour < 0; });
  return faces.size() == hole.size() && on_border == hole.border.size();
}

struct Finisher::Scratch {
  LabelFlood labels;
  PatchBuilder patch;
};

Finisher::Finisher() : scratch_(std::make_unique<Scratch>()) {}
Finisher::~Finisher() = default;
Finisher::Finisher(Finisher&&) noexcept = default;
Finisher& Finisher::operator=(Finisher&&) noexcept = default;

std::optional<Defect> Finisher::run(const Mesh& mesh, const Hole& hole, NewFaces& faces, bool allow_escaped,
                                    Patch& patch) {
  if (has_one_label(mesh, hole, faces))
    faces.labels.assign(faces.size(), mesh.label(hole.faces.front()));
  else if (auto defect = scratch_->labels.run(mesh, faces))
    return defect;
  if (const Vertex first = allow_escaped ? none : first_escaped(mesh, faces); first != none) {
    return Defect{.kind = DefectKind::Escaped,
                  .vertices = {mesh.user_vertex(first)},
                  .where = mesh.position(first),
                  .detail = crossed_by(mesh, first)};
  }
  scratch_->patch.build(mesh, hole, faces, patch);
  return std::nullopt;
}

}  // namespace kinemesh
