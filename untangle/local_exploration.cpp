#include "untangle/local_exploration.h"

#include <algorithm>
#include <ranges>

#include "core/predicates.h"

namespace kinemesh {
namespace bgi = boost::geometry::index;

namespace {

template <class Box>
Box common(const Box& a, const Box& b) {
  return {
      {std::max(a.min_corner().x(), b.min_corner().x()), std::max(a.min_corner().y(), b.min_corner().y())},
      {std::min(a.max_corner().x(), b.max_corner().x()), std::min(a.max_corner().y(), b.max_corner().y())}};
}

}  // namespace

bool LocalExploration::run(int seed) {
  extend(seed);
  walk();
  gamma_first_stable_ = gamma_ = cover();
  while (gamma_ >= 2 && grow()) {
    ++rounds_;
    walk();
    gamma_ = cover();
  }
  return gamma_ == 1;
}

std::vector<int> LocalExploration::faces() const {
  std::vector<int> all;
  for (const auto& [face, pieces] : over_) all.push_back(face);
  std::sort(all.begin(), all.end());
  return all;
}

std::vector<Cell> LocalExploration::cells() const {
  std::vector<Cell> all;
  for (const auto& [face, pieces] : over_) {
    for (const int piece : pieces) {
      if (pieces_[piece].n_faces == 1) all.push_back({face, pieces_[piece].faces[0]});
    }
  }
  std::ranges::sort(all, {}, [](const Cell& cell) { return std::pair(cell.face, cell.inverted); });
  return all;
}

// --- reading ---

// The only place that reads a face's corners.
const Shadow& LocalExploration::shadow(int face) {
  return read_.try_emplace(face, mesh_.corners(face)).first->second;
}

bool LocalExploration::is_inverted(int face) {
  const auto& [a, b, c] = shadow(face);
  return orientation(a, b, c) == Orientation::Clockwise;
}

LocalExploration::Box LocalExploration::box_of(int face) {
  const auto& [a, b, c] = shadow(face);
  return {{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y})},
          {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y})}};
}

// --- walking ---

bool LocalExploration::is_visited(int face, int piece) const {
  const auto found = over_.find(face);
  return found != over_.end() && std::ranges::binary_search(found->second, piece);
}

void LocalExploration::visit(int face, int piece) {
  auto& pieces = over_[face];
  if (pieces.empty()) face_index_.insert({box_of(face), face});
  pieces.insert(std::ranges::lower_bound(pieces, piece), piece);
  pending_.push_back({face, piece});
}

void LocalExploration::walk() {
  while (!pending_.empty()) {
    const auto pair = pending_.back();
    pending_.pop_back();
    leave(pair);
  }
}

void LocalExploration::leave(const Pair& pair) {
  if (!extended_.contains(pair.face) && is_inverted(pair.face)) extend(pair.face);
  for (const int side : mesh_.sides(pair.face)) cross(pair, side);
  change_piece(pair);
}

void LocalExploration::cross(const Pair& pair, int side) {
  const int beyond = across(side);
  if (beyond != none && !is_visited(beyond, pair.piece) && crosses(pair, side)) visit(beyond, pair.piece);
}

bool LocalExploration::crosses(const Pair& pair, int side) {
  const auto& piece = pieces_[pair.piece];
  if (meets(side, {piece.all()}, none, none)) return true;
  // A side of the piece on this edge: the face beyond lies over the piece if the edge is a crease.
  const int beyond = across(side);
  for (const int carrier : piece.all()) {
    if (carrier != pair.face && carrier != beyond) continue;
    if (meets(side, {piece.all()}, carrier, none) && is_inverted(pair.face) != is_inverted(beyond))
      return true;
  }
  return false;
}

void LocalExploration::change_piece(const Pair& pair) {
  if (settled_.contains(pair.face)) return;
  std::vector<int> near;
  const Box cell =
      common(box_of(pair.face), pieces_[pair.piece].box);  // where both ways of being connected meet
  for (auto it = piece_index_.qbegin(bgi::intersects(cell)); it != piece_index_.qend(); ++it) {
    near.push_back(it->second);
  }
  std::ranges::sort(near);  // the walk does not depend on the index
  for (const int other : near) {
    if (!is_visited(pair.face, other) && are_connected(pair.face, pair.piece, other)) visit(pair.face, other);
  }
  // Within one piece, whatever lies over the face is connected there: nothing more to find, whichever pair
  // comes next.
  const auto within = pieces_[pair.piece].all();
  const bool settled =
      std::ranges::all_of(within, [&](int f) { return is_within(shadow(pair.face), shadow(f)); });
  if (settled) settled_.insert(pair.face);
}

// Both over the face: with a common interior point, or beside each other along an edge that runs through the
// face.
bool LocalExploration::are_connected(int face, int piece, int other) {
  const auto d = pieces_[piece].all(), e = pieces_[other].all();
  boost::container::static_vector<int, 5> faces{face};
  Shadows shadows{shadow(face)};
  for (const auto& some : {d, e}) {
    for (const int f : some) {
      if (std::ranges::find(faces, f) != faces.end()) continue;
      faces.push_back(f);
      shadows.push_back(shadow(f));
    }
  }
  if (interiors_overlap({shadows.data(), shadows.size()})) return true;
  const std::array<int, 1> over{face};
  for (const int a : d) {
    for (const int side : mesh_.sides(a)) {
      const int b = across(side);
      if (b == none || std::ranges::find(e, b) == e.end() || is_inverted(a) != is_inverted(b)) continue;
      if (meets(side, {d, e, over}, a, b)) return true;
    }
  }
  return false;
}

bool LocalExploration::lies_over(int face, int piece) {
  Shadows shadows{shadow(face)};
  for (const int f : pieces_[piece].all()) {
    if (f != face) shadows.push_back(shadow(f));
  }
  return interiors_overlap({shadows.data(), shadows.size()});
}

// The edge's shadow meets the common interior of the faces, two of them left out.
bool LocalExploration::meets(int side, std::initializer_list<std::span<const int>> faces, int except,
                             int except_too) {
  Shadows shadows;
  for (const auto& some : faces) {
    for (const int f : some) {
      if (f != except && f != except_too) shadows.push_back(shadow(f));
    }
  }
  return meets_interior(mesh_.position(mesh_.from(side)), mesh_.position(mesh_.to(side)),
                        {shadows.data(), shadows.size()});
}

// --- extending ---

// The whole inverted component joins J, each of its faces over its own shadow.
void LocalExploration::extend(int face) {
  ++components_;
  std::vector<int> component{face};
  extended_.insert(face);
  for (std::size_t i = 0; i < component.size(); ++i) {
    for (const int side : mesh_.sides(component[i])) {
      const int beyond = across(side);
      if (beyond == none || extended_.contains(beyond) || !is_inverted(beyond)) continue;
      extended_.insert(beyond);
      component.push_back(beyond);
    }
  }
  inverted_ += static_cast<int>(component.size());
  for (const int f : component) {
    const int piece = add_piece({f, none}, 1);
    if (!is_visited(f, piece)) visit(f, piece);
    connect_piece(piece);
  }
}

int LocalExploration::add_piece(std::array<int, 2> faces, int n_faces) {
  const Box box = n_faces == 1 ? box_of(faces[0]) : common(box_of(faces[0]), box_of(faces[1]));
  const int piece = static_cast<int>(pieces_.size());
  pieces_.push_back({faces, n_faces, box});
  piece_index_.insert({box, piece});
  return piece;
}

// Faces of R* whose pairs have been left already have to learn of a new piece.
void LocalExploration::connect_piece(int piece) {
  std::vector<int> near;
  const Box& box = pieces_[piece].box;
  for (auto it = face_index_.qbegin(bgi::intersects(box)); it != face_index_.qend(); ++it)
    near.push_back(it->second);
  std::ranges::sort(near);
  for (const int face : near) {
    if (is_visited(face, piece)) continue;
    const auto& over = over_[face];
    const bool connected =
        settled_.contains(face)
            ? lies_over(face, piece)
            : std::ranges::any_of(over, [&](int other) { return are_connected(face, other, piece); });
    if (connected) visit(face, piece);
  }
}

// --- gamma, and growing ---

// How often R covers a point of the first piece, with signs: lifts in R only, not all faces of R*.
int LocalExploration::cover() {
  std::vector<int> lifts;
  for (const auto& [face, pieces] : over_) {
    if (std::ranges::find(pieces, 0) != pieces.end()) lifts.push_back(face);
  }
  std::ranges::sort(lifts);
  std::vector<Shadow> sheets;
  for (const int face : lifts) sheets.push_back(shadow(face));
  return signed_cover(shadow(pieces_[0].faces[0]), sheets);
}

// Adds the extended shadow G(J). False if there is nothing to add.
bool LocalExploration::grow() {
  const auto before = pieces_.size();
  std::deque<std::array<int, 2>> pending;
  start_growing(pending);
  while (!pending.empty()) {
    const auto pair = pending.front();
    pending.pop_front();
    grow_pair(pair, pending);
  }
  const auto after = pieces_.size();
  for (auto piece = before; piece < after; ++piece) connect_piece(static_cast<int>(piece));
  grown_ += static_cast<int>(after - before);
  return after > before;
}

// Two upright lifts over the same piece. The paper starts at points of the border of X; the pairs over the
// inside of X lead there while both sheets stay upright, and add nothing to X before.
bool LocalExploration::start_growing(std::deque<std::array<int, 2>>& pending) {
  std::vector<std::vector<int>> sheets(pieces_.size());
  for (const int face : faces()) {
    if (is_inverted(face)) continue;
    for (const int piece : over_[face]) sheets[piece].push_back(face);
  }
  for (std::size_t piece = 0; piece < sheets.size(); ++piece) {
    for (const int t : sheets[piece]) {
      for (const int u : sheets[piece]) {
        if (u <= t || grown_pairs_.contains({t, u})) continue;
        std::vector<Shadow> shadows{shadow(t), shadow(u)};
        for (const int f : pieces_[piece].all()) shadows.push_back(shadow(f));
        if (!interiors_overlap(shadows)) continue;
        grown_pairs_.insert({t, u});
        pending.push_back({t, u});
      }
    }
  }
  return !pending.empty();
}

void LocalExploration::grow_pair(std::array<int, 2> pair, std::deque<std::array<int, 2>>& pending) {
  add_piece(pair, 2);
  for (const int moving : {0, 1}) {
    const int stays = pair[1 - moving];
    const std::array<int, 1> under{stays};
    for (const int side : mesh_.sides(pair[moving])) {
      const int beyond = across(side);
      if (beyond == none || beyond == stays || !meets(side, {under}, none, none)) continue;
      const std::array<int, 2> next{std::min(beyond, stays), std::max(beyond, stays)};
      if (grown_pairs_.contains(next) || is_inverted(beyond)) continue;
      grown_pairs_.insert(next);
      pending.push_back(next);
    }
  }
}

}  // namespace kinemesh
