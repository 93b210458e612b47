#include "kinemesh/safe_step.h"

#include <algorithm>
#include <array>
#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <limits>
#include <string>
#include <vector>

#include "core/base/parallel.h"
#include "core/exact/moving_area.h"
#include "core/exact/vector.h"
#include "kinemesh/error.h"

namespace kinemesh {
namespace {

using Rational = boost::multiprecision::cpp_rational;

constexpr double infinity = std::numeric_limits<double>::infinity();

// Corners of one face before and after.
struct MovingFace {
  std::array<Point, 3> x0, x1;
};

// Twice, as a function of the share of the step.
template <class Number>
MovingArea<Number> area_of(const MovingFace& f) {
  const auto side = [](const std::array<Point, 3>& x, int corner) {
    return difference<Number>(x[corner], x[0]);
  };
  return moving_area(side(f.x0, 1), side(f.x1, 1), side(f.x0, 2), side(f.x1, 2));
}

// Where the rounded quadratic vanishes first in (0, 1], or infinity: only a guess.
double guess(const MovingFace& f) {
  const auto area = area_of<double>(f);
  const double a = area.constant(), b = area.linear(), c = area.square();
  const double discriminant = b * b - 4.0 * a * c;
  if (!(discriminant >= 0.0)) return infinity;
  const double q = -b + std::copysign(std::sqrt(discriminant), -b);
  const double r1 = 2.0 * a / q, r2 = 0.5 * q / c;  // without cancellation
  double first = infinity;
  for (const double r : {r1, r2})
    if (r >= 0.0 && r <= 1.0) first = std::min(first, r);
  return first;
}

// A side at share s = 0 or `until`, and a bound of what was summed up for it.
struct RoundedSide {
  Point value, magnitude;
};

RoundedSide side_at(const MovingFace& f, int corner, double s) {
  const Point e0 = f.x0[corner] - f.x0[0], e1 = f.x1[corner] - f.x1[0];
  const Point start = (1.0 - s) * e0, end = s * e1;
  return {start + end, glm::abs(start) + glm::abs(end)};
}

// Whether u x v + v' x u' exceeds its rounding error. Each side is within 4u + O(u^2) of its magnitude, a
// product within 9u, the sum of two crosses within 11u of the sum of magnitudes: 16u has room for rounding
// the bound. What underflows is off by 2^-1074, times the other factor's magnitude. Overflow fails the
// comparison.
bool is_surely_positive(const RoundedSide& u, const RoundedSide& v, const RoundedSide& w,
                        const RoundedSide& z) {
  const double value =
      u.value.x * v.value.y - u.value.y * v.value.x + w.value.x * z.value.y - w.value.y * z.value.x;
  const double magnitude = u.magnitude.x * v.magnitude.y + u.magnitude.y * v.magnitude.x +
                           w.magnitude.x * z.magnitude.y + w.magnitude.y * z.magnitude.x;
  const Point all = u.magnitude + v.magnitude + w.magnitude + z.magnitude;
  return value > 16.0 * 0x1p-53 * magnitude + std::numeric_limits<double>::min() * (1.0 + all.x + all.y);
}

// A quadratic whose three Bernstein coefficients over [0, until] are positive has no root there; they are
// u0 x v0, (u0 x v1 + u1 x v0) / 2 and u1 x v1.
bool is_surely_upright(const MovingFace& f, double until) {
  const RoundedSide u0 = side_at(f, 1, 0.0), v0 = side_at(f, 2, 0.0);
  const RoundedSide u1 = side_at(f, 1, until), v1 = side_at(f, 2, until);
  return is_surely_positive(u0, v0, u0, v0) && is_surely_positive(u0, v1, u1, v0) &&
         is_surely_positive(u1, v1, u1, v1);
}

// Whether the quadratic is positive on all of [0, s), or of [0, s].
enum class End { Open, Closed };
bool is_upright(const MovingArea<Rational>& area, double s, End end) {
  if (end == End::Open && s == 0.0) return true;
  const Rational a = area.constant(), b = area.linear(), c = area.square();
  if (a <= 0) return false;
  const Rational t(s), value = a + t * (b + t * c);
  if (end == End::Open ? value < 0 : value <= 0) return false;
  const bool dips = c > 0 && b < 0 && -b < 2 * c * t;  // the least value lies inside (0, s)
  return !dips || b * b < 4 * a * c;
}

// Non-negative doubles are ordered like their bits.
double with_bits(std::uint64_t bits) {
  return std::bit_cast<double>(bits);
}

// The largest double s in [0, 1] with the face upright throughout [0, s); infinity if it is so at 1, too.
double first_root(const MovingFace& f) {
  const auto q = area_of<Rational>(f);
  if (is_upright(q, 1.0, End::Closed)) return infinity;
  std::uint64_t low = 0, high = std::bit_cast<std::uint64_t>(1.0) + 1;  // upright below low, not below high
  const double near = guess(f), width = 0x1p-40;
  for (const double s : {near * (1.0 - width), near * (1.0 + width)})
    if (s <= 1.0) (is_upright(q, s, End::Open) ? low : high) = std::bit_cast<std::uint64_t>(s);
  while (high - low > 1) {
    const std::uint64_t middle = low + (high - low) / 2;
    (is_upright(q, with_bits(middle), End::Open) ? low : high) = middle;
  }
  return with_bits(low);
}

class Search {
 public:
  Search(std::span<const Triangle> faces, std::span<const Point> x0, std::span<const Point> x1)
      : faces_(faces), x0_(x0), x1_(x1) {}

  // A guess says up to where to look; if the first root is later, looks again up to there.
  std::optional<SafeStep> first() const {
    for (double until = first_guess();;) {
      const SafeStep found = first_among(doubtful(until));
      if (found.share <= until || until == 1.0)
        return found.share <= 1.0 ? std::optional(found) : std::nullopt;
      until = std::min(found.share, 1.0);
    }
  }

 private:
  MovingFace face(int f) const {
    const auto [i, j, k] = faces_[f];
    return {{x0_[i], x0_[j], x0_[k]}, {x1_[i], x1_[j], x1_[k]}};
  }
  int n_faces() const { return static_cast<int>(faces_.size()); }

  double first_guess() const {
    std::array<double, most_parts> first;
    first.fill(1.0);
    parallel_parts(n_faces(), grain::moves, [&](int part, int begin, int end) {
      for (int f = begin; f < end; ++f) first[part] = std::min(first[part], guess(face(f)));
    });
    return *std::min_element(first.begin(), first.end());
  }

  // Faces that may be flat in [0, until], ascending.
  std::vector<int> doubtful(double until) const {
    std::vector<char> is_doubtful(faces_.size());
    parallel_parts(n_faces(), grain::moves, [&](int, int begin, int end) {
      for (int f = begin; f < end; ++f) is_doubtful[f] = !is_surely_upright(face(f), until);
    });
    std::vector<int> found;
    for (int f = 0; f < n_faces(); ++f)
      if (is_doubtful[f]) found.push_back(f);
    return found;
  }

  SafeStep first_among(const std::vector<int>& faces) const {
    std::vector<double> roots(faces.size());
    parallel_parts(static_cast<int>(faces.size()), 1, [&](int, int begin, int end) {
      for (int i = begin; i < end; ++i) roots[i] = first_root(face(faces[i]));
    });
    const auto first = std::min_element(roots.begin(), roots.end());
    if (first == roots.end()) return {infinity, none};
    return {*first, faces[first - roots.begin()]};
  }

  std::span<const Triangle> faces_;
  std::span<const Point> x0_, x1_;
};

void require_finite(std::span<const Point> x, const char* when) {
  for (std::size_t v = 0; v < x.size(); ++v)
    if (!is_finite(x[v]))
      throw InputError("vertex " + std::to_string(v) + " is not finite " + when + " the step");
}

void require_vertices(std::span<const Triangle> faces, std::size_t n_vertices) {
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (const int v : faces[f])
      if (v < 0 || static_cast<std::size_t>(v) >= n_vertices)
        throw InputError("face " + std::to_string(f) + " has vertex " + std::to_string(v) + ", one below " +
                         std::to_string(n_vertices) + " expected");
}

}  // namespace

std::optional<SafeStep> max_safe_step(std::span<const Triangle> faces, std::span<const Point> x0,
                                      std::span<const Point> x1) {
  if (x0.size() != x1.size())
    throw InputError(std::to_string(x1.size()) + " positions after the step, " + std::to_string(x0.size()) +
                     " expected");
  require_finite(x0, "before");
  require_finite(x1, "after");
  require_vertices(faces, x0.size());
  return Search(faces, x0, x1).first();
}

}  // namespace kinemesh
