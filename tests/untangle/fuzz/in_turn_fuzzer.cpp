// libFuzzer target: tangles of lattices and of random meshes of any size and proportion, untangled one
// seed after the other in the order the bytes have it. The end is as good as that of global untangling.
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "kinemesh/build.h"
#include "tests/core/mesh/sample_meshes.h"
#include "tests/untangle/fuzz/bytes.h"
#include "tests/untangle/strategies/in_turn.h"

namespace {

using namespace kinemesh;

Mesh lattice(test::Bytes& bytes) {
  const auto domain = test::lattice_cells(bytes);
  Mesh mesh = build_mesh(domain.triangles.empty() ? test::four_triangles() : domain, {.frame = 0.5});
  test::move_on_lattice(mesh, bytes);
  return mesh;
}

// Powers of two, so that all signs are those at the usual size.
Point any_scale(test::Bytes& bytes) {
  const double size = std::ldexp(1.0, 4 * (bytes.below(241) - 120));
  return {size, bytes.below(2) ? std::ldexp(size, -bytes.below(50)) : size};
}

// Inner vertices move by steps that are small, about a face or about the whole square.
Mesh square(test::Bytes& bytes) {
  test::Random random(bytes.below(256));
  const Point scale = bytes.below(2) ? any_scale(bytes) : Point(1.0);
  Mesh mesh = build_mesh(test::mapped(test::random_square(5 + bytes.below(28), random), scale, Point(0.0)));
  const double step = std::ldexp(1.0, -4 - bytes.below(8));
  const bool stays_inside = bytes.below(8) > 0;
  for (Vertex v{0}; v < mesh.n_vertices() && !bytes.empty(); ++v) {
    if (mesh.is_constrained(v)) continue;
    const Point q = mesh.position(v) + step * scale * Point(bytes.below(256) - 128, bytes.below(256) - 128);
    const bool is_inside = 0.0 < q.x && q.x < scale.x && 0.0 < q.y && q.y < scale.y;
    if (is_inside || !stays_inside) mesh.positions()[v] = q;
  }
  return mesh;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  test::Bytes bytes(data, size);
  test::Random order(bytes.below(256));
  const Mesh tangled = bytes.below(3) == 0 ? lattice(bytes) : square(bytes);
  const auto wrong = test::check_in_turn(tangled, order);
  if (!wrong.empty()) {
    std::fprintf(stderr, "%s\n", wrong.c_str());
    std::abort();
  }
  return 0;
}
