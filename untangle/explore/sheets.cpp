#include "untangle/explore/sheets.h"

#include <algorithm>

namespace kinemesh {
namespace {

bool lies_over(const Sheet& sheet, const ConvexPiece& piece) {
  boost::container::static_vector<Shadow, 3> shadows{sheet.shadow};
  for (std::size_t i = 0; i < piece.shadows.size(); ++i) {
    if (piece.faces[i] != sheet.face) shadows.push_back(piece.shadows[i]);
  }
  return interiors_overlap({shadows.data(), shadows.size()});
}

bool lies_within(const Sheet& sheet, const ConvexPiece& piece) {
  return std::all_of(piece.shadows.begin(), piece.shadows.end(),
                     [&](const Shadow& s) { return is_within(sheet.shadow, s); });
}

void put_over(Sheet& sheet, const ConvexPieces& pieces, int piece) {
  sheet.over.push_back(piece);
  sheet.visited.push_back(false);
  sheet.is_within_piece = sheet.is_within_piece || lies_within(sheet, pieces[piece]);
}

}  // namespace

int Sheet::place_of(int piece) const {
  const auto found = std::lower_bound(over.begin(), over.end(), piece);
  return found == over.end() || *found != piece ? none : static_cast<int>(found - over.begin());
}

bool Sheet::is_visited(int piece) const {
  const int place = place_of(piece);
  return place != none && visited[place];
}

Sheet& Sheets::operator[](Face face) {
  auto& sheet = sheet_of_[face];
  if (!sheet) {
    const auto shadow = mesh_.corners(face);
    sheet = &sheets_.emplace_back(
        Sheet{face, shadow, box_of(shadow), orientation(shadow[0], shadow[1], shadow[2])});
  }
  return *sheet;
}

const Sheet* Sheets::find(Face face) const {
  const auto found = sheet_of_.find(face);
  return found == sheet_of_.end() ? nullptr : found->second;
}

void Sheets::open(Sheet& sheet, const ConvexPieces& pieces) {
  if (sheet.is_open) return;
  sheet.is_open = true;
  index_.insert({sheet.box, static_cast<int>(open_.size())});
  open_.push_back(&sheet);
  std::vector<int> near;
  pieces.for_each_near(sheet.box, [&](int piece) { near.push_back(piece); });
  std::sort(near.begin(), near.end());
  for (const int piece : near) {
    if (lies_over(sheet, pieces[piece])) put_over(sheet, pieces, piece);
  }
}

std::vector<Sheet*> Sheets::add_piece(const ConvexPieces& pieces, int piece) {
  std::vector<int> near;
  for_each_near(index_, pieces[piece].box, [&](int i) { near.push_back(i); });
  std::sort(near.begin(), near.end());
  std::vector<Sheet*> under;
  for (const int i : near) {
    if (!lies_over(*open_[i], pieces[piece])) continue;
    put_over(*open_[i], pieces, piece);
    under.push_back(open_[i]);
  }
  return under;
}

}  // namespace kinemesh
