#include "untangle/explore/local_exploration.h"

#include <algorithm>

#include "untangle/explore/shadow_growth.h"

namespace kinemesh {
namespace {

// T, D and E have a common interior point.
bool have_common_point(const Sheet& sheet, const ConvexPiece& d, const ConvexPiece& e) {
  boost::container::static_vector<Shadow, 5> shadows{sheet.shadow};
  for (std::size_t i = 0; i < d.shadows.size(); ++i) {
    if (d.faces[i] != sheet.face) shadows.push_back(d.shadows[i]);
  }
  for (std::size_t i = 0; i < e.shadows.size(); ++i) {
    if (e.faces[i] != sheet.face && !d.has(e.faces[i])) shadows.push_back(e.shadows[i]);
  }
  return interiors_overlap({shadows.data(), shadows.size()});
}

}  // namespace

bool LocalExploration::run(Face seed) {
  extend(seed);
  if (!walk()) return false;
  gamma_first_stable_ = gamma_ = cover();
  while (gamma_ >= 2 && grow()) {
    ++rounds_;
    if (!walk()) return false;
    gamma_ = cover();
  }
  return gamma_ == 1;
}

std::vector<Face> LocalExploration::faces() const {
  std::vector<Face> all;
  for (const auto& sheet : sheets_.all()) {
    if (sheet.is_in_region) all.push_back(sheet.face);
  }
  std::sort(all.begin(), all.end());
  return all;
}

std::vector<Cell> LocalExploration::cells() const {
  std::vector<Cell> all;
  for (const auto& sheet : sheets_.all()) {
    for (std::size_t i = 0; i < sheet.over.size(); ++i) {
      const auto& piece = pieces_[sheet.over[i]];
      if (sheet.visited[i] && !piece.is_grown()) all.push_back({sheet.face, piece.faces[0]});
    }
  }
  std::sort(all.begin(), all.end(), [](const Cell& a, const Cell& b) {
    return std::pair(a.face, a.inverted) < std::pair(b.face, b.inverted);
  });
  return all;
}

// --- walking ---

// Pre: the piece's interior meets that of the face's shadow.
void LocalExploration::visit(Sheet& sheet, int piece) {
  if (sheet.turn == Orientation::Collinear) {
    met_flat_face_ = true;
    return;
  }
  sheets_.open(sheet, pieces_);
  if (sheet.is_within_piece) return mark_all(sheet);
  const int place = sheet.place_of(piece);
  if (!sheet.visited[place]) mark(sheet, place);
}

void LocalExploration::mark(Sheet& sheet, int place) {
  sheet.visited[place] = sheet.is_in_region = true;
  ++sheet.n_visited;
  pending_.push_back({&sheet, sheet.over[place]});
}

void LocalExploration::mark_all(Sheet& sheet) {
  for (std::size_t place = 0; place < sheet.over.size(); ++place) {
    if (!sheet.visited[place]) mark(sheet, static_cast<int>(place));
  }
}

// False if a flat face is in the way.
bool LocalExploration::walk() {
  while (!pending_.empty() && !met_flat_face_) {
    const auto pair = pending_.back();
    pending_.pop_back();
    if (pair.sheet->is_inverted() && pieces_.find({pair.sheet->face, none}) == none) extend(pair.sheet->face);
    for (const Side side : mesh_.sides(pair.sheet->face)) cross(pair, side);
    change_piece(pair);
  }
  return !met_flat_face_;
}

void LocalExploration::cross(const Pair& pair, Side side) {
  const Face beyond = across(side);
  if (beyond == none) return;
  const auto& piece = pieces_[pair.piece];
  for (const auto& n : piece.neighbors) {
    if (n.side == side && are_beside(*pair.sheet, piece, side)) return visit(sheets_[beyond], n.piece);
  }
  const auto* known = sheets_.find(beyond);
  if (known && known->is_visited(pair.piece)) return;
  if (leads_across(pair, side)) visit(sheets_[beyond], pair.piece);
}

bool LocalExploration::leads_across(const Pair& pair, Side side) {
  const auto& piece = pieces_[pair.piece];
  const Point &a = mesh_.position(mesh_.from(side)), &b = mesh_.position(mesh_.to(side));
  if (meets_interior(a, b, {piece.shadows.data(), piece.shadows.size()})) return true;
  // A side of the piece on this edge: the face beyond lies over the piece if the edge is a crease.
  const Face beyond = across(side);
  for (std::size_t i = 0; i < piece.shadows.size(); ++i) {
    if (piece.faces[i] != pair.sheet->face && piece.faces[i] != beyond) continue;
    const auto others = piece.is_grown() ? std::span(&piece.shadows[1 - i], 1) : std::span<const Shadow>();
    if (meets_interior(a, b, others) && pair.sheet->is_inverted() != sheets_[beyond].is_inverted())
      return true;
  }
  return false;
}

void LocalExploration::change_piece(const Pair& pair) {
  auto& sheet = *pair.sheet;
  if (sheet.n_visited == sheet.over.size()) return;
  const auto& piece = pieces_[pair.piece];
  for (const auto& [side, other] : piece.neighbors) {
    const int place = sheet.place_of(other);
    if (place != none && !sheet.visited[place] && are_beside(sheet, piece, side)) mark(sheet, place);
  }
  auto over = sheet.over.begin();
  for (const int other : piece.overlapping) {  // both ascend
    over = std::lower_bound(over, sheet.over.end(), other);
    if (over == sheet.over.end()) break;
    const int place = static_cast<int>(over - sheet.over.begin());
    if (*over == other && !sheet.visited[place] && have_common_point(sheet, piece, pieces_[other]))
      mark(sheet, place);
  }
}

// An edge that the piece and its neighbour share runs through the face where both are, or along its side.
bool LocalExploration::are_beside(const Sheet& sheet, const ConvexPiece& piece, Side side) const {
  const Face carrier = mesh_.face_of(side);
  boost::container::static_vector<Shadow, 2> shadows;
  if (sheet.face != carrier) shadows.push_back(sheet.shadow);
  for (std::size_t i = 0; i < piece.shadows.size(); ++i) {
    const Face face = piece.faces[i];
    if (face != carrier && face != sheet.face) shadows.push_back(piece.shadows[i]);
  }
  return meets_interior(mesh_.position(mesh_.from(side)), mesh_.position(mesh_.to(side)),
                        {shadows.data(), shadows.size()});
}

bool LocalExploration::is_connected(const Sheet& sheet, int piece) const {
  const auto& d = pieces_[piece];
  return std::any_of(
             d.neighbors.begin(), d.neighbors.end(),
             [&](const auto& n) { return sheet.is_visited(n.piece) && are_beside(sheet, d, n.side); }) ||
         std::any_of(d.overlapping.begin(), d.overlapping.end(), [&](int other) {
           return sheet.is_visited(other) && have_common_point(sheet, d, pieces_[other]);
         });
}

// --- extending ---

// The whole inverted component joins J, each of its faces over its own shadow.
void LocalExploration::extend(Face face) {
  ++components_;
  std::vector<Face> component{face};
  const int first = pieces_.add(face, sheets_[face].shadow);
  for (std::size_t i = 0; i < component.size(); ++i) {
    for (const Side side : mesh_.sides(component[i])) {
      const Face beyond = across(side);
      if (beyond == none || !sheets_[beyond].is_inverted() || pieces_.find({beyond, none}) != none) continue;
      pieces_.add(beyond, sheets_[beyond].shadow);
      component.push_back(beyond);
    }
  }
  inverted_ += static_cast<int>(component.size());
  for (int piece = first; piece < pieces_.size(); ++piece) connect_new_piece(piece);
  for (int piece = first; piece < pieces_.size(); ++piece) visit(sheets_[pieces_[piece].faces[0]], piece);
}

// Faces of R* whose pairs have been left already have to learn of a new piece.
void LocalExploration::connect_new_piece(int piece) {
  for (auto* sheet : sheets_.add_piece(pieces_, piece)) {
    if (!sheet->is_in_region) continue;
    if (sheet->is_within_piece) {
      mark_all(*sheet);
    } else if (is_connected(*sheet, piece)) {
      mark(*sheet, sheet->place_of(piece));
    }
  }
}

// --- gamma, and growing ---

// How often R covers a point of the first piece, with signs: lifts in R only, not all faces of R*.
int LocalExploration::cover() const {
  std::vector<Shadow> lifts;
  for (const auto& sheet : sheets_.all()) {
    if (sheet.is_visited(0)) lifts.push_back(sheet.shadow);
  }
  return signed_cover(pieces_[0].shadows[0], lifts);
}

bool LocalExploration::grow() {
  const int before = pieces_.size();
  grow_shadow(mesh_, sheets_, pieces_);
  for (int piece = before; piece < pieces_.size(); ++piece) connect_new_piece(piece);
  grown_ += pieces_.size() - before;
  return pieces_.size() > before;
}

}  // namespace kinemesh
