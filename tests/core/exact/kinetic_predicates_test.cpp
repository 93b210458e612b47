// Times at which triangles collapse are ordered, and others judged at them, as rational arithmetic has it.
#include "core/exact/kinetic_predicates.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <thread>
#include <utility>
#include <vector>

#include "tests/core/mesh/sample_meshes.h"

namespace kinemesh::test {
namespace {

using Rational = boost::multiprecision::cpp_rational;

// --- the oracle ---

struct Polynomial {
  Rational a, b, c;
  Rational at(const Rational& t) const { return a + t * (b + t * c); }
};

using Corners = std::array<MovingPoint, 3>;

Rational cross_at(const Corners& p, const Rational& t, bool is_dot) {
  const auto side = [&](int k, int axis) {
    const auto coordinate = [&](const MovingPoint& m) -> Rational {
      return Rational(m.x0[axis]) * (1 - t) + Rational(m.x1[axis]) * t;
    };
    return Rational(coordinate(p[k]) - coordinate(p[0]));
  };
  if (is_dot) return side(1, 0) * side(2, 0) + side(1, 1) * side(2, 1);
  return side(1, 0) * side(2, 1) - side(1, 1) * side(2, 0);
}

// Through its values at 0, 1 and 2.
Polynomial polynomial(const Corners& p, bool is_dot = false) {
  const Rational y0 = cross_at(p, 0, is_dot), y1 = cross_at(p, 1, is_dot), y2 = cross_at(p, 2, is_dot);
  const Rational c = (y2 - 2 * y1 + y0) / 2;
  return {y0, y1 - y0 - c, c};
}

// Encloses where it goes from positive to negative within (0, 1), in a width of 2^-300: much less than what
// roots of quadratics with small integer coefficients are apart.
struct Enclosure {
  Rational low, high;
};

std::optional<Enclosure> collapse(const Polynomial& p) {
  Rational low = 0, high = 1;  // where it falls
  if (p.c != 0) {
    const Rational top = -p.b / (2 * p.c);
    if (p.c > 0 && top < high) high = top;
    if (p.c < 0 && top > low) low = top;
  } else if (p.b >= 0) {
    return std::nullopt;
  }
  if (low >= high || p.at(low) <= 0 || p.at(high) >= 0) return std::nullopt;
  for (int i = 0; i < 300; ++i) {
    const Rational middle = (low + high) / 2, value = p.at(middle);
    if (value >= 0) low = middle;
    if (value <= 0) high = middle;
    if (low == high) break;
  }
  return Enclosure{low, high};
}

int order(const Enclosure& s, const Enclosure& t) {
  return s.high < t.low ? -1 : t.high < s.low ? 1 : 0;
}

int sign(const Rational& r) {
  return (r > 0) - (r < 0);
}

// Inside the enclosure it is zero if it changes its sign, or if it is as small as the enclosure allows.
int sign_within(const Polynomial& p, const Enclosure& t) {
  const Rational tiny = Rational(1) / (boost::multiprecision::cpp_int(1) << 200);
  const Rational value = p.at(t.low);
  return abs(value) < tiny ? 0 : sign(value);
}

int sign_behind(const Polynomial& p, const Enclosure& t) {
  if (const int value = sign_within(p, t)) return value;
  if (const int slope = sign_within({p.b, 2 * p.c, 0}, t)) return slope;
  return sign(p.c);
}

// --- cases ---

// Small integers, so that roots often coincide, many of them being rational.
Corners lattice_corners(Random& random, int size) {
  const auto any = [&] {
    return Point(random.below(2 * size + 1) - size, random.below(2 * size + 1) - size);
  };
  Corners p;
  for (auto& [x0, x1] : p) {
    x0 = any();
    x1 = random.one_in(3) ? x0 : any();
  }
  return p;
}

Corners any_corners(Random& random) {
  Corners p;
  for (auto& [x0, x1] : p) {
    x0 = {random.between(-1, 1), random.between(-1, 1)};
    x1 = {random.between(-1, 1), random.between(-1, 1)};
  }
  return p;
}

KineticQuadratic area(const Corners& p) {
  return KineticQuadratic::area(p[0], p[1], p[2]);
}

KineticQuadratic dot(const Corners& p) {
  return KineticQuadratic::dot(p[0], p[1], p[2]);
}

struct Collapse {
  Corners corners;
  CollapseTime time;
  Enclosure enclosure;
};

void expect_enclosed(const Collapse& c) {
  EXPECT_LE(Rational(c.time.low()), c.enclosure.high);
  EXPECT_GE(Rational(c.time.high()), c.enclosure.low);
}

std::vector<Collapse> collapses_of(const std::vector<Corners>& all) {
  std::vector<Collapse> found;
  for (const auto& p : all) {
    const auto time = area(p).collapse_after();
    const auto expected = collapse(polynomial(p));
    EXPECT_EQ(time.has_value(), expected.has_value());
    if (!time || !expected) continue;
    found.push_back({p, *time, *expected});
    expect_enclosed(found.back());
  }
  return found;
}

// Returns how many pairs are equal.
int expect_ordered(const std::vector<Collapse>& all) {
  int ties = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < all.size(); ++j) {
      const int expected = order(all[i].enclosure, all[j].enclosure);
      EXPECT_EQ(compare(all[i].time, all[j].time), expected);
      ties += i != j && expected == 0;
    }
  }
  return ties;
}

// Returns how many are zero.
int expect_judged(const std::vector<Collapse>& times, const std::vector<Corners>& all) {
  int zeros = 0;
  for (const auto& t : times) {
    for (const auto& p : all) {
      const auto a = polynomial(p), d = polynomial(p, true);
      const int at = sign_within(a, t.enclosure);
      EXPECT_EQ(area(p).sign_at(t.time), at);
      EXPECT_EQ(area(p).sign_after(t.time), sign_behind(a, t.enclosure));
      EXPECT_EQ(dot(p).sign_at(t.time), sign_within(d, t.enclosure));
      zeros += at == 0;
    }
  }
  return zeros;
}

std::vector<Corners> lattice_cases(Random& random, int n, int size) {
  std::vector<Corners> all;
  for (int i = 0; i < n; ++i) all.push_back(lattice_corners(random, size));
  return all;
}

TEST(CollapseTime, IsOrderedAsByRationalsOnLattices) {
  Random random(1);
  for (const int size : {1, 2, 3, 5, 50}) {
    const auto collapses = collapses_of(lattice_cases(random, 200, size));
    EXPECT_GT(collapses.size(), 20u);
    const int ties = expect_ordered(collapses);
    if (size <= 3) {
      EXPECT_GT(ties, 20) << size;
    }
  }
}

TEST(CollapseTime, IsOrderedAsByRationalsInGeneralPosition) {
  Random random(2);
  std::vector<Corners> all;
  for (int i = 0; i < 150; ++i) all.push_back(any_corners(random));
  expect_ordered(collapses_of(all));
}

// The same root from different quadratics: all that doubles see is that they are close.
TEST(CollapseTime, TellsAHairFromNothing) {
  const auto falling = [](double from, double to) -> Corners {
    return {{{{0, 0}, {0, 0}}, {{1, 0}, {1, 0}}, {{0, from}, {0, to}}}};
  };
  const auto third = *area(falling(1, -2)).collapse_after(), same = *area(falling(0.5, -1)).collapse_after();
  EXPECT_EQ(compare(third, same), 0);
  const double above = std::nextafter(-2.0, 0.0);
  const auto later = *area(falling(1, above)).collapse_after();
  EXPECT_EQ(compare(third, later), -1);
  EXPECT_EQ(compare(later, third), 1);
  // t^2 = 1/2, and a hair beside it
  const Corners diagonal{{{{0, 0}, {0, 0}}, {{1, 0}, {1, 1}}, {{0, 0}, {1, 0}}}};
  EXPECT_FALSE(area(diagonal).collapse_after());
  const Corners root{{{{0, 0}, {0, 0}}, {{1, 0}, {1, 2}}, {{0, 1}, {1, 1}}}};  // 1 - 2 t^2
  const Corners beside{{{{0, 0}, {0, 0}}, {{1, 0}, {1, 2}}, {{0, 1 - 0x1p-53}, {1, 1 - 0x1p-53}}}};
  const auto t = *area(root).collapse_after(), s = *area(beside).collapse_after();
  EXPECT_EQ(compare(s, t), -1);
  EXPECT_NEAR(t.low(), std::sqrt(0.5), 1e-12);
  EXPECT_EQ(area(root).sign_at(s), 1);
  EXPECT_EQ(area(beside).sign_at(t), -1);
}

TEST(CollapseTime, IsNotWhereAnAreaOnlyTouchesZero) {
  const Corners touching{{{{0, 0}, {0, 0}}, {{1, 0}, {-1, 0}}, {{0, 1}, {0, -1}}}};  // (1 - 2 t)^2
  EXPECT_FALSE(area(touching).collapse_after());
  EXPECT_FALSE(area({{{{0, 0}, {0, 0}}, {{1, 0}, {1, 0}}, {{0, 1}, {0, 0}}}}).collapse_after());   // at 1
  EXPECT_FALSE(area({{{{0, 0}, {0, 0}}, {{1, 0}, {1, 0}}, {{0, 0}, {0, -1}}}}).collapse_after());  // at 0
  const Corners half{{{{0, 0}, {0, 0}}, {{1, 0}, {1, 0}}, {{0, 1}, {0, -1}}}};
  const auto t = *area(half).collapse_after();
  EXPECT_EQ(area(touching).sign_at(t), 0);
  EXPECT_EQ(area(touching).sign_after(t), 1);
  EXPECT_NEAR(t.low(), 0.5, 1e-12);
}

TEST(CollapseTime, CanBeAskedForFromAnotherOn) {
  Random random(4);
  for (int i = 0; i < 12; ++i) {
    const auto all = lattice_cases(random, 20, 2);
    for (const auto& from : collapses_of(all)) {
      for (const auto& p : all) {
        const auto time = area(p).collapse_after(), later = area(p).collapse_after(&from.time);
        EXPECT_EQ(later.has_value(), time && compare(*time, from.time) > 0);
      }
    }
  }
}

// Each thread begins at another place, so that none has worked all out before the others come.
TEST(CollapseTime, CanBeAskedByThreadsAtOnce) {
  Random random(6);
  const auto cases = lattice_cases(random, 150, 2);
  const auto ask = [](const std::vector<CollapseTime>& times, const std::vector<KineticQuadratic>& areas,
                      std::size_t first) {
    std::vector<int> answers(2 * times.size());
    for (std::size_t n = 0; n < times.size(); ++n) {
      const std::size_t i = (first + n) % times.size(), next = (i + 1) % times.size();
      answers[2 * i] = compare(times[i], times[next]);
      answers[2 * i + 1] = areas[i].sign_after(times[next]);
    }
    return answers;
  };
  const auto fresh = [&] {
    std::pair<std::vector<CollapseTime>, std::vector<KineticQuadratic>> all;
    for (const auto& p : cases) {
      if (const auto time = area(p).collapse_after()) {
        all.first.push_back(*time);
        all.second.push_back(area(p));
      }
    }
    return all;
  };
  const auto [alone_times, alone_areas] = fresh();
  const auto expected = ask(alone_times, alone_areas, 0);
  for (int round = 0; round < 20; ++round) {
    const auto all = fresh();
    std::vector<std::vector<int>> answers(4);
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < answers.size(); ++i)
      threads.emplace_back([&, i] { answers[i] = ask(all.first, all.second, i); });
    threads.clear();
    for (const auto& answer : answers) EXPECT_EQ(answer, expected);
  }
}

TEST(CollapseTime, EndsAtOne) {
  Random random(5);
  for (const auto& c : collapses_of(lattice_cases(random, 100, 3))) {
    EXPECT_EQ(compare(c.time, CollapseTime::end()), -1);
    EXPECT_EQ(compare(CollapseTime::end(), c.time), 1);
    EXPECT_EQ(area(c.corners).sign_at(CollapseTime::end()), sign(polynomial(c.corners).at(1)));
  }
  EXPECT_EQ(compare(CollapseTime::end(), CollapseTime::end()), 0);
}

TEST(KineticQuadratic, IsJudgedAsByRationals) {
  Random random(3);
  for (const int size : {1, 2, 4}) {
    const auto all = lattice_cases(random, 80, size);
    EXPECT_GT(expect_judged(collapses_of(all), all), 10) << size;
  }
  std::vector<Corners> all;
  for (int i = 0; i < 60; ++i) all.push_back(any_corners(random));
  expect_judged(collapses_of(all), all);
}

// Beyond what doubles can multiply, and below.
TEST(KineticQuadratic, IsExactAtTheExtremesOfDoubles) {
  Random random(6);
  for (const double scale : {0x1p-1060, 0x1p-600, 0x1p600, 0x1p1000}) {
    auto all = lattice_cases(random, 60, 3);
    const auto plain = collapses_of(all);
    for (auto& p : all)
      for (auto& [x0, x1] : p) {
        x0 *= scale;
        x1 *= scale;
      }
    const auto scaled = collapses_of(all);
    ASSERT_EQ(plain.size(), scaled.size());
    for (std::size_t i = 0; i < plain.size(); ++i)
      for (std::size_t j = 0; j < plain.size(); ++j)
        EXPECT_EQ(compare(plain[i].time, scaled[j].time), compare(plain[i].time, plain[j].time));
  }
}

}  // namespace
}  // namespace kinemesh::test
