#include "core/triangulator.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/hilbert_sort.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "core/cgal_triangulation.h"
#include "core/stopwatch.h"

namespace kinemesh {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

// Lets CGAL's sorts permute numbers of our points.
struct PointOf {
  using key_type = int;
  using value_type = Kernel::Point_2;
  using reference = value_type;
  using category = boost::readable_property_map_tag;
  const Point* points;

  friend value_type get(const PointOf& map, int i) { return {map.points[i].x, map.points[i].y}; }
};
using SortTraits = CGAL::Spatial_sort_traits_adapter_2<Kernel, PointOf>;

// Moves with its coordinates, which the sort then has at hand.
struct NumberedPoint {
  Kernel::Point_2 point;
  int number;
};
struct PointIn {
  using key_type = NumberedPoint;
  using value_type = Kernel::Point_2;
  using reference = const value_type&;
  using category = boost::readable_property_map_tag;

  friend reference get(const PointIn&, const NumberedPoint& p) { return p.point; }
};
using NumberedSortTraits = CGAL::Spatial_sort_traits_adapter_2<Kernel, PointIn>;

std::vector<int> numbers_to(std::size_t n) {
  std::vector<int> numbers(n);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

// Sorting many points so that each lies near the one before pays; a handful is inserted as it comes.
constexpr std::size_t few_points = 64;

}  // namespace

void Triangulation::clear() {
  triangles.clear();
  neighbours.clear();
  edges.clear();
}

struct Triangulator::Impl {
  CgalTriangulation<Kernel> triangulation;
};

Triangulator::Triangulator() : impl_(std::make_unique<Impl>()) {}
Triangulator::~Triangulator() = default;
Triangulator::Triangulator(Triangulator&&) noexcept = default;
Triangulator& Triangulator::operator=(Triangulator&&) noexcept = default;

std::optional<Contact> Triangulator::triangulate(std::span<const Point> points, std::span<const Edge> edges,
                                                 Triangulation& out) {
  const Stopwatch stopwatch;
  auto order = numbers_to(points.size());
  if (points.size() > few_points) {
    CGAL::spatial_sort(order.begin(), order.end(), SortTraits(PointOf{points.data()}));
  }
  auto& cgal = impl_->triangulation;
  const auto point_at = [&](int i) { return Kernel::Point_2(points[i].x, points[i].y); };
  const bool inserted = cgal.insert_points(order, point_at) && cgal.insert_edges(edges);
  milliseconds_ += stopwatch.milliseconds();
  if (inserted && cgal.extract(out)) return std::nullopt;
  if (auto contact = find_contact(points, edges)) return contact;
  throw std::logic_error("a triangulation failed although nothing touches");
}

std::vector<int> hilbert_order(std::span<const Point> points) {
  std::vector<NumberedPoint> numbered(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    numbered[i] = {{points[i].x, points[i].y}, static_cast<int>(i)};
  CGAL::hilbert_sort<CGAL::Parallel_tag>(numbered.begin(), numbered.end(), NumberedSortTraits());
  std::vector<int> order(points.size());
  std::transform(numbered.begin(), numbered.end(), order.begin(), [](const auto& p) { return p.number; });
  return order;
}

}  // namespace kinemesh
