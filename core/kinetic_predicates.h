// Signs of areas of triangles whose corners move linearly, at the times at which others collapse: what an
// event-driven triangulation decides by. Exact, for all finite coordinates: doubles under an error bound
// first, and integers where these do not tell. No root is ever taken: a time is known by its quadratic.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "core/types.h"

namespace kinemesh {

// At x0 + t (x1 - x0) for 0 <= t <= 1.
struct MovingPoint {
  Point x0, x1;
};

class CollapseTime;
struct ExactQuadratic;

// A product of two vectors that change linearly, as a function of time.
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
  double start_, mixed_, end_;                           // (1 - t)^2 start + t (1 - t) mixed + t^2 end
  double error_;                                         // of what value_at returns
  mutable std::shared_ptr<const ExactQuadratic> exact_;  // once it was needed
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
