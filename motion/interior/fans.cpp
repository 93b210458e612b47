#include "motion/interior/fans.h"

#include <numeric>

#include "core/mesh/around.h"
#include "motion/interior/vertex_blocks.h"

namespace kinemesh {
namespace {

bool is_of_domain(const Mesh& mesh, Face face) {
  return face != none && !mesh.is_padding(face);
}

// Calls visit(neighbour, face to the left of the way there, or none) counter-clockwise around a vertex, for
// all neighbours in a face of the domain.
template <class Visit>
void for_each_slot(const Mesh& mesh, Vertex vertex, const Visit& visit) {
  for_each_neighbour(mesh, vertex, [&](Vertex neighbour, Side side) {
    const bool starts_here = mesh.from(side) == vertex;
    const Face left = starts_here ? Mesh::face_of(side) : mesh.face_across(side);
    const Face right = starts_here ? mesh.face_across(side) : Mesh::face_of(side);
    if (is_of_domain(mesh, left))
      visit(neighbour, left);
    else if (is_of_domain(mesh, right))
      visit(neighbour, none);
  });
}

}  // namespace

void Fans::reserve(const Mesh& mesh) {
  start_.reserve(mesh.n_vertices() + 1);
  neighbours_.reserve(2 * mesh.n_edges());
  faces_.reserve(2 * mesh.n_edges());
}

void Fans::build(const Mesh& mesh, const std::vector<char>& has_row) {
  const int n = mesh.n_vertices();
  start_.assign(n + 1, 0);
  parallel_blocks(n, [&](int, int begin, int end) {
    for (Vertex v(begin); v < end; ++v)
      if (has_row[v]) for_each_slot(mesh, v, [&](Vertex, Face) { ++start_[v + 1]; });
  });
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  neighbours_.resize(start_.back());
  faces_.resize(start_.back());
  parallel_blocks(n, [&](int, int begin, int end) {
    for (Vertex v(begin); v < end; ++v) {
      if (!has_row[v]) continue;
      int slot = start_[v];
      for_each_slot(mesh, v, [&](Vertex neighbour, Face face) {
        neighbours_[slot] = neighbour;
        faces_[slot++] = face;
      });
    }
  });
}

}  // namespace kinemesh
