#include "tests/untangle/explore/exact_polygon.h"

#include <algorithm>

namespace kinemesh::test {
namespace {

ExactPoint exact(const Point& p) {
  return {Fraction(p.x), Fraction(p.y)};
}

// Twice the area of a, b, p: positive to the left of a -> b.
Fraction turn(const ExactPoint& a, const ExactPoint& b, const ExactPoint& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

bool is_upright(const Shadow& t) {
  return turn(exact(t[0]), exact(t[1]), exact(t[2])) > 0;
}

ExactPoint between(const ExactPoint& p, const ExactPoint& q, const Fraction& t) {
  return {p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
}

ExactPoint centre(const ExactPolygon& polygon) {
  ExactPoint sum{0, 0};
  for (const auto& p : polygon) sum = {sum.x + p.x, sum.y + p.y};
  const auto n = static_cast<int>(polygon.size());
  return {sum.x / n, sum.y / n};
}

bool is_inside(const ExactPolygon& triangle, const ExactPoint& p) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (turn(triangle[i], triangle[(i + 1) % 3], p) <= 0) return false;
  }
  return true;
}

// Those parts that have an area.
std::vector<ExactPolygon> cut(const std::vector<ExactPolygon>& parts, const ExactPoint& a,
                              const ExactPoint& b) {
  std::vector<ExactPolygon> out;
  for (const auto& part : parts) {
    for (auto& half : {clipped(part, a, b), clipped(part, b, a)}) {
      if (area(half) > 0) out.push_back(half);
    }
  }
  return out;
}

}  // namespace

ExactPolygon exact(const Shadow& t) {
  ExactPolygon polygon{exact(t[0]), exact(t[1]), exact(t[2])};
  if (!is_upright(t)) std::swap(polygon[1], polygon[2]);
  return polygon;
}

Fraction area(const ExactPolygon& polygon) {
  Fraction sum = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) sum += turn(polygon[0], polygon[i - 1], polygon[i]);
  return sum;
}

ExactPolygon clipped(const ExactPolygon& polygon, const ExactPoint& a, const ExactPoint& b) {
  ExactPolygon out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto& p = polygon[i];
    const auto& q = polygon[(i + 1) % polygon.size()];
    const Fraction at_p = turn(a, b, p), at_q = turn(a, b, q);
    if (at_p >= 0) out.push_back(p);
    if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) out.push_back(between(p, q, at_p / (at_p - at_q)));
  }
  return out;
}

bool have_common_interior(std::span<const Shadow> triangles) {
  ExactPolygon common = exact(triangles.front());
  for (const auto& triangle : triangles.subspan(1)) {
    const auto corners = exact(triangle);
    for (std::size_t i = 0; i < 3; ++i) common = clipped(common, corners[i], corners[(i + 1) % 3]);
  }
  return area(common) > 0;
}

bool runs_through(const Point& a, const Point& b, std::span<const Shadow> triangles) {
  Fraction from = 0, to = 1;  // open
  for (const auto& triangle : triangles) {
    const auto corners = exact(triangle);
    for (std::size_t i = 0; i < 3; ++i) {
      const Fraction at_a = turn(corners[i], corners[(i + 1) % 3], exact(a));
      const Fraction at_b = turn(corners[i], corners[(i + 1) % 3], exact(b));
      if (at_a <= 0 && at_b <= 0) return false;
      if (at_a < 0) from = std::max<Fraction>(from, at_a / (at_a - at_b));
      if (at_b < 0) to = std::min<Fraction>(to, at_a / (at_a - at_b));
    }
  }
  return a != b && from < to;
}

std::set<int> covers(const Shadow& piece, std::span<const Shadow> sheets) {
  std::vector<ExactPolygon> parts{exact(piece)};
  for (const auto& sheet : sheets) {
    const auto corners = exact(sheet);
    for (std::size_t i = 0; i < 3; ++i) parts = cut(parts, corners[i], corners[(i + 1) % 3]);
  }
  std::set<int> sums;
  for (const auto& part : parts) {
    int sum = 0;
    for (const auto& sheet : sheets) {
      if (is_inside(exact(sheet), centre(part))) sum += is_upright(sheet) ? 1 : -1;
    }
    sums.insert(sum);
  }
  return sums;
}

}  // namespace kinemesh::test
