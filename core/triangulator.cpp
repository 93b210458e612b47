#include "core/triangulator.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/hilbert_sort.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <stdexcept>

#include "core/stopwatch.h"

namespace kinemesh {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using FaceBase =
    CGAL::Constrained_triangulation_face_base_2<Kernel,
                                                CGAL::Triangulation_face_base_with_info_2<int, Kernel>>;
using Storage = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Cdt = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Storage, CGAL::No_constraint_intersection_tag>;

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

std::vector<int> numbers_to(std::size_t n) {
  std::vector<int> numbers(n);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

// Undirected edge as one sortable number.
std::uint64_t key_of(int a, int b) {
  const auto [low, high] = std::minmax(a, b);
  return (static_cast<std::uint64_t>(low) << 32) | static_cast<std::uint32_t>(high);
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
  Cdt cdt;
  std::vector<Cdt::Vertex_handle> vertices;                // by point
  std::vector<std::pair<std::uint64_t, int>> edge_number;  // sorted: ends, first edge with them

  bool insert_points(std::span<const Point> points);
  bool insert_edges(std::span<const Edge> edges);
  void extract(Triangulation& out);
  int number_of_edge(int a, int b) const;
  bool has_all_edges(const Triangulation& triangulation) const;
};

bool Triangulator::Impl::insert_points(std::span<const Point> points) {
  auto order = numbers_to(points.size());
  if (points.size() > few_points) {
    CGAL::spatial_sort(order.begin(), order.end(), SortTraits(PointOf{points.data()}));
  }
  vertices.resize(points.size());
  Cdt::Face_handle near;
  for (const int i : order) {
    const auto before = cdt.number_of_vertices();
    const auto vertex = cdt.insert({points[i].x, points[i].y}, near);
    if (cdt.number_of_vertices() == before) return false;  // a point is already there
    vertex->info() = i;
    vertices[i] = vertex;
    near = vertex->face();
  }
  return true;
}

bool Triangulator::Impl::insert_edges(std::span<const Edge> edges) {
  edge_number.clear();
  try {
    for (int i = 0; i < static_cast<int>(edges.size()); ++i) {
      const auto [a, b] = edges[i];
      cdt.insert_constraint(vertices[a], vertices[b]);
      edge_number.emplace_back(key_of(a, b), i);
    }
  } catch (const Cdt::Intersection_of_constraints_exception&) {
    return false;
  }
  std::sort(edge_number.begin(), edge_number.end());
  const auto same_ends = [](const auto& e, const auto& f) { return e.first == f.first; };
  edge_number.erase(std::unique(edge_number.begin(), edge_number.end(), same_ends), edge_number.end());
  return true;
}

int Triangulator::Impl::number_of_edge(int a, int b) const {
  const auto key = key_of(a, b);
  const auto found = std::lower_bound(edge_number.begin(), edge_number.end(), std::pair(key, 0));
  return found != edge_number.end() && found->first == key ? found->second : none;
}

void Triangulator::Impl::extract(Triangulation& out) {
  out.clear();
  for (auto face : cdt.all_face_handles()) face->info() = none;
  int n = 0;
  for (auto face : cdt.finite_face_handles()) face->info() = n++;
  out.triangles.reserve(n);
  out.neighbours.reserve(n);
  out.edges.reserve(n);
  for (auto face : cdt.finite_face_handles()) {
    Triangle corners, neighbours, edges;
    for (int k = 0; k < 3; ++k) corners[k] = face->vertex(k)->info();
    for (int k = 0; k < 3; ++k) {
      const int across = Cdt::cw(k);  // CGAL names a side by the corner opposite
      neighbours[k] = face->neighbor(across)->info();
      edges[k] = face->is_constrained(across) ? number_of_edge(corners[k], corners[Cdt::ccw(k)]) : none;
    }
    out.triangles.push_back(corners);
    out.neighbours.push_back(neighbours);
    out.edges.push_back(edges);
  }
}

// An edge through a third point is there only in pieces, and these have no number.
bool Triangulator::Impl::has_all_edges(const Triangulation& triangulation) const {
  std::vector<int> found;
  for (const auto& edges : triangulation.edges) {
    std::copy_if(edges.begin(), edges.end(), std::back_inserter(found), [](int e) { return e != none; });
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found.size() == edge_number.size();
}

Triangulator::Triangulator() : impl_(std::make_unique<Impl>()) {}
Triangulator::~Triangulator() = default;
Triangulator::Triangulator(Triangulator&&) noexcept = default;
Triangulator& Triangulator::operator=(Triangulator&&) noexcept = default;

std::optional<Contact> Triangulator::triangulate(std::span<const Point> points, std::span<const Edge> edges,
                                                 Triangulation& out) {
  impl_->cdt.clear();
  const Stopwatch stopwatch;
  const bool inserted = impl_->insert_points(points) && impl_->insert_edges(edges);
  milliseconds_ += stopwatch.milliseconds();
  if (inserted) {
    impl_->extract(out);
    if (impl_->has_all_edges(out) || impl_->cdt.dimension() < 2) return std::nullopt;
  }
  if (auto contact = find_contact(points, edges)) return contact;
  throw std::logic_error("a triangulation failed although nothing touches");
}

std::vector<int> hilbert_order(std::span<const Point> points) {
  auto order = numbers_to(points.size());
  CGAL::hilbert_sort(order.begin(), order.end(), SortTraits(PointOf{points.data()}));
  return order;
}

}  // namespace kinemesh
