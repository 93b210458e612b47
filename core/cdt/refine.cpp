#include "core/cdt/refine.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>

#include "core/cdt/triangulator.h"

namespace kinemesh {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

struct Number {
  int value = none;  // until the vertex gets one
};
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Number, Kernel>;
using Storage = CGAL::Triangulation_data_structure_2<VertexBase, CGAL::Delaunay_mesh_face_base_2<Kernel>>;
using Cdt = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Storage>;

constexpr double least_sine_squared = 0.125;  // what the method can reach [Shewchuk 2002, §3]

// CGAL's concept MeshingCriteria_2.
class Criteria {
 public:
  struct Quality {
    double size = 0.0;  // longest edge / size, squared; 0 where that is at most 1
    double sine = 0.0;  // of the smallest angle, squared

    bool operator<(const Quality& other) const {  // the worse is refined first
      return size != other.size ? size > other.size : sine < other.sine;
    }
  };

  class Is_bad {
   public:
    explicit Is_bad(const SizeField& size) : size_(&size) {}

    CGAL::Mesh_2::Face_badness operator()(const Quality& quality) const {
      if (quality.size > 0.0) return CGAL::Mesh_2::IMPERATIVELY_BAD;
      return quality.sine < least_sine_squared ? CGAL::Mesh_2::BAD : CGAL::Mesh_2::NOT_BAD;
    }

    CGAL::Mesh_2::Face_badness operator()(const Cdt::Face_handle& face, Quality& quality) const {
      const auto &a = face->vertex(0)->point(), &b = face->vertex(1)->point(), &c = face->vertex(2)->point();
      std::array<double, 3> edges{(b - a).squared_length(), (c - b).squared_length(),
                                  (a - c).squared_length()};
      std::sort(edges.begin(), edges.end());
      const double size = (*size_)({(a.x() + b.x() + c.x()) / 3.0, (a.y() + b.y() + c.y()) / 3.0});
      const double ratio = edges[2] / (size * size), twice_area = CGAL::determinant(b - a, c - a);
      quality = {ratio > 1.0 ? ratio : 0.0, twice_area * twice_area / (edges[1] * edges[2])};
      return (*this)(quality);
    }

   private:
    const SizeField* size_;
  };

  explicit Criteria(const SizeField& size) : size_(&size) {}
  Is_bad is_bad_object() const { return Is_bad(*size_); }

 private:
  const SizeField* size_;
};

void insert(Cdt& cdt, std::span<const Point> points, std::span<const Edge> edges) {
  std::vector<Cdt::Vertex_handle> vertices;
  Cdt::Face_handle near;
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    vertices.push_back(cdt.insert({points[i].x, points[i].y}, near));
    near = vertices.back()->face();
  }
  for (const auto& [a, b] : edges) cdt.insert_constraint(vertices[a], vertices[b]);
  for (int i = 0; i < static_cast<int>(points.size()); ++i) vertices[i]->info().value = i;
}

// Appends the vertices that the mesher made, and numbers them.
void number_new(Cdt& cdt, std::vector<Point>& points) {
  std::vector<Cdt::Vertex_handle> made;
  for (auto vertex : cdt.finite_vertex_handles()) {
    if (vertex->info().value == none) made.push_back(vertex);
  }
  std::vector<Point> places;
  for (const auto& vertex : made) places.emplace_back(vertex->point().x(), vertex->point().y());
  for (const int i : hilbert_order(places)) {
    made[i]->info().value = static_cast<int>(points.size());
    points.push_back(places[i]);
  }
}

}  // namespace

Refinement refine(std::span<const Point> points, std::span<const Edge> edges, const Point& in_hole,
                  const SizeField& size) {
  Cdt cdt;
  insert(cdt, points, edges);
  CGAL::Delaunay_mesher_2<Cdt, Criteria> mesher(cdt, Criteria(size));
  const std::array<Kernel::Point_2, 1> hole{Kernel::Point_2(in_hole.x, in_hole.y)};
  mesher.set_seeds(hole.begin(), hole.end());
  mesher.refine_mesh();
  Refinement result{{points.begin(), points.end()}, {}};
  number_new(cdt, result.points);
  for (auto face : cdt.finite_face_handles()) {
    if (!face->is_in_domain()) continue;
    const auto number = [&](int k) { return face->vertex(k)->info().value; };
    result.triangles.push_back({number(0), number(1), number(2)});
  }
  return result;
}

}  // namespace kinemesh
