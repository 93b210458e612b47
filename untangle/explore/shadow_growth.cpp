#include "untangle/explore/shadow_growth.h"

#include <algorithm>
#include <unordered_map>

namespace kinemesh {
namespace {

class Growth {
 public:
  Growth(const Mesh& mesh, Sheets& sheets, ConvexPieces& pieces)
      : mesh_(mesh), sheets_(sheets), pieces_(pieces) {}

  void run() {
    find_creases();
    start();
    while (!pending_.empty()) {
      const auto [first, second] = pending_.back();
      pending_.pop_back();
      move(*first, *second);
      move(*second, *first);
    }
  }

 private:
  using SheetPair = std::array<const Sheet*, 2>;

  bool meets(Side side, std::span<const Shadow> shadows) const {
    return meets_interior(mesh_.position(mesh_.from(side)), mesh_.position(mesh_.to(side)), shadows);
  }
  bool meets(Side side, const Sheet& sheet) const { return meets(side, std::span(&sheet.shadow, 1)); }

  void find_creases();
  void start();
  void start_at(Side crease, const std::vector<const Sheet*>& upright);
  void move(const Sheet& moving, const Sheet& staying);
  void add(const Sheet& t, const Sheet& u);
  bool is_inside(const Sheet& sheet);

  const Mesh& mesh_;
  Sheets& sheets_;
  ConvexPieces& pieces_;
  std::vector<Side> creases_;  // the sides of inverted faces along them
  BoxIndex crease_index_;
  std::unordered_map<int, bool> is_inside_;  // by face
  std::vector<SheetPair> pending_;
};

void Growth::find_creases() {
  std::vector<NumberedBox> boxes;
  for (int piece = 0; piece < pieces_.size(); ++piece) {
    if (pieces_[piece].is_grown()) continue;
    for (const Side side : mesh_.sides(pieces_[piece].faces[0])) {
      const Face beyond = mesh_.face_across(side);
      if (beyond == none || sheets_[beyond].is_inverted()) continue;
      creases_.push_back(side);
      boxes.emplace_back(box_of(mesh_.position(mesh_.from(side)), mesh_.position(mesh_.to(side))), side);
    }
  }
  crease_index_ = BoxIndex(boxes);  // packed
}

void Growth::start() {
  std::vector<std::vector<const Sheet*>> upright(pieces_.size());
  for (const auto& sheet : sheets_.all()) {
    for (std::size_t i = 0; i < sheet.over.size(); ++i) {
      if (sheet.visited[i] && !sheet.is_inverted()) upright[sheet.over[i]].push_back(&sheet);
    }
  }
  for (const Side crease : creases_) start_at(crease, upright[pieces_.find({mesh_.face_of(crease), none})]);
}

// Where X covers both sides of the crease the pairs lead to its border, and add nothing to X before.
void Growth::start_at(Side crease, const std::vector<const Sheet*>& upright) {
  std::vector<const Sheet*> crossed;
  std::copy_if(upright.begin(), upright.end(), std::back_inserter(crossed),
               [&](const Sheet* sheet) { return meets(crease, *sheet); });
  for (std::size_t i = 0; i < crossed.size(); ++i) {
    for (std::size_t j = i + 1; j < crossed.size(); ++j) {
      if (meets(crease, std::array{crossed[i]->shadow, crossed[j]->shadow})) add(*crossed[i], *crossed[j]);
    }
  }
}

void Growth::move(const Sheet& moving, const Sheet& staying) {
  for (const Side side : mesh_.sides(moving.face)) {
    const Face beyond = mesh_.face_across(side);
    if (beyond == none || !meets(side, staying)) continue;
    const auto& next = sheets_[beyond];
    if (next.turn == Orientation::CounterClockwise) add(next, staying);
  }
}

void Growth::add(const Sheet& t, const Sheet& u) {
  if (t.face > u.face) return add(u, t);
  if (pieces_.find({t.face, u.face}) != none || is_inside(t) || is_inside(u)) return;
  pieces_.add({t.face, u.face}, t.shadow, u.shadow);
  pending_.push_back({&t, &u});
}

// No border of X runs through the shadow, so that its pairs would add nothing.
bool Growth::is_inside(const Sheet& sheet) {
  const auto [known, is_new] = is_inside_.try_emplace(sheet.face, false);
  if (is_new && sheet.is_in_region) {
    known->second =
        !any_near(crease_index_, sheet.box, [&](int crease) { return meets(Side(crease), sheet); });
  }
  return known->second;
}

}  // namespace

void grow_shadow(const Mesh& mesh, Sheets& sheets, ConvexPieces& pieces) {
  Growth(mesh, sheets, pieces).run();
}

}  // namespace kinemesh
