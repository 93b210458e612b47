// The product of two vectors that change linearly from t = 0 to 1, as a quadratic of the time: of two sides
// of a moving triangle, twice its signed area.
#pragma once

#include "kinemesh/types.h"

namespace kinemesh {

// (1 - t)^2 start + t (1 - t) mixed + t^2 end, which is constant + linear t + square t^2.
template <class Number>
struct MovingArea {
  Number start, mixed, end;

  Number constant() const { return start; }
  Number linear() const { return Number(mixed - 2 * start); }
  Number square() const { return Number(start - mixed + end); }
};

// Of u and v, which go from u0, v0 to u1, v1: any vectors that have a cross product.
template <class Vector>
auto moving_area(const Vector& u0, const Vector& u1, const Vector& v0, const Vector& v1) {
  using Number = decltype(cross(u0, v0));
  return MovingArea<Number>{cross(u0, v0), Number(cross(u0, v1) + cross(u1, v0)), cross(u1, v1)};
}

}  // namespace kinemesh
