// Several vertices at once, the faces around them as functions of their places, and the places that are best
// for the angles.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "kinemesh/mesh.h"

namespace kinemesh {

// A vertex that may move: in the plane, or along a unit vector if `along` is not 0.
struct FreeVertex {
  Vertex vertex;
  Point along{0.0, 0.0};
};

// Where one vertex after the other has reached its best place (untangle/places/star.h), all of a patch
// together can often do better yet: the smallest angle is a ridge in the space of their places, on which no
// single vertex gets on.
class JointStar {
 public:
  // As if the edge were flipped, if there is one. Pre: a valid mesh, and a valid one if it were; vertices are
  // ascending by users' numbers, none comes twice.
  JointStar(const Mesh& mesh, std::span<const FreeVertex> vertices, Side flipped_edge = none);

  // Around the vertices and beside the edge, padding included.
  std::span<const Face> faces() const { return faces_; }

  // The tangent of the smallest angle of the domain's faces, with the vertices at these places; infinity if
  // there are none. Rounded.
  double tangent_at(std::span<const Point> places) const;

  // The same in the mesh as it is.
  double tangent() const { return tangent_; }

  // Padding, too. Exact.
  bool is_upright_at(std::span<const Point> places) const;

  // One for each vertex. Minimises the sum of the cotangents' 64th powers, which the largest of them, that
  // of the smallest angle, rules, by the limited-memory method of Broyden, Fletcher, Goldfarb and Shanno
  // [Nocedal 1980]; of the places on its way those where tangent_at is largest. The same bits however the
  // mesh is stored.
  std::vector<Point> best_places() const;

 private:
  struct Corner {
    int free;     // number of a free vertex, or none
    Point place;  // where it is if it is not free
  };
  using Triangle = std::array<Corner, 3>;

  struct State {
    std::vector<Point> places, gradient;
    double energy = 0.0;
  };

  void list_faces(const Mesh& mesh, std::span<const FreeVertex> vertices, Side flipped_edge);
  void list_triangles(const Mesh& mesh, std::span<const FreeVertex> vertices, Side flipped_edge);
  void measure_scale();
  std::array<Point, 3> corners_at(const Triangle& triangle, std::span<const Point> places) const;
  double energy_at(std::span<const Point> places, std::span<Point> gradient) const;
  bool descend(const State& from, std::span<const Point> shift, State& to) const;
  void put_on_lines(std::span<Point> places) const;

  std::vector<Point> start_, along_;
  std::vector<double> scale_;  // per vertex: the mean square of the lengths of its edges
  std::vector<Face> faces_;
  double tangent_;
  std::vector<Triangle> triangles_;  // of the domain, in an order of the users' numbers
  std::vector<Triangle> padding_;
};

}  // namespace kinemesh
