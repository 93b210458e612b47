// The exact stage of the predicates. The only file of the project that pays for CGAL's kernel to decide
// signs.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "kinemesh/predicates.h"

namespace kinemesh {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_2 cgal(const Point& p) {
  return {p.x, p.y};
}

}  // namespace

Orientation orientation_exact(const Point& a, const Point& b, const Point& c) {
  if (a == b || b == c || c == a) return Orientation::Collinear;  // neighbours share corners: the common case
  return static_cast<Orientation>(CGAL::orientation(cgal(a), cgal(b), cgal(c)));
}

InCircle in_circle_exact(const Point& a, const Point& b, const Point& c, const Point& d) {
  return static_cast<InCircle>(CGAL::side_of_oriented_circle(cgal(a), cgal(b), cgal(c), cgal(d)));
}

}  // namespace kinemesh
