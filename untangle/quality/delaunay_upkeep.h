// Keeps a moving mesh the constrained Delaunay triangulation, step after step.
#pragma once

#include <array>

#include "kinemesh/delaunay.h"
#include "untangle/quality/quality_pass.h"

namespace kinemesh {

// Only edges of faces that are new or have a moved corner can have stopped being locally Delaunay. Parallel
// sweeps find those that have, and flips start from them. After the first call, which looks at all edges, the
// cost is that of the changed faces and of the flips, and a comparison per vertex and face. All of the mesh
// is triangulated so, padding included: it is the constrained Delaunay triangulation of all vertices, those
// of the frame with them, and the domain's part of it that of the domain, as constrained edges separate the
// two.
class DelaunayUpkeep : public QualityPass {
 public:
  explicit DelaunayUpkeep(const Mesh& mesh);

  QualityCounts improve(Mesh& mesh, const QualityInputs& inputs) override;
  std::span<const Face> flipped_faces() const override { return flipping_.flipped_faces(); }

 private:
  void find_changed_faces(const Mesh& mesh, std::span<const Point> before,
                          std::span<const RegionRecord> replaced);
  void find_wrong_edges(const Mesh& mesh);
  void bound_angles(const Mesh& mesh, Face face);
  char wrong_sides(const Mesh& mesh, Face face) const;

  DelaunayFlipping flipping_;
  std::vector<char> has_moved_;    // per vertex
  std::vector<char> has_changed_;  // per face: is new or has a moved corner
  std::vector<std::array<float, 3>>
      cotangent_;  // per side of a changed face: bound of that across; else unknown
  std::vector<char>
      is_wrong_;             // per face, bit k: its side k is the lower one of an edge, not locally Delaunay
  std::vector<Side> wrong_;  // these sides, ascending
};

}  // namespace kinemesh
