#include "untangle/fill/doubled_edges.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/base/ascending.h"
#include "core/mesh/around.h"
#include "kinemesh/predicates.h"

namespace kinemesh {
namespace {

class EdgeCount {
 public:
  EdgeCount(const Mesh& mesh, const FaceSets& sets, int set, NewFaces& faces)
      : mesh_(mesh), sets_(sets), set_(set), faces_(faces) {
    for (int t = 0; t < faces.size(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const auto edge = ascending(MeshEdge{corner(t, k), corner(t, k + 1)});
        if (faces.neighbours[t][k] < 0)
          count_kept_edges(corner(t, k));
        else if (t < faces.neighbours[t][k])
          ++count_[edge];
      }
    }
  }

  // A flip takes a doubled edge away and adds one that is not; flips end.
  int flip_doubled() {
    int doubled = 0, flipped = 1;
    while (flipped > 0) {
      doubled = flipped = 0;
      for (int t = 0; t < faces_.size(); ++t) {
        for (int k = 0; k < 3; ++k) {
          if (faces_.neighbours[t][k] <= t || !is_doubled(t, k)) continue;  // once per inner edge
          ++(flip(t, k) ? flipped : doubled);
        }
      }
    }
    return doubled;
  }

 private:
  Vertex corner(int t, int k) const { return faces_.triangles[t][k % 3]; }
  bool is_doubled(int t, int k) const { return count(corner(t, k), corner(t, k + 1)) > 1; }
  int count(Vertex a, Vertex b) const {
    const auto found = count_.find(ascending(MeshEdge{a, b}));
    return found == count_.end() ? 0 : found->second;
  }

  // Every vertex of the border starts one side of it, or several.
  void count_kept_edges(Vertex vertex) {
    if (!seen_.insert(vertex).second) return;
    for (Spokes spokes(mesh_, vertex); !spokes.is_done(); spokes.advance()) {
      const Face across = mesh_.face_across(spokes.side());
      const bool freed = across != none && sets_.set_of(Mesh::face_of(spokes.side())) == set_ &&
                         sets_.set_of(across) == set_;
      // Seen from both ends if both are on the border; counted from the lower one, and others cannot be
      // doubled.
      if (!freed && vertex < spokes.end()) ++count_[{vertex, spokes.end()}];
    }
  }

  bool flip(int t, int k) {
    if (faces_.constraints[t][k] != none) return false;
    const int u = faces_.neighbours[t][k];
    const int j = side_back(t, k);
    const Vertex a = corner(t, k), b = corner(t, k + 1), c = corner(t, k + 2), d = corner(u, j + 2);
    if (c == d || count(c, d) > 0) return false;
    if (!is_upright(c, a, d) || !is_upright(d, b, c)) return false;
    --count_[ascending(MeshEdge{a, b})];
    ++count_[ascending(MeshEdge{c, d})];
    const auto bc = take(t, k + 1), ca = take(t, k + 2), ad = take(u, j + 1), db = take(u, j + 2);
    put(t, {c, a, d}, {ca, ad, {u, none}});
    put(u, {d, b, c}, {db, bc, {t, none}});
    return true;
  }

  struct Outside {
    int neighbour, constraint;
  };
  Outside take(int t, int k) const { return {faces_.neighbours[t][k % 3], faces_.constraints[t][k % 3]}; }

  void put(int t, const MeshTriangle& corners, const std::array<Outside, 3>& outside) {
    const int other = outside[2].neighbour;
    for (int k = 0; k < 3; ++k) {
      const int beyond = outside[k].neighbour;
      faces_.neighbours[t][k] = beyond;
      faces_.constraints[t][k] = outside[k].constraint;
      if (k == 2 || beyond < 0) continue;
      auto& back = faces_.neighbours[beyond];
      for (int j = 0; j < 3; ++j) {
        if (corner(beyond, j) == corners[(k + 1) % 3] && (back[j] == t || back[j] == other)) back[j] = t;
      }
    }
    faces_.triangles[t] = corners;
  }

  int side_back(int t, int k) const {
    const int u = faces_.neighbours[t][k];
    int j = 0;
    while (faces_.neighbours[u][j] != t || corner(u, j) != corner(t, k + 1)) ++j;
    return j;
  }

  bool is_upright(Vertex a, Vertex b, Vertex c) const {
    return orientation(mesh_.position(a), mesh_.position(b), mesh_.position(c)) ==
           Orientation::CounterClockwise;
  }

  const Mesh& mesh_;
  const FaceSets& sets_;
  int set_;
  NewFaces& faces_;
  std::map<MeshEdge, int> count_;
  std::set<Vertex> seen_;
};

}  // namespace

int avoid_doubled_edges(const Mesh& mesh, const FaceSets& sets, int set, NewFaces& faces) {
  return EdgeCount(mesh, sets, set, faces).flip_doubled();
}

}  // namespace kinemesh
