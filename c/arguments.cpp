#include "c/arguments.h"

#include <cmath>
#include <type_traits>

#include "core/base/shortest_text.h"

namespace kinemesh {
namespace {

static_assert(std::is_same_v<std::int32_t, int>);

std::string is(const char* name, const std::string& value) {
  return std::string(name) + " is " + value + ", ";
}

}  // namespace

std::size_t count(std::int32_t n, const char* name) {
  if (n < 0) throw InputError(is(name, std::to_string(n)) + "at least 0 expected");
  return static_cast<std::size_t>(n);
}

std::size_t index(std::int32_t i, std::size_t n, const char* name) {
  if (i < 0 || static_cast<std::size_t>(i) >= n)
    throw InputError(is(name, std::to_string(i)) + "a number from 0 and below " + std::to_string(n) +
                     " expected");
  return static_cast<std::size_t>(i);
}

double not_negative(double value, const char* name) {
  if (!std::isfinite(value) || value < 0.0)
    throw InputError(is(name, shortest_text(value)) + "a finite number, not negative, expected");
  return value;
}

std::vector<Point> points(std::span<const double> xy) {
  std::vector<Point> all(xy.size() / 2);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = {xy[2 * i], xy[2 * i + 1]};
  return all;
}

std::vector<Triangle> triangles_of(std::span<const std::int32_t> corners) {
  std::vector<Triangle> all(corners.size() / 3);
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] = {corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]};
  return all;
}

std::vector<double> flat(std::span<const Point> points) {
  std::vector<double> xy;
  xy.reserve(2 * points.size());
  for (const Point& p : points) xy.insert(xy.end(), {p.x, p.y});
  return xy;
}

void copy(const MeshData& data, double* xy, std::int32_t* triangles, std::int32_t* labels) {
  for (int v = 0; xy && v < data.n_vertices(); ++v) {
    *xy++ = data.points[v].x;
    *xy++ = data.points[v].y;
  }
  for (int f = 0; f < data.n_faces(); ++f) {
    for (int k = 0; triangles && k < 3; ++k) *triangles++ = data.triangles[f][k];
    if (labels) *labels++ = data.label(f);
  }
}

}  // namespace kinemesh
