// Signs of areas of triangles whose corners move linearly, at the times at which others collapse: what an
// event-driven triangulation decides by. Exact, for all finite coordinates: doubles under an error bound
// first, and integers where these do not tell. No root is ever taken: a time is known by its quadratic.
#pragma once

#include <array>
#include <atomic>
#include <cmath>
#include <optional>

#include "core/exact/moving_area.h"
#include "kinemesh/predicates.h"
#include "kinemesh/types.h"

namespace kinemesh {

// At x0 + t (x1 - x0) for 0 <= t <= 1.
struct MovingPoint {
  Point x0, x1;
};

// Each coefficient is right within `error`, and so is its value in [0, 1].
struct RoundedQuadratic : MovingArea<double> {
  double error;
};

// Of u x v, where u and v go from u0, v0 to u1, v1, themselves differences of exact points. A difference is
// right within a factor 1 +- u, u = 2^-53, a product of two within 3u + O(u^2), each coefficient within 6u of
// the sum of its products' magnitudes; weights and sums of a value take 6u more: 16u has room for rounding
// the bound. What underflows is off by 2^-1074. Overflow makes bound or value infinite or NaN, so that
// comparisons fail.
inline RoundedQuadratic rounded_product(const Point& u0, const Point& u1, const Point& v0, const Point& v1) {
  const auto size = [](const Point& u, const Point& v) { return std::abs(u.x * v.y) + std::abs(u.y * v.x); };
  const double sum = size(u0, v0) + size(u1, v1) + size(u0, v1) + size(u1, v0);
  return {moving_area(u0, u1, v0, v1), 16.0 * 0x1p-53 * sum + underflow_error};
}

// Throughout [0, 1], if its Bernstein coefficients are.
inline bool is_surely_positive(const RoundedQuadratic& q) {
  return q.start > q.error && 0.5 * q.mixed > q.error && q.end > q.error;
}

class CollapseTime;
struct ExactQuadratic;

// A quadratic in integers that is worked out once it is needed, which is hardly ever. Several threads may
// need it at once: one is kept. A copy has its own.
class ExactOnce {
 public:
  ExactOnce() = default;
  ExactOnce(const ExactOnce& other);
  ExactOnce(ExactOnce&& other) noexcept : kept_(other.get()) { other.set(nullptr); }
  ExactOnce& operator=(ExactOnce other) noexcept {
    const auto* mine = get();
    set(other.get());
    other.set(mine);
    return *this;
  }
  ~ExactOnce() {
    if (get()) destroy();
  }
  const ExactQuadratic* get() const {
    return kept_.load(std::memory_order_acquire);
  }                                                          // null if not yet needed
  const ExactQuadratic& keep(ExactQuadratic&& fresh) const;  // the first that came

 private:
  void set(const ExactQuadratic* known) { kept_.store(known, std::memory_order_relaxed); }  // alone with it
  void destroy() noexcept;

  mutable std::atomic<const ExactQuadratic*> kept_ = nullptr;
};

// A product of two vectors that change linearly, as a function of time. Constant members may be called by
// several threads at once.
class KineticQuadratic {
 public:
  static KineticQuadratic area(const MovingPoint& a, const MovingPoint& b, const MovingPoint& c);  // twice
  static KineticQuadratic dot(const MovingPoint& a, const MovingPoint& b, const MovingPoint& c);   // at a

  int sign_at(const CollapseTime& t) const;
  int sign_after(const CollapseTime& t) const;  // throughout some open interval that begins at t

  // When it goes from positive to negative, which happens once at most: strictly between `from`, or 0, and 1.
  std::optional<CollapseTime> collapse_after(const CollapseTime* from = nullptr) const;

 private:
  friend class CollapseTime;
  friend int compare(const CollapseTime& s, const CollapseTime& t);

  KineticQuadratic(const std::array<MovingPoint, 3>& corners, bool is_dot);

  double value_at(double t) const;
  double guess_collapse(double& slope) const;
  bool is_surely_positive_from(double t) const;
  bool surely_collapses_in(double low, double high) const;
  const ExactQuadratic& exact() const;

  std::array<MovingPoint, 3> corners_;
  bool is_dot_;
  RoundedQuadratic rounded_;
  ExactOnce exact_;
};

// A time at which a quadratic goes from positive to negative.
class CollapseTime {
 public:
  static CollapseTime end();  // 1

  double low() const { return low_; }  // it lies in [low, high]
  double high() const { return high_; }

 private:
  friend class KineticQuadratic;
  friend int compare(const CollapseTime& s, const CollapseTime& t);

  CollapseTime(const KineticQuadratic& quadratic, double low, double high)
      : quadratic_(quadratic), low_(low), high_(high) {}

  KineticQuadratic quadratic_;
  double low_, high_;
};

int compare(const CollapseTime& s, const CollapseTime& t);  // sign of s - t

}  // namespace kinemesh
