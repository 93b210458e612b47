#include "motion/fields/noise.h"

#include <cmath>
#include <numbers>

#include "motion/fields/philox.h"

namespace kinemesh {
namespace {

// Kinds of noise with one seed draw from different streams.
constexpr std::uint32_t jitter_stream = 0;
constexpr std::uint32_t brownian_stream = 0x42726f77;

std::array<double, 2> draw(std::uint32_t stream, std::uint64_t seed, std::uint64_t vertex,
                           std::uint64_t step) {
  const auto low = [](std::uint64_t n) { return static_cast<std::uint32_t>(n); };
  const auto high = [](std::uint64_t n) { return static_cast<std::uint32_t>(n >> 32); };
  return unit_interval(
      philox({low(vertex), high(vertex), low(step), high(step)}, {low(seed), high(seed) ^ stream}));
}

}  // namespace

Point Jitter::kick(std::uint64_t vertex, std::uint64_t step, double, double spacing) const {
  const auto [u, v] = draw(jitter_stream, seed_, vertex, step);
  return amplitude_ * spacing * Point(2.0 * u - 1.0, 2.0 * v - 1.0);
}

Point Brownian::kick(std::uint64_t vertex, std::uint64_t step, double dt, double) const {
  const auto [u, v] = draw(brownian_stream, seed_, vertex, step);
  const double radius = std::sqrt(-2.0 * std::log(1.0 - u)) * std::sqrt(2.0 * diffusion_ * dt);  // 1 - u > 0
  const double angle = 2.0 * std::numbers::pi * v;
  return radius * Point(std::cos(angle), std::sin(angle));
}

}  // namespace kinemesh
