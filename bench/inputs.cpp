#include "inputs.h"

#include <map>
#include <memory>

#include "kinemesh/build.h"
#include "kinemesh/motion.h"
#include "kinemesh/shapes.h"
#include "motion/fields/noise.h"

namespace kinemesh::bench {

const MeshData& square(int vertices) {
  static std::map<int, MeshData> made;
  const auto [found, is_new] = made.try_emplace(vertices);
  if (is_new) found->second = make_square(vertices);
  return found->second;
}

const Mesh& square_mesh(int vertices) {
  static std::map<int, Mesh> built;
  const auto found = built.find(vertices);
  return found != built.end() ? found->second
                              : built.emplace(vertices, build_mesh(square(vertices))).first->second;
}

std::vector<Point> jittered(int vertices, double amplitude) {
  const Mesh& mesh = square_mesh(vertices);
  const Motion motion(mesh, {{std::make_shared<Jitter>(amplitude, 1), {}}});
  std::vector<Point> moved(mesh.n_vertices());
  motion.advance(mesh.positions(), 0.0, 1.0, 0, moved);
  return moved;
}

}  // namespace kinemesh::bench
