#include "core/exact/kinetic_predicates.h"

#include <algorithm>
#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <utility>

#include "core/exact/vector.h"

namespace kinemesh {

// a + b t + c t^2, times a positive number that does not matter.
struct ExactQuadratic {
  boost::multiprecision::cpp_int a, b, c;
};

namespace {

using Integer = boost::multiprecision::cpp_int;

// --- exact ---

// A double as an integer times a power of two, the integer odd or 0.
struct Dyadic {
  std::int64_t mantissa = 0;
  int exponent = std::numeric_limits<int>::max();
};

Dyadic dyadic(double x) {
  if (x == 0.0) return {};
  int exponent;
  const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
  const int zeros = std::countr_zero(static_cast<std::uint64_t>(mantissa));
  return {mantissa / (std::int64_t{1} << zeros), exponent - 53 + zeros};
}

// At one end of time, in a unit that makes all coordinates integers.
using ExactVector = Vector<Integer>;

class Scale {
 public:
  explicit Scale(const std::array<MovingPoint, 3>& points) {
    for (const auto& [x0, x1] : points)
      for (const double x : {x0.x, x0.y, x1.x, x1.y}) exponent_ = std::min(exponent_, dyadic(x).exponent);
  }
  ExactVector difference(const Point& p, const Point& q) const {
    return {scaled(p.x) - scaled(q.x), scaled(p.y) - scaled(q.y)};
  }

 private:
  Integer scaled(double x) const {
    const auto [mantissa, exponent] = dyadic(x);
    return mantissa == 0 ? Integer(0) : Integer(mantissa) << static_cast<unsigned>(exponent - exponent_);
  }

  int exponent_ = std::numeric_limits<int>::max();
};

ExactVector turned(const ExactVector& v) {
  return {-v.y, v.x};
}

ExactQuadratic exact_quadratic(const std::array<MovingPoint, 3>& p, bool is_dot) {
  const Scale scale(p);
  const auto u0 = scale.difference(p[1].x0, p[0].x0), u1 = scale.difference(p[1].x1, p[0].x1);
  auto v0 = scale.difference(p[2].x0, p[0].x0), v1 = scale.difference(p[2].x1, p[0].x1);
  if (is_dot) {
    v0 = turned(v0);
    v1 = turned(v1);
  }
  const auto area = moving_area(u0, u1, v0, v1);
  return {area.constant(), area.linear(), area.square()};
}

int sign(const Integer& value) {
  return value.sign();
}

// numerator / denominator, the latter positive.
struct Fraction {
  Integer numerator, denominator;
};

Fraction fraction(double x) {  // pre: 0 <= x <= 1
  const auto [mantissa, exponent] = dyadic(x);
  if (mantissa == 0) return {0, 1};
  return {mantissa, Integer(1) << static_cast<unsigned>(std::max(0, -exponent))};
}

int sign_at(const ExactQuadratic& q, const Fraction& t) {
  const auto& [p, d] = t;
  return sign(Integer(d * (q.a * d + q.b * p) + q.c * p * p));
}

ExactQuadratic derivative(const ExactQuadratic& q) {
  return {q.b, 2 * q.c, 0};
}

bool collapses(const ExactQuadratic& q) {
  return q.c == 0 ? q.b < 0 : q.b * q.b > 4 * q.a * q.c;
}

// Sign of T - s, T the time at which q goes from positive to negative, given the signs of q and of its
// derivative at s: where q falls, T is ahead just if q is positive; elsewhere T is the first of two roots and
// behind, or the second and ahead. Pre: collapses(q).
int side_of_collapse(const ExactQuadratic& q, int value, int slope) {
  if (slope < 0) return value;
  return q.c > 0 ? -1 : 1;
}

int compare_collapse(const ExactQuadratic& q, const Fraction& s) {
  return side_of_collapse(q, sign_at(q, s), sign_at(derivative(q), s));
}

// At the time T at which p collapses: c_p q - c_q p is linear and vanishes with q there.
int sign_at_collapse(const ExactQuadratic& q, const ExactQuadratic& p) {
  if (p.c == 0) return sign_at(q, {p.a, -p.b});
  const Integer slope = p.c * q.b - q.c * p.b, constant = p.c * q.a - q.c * p.a;
  if (slope == 0) return sign(p.c) * sign(constant);
  const int upward = sign(slope);
  return sign(p.c) * upward * compare_collapse(p, {-upward * constant, upward * slope});
}

// --- rounded ---

int sign(double value) {
  return (value > 0.0) - (value < 0.0);
}

}  // namespace

ExactOnce::ExactOnce(const ExactOnce& other) {
  if (const auto* known = other.get()) set(new ExactQuadratic(*known));
}

void ExactOnce::destroy() noexcept {
  delete get();
}

const ExactQuadratic& ExactOnce::keep(ExactQuadratic&& fresh) const {
  auto mine = std::make_unique<const ExactQuadratic>(std::move(fresh));
  const ExactQuadratic* first = nullptr;
  if (kept_.compare_exchange_strong(first, mine.get(), std::memory_order_acq_rel)) return *mine.release();
  return *first;
}

KineticQuadratic::KineticQuadratic(const std::array<MovingPoint, 3>& p, bool is_dot)
    : corners_(p), is_dot_(is_dot) {
  Point v0 = p[2].x0 - p[0].x0, v1 = p[2].x1 - p[0].x1;
  if (is_dot) {
    v0 = {-v0.y, v0.x};
    v1 = {-v1.y, v1.x};
  }
  rounded_ = rounded_product(p[1].x0 - p[0].x0, p[1].x1 - p[0].x1, v0, v1);
}

KineticQuadratic KineticQuadratic::area(const MovingPoint& a, const MovingPoint& b, const MovingPoint& c) {
  return {{a, b, c}, false};
}

KineticQuadratic KineticQuadratic::dot(const MovingPoint& a, const MovingPoint& b, const MovingPoint& c) {
  return {{a, b, c}, true};
}

const ExactQuadratic& KineticQuadratic::exact() const {
  const auto* known = exact_.get();
  return known ? *known : exact_.keep(exact_quadratic(corners_, is_dot_));
}

double KineticQuadratic::value_at(double t) const {
  const double s = 1.0 - t;
  return s * s * rounded_.start + s * t * rounded_.mixed + t * t * rounded_.end;
}

// The slope lies between those at the ends of [0, 1], each right within four times the error.
int KineticQuadratic::sign_at(const CollapseTime& t) const {
  const double width = t.high_ - t.low_;
  const double steepest = std::max(std::abs(rounded_.mixed - 2.0 * rounded_.start),
                                   std::abs(2.0 * rounded_.end - rounded_.mixed));
  const double value = value_at(t.low_ + 0.5 * width);
  if (std::abs(value) > rounded_.error + (steepest + 4.0 * rounded_.error) * width) return sign(value);
  return sign_at_collapse(exact(), t.quadratic_.exact());
}

int KineticQuadratic::sign_after(const CollapseTime& t) const {
  if (const int value = sign_at(t)) return value;
  if (const int slope = sign_at_collapse(derivative(exact()), t.quadratic_.exact())) return slope;
  return sign(exact().c);
}

// Only a guess: where the rounded quadratic goes from positive to negative, and how steeply.
double KineticQuadratic::guess_collapse(double& slope) const {
  const double a = rounded_.constant(), b = rounded_.linear(), c = rounded_.square();
  slope = std::sqrt(std::max(0.0, b * b - 4.0 * a * c));
  return b <= 0.0 ? 2.0 * a / (slope - b) : (-b - slope) / (2.0 * c);  // without cancellation
}

// By the Bernstein coefficients over [t, 1].
bool KineticQuadratic::is_surely_positive_from(double t) const {
  const double middle = 0.5 * (1.0 - t) * rounded_.mixed + t * rounded_.end;
  return value_at(t) > rounded_.error && middle > rounded_.error && rounded_.end > rounded_.error;
}

bool KineticQuadratic::surely_collapses_in(double low, double high) const {
  return low >= 0.0 && high <= 1.0 && value_at(low) > rounded_.error && value_at(high) < -rounded_.error;
}

std::optional<CollapseTime> KineticQuadratic::collapse_after(const CollapseTime* from) const {
  if (is_surely_positive_from(from ? from->low_ : 0.0)) return std::nullopt;
  double slope;
  const double near = guess_collapse(slope), width = 4.0 * rounded_.error / slope + 8.0 * 0x1p-53;
  std::optional<CollapseTime> time;
  if (surely_collapses_in(near - width, near + width)) {
    time = CollapseTime(*this, near - width, near + width);
  } else {
    const auto& q = exact();
    if (!collapses(q) || compare_collapse(q, {0, 1}) <= 0 || compare_collapse(q, {1, 1}) >= 0)
      return std::nullopt;
    time = CollapseTime(*this, 0.0, 1.0);
    for (const double w : {0.0, 0x1p-48, 0x1p-36, 0x1p-20}) {
      const double low = std::max(0.0, near - w), high = std::min(1.0, near + w);
      if (!(low <= high) || compare_collapse(q, fraction(low)) < 0 || compare_collapse(q, fraction(high)) > 0)
        continue;
      time = CollapseTime(*this, low, high);
      break;
    }
  }
  if (from && compare(*time, *from) <= 0) return std::nullopt;
  return time;
}

int compare(const CollapseTime& s, const CollapseTime& t) {
  if (s.high_ < t.low_) return -1;
  if (t.high_ < s.low_) return 1;
  if (s.low_ == s.high_ && t.low_ == t.high_) return 0;
  const auto &p = s.quadratic_.exact(), &q = t.quadratic_.exact();
  return side_of_collapse(p, sign_at_collapse(p, q), sign_at_collapse(derivative(p), q));
}

// When (t, 0) reaches (1, 0).
CollapseTime CollapseTime::end() {
  const MovingPoint here{{0, 0}, {0, 0}}, ahead{{1, 0}, {1, 0}}, falling{{0, 1}, {0, 0}};
  return {KineticQuadratic::area(here, ahead, falling), 1.0, 1.0};
}

}  // namespace kinemesh
