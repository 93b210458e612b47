#include "core/cdt/triangulator.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/hilbert_sort.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "core/base/parallel.h"
#include "core/base/stopwatch.h"
#include "core/cdt/cgal_triangulation.h"

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

// What CGAL::hilbert_sort does, its four quarters at the same time. CGAL could do that too, but hands its
// tasks over where the thread sanitizer does not see it.
void sort_along_curve(std::vector<NumberedPoint>& points) {
  using Sort = CGAL::Hilbert_sort_median_2<NumberedSortTraits, CGAL::Sequential_tag>;
  boost::rand48 random;
  boost::random_number_generator<boost::rand48, std::ptrdiff_t> number(random);
  CGAL::cpp98::random_shuffle(points.begin(), points.end(), number);
  const auto begin = points.begin(), end = points.end(), middle = begin + (end - begin) / 2;
  const auto low = begin + (middle - begin) / 2, high = middle + (end - middle) / 2;
  const Sort sort{NumberedSortTraits()};
  std::nth_element(begin, middle, end,
                   [](const auto& p, const auto& q) { return p.point.x() < q.point.x(); });
  const auto left = [&] {
    std::nth_element(begin, low, middle,
                     [](const auto& p, const auto& q) { return p.point.y() < q.point.y(); });
    parallel_pair([&] { sort.recursive_sort<1, false, false>(begin, low); },
                  [&] { sort.recursive_sort<0, false, false>(low, middle); });
  };
  const auto right = [&] {
    std::nth_element(middle, high, end,
                     [](const auto& p, const auto& q) { return q.point.y() < p.point.y(); });
    parallel_pair([&] { sort.recursive_sort<0, false, false>(middle, high); },
                  [&] { sort.recursive_sort<1, true, true>(high, end); });
  };
  parallel_pair(left, right);
}

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
  if (points.size() < 2) return numbers_to(points.size());
  std::vector<NumberedPoint> numbered(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    numbered[i] = {{points[i].x, points[i].y}, static_cast<int>(i)};
  sort_along_curve(numbered);
  std::vector<int> order(points.size());
  std::transform(numbered.begin(), numbered.end(), order.begin(), [](const auto& p) { return p.number; });
  return order;
}

}  // namespace kinemesh
