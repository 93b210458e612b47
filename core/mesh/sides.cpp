#include "core/mesh/sides.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <memory>
#include <utility>

#include "core/base/parallel.h"

namespace kinemesh {
namespace {

struct Entry {
  Edge ends;
  int side;
};

int lower_end(const Edge& ends) {
  return std::min(ends[0], ends[1]);
}

// The vertices in groups of consecutive ones: so few that the sides of a group are sorted in the cache, and
// so many that counting sides by part and group costs nothing.
class Groups {
 public:
  explicit Groups(int n_vertices) : n_vertices_(n_vertices) {
    while (count() > most) ++bits_;
  }
  int count() const { return (n_vertices_ >> bits_) + 1; }
  int of(int vertex) const { return vertex >> bits_; }

 private:
  static constexpr int most = 512;
  int n_vertices_;
  int bits_ = 11;
};

// All sides, those with the lower vertex in one group together, ascending within it.
class SidesByGroup {
 public:
  SidesByGroup(std::span<const Triangle> triangles, const Groups& groups)
      : first_(groups.count() + 1), entries_(new Entry[3 * triangles.size()]) {
    const int n = static_cast<int>(triangles.size()), n_groups = groups.count();
    std::vector<std::vector<int>> places(n_parts(n, grain::items), std::vector<int>(n_groups));
    const auto group_of = [&](const Edge& ends) { return groups.of(lower_end(ends)); };
    parallel_parts(n, grain::items, [&](int part, int begin, int end) {
      for_sides(triangles, begin, end, [&](const Edge& ends, int) { ++places[part][group_of(ends)]; });
    });
    int place = 0;
    for (int group = 0; group < n_groups; ++group) {
      first_[group] = place;
      for (auto& of_part : places) place += std::exchange(of_part[group], place);
    }
    first_[n_groups] = place;
    parallel_parts(n, grain::items, [&](int part, int begin, int end) {
      for_sides(triangles, begin, end, [&](const Edge& ends, int side) {
        entries_[places[part][group_of(ends)]++] = {ends, side};
      });
    });
  }
  std::span<const Entry> of(int group) const {
    return {entries_.get() + first_[group], entries_.get() + first_[group + 1]};
  }

 private:
  template <class Visit>
  static void for_sides(std::span<const Triangle> triangles, int begin, int end, const Visit& visit) {
    for (int f = begin; f < end; ++f) {
      const auto& [a, b, c] = triangles[f];
      visit({a, b}, 3 * f);
      visit({b, c}, 3 * f + 1);
      visit({c, a}, 3 * f + 2);
    }
  }

  std::vector<int> first_;  // per group: begin of its entries
  std::unique_ptr<Entry[]> entries_;
};

// Pairs the sides of one group after the other. A table of the group's edges says which side was there first;
// it is open, and at most half full.
class Pairing {
 public:
  Pairing(std::vector<int>& opposite, Winding winding) : opposite_(opposite), winding_(winding) {}

  void pair(std::span<const Entry> entries) {
    const std::size_t size = std::bit_ceil(2 * entries.size());
    shift_ = 64 - std::countr_zero(size);
    table_.assign(size, {{none, none}, none});
    for (const Entry& e : entries) {
      Entry& first = place_of(e.ends);
      if (first.ends[0] == none)
        first = e;
      else
        join(first, e);
    }
  }

  int conflict() const { return conflict_.side == none ? none : conflict_.side / 3; }

 private:
  static constexpr int spoilt = -2;  // instead of the first side, where sides cannot be paired

  // The edge as one number, in the order of its lower end and then the other one.
  static std::uint64_t key_of(const Edge& ends) {
    const auto [low, high] = std::minmax(ends[0], ends[1]);
    return static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint32_t>(high);
  }

  Entry& place_of(const Edge& ends) {
    const auto key = key_of(ends);
    std::size_t i = key * 0x9E3779B97F4A7C15u >> shift_;  // by the golden ratio
    while (table_[i].ends[0] != none && key_of(table_[i].ends) != key) i = (i + 1) & (table_.size() - 1);
    return table_[i];
  }

  void join(Entry& first, const Entry& e) {
    const bool fits = winding_ == Winding::Any || first.ends[0] != e.ends[0];
    const bool pairs = fits && first.side != spoilt && opposite_[first.side] == none;
    if (!pairs) return spoil(first, e);
    opposite_[first.side] = e.side;
    opposite_[e.side] = first.side;
  }

  // Entries come ascending: the last one of the lowest edge is kept.
  void spoil(Entry& first, const Entry& e) {
    if (first.side != spoilt && opposite_[first.side] != none) {
      opposite_[opposite_[first.side]] = none;
      opposite_[first.side] = none;
    }
    first.side = spoilt;
    if (conflict_.side == none || key_of(e.ends) <= key_of(conflict_.ends)) conflict_ = e;
  }

  std::vector<int>& opposite_;
  Winding winding_;
  std::vector<Entry> table_;
  int shift_ = 0;
  Entry conflict_{{none, none}, none};
};

}  // namespace

SidePairs pair_sides(std::span<const Triangle> triangles, int n_vertices, Winding winding) {
  const Groups groups(n_vertices);
  const SidesByGroup sides(triangles, groups);
  SidePairs pairs{std::vector<int>(3 * triangles.size(), none), none};
  std::vector<int> conflicts(n_parts(groups.count(), 1), none);
  parallel_parts(groups.count(), 1, [&](int part, int begin, int end) {
    Pairing pairing(pairs.opposite, winding);
    for (int group = begin; group < end; ++group) {
      if (!sides.of(group).empty()) pairing.pair(sides.of(group));
    }
    conflicts[part] = pairing.conflict();
  });
  const auto first = std::find_if(conflicts.begin(), conflicts.end(), [](int f) { return f != none; });
  if (first != conflicts.end()) pairs.conflict = *first;
  return pairs;
}

}  // namespace kinemesh
