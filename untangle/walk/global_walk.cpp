#include "untangle/walk/global_walk.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "kinemesh/predicates.h"

namespace kinemesh {
namespace {

constexpr std::size_t seeds_ahead = 16;

}  // namespace

void GlobalWalk::run(const Mesh& mesh, const Tangles& tangles, FaceSets& regions) {
  start(mesh, tangles, regions);
  advance(std::numeric_limits<int>::max());
}

void GlobalWalk::start(const Mesh& mesh, const Tangles& tangles, FaceSets& regions) {
  mesh_ = &mesh;
  regions_ = &regions;
  for (const Face face : tangled_) is_tangled_[face] = false;
  tangled_.clear();
  is_tangled_.resize(mesh.n_faces(), false);
  std::merge(tangles.inverted.begin(), tangles.inverted.end(), tangles.flat.begin(), tangles.flat.end(),
             std::back_inserter(tangled_));
  for (const Face face : tangled_) is_tangled_[face] = true;
  shadows_.build(mesh, tangled_);
  regions.reset(mesh.n_faces());
  next_seed_ = 0;
  n_visited_ = 0;
  most_faces_ = std::numeric_limits<int>::max();
}

bool GlobalWalk::advance(int n_faces) {
  const int n_before = n_visited_;
  for (; next_seed_ < tangled_.size() && n_visited_ - n_before < n_faces && !is_too_far(); ++next_seed_) {
    if (next_seed_ % seeds_ahead == 0) {
      const std::span all(tangled_);
      fetch_around(all.subspan(next_seed_, std::min(seeds_ahead, all.size() - next_seed_)));
    }
    if (regions_->set_of(tangled_[next_seed_]) == none) walk_from(tangled_[next_seed_]);
  }
  return next_seed_ < tangled_.size();
}

void GlobalWalk::walk_from(Face seed) {
  region_ = regions_->open();
  pending_.clear();
  visit(seed);
  while (!pending_.empty() && !is_too_far()) {
    const Face face = pending_.back();
    pending_.pop_back();
    leave(face);
  }
  regions_->sort(region_);
}

// A walk waits for memory at each step, since the next face is known only once the last has come. So what
// lies around some seeds is asked for side by side beforehand.
void GlobalWalk::fetch_around(std::span<const Face> seeds) const {
  std::array<std::array<Face, 3>, seeds_ahead> neighbours;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      neighbours[i][k] = mesh_->face_across(Mesh::side(seeds[i], k));
      if (neighbours[i][k] != none) mesh_->fetch(neighbours[i][k]);
    }
  }
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    for (const Face face : neighbours[i]) {
      if (face == none) continue;
      for (const Vertex v : mesh_->triangles()[face]) __builtin_prefetch(&mesh_->position(v));
    }
  }
}

void GlobalWalk::visit(Face face) {
  regions_->add(face, region_);
  ++n_visited_;
  pending_.push_back(face);
}

void GlobalWalk::leave(Face face) {
  const bool all_sides = is_tangled_[face];  // rule (i)
  bool has_near = false;
  for (const Side side : mesh_->sides(face)) {
    const Face across = mesh_->face_across(side);
    if (across == none || regions_->set_of(across) == region_) continue;
    const bool is_in = all_sides || is_tangled_[across];
    if (!is_in && !has_near) shadows_.find_near(mesh_->corners(face), near_);
    has_near = has_near || !is_in;
    if (is_in || is_conflicting(side)) visit(across);
  }
}

// Rules (ii) and (iii), for a side of the face that near_ is of.
bool GlobalWalk::is_conflicting(Side side) const {
  const Vertex a = mesh_->from(side), b = mesh_->to(side);
  const Segment edge{mesh_->position(a), mesh_->position(b), a, b};
  return shadows_.any_of(near_, edge.a, edge.b, [&](Face face) {
    return touches(edge, NumberedTriangle{mesh_->corners(face), numbers_of(mesh_->triangles()[face])});
  });
}

}  // namespace kinemesh
