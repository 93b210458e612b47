// Counter-based random numbers: the 128 bits for a counter and a key, computed alone and in any order.
#pragma once

#include <array>
#include <cstdint>

namespace kinemesh {

using PhiloxCounter = std::array<std::uint32_t, 4>;
using PhiloxKey = std::array<std::uint32_t, 2>;

// Philox4x32-10 [Salmon 2011]: ten rounds of two 32 x 32 -> 64 bit products, the key raised by Weyl
// constants. Agrees with the authors' known answers (tests/motion/fields/noise_test.cpp).
constexpr PhiloxCounter philox(PhiloxCounter c, PhiloxKey k) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t p0 = std::uint64_t{0xD2511F53u} * c[0];
    const std::uint64_t p1 = std::uint64_t{0xCD9E8D57u} * c[2];
    c = {static_cast<std::uint32_t>(p1 >> 32) ^ c[1] ^ k[0], static_cast<std::uint32_t>(p1),
         static_cast<std::uint32_t>(p0 >> 32) ^ c[3] ^ k[1], static_cast<std::uint32_t>(p0)};
    k[0] += 0x9E3779B9u;
    k[1] += 0xBB67AE85u;
  }
  return c;
}

// Two numbers in [0, 1), multiples of 2^-53, from the 128 bits.
constexpr std::array<double, 2> unit_interval(const PhiloxCounter& bits) {
  const auto unit = [](std::uint32_t low, std::uint32_t high) {
    return static_cast<double>(((std::uint64_t{high} << 32) | low) >> 11) * 0x1p-53;
  };
  return {unit(bits[0], bits[1]), unit(bits[2], bits[3])};
}

}  // namespace kinemesh
