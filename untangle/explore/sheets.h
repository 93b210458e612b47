// The faces that a local exploration has read, and which pieces of X each of them lies over.
#pragma once

#include <deque>
#include <unordered_map>
#include <vector>

#include "core/base/box_index.h"
#include "core/exact/overlap.h"
#include "kinemesh/mesh.h"
#include "kinemesh/predicates.h"
#include "untangle/explore/convex_pieces.h"

namespace kinemesh {

struct Sheet {
  Face face;
  Shadow shadow;
  Box box;
  Orientation turn;
  bool is_open = false;          // `over` is complete
  bool is_within_piece = false;  // then whatever lies over the face is connected there
  bool is_in_region = false;     // a pair has been visited
  std::vector<int> over{};       // pieces whose interiors meet that of the shadow, ascending
  std::size_t n_visited = 0;
  std::vector<char> visited{};  // beside `over`: the pair belongs to R

  bool is_inverted() const { return turn == Orientation::Clockwise; }
  int place_of(int piece) const;  // in `over`, or none
  bool is_visited(int piece) const;
};

class Sheets {
 public:
  explicit Sheets(const Mesh& mesh) : mesh_(mesh) {}

  // The only place that reads a face's corners.
  Sheet& operator[](Face face);
  const Sheet* find(Face face) const;  // null if it has not been read
  const std::deque<Sheet>& all() const { return sheets_; }

  // Finds what lies over the face; from then on `add_piece` has to be told of new pieces.
  void open(Sheet& sheet, const ConvexPieces& pieces);

  // The open sheets that lie over a piece just added, which joins their `over`; in order of opening.
  std::vector<Sheet*> add_piece(const ConvexPieces& pieces, int piece);

 private:
  const Mesh& mesh_;
  std::deque<Sheet> sheets_;  // addresses last
  std::unordered_map<int, Sheet*> sheet_of_;
  std::vector<Sheet*> open_;
  BoxIndex index_;  // of open_
};

}  // namespace kinemesh
