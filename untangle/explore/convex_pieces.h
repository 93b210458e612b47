// The shadow X of a local exploration, as the union of convex pieces.
#pragma once

#include <boost/container/static_vector.hpp>
#include <boost/functional/hash.hpp>
#include <unordered_map>
#include <vector>

#include "core/base/box_index.h"
#include "core/exact/overlap.h"
#include "kinemesh/mesh.h"

namespace kinemesh {

using FacePair = std::array<Face, 2>;

// The shadow of an inverted face or, grown, the overlap of the shadows of two upright ones.
struct ConvexPiece {
  // Beyond a side of one of the faces.
  struct Neighbor {
    Side side;
    int piece;
  };

  FacePair faces;                                      // the second is none unless grown
  boost::container::static_vector<Shadow, 2> shadows;  // of the faces
  Box box;
  boost::container::static_vector<Neighbor, 6> neighbors;
  std::vector<int> overlapping;  // pieces with interior points in common

  bool is_grown() const { return faces[1] != none; }
  bool has(Face face) const { return faces[0] == face || faces[1] == face; }
};

class ConvexPieces {
 public:
  explicit ConvexPieces(const Mesh& mesh) : mesh_(mesh) {}

  int size() const { return static_cast<int>(pieces_.size()); }
  const ConvexPiece& operator[](int piece) const { return pieces_[piece]; }

  // The number of the piece f(face), or of the overlap of two upright faces in ascending order; none if it
  // has not been added.
  int find(const FacePair& faces) const;
  int add(Face face, const Shadow& shadow);
  int add(const FacePair& faces, const Shadow& first, const Shadow& second);

  // Numbers of pieces whose boxes meet this one, in no particular order.
  template <class Visit>
  void for_each_near(const Box& box, const Visit& visit) const {
    kinemesh::for_each_near(index_, box, visit);
  }

 private:
  int add(ConvexPiece piece);
  void find_overlapping(int piece);
  void find_neighbors(int piece);

  const Mesh& mesh_;
  std::vector<ConvexPiece> pieces_;
  struct Hash {
    std::size_t operator()(const FacePair& faces) const {
      return boost::hash<std::array<int, 2>>()({faces[0], faces[1]});
    }
  };

  std::unordered_map<FacePair, int, Hash> number_;
  BoxIndex index_;
};

}  // namespace kinemesh
