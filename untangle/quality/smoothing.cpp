#include "kinemesh/smoothing.h"

#include <array>

#include "core/mesh/around.h"
#include "kinemesh/error.h"
#include "kinemesh/local.h"
#include "kinemesh/measure.h"
#include "untangle/quality/vertex_sweeps.h"

namespace kinemesh {
namespace {

class Smoother {
 public:
  Smoother(Mesh& mesh, const SmoothingOptions& options) : mesh_(mesh), options_(options) {}

  SmoothingOutcome run() {
    outcome_.min_angle_before_deg = measure(mesh_).min_angle_deg;
    if (untangle()) sweep();
    outcome_.min_angle_after_deg = measure(mesh_).min_angle_deg;
    return outcome_;
  }

 private:
  bool untangle();
  Face tangled_face_at(Vertex vertex) const;
  bool untangle_from(Face face);
  void sweep();

  Mesh& mesh_;
  const SmoothingOptions& options_;
  SmoothingOutcome outcome_;
  LocalUntangling untangler_;
};

bool Smoother::untangle() {
  for (const Vertex v : mesh_.vertices()) {
    for (Face face = tangled_face_at(v); face != none; face = tangled_face_at(v)) {
      if (!untangle_from(face)) return false;
    }
  }
  return true;
}

Face Smoother::tangled_face_at(Vertex vertex) const {
  Face tangled = none;
  for_each_side_from(mesh_, vertex, [&](Side side) {
    if (!is_upright(mesh_, Mesh::face_of(side))) tangled = Mesh::face_of(side);
  });
  return tangled;
}

bool Smoother::untangle_from(Face face) {
  auto repaired = untangler_.repair_seeds(mesh_, std::array{face}, options_.repair);
  outcome_.untangled += static_cast<int>(repaired.record.regions.size());
  outcome_.replaced += repaired.record.replaced;
  outcome_.defect = std::move(repaired.defect);
  return !outcome_.defect;
}

void Smoother::sweep() {
  const auto counts = VertexSweeps(mesh_).run(mesh_, options_);
  outcome_.sweeps = counts.sweeps;
  outcome_.moves = counts.moves;
  outcome_.moved = counts.moved;
}

}  // namespace

SmoothingOutcome smooth(Mesh& mesh, const SmoothingOptions& options) {
  if (options.max_sweeps < 0) throw InputError("max_sweeps must be 0 or more");
  if (!(options.least_move >= 0.0)) throw InputError("least_move must be 0 or more");
  return Smoother(mesh, options).run();
}

}  // namespace kinemesh
