// Triangulations of what lies to one side of sub-segments. For .cpp files only: CGAL.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "core/cdt/cgal_triangulation.h"
#include "untangle/fill/plane_parts.h"
#include "untangle/fill/shadow_border.h"

namespace kinemesh {

// What a triangulation has to hold. Vertices are those of the ShadowBorder, edges run between places in
// `vertices`.
struct Outline {
  std::vector<int> vertices;     // in the order of their insertion
  std::vector<Edge> edges;       // sub-segments, then constrained edges
  std::vector<int> subs;         // the numbers of the former
  std::vector<int> constraints;  // those of the latter
  std::map<int, int> places;     // by vertex

  int add_vertex(int v);  // unless it is there; returns its place

  // With the vertices at its ends; constraints after all sub-segments.
  void add_sub_segment(int number, const SubSegment& sub);
  void add_constraint(int number, int a, int b);
};

class OutlineMesher {
 public:
  enum class Keep { Left, Right };

  explicit OutlineMesher(const ShadowBorder& border) : border_(border) {}

  // Triangulates the convex hull of the vertices and keeps what can be reached from the chosen side of the
  // sub-segments without crossing one. Sides on the hull are left open, with nothing across. Nothing if
  // vertices or edges touch where they should not, or if the other side of a sub-segment is reached.
  std::optional<PlanePart> run(const Outline& outline, Keep keep);

 private:
  bool triangulate();
  bool flood();
  void start();
  bool spread(int t, int k);
  void reach(int t);
  int n_triangles() const { return static_cast<int>(triangulation_.triangles.size()); }
  int sub_on(int t, int k) const;
  bool is_on_kept_side(int t, int k) const;
  PlanePart kept_faces() const;
  std::vector<int> numbers() const;
  PlaneSide side_of(int t, int k, const std::vector<int>& number) const;

  const ShadowBorder& border_;
  const Outline* outline_ = nullptr;
  Keep keep_ = Keep::Left;
  CgalTriangulation<ExactKernel> cgal_;
  Triangulation triangulation_;
  std::vector<bool> reached_;  // per triangle
  std::vector<int> pending_;
};

}  // namespace kinemesh
