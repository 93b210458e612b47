#include "untangle/explore/convex_pieces.h"

#include <algorithm>

namespace kinemesh {

int ConvexPieces::find(const FacePair& faces) const {
  const auto found = number_.find(faces);
  return found == number_.end() ? none : found->second;
}

int ConvexPieces::add(Face face, const Shadow& shadow) {
  return add({{face, none}, {shadow}, box_of(shadow), {}, {}});
}

int ConvexPieces::add(const FacePair& faces, const Shadow& first, const Shadow& second) {
  return add({faces, {first, second}, common(box_of(first), box_of(second)), {}, {}});
}

int ConvexPieces::add(ConvexPiece piece) {
  const int number = size();
  number_.emplace(piece.faces, number);
  pieces_.push_back(std::move(piece));
  find_overlapping(number);
  find_neighbors(number);
  index_.insert({pieces_[number].box, number});
  return number;
}

void ConvexPieces::find_overlapping(int number) {
  auto& piece = pieces_[number];
  for_each_near(piece.box, [&](int near) {
    boost::container::static_vector<Shadow, 4> shadows(piece.shadows.begin(), piece.shadows.end());
    for (std::size_t i = 0; i < pieces_[near].shadows.size(); ++i) {
      if (!piece.has(pieces_[near].faces[i])) shadows.push_back(pieces_[near].shadows[i]);
    }
    if (interiors_overlap({shadows.data(), shadows.size()})) piece.overlapping.push_back(near);
  });
  std::sort(piece.overlapping.begin(), piece.overlapping.end());  // whatever the order of the index
  for (const int other : piece.overlapping) pieces_[other].overlapping.push_back(number);
}

void ConvexPieces::find_neighbors(int number) {
  auto& piece = pieces_[number];
  for (const Face face : piece.faces) {
    if (face == none) break;
    for (const Side side : Mesh::sides(face)) {
      const Face beyond = mesh_.face_across(side);
      if (beyond == none) continue;
      auto faces = piece.faces;
      std::replace(faces.begin(), faces.end(), face, beyond);
      if (piece.is_grown()) std::sort(faces.begin(), faces.end());
      const int other = find(faces);
      if (other == none) continue;
      piece.neighbors.push_back({side, other});
      pieces_[other].neighbors.push_back({mesh_.opposite(side), number});
    }
  }
}

}  // namespace kinemesh
