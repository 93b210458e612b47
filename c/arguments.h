// What callers hand over, checked: each error names the argument and what was expected.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "kinemesh/error.h"
#include "kinemesh/mesh_data.h"
#include "kinemesh/types.h"

namespace kinemesh {

template <class T>
T* required(T* pointer, const char* name) {
  if (!pointer) throw InputError(std::string(name) + " is NULL, an address expected");
  return pointer;
}

// Where a new handle goes; NULL until all has gone well.
template <class Handle>
Handle*& cleared(Handle** handle, const char* name) {
  *required(handle, name) = nullptr;
  return *handle;
}

// Of n elements; NULL is fine where there are none.
template <class T>
std::span<const T> array(const T* first, std::size_t n, const char* name) {
  return {n > 0 ? required(first, name) : nullptr, n};
}

// A number of things, at least 0.
std::size_t count(std::int32_t n, const char* name);

// A number of one of n things.
std::size_t index(std::int32_t i, std::size_t n, const char* name);

// A finite number, at least 0.
double not_negative(double value, const char* name);

// The caller's arrays as ours, and numbers of points as the caller's.
std::vector<Point> points(std::span<const double> xy);
std::vector<Triangle> triangles_of(std::span<const std::int32_t> corners);
std::vector<double> flat(std::span<const Point> points);

// To the caller's arrays, each of which may be null.
void copy(const MeshData& data, double* xy, std::int32_t* triangles, std::int32_t* labels);

}  // namespace kinemesh
