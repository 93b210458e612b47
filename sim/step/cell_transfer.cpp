#include "kinemesh/cell_transfer.h"

#include <algorithm>
#include <boost/geometry/algorithms/distance.hpp>
#include <boost/geometry/strategies/strategies.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <map>
#include <string>
#include <utility>

#include "core/base/box_index.h"
#include "kinemesh/error.h"

namespace kinemesh {
namespace {

using Corners = std::array<Point, 3>;

double signed_area(const Corners& t) {
  return cross(t[1] - t[0], t[2] - t[0]) / 2;
}

Point centre(const Corners& t) {
  return (t[0] + t[1] + t[2]) / 3.0;
}

// A convex polygon that can hold what is left of a triangle after three cuts.
struct Polygon {
  std::array<Point, 7> corners;
  int size = 0;
  void add(const Point& p) { corners[size++] = p; }
};

// The part to the left of the line from -> to.
Polygon cut(const Polygon& polygon, const Point& from, const Point& to) {
  Polygon left;
  for (int i = 0; i < polygon.size; ++i) {
    const Point &p = polygon.corners[i], &q = polygon.corners[(i + 1) % polygon.size];
    const double side_p = cross(to - from, p - from), side_q = cross(to - from, q - from);
    if (side_p >= 0) left.add(p);
    if ((side_p < 0) != (side_q < 0)) left.add(p + (q - p) * (side_p / (side_p - side_q)));
  }
  return left;
}

double area(const Polygon& polygon) {
  double twice = 0.0;
  for (int i = 2; i < polygon.size; ++i)
    twice += cross(polygon.corners[i - 1] - polygon.corners[0], polygon.corners[i] - polygon.corners[0]);
  return twice / 2;
}

Corners turned_upright(Corners t) {
  if (signed_area(t) < 0) std::swap(t[1], t[2]);
  return t;
}

// Where the face's vertices are after the step. Not for corners of the frame.
Corners carried(const StepChanges& changes, const UserTriangle& corners) {
  return {changes.after(corners[0]), changes.after(corners[1]), changes.after(corners[2])};
}

// One label in a patch: indices in patch.faces of the faces that have it.
struct Share {
  std::vector<int> before, after;
};

std::map<int, Share> by_label(const ChangedPatch& patch) {
  std::map<int, Share> shares;
  for (int i = 0; i < static_cast<int>(patch.faces.size()); ++i) {
    shares[patch.faces[i].label_before].before.push_back(i);
    shares[patch.faces[i].label_after].after.push_back(i);
  }
  shares.erase(padding_label);
  for (const auto& [label, share] : shares) {
    if (share.before.empty() || share.after.empty())
      throw InputError("label " + std::to_string(label) + " is on one side of a change only, at face " +
                       std::to_string(patch.faces.front().face));
  }
  return shares;
}

// The new faces of a label and what they receive.
class Receivers {
 public:
  Receivers(const StepChanges& changes, const ChangedPatch& patch, const std::vector<int>& faces)
      : amounts_(faces.size(), 0.0) {
    std::vector<NumberedBox> entries;
    for (const int i : faces) {
      corners_.push_back(carried(changes, patch.faces[i].after));
      entries.emplace_back(box_of(corners_.back()), static_cast<int>(entries.size()));
      total_area_ += signed_area(corners_.back());
    }
    index_ = BoxIndex(entries);
  }

  // Spreads an amount evenly over a triangle. Overlaps of a sliver can round to more than its area.
  void spread(double amount, const Corners& image) {
    left_over_ += amount;
    overlaps_.clear();
    double covered = 0.0;
    for (auto it = index_.qbegin(boost::geometry::index::intersects(box_of(image))); it != index_.qend();
         ++it) {
      overlaps_.emplace_back(it->second, overlap_area(image, corners_[it->second]));
      covered += overlaps_.back().second;
    }
    const double whole = std::max(covered, std::abs(signed_area(image)));
    for (const auto& [receiver, overlap] : overlaps_)
      if (overlap > 0) give(receiver, amount * (overlap / whole));
  }

  // Gives away what is left over.
  std::span<const double> finish() {
    const double rest = left_over_;
    for (std::size_t i = 0; i < amounts_.size(); ++i)
      give(static_cast<int>(i), rest * (signed_area(corners_[i]) / total_area_));
    return amounts_;
  }

 private:
  void give(int receiver, double amount) {
    amounts_[receiver] += amount;
    left_over_ -= amount;
  }

  std::vector<Corners> corners_;
  std::vector<double> amounts_;
  BoxIndex index_;
  double total_area_ = 0.0, left_over_ = 0.0;
  std::vector<std::pair<int, double>> overlaps_;
};

void remap_patch(const StepChanges& changes, const ChangedPatch& patch, std::span<const double> before,
                 std::span<double> after) {
  for (const auto& [label, share] : by_label(patch)) {
    Receivers receivers(changes, patch, share.after);
    for (const int i : share.before) receivers.spread(before[i], carried(changes, patch.faces[i].before));
    const auto amounts = receivers.finish();
    for (std::size_t i = 0; i < amounts.size(); ++i) after[share.after[i]] = amounts[i];
  }
}

void remap_patch_averages(const StepChanges& changes, const ChangedPatch& patch,
                          std::span<const double> before, std::span<double> after) {
  std::vector<double> amounts(before.begin(), before.end());
  for (std::size_t i = 0; i < amounts.size(); ++i)
    if (patch.faces[i].label_before != padding_label)
      amounts[i] *= signed_area(carried(changes, patch.faces[i].before));
  remap_patch(changes, patch, amounts, after);
  for (std::size_t i = 0; i < amounts.size(); ++i)
    if (patch.faces[i].label_after != padding_label)
      after[i] /= signed_area(carried(changes, patch.faces[i].after));
}

// Of points, the nearest; of several, the one with the smallest number.
int nearest(const BoxIndex& index, const Point& at) {
  namespace bgi = boost::geometry::index;
  const auto rank = [&](const NumberedBox& entry) {
    return std::pair(glm::distance(entry.first.low, at), entry.second);
  };
  auto best = rank(*index.qbegin(bgi::nearest(at, 1)));
  const Box around = box_of(at - Point(best.first), at + Point(best.first));
  for (auto it = index.qbegin(bgi::intersects(around)); it != index.qend(); ++it)
    best = std::min(best, rank(*it));
  return best.second;
}

void copy_nearest_in_patch(const StepChanges& changes, const ChangedPatch& patch,
                           std::span<const double> before, std::span<double> after) {
  for (const auto& [label, share] : by_label(patch)) {
    std::vector<NumberedBox> entries;
    for (const int i : share.before) {
      const Point at = centre(carried(changes, patch.faces[i].before));
      entries.emplace_back(box_of(at, at), i);
    }
    const BoxIndex index(entries);
    for (const int i : share.after)
      after[i] = before[nearest(index, centre(carried(changes, patch.faces[i].after)))];
  }
}

}  // namespace

double overlap_area(const Corners& a, const Corners& b) {
  const Corners s = turned_upright(a), t = turned_upright(b);
  Polygon common;
  for (const Point& p : s) common.add(p - t[0]);  // small numbers round less
  const Corners clip{Point(0.0), t[1] - t[0], t[2] - t[0]};
  for (int k = 0; k < 3 && common.size > 0; ++k) common = cut(common, clip[k], clip[(k + 1) % 3]);
  return std::max(0.0, area(common));
}

void CellUpdate::apply(std::span<double> cells) const noexcept {
  for (std::size_t i = 0; i < faces.size(); ++i) cells[faces[i]] = values[i];
}

CellUpdate transfer_by(const PatchTransfer& transfer, const StepChanges& changes,
                       std::span<const double> values) {
  CellUpdate update;
  for (const auto& patch : changes.patches) {
    std::vector<double> before, after(patch.faces.size(), 0.0);
    for (const auto& change : patch.faces) {
      if (change.face >= static_cast<int>(values.size()))
        throw InputError(std::to_string(values.size()) + " values of faces, but there is a face " +
                         std::to_string(change.face));
      before.push_back(values[change.face]);
      update.faces.push_back(change.face);
    }
    transfer(changes, patch, before, after);
    update.values.insert(update.values.end(), after.begin(), after.end());
  }
  return update;
}

CellUpdate remap_amounts(const StepChanges& changes, std::span<const double> amounts) {
  return transfer_by(remap_patch, changes, amounts);
}

CellUpdate remap_averages(const StepChanges& changes, std::span<const double> averages) {
  return transfer_by(remap_patch_averages, changes, averages);
}

CellUpdate copy_nearest(const StepChanges& changes, std::span<const double> values) {
  return transfer_by(copy_nearest_in_patch, changes, values);
}

}  // namespace kinemesh
