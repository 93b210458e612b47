#include "kinemesh/detail/polyline.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "kinemesh/error.h"

namespace kinemesh {

Polyline::Polyline(std::vector<Point> points) : points_(std::move(points)) {
  if (points_.size() < 2) throw InputError("a line: two points expected, at least");
  start_.push_back(0.0);
  for (std::size_t i = 1; i < points_.size(); ++i) {
    const double length = glm::distance(points_[i - 1], points_[i]);
    if (!(length > 0.0 && std::isfinite(length))) throw InputError("a line: segments of a length expected");
    start_.push_back(start_.back() + length);
  }
}

double Polyline::parameter_near(const Point& x) const {
  double best = 0.0, nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < n_segments(); ++i) {
    const double length = start_[i + 1] - start_[i];
    const Point along = (points_[i + 1] - points_[i]) / length;
    const bool goes_on_before = !is_closed() && i == 0,
               goes_on_behind = !is_closed() && i + 1 == n_segments();
    double s = glm::dot(along, x - points_[i]);
    if (!goes_on_before) s = std::max(s, 0.0);
    if (!goes_on_behind) s = std::min(s, length);
    const double distance = glm::distance(x, points_[i] + s * along);
    if (distance < nearest) {
      nearest = distance;
      best = start_[i] + s;
    }
  }
  return best;
}

std::size_t Polyline::segment_at(double parameter) const {
  const auto behind = std::upper_bound(start_.begin(), start_.end(), parameter);
  const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(behind - start_.begin(), 1)) - 1;
  return std::min(i, n_segments() - 1);
}

Point Polyline::at(double parameter) const {
  if (is_closed()) {
    parameter = std::fmod(parameter, length());
    if (parameter < 0.0) parameter += length();
  }
  const std::size_t i = segment_at(parameter);
  const double share = (parameter - start_[i]) / (start_[i + 1] - start_[i]);
  return points_[i] + share * (points_[i + 1] - points_[i]);
}

Point Polyline::tangent_near(const Point& x) const {
  const std::size_t i = segment_at(parameter_near(x));
  return (points_[i + 1] - points_[i]) / (start_[i + 1] - start_[i]);
}

double Polyline::way(double from, double to) const {
  return is_closed() ? std::remainder(to - from, length()) : to - from;
}

}  // namespace kinemesh
