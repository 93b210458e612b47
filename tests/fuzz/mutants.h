// Files that are nearly right: texts and numbers changed in ways that know tokens, lines, sections and
// counts. The same seed gives the same mutants everywhere.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace kinemesh {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next();
  std::size_t below(std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(next() % n); }
  bool one_in(std::size_t n) { return below(n) == 0; }
  template <class Items>
  const auto& one_of(const Items& items) {
    return items[below(std::size(items))];
  }

 private:
  std::uint64_t state_;
};

// One to a few changes: numbers become others, huge, negative, one more or less, not finite; words and names
// are repeated; lines and sections are dropped, doubled, swapped; the end is cut off; bytes flip.
std::string mutated_text(std::string text, Dice& dice);

// Likewise for numbers in little endian: counts and values of 4 and 8 bytes are overwritten, pieces are
// dropped and doubled, bits flip.
std::string mutated_bytes(std::string bytes, Dice& dice);

}  // namespace kinemesh
