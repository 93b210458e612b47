#include "core/exact/overlap.h"

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <boost/container/static_vector.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <vector>

#include "core/exact/vector.h"
#include "kinemesh/predicates.h"

namespace kinemesh {
namespace {

using Rational = boost::multiprecision::cpp_rational;

// Left of a -> b, open.
struct Halfplane {
  Point a, b;
};

std::array<Halfplane, 3> sides_of(const Shadow& t) {
  if (orientation(t[0], t[1], t[2]) == Orientation::Clockwise)
    return {{{t[1], t[0]}, {t[2], t[1]}, {t[0], t[2]}}};
  return {{{t[0], t[1]}, {t[1], t[2]}, {t[2], t[0]}}};
}

// The filters bound the error by the largest coordinate difference m that enters. With u = 2^-53 a difference
// is right within u m; a cross product of two, at most 2 m^2 in size, within 8 u m^2; a product of two cross
// products within 36 u m^4; a sum of three of these within 130 u m^4 [the way of Shewchuk 1997, §4.3].
// Outside the range below powers of m may under- or overflow, and the exact way is taken.
constexpr double unit = 0x1p-53;
constexpr double cross_error = 16.0 * unit;
constexpr double form_error = 256.0 * unit;
constexpr double smallest = 1e-60, largest = 1e60;

double size_of(std::initializer_list<Vector<double>> vectors) {
  double m = 0.0;
  for (const auto& v : vectors) m = std::max({m, std::abs(v.x), std::abs(v.y)});
  return m;
}

template <class Number>
int sign(const Number& value) {
  return (value > 0) - (value < 0);
}

// Sign of value if its error is below bound, or nothing.
std::optional<int> certain_sign(double value, double bound) {
  if (std::abs(value) > bound) return sign(value);
  return std::nullopt;
}

// --- three half-planes ---

// Farkas: { n_i . x > c_i } has no point if and only if some l_i >= 0, not all 0, have sum l_i n_i = 0 and
// sum l_i c_i >= 0. In the plane l = (n2 x n3, n3 x n1, n1 x n2) is the only candidate up to a factor; where
// one of its entries is 0 two of the half-planes decide, and those belong to two triangles that are known to
// overlap.
template <class Number>
Number turn_between(const Halfplane& h, const Halfplane& i) {
  return cross(difference<Number>(h.b, h.a), difference<Number>(i.b, i.a));
}

// sum l_i c_i, seen from h.a, where c of h is 0.
template <class Number>
Number farkas_sum(const Halfplane& h, const Halfplane& i, const Halfplane& j) {
  const auto d = difference<Number>(h.b, h.a), e = difference<Number>(i.b, i.a),
             f = difference<Number>(j.b, j.a);
  const auto p = difference<Number>(i.a, h.a), q = difference<Number>(j.a, h.a);
  return cross(f, d) * cross(e, p) + cross(d, e) * cross(f, q);
}

bool is_end(const Point& p, const Halfplane& h) {
  return p == h.a || p == h.b;
}

bool are_on_one_line(const Halfplane& h, const Halfplane& i) {
  return is_end(h.a, i) && is_end(h.b, i);
}

// Sides of neighbouring faces share vertices; then the sum is 0 without arithmetic.
bool meet_in_one_end(const Halfplane& h, const Halfplane& i, const Halfplane& j) {
  return (is_end(h.a, i) && is_end(h.a, j)) || (is_end(h.b, i) && is_end(h.b, j));
}

int sign_of_turn(const Halfplane& h, const Halfplane& i) {
  const double m = size_of({difference<double>(h.b, h.a), difference<double>(i.b, i.a)});
  if (m > smallest && m < largest) {
    if (const auto value = certain_sign(turn_between<double>(h, i), cross_error * m * m)) return *value;
  }
  return sign(turn_between<Rational>(h, i));
}

int sign_of_farkas_sum(const Halfplane& h, const Halfplane& i, const Halfplane& j) {
  if (meet_in_one_end(h, i, j)) return 0;
  const double m =
      size_of({difference<double>(h.b, h.a), difference<double>(i.b, i.a), difference<double>(j.b, j.a),
               difference<double>(i.a, h.a), difference<double>(j.a, h.a)});
  if (m > smallest && m < largest) {
    if (const auto value = certain_sign(farkas_sum<double>(h, i, j), form_error * m * m * m * m))
      return *value;
  }
  return sign(farkas_sum<Rational>(h, i, j));
}

bool has_point(const Halfplane& h, const Halfplane& i, const Halfplane& j) {
  if (are_on_one_line(h, i) || are_on_one_line(i, j) || are_on_one_line(j, h)) return true;  // two decide
  const int turn_hi = sign_of_turn(h, i);
  if (turn_hi == 0 || sign_of_turn(i, j) != turn_hi || sign_of_turn(j, h) != turn_hi) return true;
  return turn_hi * sign_of_farkas_sum(h, i, j) < 0;
}

// --- a common point, found without exact arithmetic ---

constexpr std::size_t most_triangles = 5;
using Polygon = boost::container::static_vector<Point, 3 * most_triangles + 3>;

// What rounded arithmetic leaves of a convex polygon on the left of a -> b.
Polygon clip(const Polygon& polygon, const Halfplane& h) {
  const auto distance = [&](const Point& p) {
    return cross(difference<double>(h.b, h.a), difference<double>(p, h.a));
  };
  Polygon left;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &p = polygon[i], &q = polygon[i + 1 == polygon.size() ? 0 : i + 1];
    const double at_p = distance(p), at_q = distance(q);
    if (left.size() + 2 > left.capacity()) return {};
    if (at_p > 0.0) left.push_back(p);
    if ((at_p > 0.0) != (at_q > 0.0)) left.push_back(p + at_p / (at_p - at_q) * (q - p));
  }
  return left;
}

// True if the middle of what clipping leaves is, exactly, inside all of the triangles. Fast, and seldom false
// where they overlap.
bool have_evident_point(std::span<const Shadow> triangles) {
  if (triangles.size() > most_triangles) return false;
  Polygon rest(triangles[0].begin(), triangles[0].end());
  for (const auto& t : triangles.subspan(1)) {
    for (const auto& h : sides_of(t)) rest = clip(rest, h);
  }
  Point middle(0.0);
  for (const auto& p : rest) middle += p / static_cast<double>(rest.size());
  if (rest.empty() || !std::isfinite(middle.x + middle.y)) return false;
  return std::all_of(triangles.begin(), triangles.end(),
                     [&](const Shadow& t) { return strictly_inside(middle, t); });
}

// --- a segment and two half-planes ---

// The signed distance from the side, up to a factor, is u at one end of the segment and w at the other.
template <class Number>
Number determinant(const Halfplane& h, const Point& a, const Point& b, const Halfplane& i) {
  const auto value = [](const Halfplane& g, const Point& p) {
    return cross(difference<Number>(g.b, g.a), difference<Number>(p, g.a));
  };
  return value(h, a) * value(i, b) - value(i, a) * value(h, b);
}

// Along a -> b one leaves h after one has entered i.
bool leaves_after_entering(const Halfplane& h, const Halfplane& i, const Point& a, const Point& b) {
  const double m =
      size_of({difference<double>(h.b, h.a), difference<double>(i.b, i.a), difference<double>(a, h.a),
               difference<double>(b, h.a), difference<double>(a, i.a), difference<double>(b, i.a)});
  if (m > smallest && m < largest) {
    if (const auto value = certain_sign(determinant<double>(h, a, b, i), form_error * m * m * m * m))
      return *value > 0;
  }
  return sign(determinant<Rational>(h, a, b, i)) > 0;
}

// --- one inside the other ---

bool is_within(const Shadow& t, const std::array<Halfplane, 3>& sides) {
  return std::all_of(sides.begin(), sides.end(), [&](const Halfplane& h) {
    return std::none_of(t.begin(), t.end(),
                        [&](const Point& p) { return orientation(h.a, h.b, p) == Orientation::Clockwise; });
  });
}

// --- the cover over a point ---

struct RationalPoint {
  Rational x, y;
};

// A point inside the piece, other weights giving another one.
RationalPoint weighted(const Shadow& t, int i, int j, int k) {
  const Rational n = i + j + k;
  return {(i * Rational(t[0].x) + j * Rational(t[1].x) + k * Rational(t[2].x)) / n,
          (i * Rational(t[0].y) + j * Rational(t[1].y) + k * Rational(t[2].y)) / n};
}

Orientation turn(const Point& a, const Point& b, const Point& p) {
  return orientation(a, b, p);
}

Orientation turn(const Point& a, const Point& b, const RationalPoint& p) {
  const auto d = difference<Rational>(b, a);
  const Vector<Rational> v{p.x - Rational(a.x), p.y - Rational(a.y)};
  return static_cast<Orientation>(sign(cross(d, v)));
}

// Inside, outside or on a side of the sheet.
template <class P>
InCircle side_of(const Shadow& sheet, const P& p) {
  bool on = false;
  for (const auto& [a, b] : sides_of(sheet)) {
    const auto o = turn(a, b, p);
    if (o == Orientation::Clockwise) return InCircle::Outside;
    on = on || o == Orientation::Collinear;
  }
  return on ? InCircle::On : InCircle::Inside;
}

// Nothing if the point is not good for counting.
template <class P>
std::optional<int> cover_over(const P& p, const Shadow& piece, std::span<const Shadow> sheets) {
  if (side_of(piece, p) != InCircle::Inside) return std::nullopt;
  int sum = 0;
  for (const auto& sheet : sheets) {
    const auto side = side_of(sheet, p);
    if (side == InCircle::On) return std::nullopt;
    if (side == InCircle::Inside) sum += static_cast<int>(orientation(sheet[0], sheet[1], sheet[2]));
  }
  return sum;
}

}  // namespace

bool interiors_overlap(const Shadow& s, const Shadow& t, const Shadow& u) {
  if (!interiors_overlap(s, t) || !interiors_overlap(t, u) || !interiors_overlap(u, s)) return false;
  const auto of_s = sides_of(s), of_t = sides_of(t), of_u = sides_of(u);
  if (is_within(s, of_t) || is_within(s, of_u) || is_within(t, of_s) || is_within(t, of_u) ||
      is_within(u, of_s) || is_within(u, of_t)) {
    return true;
  }
  for (const auto& h : of_s) {
    for (const auto& i : of_t) {
      for (const auto& j : of_u) {
        if (!has_point(h, i, j)) return false;
      }
    }
  }
  return true;
}

bool is_within(const Shadow& t, const Shadow& container) {
  return is_within(t, sides_of(container));
}

bool interiors_overlap(std::span<const Shadow> triangles) {
  const std::size_t n = triangles.size();
  if (n < 2) return true;
  if (n == 2) return interiors_overlap(triangles[0], triangles[1]);
  if (have_evident_point(triangles)) return true;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      for (std::size_t k = j + 1; k < n; ++k) {
        if (!interiors_overlap(triangles[i], triangles[j], triangles[k])) return false;
      }
    }
  }
  return true;
}

bool meets_interior(const Point& a, const Point& b, std::span<const Shadow> triangles) {
  if (a == b) return false;
  boost::container::small_vector<Halfplane, 9> leaving, entering;  // on the way from a to b
  for (const auto& t : triangles) {
    for (const auto& h : sides_of(t)) {
      const bool in_at_a = orientation(h.a, h.b, a) == Orientation::CounterClockwise;
      const bool in_at_b = orientation(h.a, h.b, b) == Orientation::CounterClockwise;
      if (!in_at_a && !in_at_b) return false;
      if (!in_at_b) leaving.push_back(h);
      if (!in_at_a) entering.push_back(h);
    }
  }
  // Intervals of a line have a common point if any two have.
  for (const auto& h : leaving) {
    for (const auto& i : entering) {
      if (!leaves_after_entering(h, i, a, b)) return false;
    }
  }
  return true;
}

int signed_cover(const Shadow& piece, std::span<const Shadow> sheets) {
  const Point centroid = (piece[0] + piece[1] + piece[2]) / 3.0;
  if (std::isfinite(centroid.x + centroid.y)) {
    if (const auto sum = cover_over(centroid, piece, sheets)) return *sum;
  }
  // Finitely many lines cannot hold all of these points; a sliver may contain no double.
  for (int n = 1;; ++n) {
    if (const auto sum = cover_over(weighted(piece, 1, n, n * n + 1), piece, sheets)) return *sum;
  }
}

}  // namespace kinemesh
