// The minimum locally removable region around one inverted face, found without reading anything beyond it.
#pragma once

#include <vector>

#include "kinemesh/mesh.h"
#include "untangle/explore/convex_pieces.h"
#include "untangle/explore/sheets.h"
#include "untangle/fill/remeshable_set.h"

namespace kinemesh {

// The shadow X of the inverted components J is kept as convex pieces: the shadow of each inverted face of J
// and, after growing, overlaps of the shadows of two upright ones. The exploration walks over pairs (T, D) of
// a face and a piece with overlapping interiors, each the cell of R = N(I, X) in which T lies over D:
//   start    (T, f(T)) for each face T of the seed's component;
//   (T, D) -> (U, D)   across their common edge e if f(e) meets the interior of D, or if e is a crease edge
//                      that carries a side of D;
//   (T, D) -> (U, E)   across their common edge e if D has a side on e in T, E one in U, and these meet;
//   (T, D) -> (T, E)   if T, D and E have a common interior point, or if D and E have sides on the same edge
//                      whose common part runs through the interior of f(T);
//   extend   when T is inverted its component joins J;
//   grow     when nothing is left to walk and gamma >= 2 (untangle/explore/shadow_growth.h).
// R* are the faces of all pairs. The paper's sketch walks whole faces; it may overstep the minimum, because a
// face can lie over X in two places of which only one belongs to R. J and X only grow, so that grown pieces
// are never lost. [Agarwal 2008, §4, Lemmas 4.1-4.3, Theorem 4.4]
class LocalExploration {
 public:
  explicit LocalExploration(const Mesh& mesh) : mesh_(mesh), pieces_(mesh), sheets_(mesh) {}

  // Explores from an inverted face. Pre: face is inverted. One call per object. Exact; in general position
  // the region is the minimum. False in degenerate positions: a flat face is met, or no stable region with
  // gamma = 1 came out.
  [[nodiscard]] bool run(Face seed);

  std::vector<Face> faces() const;  // R*, ascending
  std::vector<Cell> cells() const;  // of R over the inverted faces of J, by face and piece
  const ConvexPieces& shadow() const { return pieces_; }                   // X
  int explored() const { return static_cast<int>(sheets_.all().size()); }  // faces whose corners were read
  int inverted() const { return inverted_; }                               // faces of J
  int components() const { return components_; }                           // of J
  int gamma_first_stable() const { return gamma_first_stable_; }  // when extending first came to rest
  int gamma() const { return gamma_; }                            // at the end
  int rounds() const { return rounds_; }                          // of growing
  int grown() const { return grown_; }                            // pieces these added

 private:
  struct Pair {
    Sheet* sheet;
    int piece;
  };

  Face across(Side side) const { return mesh_.face_across(side); }

  void visit(Sheet& sheet, int piece);
  void mark(Sheet& sheet, int place);
  void mark_all(Sheet& sheet);
  bool walk();
  void cross(const Pair& pair, Side side);
  bool leads_across(const Pair& pair, Side side);
  void change_piece(const Pair& pair);
  void extend(Face face);
  void connect_new_piece(int piece);
  bool is_connected(const Sheet& sheet, int piece) const;
  bool are_beside(const Sheet& sheet, const ConvexPiece& piece, Side side) const;
  int cover() const;
  bool grow();

  const Mesh& mesh_;
  ConvexPieces pieces_;  // their union is X
  Sheets sheets_;
  std::vector<Pair> pending_;
  int inverted_ = 0, components_ = 0, rounds_ = 0, grown_ = 0;
  int gamma_first_stable_ = 0, gamma_ = 0;
  bool met_flat_face_ = false;
};

}  // namespace kinemesh
