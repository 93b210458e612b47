#include "untangle/places/optimal_point.h"

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cmath>
#include <limits>

#include "kinemesh/measure.h"

namespace kinemesh {
namespace {

constexpr int max_steps = 30;
constexpr int max_halvings = 12;
constexpr double nearly_smallest = 1e-3;  // radians above the smallest that count as equal to it
constexpr double least_share = 0.1;       // of the gain a step promises that it has to bring
constexpr double least_gain = 1e-5;       // radians a step must bring for another to be tried

// One angle of one triangle, as a function of the place of the vertex.
struct Angle {
  double value;    // radians
  Point gradient;  // radians per length
};

// Those of up to twelve faces take no memory of their own.
using Angles = boost::container::small_vector<Angle, 36>;
using Gradients = boost::container::small_vector<Point, 36>;

// Of the direction of d, with respect to d.
Point gradient_of_direction(const Point& d) {
  return Point(-d.y, d.x) / dot(d, d);
}

void append_angles(const LinkEdge& edge, const Point& x, Angles& angles) {
  const auto& [p, q] = edge;
  const Point side = q - p, to_p = x - p, to_q = x - q;
  const Point at_p = gradient_of_direction(to_p), at_q = -gradient_of_direction(to_q);
  angles.push_back({std::atan2(cross(side, to_p), dot(side, to_p)), at_p});
  angles.push_back({std::atan2(cross(to_q, -side), dot(to_q, -side)), at_q});
  angles.push_back({std::atan2(cross(to_p, to_q), dot(to_p, to_q)), -(at_p + at_q)});
}

Point nearest_to_origin(const Point& a, const Point& b) {
  const Point d = b - a;
  const double squared = dot(d, d);
  const double t = squared > 0.0 ? std::clamp(-dot(a, d) / squared, 0.0, 1.0) : 0.0;
  return a + t * d;
}

// The shortest vector in the convex hull of the gradients, unless the origin lies inside it: then some point
// of its border, which at least one gradient opposes.
Point shortest_in_hull(const Gradients& gradients) {
  Point best = gradients.front();
  for (std::size_t i = 0; i < gradients.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Point p = nearest_to_origin(gradients[i], gradients[j]);
      if (dot(p, p) < dot(best, best)) best = p;
    }
  }
  return best;
}

class Ascent {
 public:
  Ascent(std::span<const LinkEdge> link, const Point& start)
      : link_(link), x_(start), smallest_(smallest_angle(link, start)) {}

  Point run() {
    for (int step = 0; step < max_steps; ++step) {
      const double before = smallest_;
      if (!advance() || smallest_ < before + least_gain) break;
    }
    return x_;
  }

 private:
  // False at a maximum, as far as this can tell.
  bool advance() {
    list_angles();
    if (active_.empty()) return false;  // overflow
    const Point direction = shortest_in_hull(active_);
    double slope = std::numeric_limits<double>::infinity();
    for (const Point& gradient : active_) slope = std::min(slope, dot(gradient, direction));
    return slope > 0.0 && search(direction, slope);
  }

  void list_angles() {
    angles_.clear();
    active_.clear();
    for (const auto& edge : link_) append_angles(edge, x_, angles_);
    for (const auto& angle : angles_) {
      if (angle.value <= smallest_ + nearly_smallest) active_.push_back(angle.gradient);
    }
  }

  bool search(const Point& direction, double slope) {
    double step = first_step(direction, slope);
    for (int halving = 0; halving <= max_halvings; ++halving, step /= 2) {
      const Point there = x_ + step * direction;
      const double angle = smallest_angle(link_, there);
      if (!(angle > smallest_ + least_share * step * slope)) continue;
      x_ = there;
      smallest_ = angle;
      return true;
    }
    return false;
  }

  // To where another angle overtakes the smallest; no angle can be asked to grow beyond that of an
  // equilateral triangle.
  double first_step(const Point& direction, double slope) const {
    constexpr double equilateral = 1.0471975511965976;
    double step = (equilateral - smallest_) / slope;
    for (const auto& angle : angles_) {
      const double loss = slope - dot(angle.gradient, direction);
      if (loss > 0.0 && angle.value > smallest_ + nearly_smallest)
        step = std::min(step, (angle.value - smallest_) / loss);
    }
    return step;
  }

  std::span<const LinkEdge> link_;
  Point x_;
  double smallest_;
  Angles angles_;
  Gradients active_;  // gradients of the angles that are, nearly, the smallest
};

}  // namespace

double smallest_angle(std::span<const LinkEdge> link, const Point& x) {
  double tangent = std::numeric_limits<double>::infinity();
  for (const auto& [p, q] : link) tangent = std::min(tangent, tangent_of_smallest_angle({x, p, q}));
  return std::atan(tangent);
}

Point optimal_point(std::span<const LinkEdge> link, const Point& start) {
  return Ascent(link, start).run();
}

}  // namespace kinemesh
