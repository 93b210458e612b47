// A table from sides to numbers that takes its memory once.
#pragma once

#include <cstdint>
#include <vector>

#include "kinemesh/types.h"

#pragma GCC visibility push(default)
namespace kinemesh {

// Open addressing, linear probing; at most half full, so that a search ends soon.
class SideNumbers {
 public:
  // Empty, with room for n sides.
  void reset(std::size_t n) {
    std::size_t size = 2;
    while (size < 2 * n) size *= 2;
    entries_.assign(size, {});
  }

  int find(Side side) const noexcept {  // or none
    if (entries_.empty()) return none;
    std::size_t i = home(side);
    while (entries_[i].side != side && entries_[i].side != none) i = following(i);
    return entries_[i].number;
  }

  // Pre: the side is not in it, and there is room.
  void insert(Side side, int number) noexcept {
    std::size_t i = home(side);
    while (entries_[i].side != none) i = following(i);
    entries_[i] = {side, number};
  }

  // Closes the gap, so that what was found before still is. Does nothing for a side that is not in it.
  void erase(Side side) noexcept {
    std::size_t gap = home(side);
    while (entries_[gap].side != side) {
      if (entries_[gap].side == none) return;
      gap = following(gap);
    }
    for (std::size_t i = following(gap); entries_[i].side != none; i = following(i)) {
      if (distance(home(entries_[i].side), i) < distance(gap, i)) continue;
      entries_[gap] = entries_[i];
      gap = i;
    }
    entries_[gap] = {};
  }

 private:
  struct Entry {
    Side side;
    int number = none;
  };

  std::size_t home(Side side) const {
    return (static_cast<std::uint64_t>(side) * 0x9E3779B97F4A7C15u >> 32) & (entries_.size() - 1);
  }
  std::size_t following(std::size_t i) const { return (i + 1) & (entries_.size() - 1); }
  std::size_t distance(std::size_t from, std::size_t to) const { return (to - from) & (entries_.size() - 1); }

  std::vector<Entry> entries_;
};

}  // namespace kinemesh
#pragma GCC visibility pop
