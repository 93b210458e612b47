// Mass and stiffness matrix of linear (P1) finite elements, row by row, and kept up while faces are replaced.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "kinemesh/mesh_data.h"
#include "kinemesh/step_changes.h"

namespace heat {

using kinemesh::FaceChange;
using kinemesh::MeshData;
using kinemesh::Point;
using kinemesh::Triangle;

// One triangle's share. Entries of the mass matrix are area / 12, on its diagonal area / 6. Both matrices
// stay the same when the triangle is moved rigidly.
struct Element {
  double area = 0.0;
  std::array<std::array<double, 3>, 3> stiffness{};  // integral of grad phi_i . grad phi_j
};
Element element(const std::array<Point, 3>& corners);

class P1Matrices {
 public:
  struct Entry {
    int column;
    double mass, stiffness;
  };

  explicit P1Matrices(const MeshData& mesh);

  // These faces have other corners now; to be followed by measure for them.
  void rewire(std::span<const FaceChange> faces);

  // Computes anew what these faces contribute, and sums anew the rows of their corners, in the order of the
  // faces: as in a mesh that always had them. x: the vertices now.
  void measure(std::span<const int> faces, std::span<const Point> x);

  std::span<const Entry> row(int vertex) const { return rows_[vertex]; }  // by column
  std::span<const Triangle> triangles() const { return triangles_; }
  std::span<const int> faces_at(int vertex) const { return faces_at_[vertex]; }  // ascending
  double area(int face) const { return elements_[face].area; }
  int n_vertices() const { return static_cast<int>(rows_.size()); }
  long rows_summed() const { return rows_summed_; }  // since the start

 private:
  void sum_row(int vertex);

  std::vector<Triangle> triangles_;
  std::vector<Element> elements_;           // per face
  std::vector<std::vector<int>> faces_at_;  // per vertex, ascending
  std::vector<std::vector<Entry>> rows_;    // per vertex
  long rows_summed_ = 0;
};

}  // namespace heat
