#include "core/exact/compare_areas.h"

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

#include "kinemesh/predicates.h"

namespace kinemesh {
namespace {

using Corners3 = std::array<Point, 3>;
using Rational = boost::multiprecision::cpp_rational;

// Twice the area is l - r, as in orientation().
template <class Number>
struct Products {
  Number l, r;
};

template <class Number>
Products<Number> products(const Corners3& t) {
  const auto& [a, b, c] = t;
  const auto x = [](const Point& p, const Point& q) { return Number(p.x) - Number(q.x); };
  const auto y = [](const Point& p, const Point& q) { return Number(p.y) - Number(q.y); };
  return {x(a, c) * y(b, c), y(a, c) * x(b, c)};
}

template <class Number>
int sign(const Number& value) {
  return (value > 0) - (value < 0);
}

int compare_exactly(const Corners3& s, const Corners3& t) {
  const auto p = products<Rational>(s), q = products<Rational>(t);
  return sign<Rational>((p.l - p.r) - (q.l - q.r));
}

// With u = 2^-53 each product is right within 3u + O(u^2) of itself and either difference of two within u
// more of what went into it, and so is the last one: 5u + O(u^2) of the products' sizes together, which are
// rounded themselves. Underflow: four products, each off by 2^-1075 at most. Where something overflows the
// bound is infinite.
constexpr double area_error = 8.0 * 0x1p-53;

}  // namespace

int compare_areas(const Corners3& s, const Corners3& t) {
  const auto p = products<double>(s), q = products<double>(t);
  const double difference = (p.l - p.r) - (q.l - q.r);
  const double size = std::abs(p.l) + std::abs(p.r) + std::abs(q.l) + std::abs(q.r);
  if (std::abs(difference) > area_error * size + underflow_error) return sign(difference);
  return compare_exactly(s, t);
}

}  // namespace kinemesh
