// Heat in a stirred disc, by finite volumes on an OpenMesh mesh whose properties hold what the solver knows.
// docs/embedding.md shows it in pieces.
//
// The mesh moves with the medium, so that the heat of a face stays in it, and what flows between faces is
// conduction alone. The stirring folds hot into cold: heat that would take long to cross the disc has a short
// way left.
#include "kinemesh/openmesh.h"

#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>
#include <OpenMesh/Core/Utils/PropertyManager.hh>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <vector>

#include "kinemesh/build.h"
#include "kinemesh/cell_transfer.h"
#include "kinemesh/shapes.h"
#include "kinemesh/stepper.h"

namespace {

using OpenMesh::TriMesh;

// Of the stream function (1 - r^2)^2 d, where d is x and y in turn: none on the border.
kinemesh::Point velocity(const kinemesh::Point& x, double t) {
  const kinemesh::Point along = std::fmod(t, 2.0) < 1.0 ? kinemesh::Point(1, 0) : kinemesh::Point(0, 1);
  const double s = 1.0 - kinemesh::dot(x, x);
  const kinemesh::Point gradient = s * s * along - 4.0 * s * kinemesh::dot(x, along) * x;
  return 2.0 * kinemesh::Point(gradient.y, -gradient.x);
}

// Stands for yours.
class Solver {
 public:
  explicit Solver(TriMesh& mesh) : mesh_(mesh), heat_(mesh, "heat") {
    for (const auto face : mesh.faces())
      heat_[face] = mesh.calc_face_centroid(face)[0] < 0.0 ? mesh.calc_face_area(face) : 0.0;
  }

  // One amount per face.
  std::vector<double>& heat() { return mesh_.property(heat_.getRawProperty()).data_vector(); }
  double total() { return std::accumulate(heat().begin(), heat().end(), 0.0); }

  // Of the temperature: its mean square distance from what it is in the end.
  double variance() {
    double area = 0.0, square = 0.0;
    for (const auto face : mesh_.faces()) area += mesh_.calc_face_area(face);
    for (const auto face : mesh_.faces())
      square += std::pow(temperature(face) - total() / area, 2) * mesh_.calc_face_area(face);
    return square / area;
  }

  // Where the medium takes the vertices, by the midpoint rule.
  std::vector<kinemesh::Point> stirred(double t, double dt) const {
    std::vector<kinemesh::Point> next;
    for (const auto vertex : mesh_.vertices()) {
      const kinemesh::Point x(mesh_.point(vertex)[0], mesh_.point(vertex)[1]);
      const auto way = dt * velocity(x + 0.5 * dt * velocity(x, t), t + 0.5 * dt);
      next.push_back(vertex.is_boundary() ? x : x + way);
    }
    return next;
  }

  // Takes the edges in turn: the temperatures of the two faces come closer as they would if these were alone.
  // Keeps the heat and makes no new extremes, however thin the faces.
  void conduct(double dt) {
    for (const auto edge : mesh_.edges()) {
      if (edge.is_boundary()) continue;
      const auto a = edge.h0().face(), b = edge.h1().face();
      const double way = (mesh_.calc_face_centroid(a) - mesh_.calc_face_centroid(b)).norm();
      const double conductance = conductivity * mesh_.calc_edge_length(edge) / way;
      const double both = 1.0 / mesh_.calc_face_area(a) + 1.0 / mesh_.calc_face_area(b);
      const double flow = (temperature(a) - temperature(b)) / both * -std::expm1(-both * conductance * dt);
      heat_[a] -= flow;
      heat_[b] += flow;
    }
  }

 private:
  double temperature(OpenMesh::FaceHandle face) const { return heat_[face] / mesh_.calc_face_area(face); }

  static constexpr double conductivity = 1e-3;
  TriMesh& mesh_;
  OpenMesh::FProp<double> heat_;
};

}  // namespace

int main() {
  TriMesh mesh = kinemesh::to_openmesh<TriMesh>(kinemesh::build_mesh(kinemesh::make_disk(2000)));
  TriMesh still_mesh = mesh;
  Solver solver(mesh), still(still_mesh);
  const double heat = solver.total();
  int rewritten = 0;

  kinemesh::Stepper stepper(kinemesh::build_mesh(mesh), {.quality = "delaunay"});
  stepper.observe([&](const kinemesh::StepChanges& changes) {
    const auto update = kinemesh::remap_amounts(changes, solver.heat());
    kinemesh::apply(changes, mesh);  // all of it or, where it throws, nothing
    update.apply(solver.heat());
    for (const auto& patch : changes.patches) rewritten += static_cast<int>(patch.faces.size());
  });

  const double dt = 0.05;
  for (int n = 0; n < 160; ++n) {
    const auto outcome = stepper.step(solver.stirred(stepper.time(), dt), dt);
    if (!outcome) {
      std::puts(outcome.defect->message().c_str());  // and mesh is as it was before the step
      return 1;
    }
    solver.conduct(dt);
    still.conduct(dt);
  }

  const double off = std::abs(solver.total() / heat - 1.0);
  const bool is_same = kinemesh::from_openmesh(mesh).triangles == stepper.mesh().domain().triangles;
  std::printf("%d steps, %d faces rewritten, mesh %s, heat off by %.1e\n", stepper.steps_done(), rewritten,
              is_same ? "followed" : "lost", off);
  std::printf("variance %.4f, and %.4f where nobody stirs\n", solver.variance(), still.variance());
  const bool is_mixed = solver.variance() < 0.5 * still.variance();
  return is_same && off < 1e-12 && is_mixed && *std::ranges::min_element(solver.heat()) >= 0.0 ? 0 : 1;
}
