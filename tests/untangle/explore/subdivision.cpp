#include "tests/untangle/explore/subdivision.h"
#include "tests/core/mesh/edges.h"

#include <CGAL/Arr_consolidated_curve_data_traits_2.h>
#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <algorithm>
#include <map>

namespace kinemesh::test {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using SegmentTraits = CGAL::Arr_segment_traits_2<Kernel>;
using Traits = CGAL::Arr_consolidated_curve_data_traits_2<SegmentTraits, int>;  // data: number of the edge
using Arrangement = CGAL::Arrangement_2<Traits>;

Kernel::Point_2 exact(const Point& p) {
  return {p.x, p.y};
}

Arrangement arrange(const Mesh& mesh) {
  std::vector<Traits::Curve_2> curves;
  for (const Side edge : all_edges(mesh)) {
    const auto a = exact(mesh.position(mesh.from(edge))), b = exact(mesh.position(mesh.to(edge)));
    if (a != b) curves.emplace_back(SegmentTraits::Curve_2(a, b), int{edge});
  }
  Arrangement arrangement;
  CGAL::insert(arrangement, curves.begin(), curves.end());
  return arrangement;
}

template <class Handle>
using NumberOf = std::map<Handle, int>;

Subdivision::Segment segment_of(const Arrangement::Halfedge& halfedge,
                                const NumberOf<Arrangement::Face_const_handle>& cells,
                                const NumberOf<Arrangement::Vertex_const_handle>& vertices) {
  const bool forward = halfedge.direction() == CGAL::ARR_LEFT_TO_RIGHT;
  const auto& h = forward ? halfedge : *halfedge.twin();
  Subdivision::Segment segment{
      cells.at(h.face()), cells.at(h.twin()->face()), {vertices.at(h.source()), vertices.at(h.target())}, {}};
  for (auto it = h.curve().data().begin(); it != h.curve().data().end(); ++it)
    segment.edges.push_back(Side(*it));
  std::sort(segment.edges.begin(), segment.edges.end());
  return segment;
}

}  // namespace

Subdivision subdivide(const Mesh& mesh) {
  const Arrangement arrangement = arrange(mesh);
  Subdivision out;
  NumberOf<Arrangement::Face_const_handle> cells;
  for (auto it = arrangement.faces_begin(); it != arrangement.faces_end(); ++it) cells[it] = out.n_cells++;
  NumberOf<Arrangement::Vertex_const_handle> vertices;
  std::map<Kernel::Point_2, int> places;
  for (auto it = arrangement.vertices_begin(); it != arrangement.vertices_end(); ++it) {
    places[it->point()] = out.n_vertices;
    vertices[it] = out.n_vertices++;
  }
  for (auto it = arrangement.edges_begin(); it != arrangement.edges_end(); ++it) {
    out.segments.push_back(segment_of(*it, cells, vertices));
  }
  for (const Vertex v : mesh.vertices()) {
    out.place_of.push_back(mesh.is_isolated(v) ? none : places.at(exact(mesh.position(v))));
  }
  return out;
}

}  // namespace kinemesh::test
