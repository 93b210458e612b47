// Vectors in any numbers.
#pragma once

#include "kinemesh/types.h"

namespace kinemesh {

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

}  // namespace kinemesh
