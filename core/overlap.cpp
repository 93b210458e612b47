#include "core/overlap.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <vector>

#include "core/predicates.h"

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

template <class Number>
struct Vector {
  Number x, y;
};

template <class Number>
Vector<Number> difference(const Point& p, const Point& q) {
  return {Number(p.x) - Number(q.x), Number(p.y) - Number(q.y)};
}

template <class Number>
Number cross(const Vector<Number>& u, const Vector<Number>& v) {
  return u.x * v.y - u.y * v.x;
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
struct Form {
  std::array<Number, 3> l;
  Number value;  // sum l_i c_i
};

template <class Number>
Form<Number> farkas(const Halfplane& h, const Halfplane& i, const Halfplane& j) {
  const auto d = difference<Number>(h.b, h.a), e = difference<Number>(i.b, i.a),
             f = difference<Number>(j.b, j.a);
  const auto p = difference<Number>(i.a, h.a),
             q = difference<Number>(j.a, h.a);  // seen from h.a, where c of h is 0
  const std::array<Number, 3> l{cross(e, f), cross(f, d), cross(d, e)};
  return {l, l[1] * cross(e, p) + l[2] * cross(f, q)};
}

template <class Sign>
bool is_empty(const std::array<Sign, 3>& l, int value) {
  if (l[0] > 0 && l[1] > 0 && l[2] > 0) return value >= 0;
  if (l[0] < 0 && l[1] < 0 && l[2] < 0) return value <= 0;
  return false;
}

bool has_point(const Halfplane& h, const Halfplane& i, const Halfplane& j) {
  const double m =
      size_of({difference<double>(h.b, h.a), difference<double>(i.b, i.a), difference<double>(j.b, j.a),
               difference<double>(i.a, h.a), difference<double>(j.a, h.a)});
  if (m > smallest && m < largest) {
    const auto form = farkas<double>(h, i, j);
    const double bound = cross_error * m * m;
    const bool certain =
        std::all_of(form.l.begin(), form.l.end(), [&](double l) { return std::abs(l) > bound; });
    if (certain) {
      const std::array<int, 3> l{sign(form.l[0]), sign(form.l[1]), sign(form.l[2])};
      if (l[0] != l[1] || l[1] != l[2]) return true;
      if (const auto value = certain_sign(form.value, form_error * m * m * m * m))
        return !is_empty(l, *value);
    }
  }
  const auto form = farkas<Rational>(h, i, j);
  return !is_empty(std::array<int, 3>{sign(form.l[0]), sign(form.l[1]), sign(form.l[2])}, sign(form.value));
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

// h is entered at b's end no sooner than... : along a -> b one leaves h after one enters i.
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
Side side_of(const Shadow& sheet, const P& p) {
  bool on = false;
  for (const auto& [a, b] : sides_of(sheet)) {
    const auto o = turn(a, b, p);
    if (o == Orientation::Clockwise) return Side::Outside;
    on = on || o == Orientation::Collinear;
  }
  return on ? Side::On : Side::Inside;
}

// Nothing if the point is not good for counting.
template <class P>
std::optional<int> cover_over(const P& p, const Shadow& piece, std::span<const Shadow> sheets) {
  if (side_of(piece, p) != Side::Inside) return std::nullopt;
  int sum = 0;
  for (const auto& sheet : sheets) {
    const auto side = side_of(sheet, p);
    if (side == Side::On) return std::nullopt;
    if (side == Side::Inside) sum += static_cast<int>(orientation(sheet[0], sheet[1], sheet[2]));
  }
  return sum;
}

}  // namespace

bool interiors_overlap(const Shadow& s, const Shadow& t, const Shadow& u) {
  if (!interiors_overlap(s, t) || !interiors_overlap(t, u) || !interiors_overlap(u, s)) return false;
  for (const auto& h : sides_of(s)) {
    for (const auto& i : sides_of(t)) {
      for (const auto& j : sides_of(u)) {
        if (!has_point(h, i, j)) return false;
      }
    }
  }
  return true;
}

bool interiors_overlap(std::span<const Shadow> triangles) {
  const std::size_t n = triangles.size();
  if (n < 2) return true;
  if (n == 2) return interiors_overlap(triangles[0], triangles[1]);
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
  std::vector<Halfplane> leaving, entering;  // on the way from a to b
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
  if (const auto sum = cover_over(centroid, piece, sheets)) return *sum;
  // Finitely many lines cannot hold all of these points; a sliver may contain no double.
  for (int n = 1;; ++n) {
    if (const auto sum = cover_over(weighted(piece, 1, n, n * n + 1), piece, sheets)) return *sum;
  }
}

}  // namespace kinemesh
