// libFuzzer target: a small lattice mesh with missing cells and labels, any vertex moved by halves of cells,
// as the bytes have it. Whatever they say, a repair either leaves a valid mesh or names a true reason and
// changes nothing; following the vertices on their way comes to the same.
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "kinemesh/build.h"
#include "kinemesh/validate.h"
#include "tests/untangle/fuzz/bytes.h"
#include "tests/untangle/in_motion.h"
#include "tests/untangle/properties.h"
#include "tests/untangle/random_tangles.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace kinemesh;
  test::Bytes bytes(data, size);
  const auto domain = test::lattice_cells(bytes);
  if (domain.triangles.empty()) return 0;
  Mesh mesh = build_mesh(domain, {.frame = 0.5});
  test::snap_frame(mesh);
  while (!bytes.empty()) {
    const std::vector<Point> before(mesh.positions().begin(), mesh.positions().end());
    test::move_on_lattice(mesh, bytes);
    test::MotionTotals totals;
    auto wrong = test::check_in_motion(mesh, before, totals);
    if (wrong.empty()) wrong = test::check_step(mesh, false);
    if (!wrong.empty()) {
      std::fprintf(stderr, "%s\n", wrong.c_str());
      std::abort();
    }
    if (validate(mesh)) return 0;  // no valid mesh exists
  }
  return 0;
}
