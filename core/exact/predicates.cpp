#include "kinemesh/predicates.h"

#include <algorithm>

#include "core/base/box.h"

namespace kinemesh {
namespace {

// As orientation_error: the lifts carry 4 roundings, the 2x2 minors 4 relative to their summed terms, each
// product one and the sum of three 2, together 11u + O(u^2) of the permanent. A product that underflows is
// off by 2^-1075, and is multiplied by at most a lift or a minor, which is no larger than two lifts: hence
// underflow_error * (1 + lifts).
constexpr double in_circle_error = 16.0 * 0x1p-53;

struct Minor {
  double value, permanent;
};

Minor minor2(const Point& p, const Point& q) {
  const double l = p.x * q.y, r = p.y * q.x;
  return {l - r, std::abs(l) + std::abs(r)};
}

double lift(const Point& p) {
  return p.x * p.x + p.y * p.y;
}

// Both on one side of a line, and neither on it.
bool same_side(Orientation p, Orientation q) {
  return p == q && p != Orientation::Collinear;
}

// Closed segments, no vertex shared. On a common line the boxes overlap just when the segments do, so that
// the four signs are the whole test in every degenerate case, zero length included.
bool segments_meet(const Point& a, const Point& b, const Point& c, const Point& d) {
  return meet(box_of(a, b), box_of(c, d)) && !same_side(orientation(a, b, c), orientation(a, b, d)) &&
         !same_side(orientation(c, d, a), orientation(c, d, b));
}

Segment side(const NumberedTriangle& t, int k) {
  const int l = (k + 1) % 3;
  return {t.p[k], t.p[l], t.v[k], t.v[l]};
}

int corner_of(const NumberedTriangle& t, int vertex) {
  for (int k = 0; k < 3; ++k) {
    if (t.v[k] == vertex) return k;
  }
  return none;
}

Orientation turn(const std::array<Point, 3>& t) {
  return orientation(t[0], t[1], t[2]);
}

// All of the segment strictly outside one side of the proper triangle that turns `o`.
bool beyond_a_side(const Point& a, const Point& b, const std::array<Point, 3>& t, Orientation o) {
  for (int k = 0; k < 3; ++k) {
    const Point &p = t[k], &q = t[(k + 1) % 3];
    if (orientation(p, q, a) == -o && orientation(p, q, b) == -o) return true;
  }
  return false;
}

// No vertex shared. Disjoint convex polygons are separated by a line along a side of one of them; a segment
// has one.
bool meets(const Segment& s, const std::array<Point, 3>& t) {
  if (!meet(box_of(s.a, s.b), box_of(t))) return false;
  const Orientation first = orientation(s.a, s.b, t[0]);
  if (same_side(first, orientation(s.a, s.b, t[1])) && same_side(first, orientation(s.a, s.b, t[2])))
    return false;
  const Orientation o = turn(t);
  if (o != Orientation::Collinear) return !beyond_a_side(s.a, s.b, t, o);
  return segments_meet(s.a, s.b, t[0], t[1]) || segments_meet(s.a, s.b, t[1], t[2]) ||
         segments_meet(s.a, s.b, t[2], t[0]);
}

// The segment from corner v to w, w no corner of the triangle v, p, q. It leaves v into a proper triangle, or
// along a side of it, just when w is in the closed cone of v; w at v's place is in it too.
bool leaves_into(const Point& v, const Point& w, const Point& p, const Point& q) {
  const Orientation o = orientation(v, p, q);
  if (o != Orientation::Collinear) return orientation(v, p, w) != -o && orientation(v, w, q) != -o;
  return on_segment(w, v, p) || on_segment(w, v, q) || segments_meet(v, w, p, q);
}

// All of t outside, or with `weakly` also on, one side of the proper triangle s that turns `o`.
bool separates(const std::array<Point, 3>& s, Orientation o, const std::array<Point, 3>& t, bool weakly) {
  for (int k = 0; k < 3; ++k) {
    const auto outside = [&](const Point& p) {
      const Orientation at = orientation(s[k], s[(k + 1) % 3], p);
      return at == -o || (weakly && at == Orientation::Collinear);
    };
    if (std::all_of(t.begin(), t.end(), outside)) return true;
  }
  return false;
}

bool a_side_touches(const NumberedTriangle& s, const NumberedTriangle& t) {
  return touches(side(s, 0), t) || touches(side(s, 1), t) || touches(side(s, 2), t);
}

}  // namespace

InCircle in_circle(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Point ad = a - d, bd = b - d, cd = c - d;
  const double la = lift(ad), lb = lift(bd), lc = lift(cd);
  const Minor bc = minor2(bd, cd), ca = minor2(cd, ad), ab = minor2(ad, bd);
  const double det = la * bc.value + lb * ca.value + lc * ab.value;
  const double permanent = la * bc.permanent + lb * ca.permanent + lc * ab.permanent;
  if (std::abs(det) > in_circle_error * permanent + underflow_error * (1.0 + la + lb + lc)) {
    return det > 0.0 ? InCircle::Inside : InCircle::Outside;
  }
  return in_circle_exact(a, b, c, d);
}

bool segments_touch(const Segment& s, const Segment& t) {
  const bool a_shared = s.va == t.va || s.va == t.vb, b_shared = s.vb == t.va || s.vb == t.vb;
  if (a_shared && b_shared) return false;
  if (!a_shared && !b_shared) return segments_meet(s.a, s.b, t.a, t.b);
  const Point& own = a_shared ? s.b : s.a;
  const int common = a_shared ? s.va : s.vb;
  const Point& other = t.va == common ? t.b : t.a;
  return on_segment(own, t.a, t.b) || on_segment(other, s.a, s.b);
}

bool segments_cross(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Orientation at_c = orientation(a, b, c), at_a = orientation(c, d, a);
  return at_c != Orientation::Collinear && at_c == -orientation(a, b, d) && at_a != Orientation::Collinear &&
         at_a == -orientation(c, d, b);
}

bool on_segment(const Point& p, const Point& a, const Point& b) {
  return meet(box_of(p, p), box_of(a, b)) && orientation(a, b, p) == Orientation::Collinear;
}

bool strictly_inside(const Point& p, const std::array<Point, 3>& t) {
  const Orientation o = orientation(t[0], t[1], p);
  return same_side(o, orientation(t[1], t[2], p)) && same_side(o, orientation(t[2], t[0], p));
}

bool touches(const Segment& s, const NumberedTriangle& t) {
  const int a = corner_of(t, s.va), b = corner_of(t, s.vb);
  if (a == none && b == none) return meets(s, t.p);
  if (a != none && b != none) return false;
  const int k = a != none ? a : b;
  return leaves_into(t.p[k], a != none ? s.b : s.a, t.p[(k + 1) % 3], t.p[(k + 2) % 3]);
}

bool interiors_overlap(const std::array<Point, 3>& s, const std::array<Point, 3>& t) {
  if (!meet(box_of(s), box_of(t))) return false;
  const Orientation os = turn(s), ot = turn(t);
  if (os == Orientation::Collinear || ot == Orientation::Collinear) return false;
  return !separates(s, os, t, true) && !separates(t, ot, s, true);
}

bool touches(const NumberedTriangle& s, const NumberedTriangle& t) {
  if (!meet(box_of(s.p), box_of(t.p))) return false;
  return a_side_touches(s, t) || a_side_touches(t, s);
}

}  // namespace kinemesh
