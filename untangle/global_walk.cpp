#include "untangle/global_walk.h"

#include <algorithm>
#include <iterator>

#include "core/predicates.h"
#include "untangle/shadow_index.h"

namespace kinemesh {
namespace {

std::vector<int> merged(const std::vector<int>& a, const std::vector<int>& b) {
  std::vector<int> all;
  all.reserve(a.size() + b.size());
  std::merge(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all));
  return all;
}

class GlobalWalk {
 public:
  GlobalWalk(const Mesh& mesh, const Tangles& tangles, FaceSets& regions)
      : mesh_(mesh),
        tangled_(merged(tangles.inverted, tangles.flat)),
        shadows_(mesh, tangled_),
        regions_(regions) {}

  void run() {
    for (const int seed : tangled_) {
      if (regions_.set_of(seed) != none) continue;
      region_ = regions_.open();
      visit(seed);
      while (!pending_.empty()) leave(next());
      regions_.sort(region_);
    }
  }

 private:
  int next() {
    const int face = pending_.back();
    pending_.pop_back();
    return face;
  }

  void visit(int face) {
    regions_.add(face, region_);
    pending_.push_back(face);
  }

  void leave(int face) {
    const bool all_sides = is_tangled(face);
    for (const int side : mesh_.sides(face)) {
      const int across = mesh_.face_of(Mesh::opposite(side));
      if (across == none || regions_.set_of(across) == region_) continue;
      if (all_sides || is_tangled(across) || is_conflicting(side)) visit(across);
    }
  }

  // Rule (i).
  bool is_tangled(int face) const { return std::binary_search(tangled_.begin(), tangled_.end(), face); }

  // Rules (ii) and (iii).
  bool is_conflicting(int side) const {
    const int a = mesh_.from(side), b = mesh_.to(side);
    const Segment edge{mesh_.position(a), mesh_.position(b), a, b};
    return shadows_.any_near(edge.a, edge.b, [&](int face) {
      return touches(edge, Corners{mesh_.corners(face), mesh_.triangles()[face]});
    });
  }

  const Mesh& mesh_;
  std::vector<int> tangled_;
  ShadowIndex shadows_;
  FaceSets& regions_;
  int region_ = none;
  std::vector<int> pending_;
};

}  // namespace

void walk_globally(const Mesh& mesh, const Tangles& tangles, FaceSets& regions) {
  regions.reset(mesh.n_faces());
  GlobalWalk(mesh, tangles, regions).run();
}

}  // namespace kinemesh
