// The faces that are to take a region's place, between their triangulation and the splice.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/mesh/patch.h"
#include "kinemesh/defect.h"
#include "untangle/fill/hole.h"

namespace kinemesh {

// Side k of a triangle runs from corner k to corner k + 1.
struct NewFaces {
  std::vector<MeshTriangle> triangles;  // counter-clockwise
  std::vector<Triangle>
      neighbours;  // across side k: number of another triangle, or ~s where side k lies where side
                   // s of one of the region's faces lies on the region's border
  std::vector<Triangle> constraints;  // of side k: number of one, or none; of no meaning on the border
  std::vector<int> labels;            // per triangle; set by finish

  int size() const { return static_cast<int>(triangles.size()); }
  void clear();
  void add(const MeshTriangle& corners, const Triangle& neighbours_of, const Triangle& constraints_of);
};

// As many faces as were taken out, and as many sides along the border.
bool fit(const NewFaces& faces, const Hole& hole);

// What lines the vertices and edges of a defect are of, in words: borders, interfaces, markers. Cost: O(m)
// each for m constrained edges.
std::string lines_of(const Mesh& mesh, const Defect& defect);

// Makes the patch. Keeps scratch memory for the next.
class Finisher {
 public:
  Finisher();
  ~Finisher();
  Finisher(Finisher&&) noexcept;
  Finisher& operator=(Finisher&&) noexcept;

  // Decides what the triangulation leaves open. Labels spread from the faces inside the region's border over
  // the new ones and change at constraints only; where two of them meet the defect names the edges they came
  // from. A vertex on no constrained edge that came to lie in another label than its home has escaped, a
  // defect unless it is allowed. A new face takes the place of one with its label, so that the user's numbers
  // stay where they are; only when vertices have escaped do slots change their label. The patch does not
  // depend on the order of the new faces. Checks the certificate: as many faces as were in the set, as many
  // edges, each constrained edge again, each face upright. Throws std::logic_error otherwise, which is a bug
  // of ours. Without a defect `patch` is overwritten.
  [[nodiscard]] std::optional<Defect> run(const Mesh& mesh, const Hole& hole, NewFaces& faces,
                                          bool allow_escaped, Patch& patch);

 private:
  struct Scratch;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace kinemesh
