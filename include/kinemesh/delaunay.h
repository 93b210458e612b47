// Edge flips to the constrained Delaunay triangulation, in meshes that may be tangled.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "kinemesh/defect.h"
#include "kinemesh/local.h"
#include "kinemesh/mesh.h"

#pragma GCC visibility push(default)
namespace kinemesh {

// Without a defect every edge asked for, and every edge a flip or a repair has touched, is constrained or
// locally Delaunay. With one, all that was done before stays done: connectivity is sound, and no face has
// become inverted or flat that was upright.
struct FlipOutcome {
  int flips = 0;
  int visits = 0;                     // edges looked at, each as often as it was
  int untangled = 0;                  // regions replaced because a flip met an inverted or flat face
  int replaced = 0;                   // faces in them
  std::optional<Defect> defect = {};  // why the last of them could not be

  explicit operator bool() const { return !defect; }
};

// Lawson's algorithm [Lawson 1977], for constrained edges [Lee & Lin 1986]: an edge with a vertex inside the
// circle around the face on its other side is flipped, and the four edges around it are looked at again.
// Where a face beside an edge is inverted or flat, its region is untangled first and flipping goes on from
// the new faces [Agarwal 2008, §1]. Signs are exact, so the result is the constrained Delaunay triangulation,
// up to which diagonals cocircular vertices have, if all edges that were not locally Delaunay were asked for.
// Padding takes part. Vertices do not move, labels and constrained edges stay. Deterministic. Keeps scratch
// memory.
class DelaunayFlipping {
 public:
  // Takes the memory for any number of flips in meshes of this size: run then allocates none unless it meets
  // an inverted or flat face, and so cannot fail in a valid mesh.
  void reserve(const Mesh& mesh);

  // From all edges. Without a defect the mesh is valid in the end.
  [[nodiscard]] FlipOutcome run(Mesh& mesh, const RepairOptions& options = {});

  // From these sides' edges; sides_of the faces that are new or have a moved corner are all that can have
  // changed. Cost: their number, four visits a flip, and the repairs. Tangles that no flip meets stay. Throws
  // InputError for a side that does not exist.
  [[nodiscard]] FlipOutcome run(Mesh& mesh, std::span<const Side> sides, const RepairOptions& options = {});

  // Those that the flips of the last run have rewritten, each once, in no order.
  std::span<const Face> flipped_faces() const { return flipped_faces_; }

 private:
  void reset(const Mesh& mesh);
  void push(Side side);
  Side pop();
  FlipOutcome run_pending(Mesh& mesh, const RepairOptions& options);
  void visit(Mesh& mesh, Side side, const RepairOptions& options, FlipOutcome& outcome);
  void untangle(Mesh& mesh, Face face, const RepairOptions& options, FlipOutcome& outcome);
  void flip(Mesh& mesh, Side edge);
  void note_flipped(Face face);

  std::vector<Side> pending_;     // sides, a stack: what was touched last is still in the cache
  std::vector<char> is_pending_;  // per side
  std::vector<Face> flipped_faces_;
  std::vector<char> is_flipped_;  // per face
  LocalUntangling untangler_;
};

// Each edge of these faces once, by the side in the lower of its faces; ascending.
std::vector<Side> sides_of(const Mesh& mesh, std::span<const Face> faces);

}  // namespace kinemesh
#pragma GCC visibility pop
