#include "untangle/strategies/remesh.h"

#include <stdexcept>

#include "core/base/stopwatch.h"
#include "untangle/fill/records.h"
#include "untangle/walk/detect.h"

namespace kinemesh {

RepairOutcome FullRemesh::repair(Mesh& mesh, const Move& move) {
  RepairOutcome outcome;
  auto& record = outcome.record;
  const auto tangles = detect(mesh, move, record);

  const Stopwatch working;
  const double cgal_before = mesher_.triangulator_ms();
  everything_.reset(mesh.n_faces());
  const int all = everything_.open();
  for (const Face face : mesh.faces()) everything_.add(face, all);
  hole_.dig(mesh, everything_, all);
  auto line = describe_region(mesh, hole_);
  record.components = line.components;
  const auto result = mesher_.run(mesh, hole_);
  record.triangulate_ms = mesher_.triangulator_ms() - cgal_before;
  if (result == RegionMesher::Result::NoMesh) {
    outcome.defect = mesher_.defect();
    return outcome;
  }
  // The border of the whole is convex, so only a vertex outside could make it fail, and that is NoMesh.
  if (result == RegionMesher::Result::NotSimple)
    throw std::logic_error("the whole mesh has no simple border");
  Patch patch;
  outcome.defect = finisher_.run(mesh, hole_, mesher_.new_faces(), move.options().allow_escaped, patch);
  if (outcome.defect) return outcome;

  record.replaced = mesh.n_faces();
  record.regions.push_back(std::move(line));
  mesh.splice(patch);
  record.escaped = count_escaped(mesh, move.options());
  record.splice_ms = working.milliseconds() - record.triangulate_ms;
  return outcome;
}

}  // namespace kinemesh
