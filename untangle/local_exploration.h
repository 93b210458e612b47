// The minimum locally removable region around one inverted face, found without reading anything beyond it.
#pragma once

#include <boost/container/static_vector.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <deque>
#include <set>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "core/mesh.h"
#include "core/overlap.h"
#include "untangle/overlapping_mesher.h"

namespace kinemesh {

// The shadow X of the inverted components J is kept as convex pieces: the shadow of each inverted face of J
// and, after growing, overlaps of the shadows of two upright ones. The exploration walks over pairs (T, D) of
// a face and a piece with overlapping interiors, each the cell of R = N(I, X) in which T lies over D:
//   start    (T, f(T)) for each face T of the seed's component;
//   (T, D) -> (U, D)   across their common edge e if f(e) meets the interior of D, or if e is a crease edge
//   that carries
//                      a side of D;
//   (T, D) -> (T, E)   if T, D and E have a common interior point, or if D and E have sides on the same edge
//   whose
//                      common part runs through the interior of f(T);
//   extend   when T is inverted its component joins J;
//   grow     when nothing is left to walk and gamma >= 2: pairs of upright sheets are walked outward together
//   while both
//            stay upright, and each adds the overlap of its shadows to X.
// R* are the faces of all pairs. The paper's sketch walks whole faces; it may overstep the minimum, because a
// face can lie over X in two places of which only one belongs to R. J and X only grow, so that grown pieces
// are never lost. [Agarwal 2008, §4, Lemmas 4.1-4.3, Theorem 4.4]
class LocalExploration {
 public:
  explicit LocalExploration(const Mesh& mesh) : mesh_(mesh) {}

  // Explores from an inverted face. Pre: face is inverted. One call per object. Exact; in general position
  // the region is the minimum. False in degenerate positions where no stable region with gamma = 1 came out.
  [[nodiscard]] bool run(int seed);

  std::vector<int> faces() const;   // R*, ascending
  std::vector<Cell> cells() const;  // of R over the inverted faces of J, by face and piece
  int explored() const { return static_cast<int>(read_.size()); }  // faces whose corners were read
  int inverted() const { return inverted_; }                       // faces of J
  int components() const { return components_; }                   // of J
  int gamma_first_stable() const { return gamma_first_stable_; }   // when extending first came to rest
  int gamma() const { return gamma_; }                             // at the end
  int rounds() const { return rounds_; }                           // of growing
  int grown() const { return grown_; }                             // pieces these added

 private:
  using Corner = boost::geometry::model::d2::point_xy<double>;
  using Box = boost::geometry::model::box<Corner>;
  using Index = boost::geometry::index::rtree<std::pair<Box, int>, boost::geometry::index::quadratic<16>>;

  // The shadow of faces[0] or, grown, its overlap with that of faces[1].
  struct Piece {
    std::array<int, 2> faces;
    int n_faces;
    Box box;
    std::span<const int> all() const { return {faces.data(), static_cast<std::size_t>(n_faces)}; }
  };
  struct Pair {
    int face, piece;
  };
  using Shadows = boost::container::static_vector<Shadow, 5>;  // of a face and two pieces at the most

  const Shadow& shadow(int face);
  bool is_inverted(int face);
  Box box_of(int face);
  int across(int side) const { return mesh_.face_of(Mesh::opposite(side)); }
  bool is_visited(int face, int piece) const;

  void visit(int face, int piece);
  void walk();
  void leave(const Pair& pair);
  void cross(const Pair& pair, int side);
  void change_piece(const Pair& pair);
  void extend(int face);
  int add_piece(std::array<int, 2> faces, int n_faces);
  void connect_piece(int piece);

  bool crosses(const Pair& pair, int side);
  bool are_connected(int face, int piece, int other);
  bool lies_over(int face, int piece);
  bool meets(int side, std::initializer_list<std::span<const int>> faces, int except, int except_too);

  int cover();
  bool grow();
  bool start_growing(std::deque<std::array<int, 2>>& pending);
  void grow_pair(std::array<int, 2> pair, std::deque<std::array<int, 2>>& pending);

  const Mesh& mesh_;
  std::unordered_map<int, Shadow> read_;            // faces read so far
  std::vector<Piece> pieces_;                       // their union is X
  std::unordered_map<int, std::vector<int>> over_;  // pieces of the pairs of each face of R*, ascending
  std::unordered_set<int> settled_;                 // faces within one piece whose pairs have all been found
  std::unordered_set<int> extended_;                // faces of J
  std::set<std::array<int, 2>> grown_pairs_;
  std::vector<Pair> pending_;
  Index piece_index_;
  Index face_index_;  // of R*
  int inverted_ = 0, components_ = 0, rounds_ = 0, grown_ = 0;
  int gamma_first_stable_ = 0, gamma_ = 0;
};

}  // namespace kinemesh
