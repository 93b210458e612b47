#include "tests/core/exact/exact_oracle.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

namespace kinemesh::oracle {
namespace {

using Integer = boost::multiprecision::cpp_int;
using Number = boost::rational<long long>;

// x * 2^1074, an integer for every finite double.
Integer scaled(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  const auto digits = static_cast<long long>(std::ldexp(mantissa, 53));
  const int shift = exponent - 53 + 1074;
  Integer result = digits < 0 ? -digits : digits;
  if (shift >= 0) {
    result <<= static_cast<unsigned>(shift);
  } else {
    result >>= static_cast<unsigned>(-shift);  // a denormal: the bits shifted out are zeros
  }
  return digits < 0 ? Integer(-result) : result;
}

struct Vector {
  Integer x, y;
};

Vector difference(const Point& p, const Point& q) {
  return {scaled(p.x) - scaled(q.x), scaled(p.y) - scaled(q.y)};
}

Integer cross(const Vector& p, const Vector& q) {
  return p.x * q.y - p.y * q.x;
}
Integer square(const Vector& p) {
  return p.x * p.x + p.y * p.y;
}

Fraction2 fraction(const Point& p) {
  return {static_cast<long long>(p.x), static_cast<long long>(p.y)};
}

Number cross(const Fraction2& o, const Fraction2& a, const Fraction2& b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

Number dot(const Fraction2& o, const Fraction2& a, const Fraction2& b) {
  return (a.x - o.x) * (b.x - o.x) + (a.y - o.y) * (b.y - o.y);
}

// The part of a closed hull where value >= 0, for an affine function of the plane.
template <class Function>
Hull clipped(const Hull& h, Function value) {
  Hull result;
  for (std::size_t i = 0; i < h.size(); ++i) {
    const Fraction2 &p = h[i], &q = h[(i + 1) % h.size()];
    const Number at_p = value(p), at_q = value(q);
    if (at_p >= 0) result.push_back(p);
    if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) {
      const Number t = at_p / (at_p - at_q);
      result.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
    }
  }
  return result;
}

bool flat(const std::array<Point, 3>& t) {
  return hull(t).size() < 3;
}

bool contains_another(const Hull& h, const Fraction2& point) {
  return std::any_of(h.begin(), h.end(), [&](const Fraction2& p) { return p != point; });
}

bool on(const Point& p, const Point& a, const Point& b) {
  return !intersection(hull(p, p), hull(a, b)).empty();
}

std::vector<int> shared(const NumberedTriangle& s, const NumberedTriangle& t) {
  std::vector<int> corners;  // of s
  for (int k = 0; k < 3; ++k) {
    if (std::find(t.v.begin(), t.v.end(), s.v[k]) != t.v.end()) corners.push_back(k);
  }
  return corners;
}

// The place of corner k is taken by another point of the triangle too.
bool corner_doubled(const NumberedTriangle& t, int k) {
  return on(t.p[k], t.p[(k + 1) % 3], t.p[(k + 2) % 3]);
}

int corner(const NumberedTriangle& t, int vertex) {
  return static_cast<int>(std::find(t.v.begin(), t.v.end(), vertex) - t.v.begin());
}

}  // namespace

Orientation orientation(const Point& a, const Point& b, const Point& c) {
  return static_cast<Orientation>(cross(difference(a, c), difference(b, c)).sign());
}

InCircle in_circle(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Vector ad = difference(a, d), bd = difference(b, d), cd = difference(c, d);
  const Integer det = square(ad) * cross(bd, cd) + square(bd) * cross(cd, ad) + square(cd) * cross(ad, bd);
  return static_cast<InCircle>(det.sign());
}

Hull hull(const Point& a, const Point& b) {
  return a == b ? Hull{fraction(a)} : Hull{fraction(a), fraction(b)};
}

Hull hull(const std::array<Point, 3>& t) {
  const Fraction2 a = fraction(t[0]), b = fraction(t[1]), c = fraction(t[2]);
  const Number turn = cross(a, b, c);
  if (turn > 0) return {a, b, c};
  if (turn < 0) return {a, c, b};
  if (dot(a, b, c) <= 0) return hull(t[1], t[2]);
  return dot(b, a, c) <= 0 ? hull(t[0], t[2]) : hull(t[0], t[1]);
}

Hull intersection(const Hull& a, const Hull& b) {
  Hull h = a;
  if (b.size() == 1) {
    const Fraction2 p = b[0];
    for (const int sign : {1, -1}) {
      h = clipped(h, [&](const Fraction2& q) { return (q.x - p.x) * sign; });
      h = clipped(h, [&](const Fraction2& q) { return (q.y - p.y) * sign; });
    }
    return h;
  }
  for (std::size_t i = 0; i < b.size(); ++i) {
    const Fraction2 &p = b[i], &q = b[(i + 1) % b.size()];
    h = clipped(h, [&](const Fraction2& r) { return cross(p, q, r); });
    if (b.size() == 2) h = clipped(h, [&](const Fraction2& r) { return dot(p, q, r); });
  }
  return h;
}

bool segments_touch(const Segment& s, const Segment& t) {
  const bool a = s.va == t.va || s.va == t.vb, b = s.vb == t.va || s.vb == t.vb;
  if (a && b) return false;
  const Hull common = intersection(hull(s.a, s.b), hull(t.a, t.b));
  if (!a && !b) return !common.empty();
  return s.a == s.b || t.a == t.b || contains_another(common, fraction(a ? s.a : s.b));
}

bool segments_cross(const Point& a, const Point& b, const Point& c, const Point& d) {
  if (a == b || c == d) return false;
  const Hull common = intersection(hull(a, b), hull(c, d));
  return !common.empty() && !contains_another(common, common[0]) && !on(a, c, d) && !on(b, c, d) &&
         !on(c, a, b) && !on(d, a, b);
}

bool touches(const Segment& s, const NumberedTriangle& t) {
  const int a = corner(t, s.va), b = corner(t, s.vb);
  if (a < 3 && b < 3) return false;
  const Hull common = intersection(hull(s.a, s.b), hull(t.p));
  if (a == 3 && b == 3) return !common.empty();
  return s.a == s.b || corner_doubled(t, a < 3 ? a : b) ||
         contains_another(common, fraction(a < 3 ? s.a : s.b));
}

bool touches(const NumberedTriangle& s, const NumberedTriangle& t) {
  const std::vector<int> corners = shared(s, t);
  if (corners.size() == 3) return false;
  if (corners.size() == 2 && (flat(s.p) || flat(t.p))) return true;
  const Hull common = intersection(hull(s.p), hull(t.p));
  if (corners.empty()) return !common.empty();
  const int k = corners[0];
  if (corners.size() == 1) {
    return corner_doubled(s, k) || corner_doubled(t, corner(t, s.v[k])) ||
           contains_another(common, fraction(s.p[k]));
  }
  const int l = corners[1];
  const auto off_the_edge = [&](const Fraction2& p) {  // by the numerator: rational != 0 recurses in C++20
    return cross(fraction(s.p[k]), fraction(s.p[l]), p).numerator() != 0;
  };
  return std::any_of(common.begin(), common.end(), off_the_edge);
}

bool interiors_overlap(const std::array<Point, 3>& s, const std::array<Point, 3>& t) {
  if (flat(s) || flat(t)) return false;
  const Hull common = intersection(hull(s), hull(t));
  Number area = 0;
  for (std::size_t i = 0; i + 2 < common.size(); ++i) area += cross(common[0], common[i + 1], common[i + 2]);
  return area > 0;
}

}  // namespace kinemesh::oracle
