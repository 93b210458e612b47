// Smooths a badly tangled mesh with the methods that know how to untangle on their way.
//
//   example_smooth_tangled OUT_DIRECTORY
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>

#include "kinemesh/build.h"
#include "kinemesh/delaunay.h"
#include "kinemesh/measure.h"
#include "kinemesh/shapes.h"
#include "kinemesh/smoothing.h"
#include "kinemesh/svg.h"
#include "kinemesh/validate.h"
#include "motion/fields/noise.h"

namespace {

using namespace kinemesh;

// Every vertex inside is kicked by up to three times the distance of neighbours, unless that takes it out of
// the domain.
Mesh tangled_annulus() {
  Mesh mesh = build_mesh(make_annulus(600));
  const Jitter jitter(3.0, 1);
  const double spacing = mean_spacing(mesh);
  for (const Vertex v : mesh.vertices()) {
    if (mesh.is_constrained(v)) continue;
    const Point there = mesh.position(v) + jitter.kick(mesh.user_vertex(v), 1, 1.0, spacing);
    const double radius = std::hypot(there.x, there.y);
    if (0.52 < radius && radius < 0.98) mesh.positions()[v] = there;
  }
  return mesh;
}

// Smoothing does not change who is whose neighbour, flipping moves no vertex: in turn, they go further than
// either.
void improve(Mesh& mesh, SmoothingMethod method) {
  DelaunayFlipping flipping;
  for (int round = 1; round <= 4; ++round) {
    const SmoothingOutcome smoothed = smooth(mesh, {.method = method});
    const FlipOutcome flipped = flipping.run(mesh);
    if (!smoothed || !flipped)
      throw std::runtime_error((smoothed ? flipped.defect : smoothed.defect)->message());
    std::printf(
        "  %3d regions untangled, %4d vertices moved, %4d edges flipped: smallest angle %.3g degrees\n",
        smoothed.untangled + flipped.untangled, smoothed.moved, flipped.flips, measure(mesh).min_angle_deg);
  }
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) throw std::runtime_error("OUT_DIRECTORY expected");
  const std::filesystem::path directory = argv[1];
  const Mesh tangled = tangled_annulus();
  write_svg(directory / "tangled.svg", tangled.domain());
  std::printf("tangled: smallest angle %.3g degrees\n", measure(tangled).min_angle_deg);
  for (const auto& [name, method] : {std::pair("laplacian", SmoothingMethod::Laplacian),
                                     std::pair("optimization", SmoothingMethod::Optimization)}) {
    Mesh mesh = tangled;
    std::printf("%s and flipping:\n", name);
    improve(mesh, method);
    if (const auto defect = validate(mesh)) throw std::runtime_error(defect->message());
    write_svg(directory / (std::string(name) + ".svg"), mesh.domain());
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "example_smooth_tangled: %s\n", error.what());
  return 1;
}
