// CGAL's constrained Delaunay triangulation as plain arrays, over any of its kernels. For .cpp files only:
// expensive.
#pragma once

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/cdt/triangulator.h"

namespace kinemesh {

// One triangulation at a time: insert points, insert edges, extract.
template <class Kernel>
class CgalTriangulation {
 public:
  // In the given order, each point near the one before if that pays. False if two are at the same place.
  template <class PointAt>
  bool insert_points(std::span<const int> order, const PointAt& point_at) {
    cdt_.clear();
    vertices_.resize(order.size());
    typename Cdt::Face_handle near;
    for (const int i : order) {
      const auto before = cdt_.number_of_vertices();
      const auto vertex = cdt_.insert(point_at(i), near);
      if (cdt_.number_of_vertices() == before) return false;
      vertex->info() = i;
      vertices_[i] = vertex;
      near = vertex->face();
    }
    return true;
  }

  // False if two of them cross.
  bool insert_edges(std::span<const Edge> edges) {
    number_edges(edges);
    try {
      for (int i = 0; i < static_cast<int>(edges.size()); ++i) {
        const auto [a, b] = edges[i];
        if (number_of_edge(a, b) != i) continue;  // CGAL takes an edge's repetition for a crossing
        cdt_.insert_constraint(vertices_[a], vertices_[b]);
      }
    } catch (const typename Cdt::Intersection_of_constraints_exception&) {
      return false;
    }
    return true;
  }

  // False if an edge is not there in one piece, because it runs through a third point.
  bool extract(Triangulation& out) {
    out.clear();
    for (auto face : cdt_.all_face_handles()) face->info() = none;
    int n = 0;
    for (auto face : cdt_.finite_face_handles()) face->info() = n++;
    out.triangles.reserve(n);
    out.neighbours.reserve(n);
    out.edges.reserve(n);
    for (auto face : cdt_.finite_face_handles()) {
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
    return cdt_.dimension() < 2 || has_all_edges(out);
  }

 private:
  using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
  using FaceBase =
      CGAL::Constrained_triangulation_face_base_2<Kernel,
                                                  CGAL::Triangulation_face_base_with_info_2<int, Kernel>>;
  using Storage = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
  using Cdt =
      CGAL::Constrained_Delaunay_triangulation_2<Kernel, Storage, CGAL::No_constraint_intersection_tag>;

  // Undirected edge as one sortable number.
  static std::uint64_t key_of(int a, int b) {
    const auto [low, high] = std::minmax(a, b);
    return (static_cast<std::uint64_t>(low) << 32) | static_cast<std::uint32_t>(high);
  }

  void number_edges(std::span<const Edge> edges) {
    edge_number_.clear();
    for (int i = 0; i < static_cast<int>(edges.size()); ++i) {
      edge_number_.emplace_back(key_of(edges[i][0], edges[i][1]), i);
    }
    std::sort(edge_number_.begin(), edge_number_.end());
    const auto same_ends = [](const auto& e, const auto& f) { return e.first == f.first; };
    edge_number_.erase(std::unique(edge_number_.begin(), edge_number_.end(), same_ends), edge_number_.end());
  }

  int number_of_edge(int a, int b) const {
    const auto key = key_of(a, b);
    const auto found = std::lower_bound(edge_number_.begin(), edge_number_.end(), std::pair(key, 0));
    return found != edge_number_.end() && found->first == key ? found->second : none;
  }

  bool has_all_edges(const Triangulation& triangulation) const {
    std::vector<int> found;
    for (const auto& edges : triangulation.edges) {
      std::copy_if(edges.begin(), edges.end(), std::back_inserter(found), [](int e) { return e != none; });
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found.size() == edge_number_.size();
  }

  Cdt cdt_;
  std::vector<typename Cdt::Vertex_handle> vertices_;       // by point
  std::vector<std::pair<std::uint64_t, int>> edge_number_;  // sorted: ends, first edge with them
};

}  // namespace kinemesh
