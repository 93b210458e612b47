// Writes a tangled mesh to try things on and names an inverted face whose region is worth a picture:
//
//   example_make_tangle jitter|umbilic tangled.off
//   kinemesh untangle tangled.off -o out.off --strategy local --seed SEED --report region.json
//   kinemesh draw tangled.off --region region.json -o region.png
#include <cstdio>
#include <random>
#include <stdexcept>
#include <string>

#include "kinemesh/build.h"
#include "kinemesh/local.h"
#include "kinemesh/mesh_io.h"
#include "kinemesh/shapes.h"
#include "untangle/explore/local_exploration.h"
#include "untangle/walk/detect.h"

namespace {

using namespace kinemesh;

// Inner vertices at random within a square of the given half width.
MeshData jittered(int vertices, double step, unsigned seed) {
  Mesh mesh = build_mesh(make_square(vertices, seed));
  std::mt19937 random(seed);
  const auto uniform = [&] { return step * (2.0 * static_cast<double>(random()) / 0xffffffffu - 1.0); };
  for (const Vertex v : mesh.vertices()) {
    if (!mesh.is_constrained(v)) mesh.positions()[v] += Point(uniform(), uniform());
  }
  return mesh.domain();
}

// An inverted face of the component whose region, of no more than so many faces, is the most telling.
Face choose_seed(const Mesh& mesh, std::size_t most) {
  Face best;
  int most_grown = -1;
  std::size_t largest = 0;
  const auto inverted = detect(mesh).inverted;
  const auto components = inverted_components(mesh, inverted);
  std::vector<bool> is_tried(components.count, false);
  for (std::size_t i = 0; i < inverted.size(); ++i) {
    const Face seed = inverted[i];
    if (is_tried[components.of[i]]) continue;
    is_tried[components.of[i]] = true;
    LocalExploration exploration(mesh);
    if (!exploration.run(seed)) continue;
    const std::size_t n = exploration.faces().size();
    if (n > most || std::pair(exploration.grown(), n) <= std::pair(most_grown, largest)) continue;
    best = seed;
    most_grown = exploration.grown();
    largest = n;
  }
  return best;
}

void make(const MeshData& data, std::size_t most, const std::string& file) {
  write_mesh(file, data);
  const Mesh mesh = build_mesh(data);
  const Face seed = choose_seed(mesh, most);
  if (seed == none) throw std::runtime_error("no region of that size");
  std::printf("%d\n", int{mesh.user_face(seed)});
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string kind = argc == 3 ? argv[1] : "";
  if (kind == "jitter") {
    make(jittered(400, 0.04, 3), 60, argv[2]);
  } else if (kind == "umbilic") {
    make(make_umbilic(2, 400), 2000, argv[2]);
  } else {
    throw std::runtime_error("jitter|umbilic OUT.off expected");
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "example_make_tangle: %s\n", error.what());
  return 1;
}
