#include "untangle/fill/overlapping_mesher.h"

#include "untangle/fill/part_gluing.h"
#include "untangle/fill/plane_parts.h"
#include "untangle/fill/shadow_border.h"

namespace kinemesh {

std::optional<NewFaces> mesh_overlapping(const Mesh& mesh, const FaceSets& sets, int set,
                                         std::span<const Cell> cells) {
  const RemeshableSet faces(mesh, sets, set, cells);
  const auto border = trace_shadow_border(faces);
  if (!border) return std::nullopt;
  const auto parts = triangulate_parts(faces, *border);
  if (!parts) return std::nullopt;
  return glue_parts(faces, *border, *parts);
}

}  // namespace kinemesh
