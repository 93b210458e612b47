#include "motion/fields/noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "motion/fields/philox.h"

namespace kinemesh {
namespace {

// The authors' known answers for philox4x32-10 [Salmon 2011]: zeros, ones, the digits of pi.
TEST(Philox, GivesTheKnownAnswers) {
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (PhiloxCounter{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  constexpr std::uint32_t all = 0xffffffff;
  EXPECT_EQ(philox({all, all, all, all}, {all, all}),
            (PhiloxCounter{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (PhiloxCounter{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Philox, UnitIntervalExcludesOne) {
  constexpr std::uint32_t all = 0xffffffff;
  const auto [most, least] = unit_interval({all, all, 0, 0});
  EXPECT_EQ(most, 1.0 - 0x1p-53);
  EXPECT_EQ(least, 0.0);
  EXPECT_EQ(unit_interval({0, 0x80000000u, 0, 0x40000000u}), (std::array<double, 2>{0.5, 0.25}));
}

struct Moments {
  Point mean{0.0}, square{0.0};
  double product = 0.0, fourth = 0.0, largest = 0.0;
};

Moments moments(const NoiseField& noise, int n, double dt, double spacing) {
  Moments m;
  for (int i = 0; i < n; ++i) {
    const Point k = noise.kick(i % 1000, i / 1000, dt, spacing);
    m.mean += k / static_cast<double>(n);
    m.square += k * k / static_cast<double>(n);
    m.product += k.x * k.y / n;
    m.fourth += k.x * k.x * k.x * k.x / n;
    m.largest = std::max({m.largest, std::abs(k.x), std::abs(k.y)});
  }
  return m;
}

constexpr int samples = 1'000'000;

TEST(Jitter, IsUniformInItsSquareWhateverTheStep) {
  const Moments m = moments(Jitter(0.5, 3), samples, 123.0, 0.2);
  const double a = 0.1, variance = a * a / 3.0, deviation = std::sqrt(variance / samples);
  EXPECT_LE(m.largest, a);
  EXPECT_GT(m.largest, 0.9999 * a);
  EXPECT_NEAR(m.mean.x, 0.0, 5 * deviation);
  EXPECT_NEAR(m.mean.y, 0.0, 5 * deviation);
  EXPECT_NEAR(m.square.x / variance, 1.0, 0.01);
  EXPECT_NEAR(m.square.y / variance, 1.0, 0.01);
  EXPECT_NEAR(m.product / variance, 0.0, 0.01);
  EXPECT_NEAR(m.fourth / (a * a * a * a / 5.0), 1.0, 0.01);
}

TEST(Brownian, IsGaussianWithVarianceTwiceDiffusionTimesTime) {
  const double variance = 2.0 * 0.3 * 0.25;
  const Moments m = moments(Brownian(0.3, 3), samples, 0.25, 99.0);
  EXPECT_NEAR(m.mean.x / std::sqrt(variance), 0.0, 0.005);
  EXPECT_NEAR(m.mean.y / std::sqrt(variance), 0.0, 0.005);
  EXPECT_NEAR(m.square.x / variance, 1.0, 0.01);
  EXPECT_NEAR(m.square.y / variance, 1.0, 0.01);
  EXPECT_NEAR(m.product / variance, 0.0, 0.01);
  EXPECT_NEAR(m.fourth / (3.0 * variance * variance), 1.0, 0.03);
}

TEST(Noise, DependsOnSeedVertexAndStepAlone) {
  const Jitter one(1.0, 1);
  EXPECT_EQ(one.kick(5, 7, 0.1, 1.0), Jitter(1.0, 1).kick(5, 7, 0.2, 1.0));
  std::set<double> different;
  for (const std::uint64_t high : {0ull, 1ull << 32})
    for (const std::uint64_t low : {5ull, 7ull}) {
      different.insert(one.kick(high + low, 0, 0.1, 1.0).x);
      different.insert(one.kick(0, high + low, 0.1, 1.0).x);
      different.insert(Jitter(1.0, high + low).kick(0, 0, 0.1, 1.0).x);
    }
  EXPECT_EQ(different.size(), 12u);
}

TEST(Noise, KindsWithOneSeedAreNotCorrelated) {
  const Jitter jitter(1.0, 1);
  const Brownian brownian(0.5, 1);
  double product = 0.0;
  const int n = 100'000;
  for (int v = 0; v < n; ++v) product += jitter.kick(v, 0, 1.0, 1.0).x * brownian.kick(v, 0, 1.0, 1.0).x / n;
  EXPECT_NEAR(product, 0.0, 5.0 / std::sqrt(3.0 * n));
}

}  // namespace
}  // namespace kinemesh
