#include "untangle/global_walk.h"

#include <algorithm>
#include <iterator>

#include "core/predicates.h"

namespace kinemesh {

void GlobalWalk::run(const Mesh& mesh, const Tangles& tangles, FaceSets& regions) {
  mesh_ = &mesh;
  regions_ = &regions;
  for (const int face : tangled_) is_tangled_[face] = false;
  tangled_.clear();
  is_tangled_.resize(mesh.n_faces(), false);
  std::merge(tangles.inverted.begin(), tangles.inverted.end(), tangles.flat.begin(), tangles.flat.end(),
             std::back_inserter(tangled_));
  for (const int face : tangled_) is_tangled_[face] = true;
  shadows_.build(mesh, tangled_);

  regions.reset(mesh.n_faces());
  pending_.clear();
  for (const int seed : tangled_) {
    if (regions.set_of(seed) != none) continue;
    region_ = regions.open();
    visit(seed);
    while (!pending_.empty()) {
      const int face = pending_.back();
      pending_.pop_back();
      leave(face);
    }
    regions.sort(region_);
  }
}

void GlobalWalk::visit(int face) {
  regions_->add(face, region_);
  pending_.push_back(face);
}

void GlobalWalk::leave(int face) {
  const bool all_sides = is_tangled_[face];  // rule (i)
  for (const int side : mesh_->sides(face)) {
    const int across = mesh_->face_of(Mesh::opposite(side));
    if (across == none || regions_->set_of(across) == region_) continue;
    if (all_sides || is_tangled_[across] || is_conflicting(side)) visit(across);
  }
}

// Rules (ii) and (iii).
bool GlobalWalk::is_conflicting(int side) const {
  const int a = mesh_->from(side), b = mesh_->to(side);
  const Segment edge{mesh_->position(a), mesh_->position(b), a, b};
  return shadows_.any_near(edge.a, edge.b, [&](int face) {
    return touches(edge, Corners{mesh_->corners(face), mesh_->triangles()[face]});
  });
}

}  // namespace kinemesh
