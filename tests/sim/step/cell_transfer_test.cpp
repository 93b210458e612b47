#include "kinemesh/cell_transfer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <random>
#include <set>
#include <stdexcept>

#include "kinemesh/error.h"
#include "tests/sim/helpers.h"
#include "tests/sim/step/kicks.h"

namespace kinemesh {
namespace {

using test::all_ways;
using test::kicked;
using test::stepper_on;
using test::two_labels;

double area(const Point& a, const Point& b, const Point& c) {
  return ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
}

double area_after(const StepChanges& changes, const Triangle& t) {
  const auto at = [&](int v) { return changes.after(UserVertex(v)); };
  return area(at(t[0]), at(t[1]), at(t[2]));
}

double area_of(const MeshData& data, int face) {
  const auto& [a, b, c] = data.triangles[face];
  return area(data.points[a], data.points[b], data.points[c]);
}

std::map<int, double> sums(const MeshData& data, const std::vector<double>& cells) {
  std::map<int, double> by_label;
  for (int f = 0; f < data.n_faces(); ++f) by_label[data.label(f)] += cells[f];
  return by_label;
}

void expect_near(const std::map<int, double>& a, const std::map<int, double>& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (const auto& [label, sum] : a) EXPECT_NEAR(sum, b.at(label), tolerance * std::abs(sum)) << label;
}

// Ten rough steps; `observe` takes the cells from one to the next, and `check` looks at them after each.
template <class Observe, class Check>
void run_steps(const StepperOptions& options, const Observe& observe, const Check& check) {
  SCOPED_TRACE(test::name_of(options));
  std::mt19937 random(29);
  Stepper stepper = stepper_on(two_labels(12), options);
  int changed = 0;
  stepper.observe([&](const StepChanges& changes) {
    for (const auto& patch : changes.patches) changed += static_cast<int>(patch.faces.size());
    observe(changes);
  });
  for (int n = 0; n < 10; ++n) {
    const auto outcome = stepper.step(kicked(stepper, 0.1, random), 0.5);
    ASSERT_TRUE(outcome) << outcome.defect->message();
    check(stepper.mesh().domain());
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(changed, 500);
}

std::vector<double> random_cells(int n) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> value(0.0, 1.0);
  std::vector<double> cells(n);
  for (double& cell : cells) cell = value(random);
  return cells;
}

TEST(CellTransfer, KeepsTheAmountOfEachLabelAndItsSign) {
  for (const auto& options : all_ways()) {
    const auto data = two_labels(12);
    auto mass = random_cells(data.n_faces());
    const auto at_first = sums(data, mass);
    run_steps(
        options, [&](const StepChanges& changes) { remap_amounts(changes, mass).apply(mass); },
        [&](const MeshData& now) {
          expect_near(at_first, sums(now, mass), 1e-13);
          EXPECT_GE(*std::ranges::min_element(mass), -1e-15);
        });
  }
}

// Amounts that follow the swept areas: of an inverted face it is negative.
TEST(CellTransfer, KeepsAConstantDensity) {
  for (const auto& options : all_ways()) {
    auto data = two_labels(12);
    std::vector<double> amounts(data.n_faces());
    int inverted = 0;
    run_steps(
        options,
        [&](const StepChanges& changes) {
          for (int f = 0; f < data.n_faces(); ++f) {
            amounts[f] = 2.5 * area_after(changes, data.triangles[f]);
            inverted += amounts[f] < 0;
          }
          remap_amounts(changes, amounts).apply(amounts);
        },
        [&](const MeshData& now) {
          data = now;
          for (int f = 0; f < now.n_faces(); ++f) EXPECT_NEAR(amounts[f], 2.5 * area_of(now, f), 1e-15) << f;
        });
    EXPECT_GT(inverted, 100);
  }
}

TEST(CellTransfer, KeepsConstantAveragesAndTheSignedIntegral) {
  for (const auto& options : all_ways()) {
    auto data = two_labels(12);
    std::vector<double> constant(data.n_faces(), 2.5), any = random_cells(data.n_faces());
    std::map<int, double> integral;
    run_steps(
        options,
        [&](const StepChanges& changes) {
          std::vector<double> amounts;
          for (int f = 0; f < data.n_faces(); ++f)
            amounts.push_back(any[f] * area_after(changes, data.triangles[f]));
          integral = sums(data, amounts);
          const auto one = remap_averages(changes, constant), other = remap_averages(changes, any);
          one.apply(constant);
          other.apply(any);
        },
        [&](const MeshData& now) {
          data = now;
          std::vector<double> amounts;
          for (int f = 0; f < now.n_faces(); ++f) {
            EXPECT_NEAR(constant[f] * area_of(now, f), 2.5 * area_of(now, f), 1e-13) << f;
            amounts.push_back(any[f] * area_of(now, f));
          }
          expect_near(integral, sums(now, amounts), 1e-12);
        });
  }
}

TEST(CellTransfer, CopiesValuesOfTheSameLabel) {
  for (const auto& options : all_ways()) {
    const auto data = two_labels(12);
    std::vector<double> cells;
    for (int f = 0; f < data.n_faces(); ++f) cells.push_back(1000 * data.label(f) + f);
    run_steps(
        options, [&](const StepChanges& changes) { copy_nearest(changes, cells).apply(cells); },
        [&](const MeshData& now) {
          std::set<double> values(cells.begin(), cells.end());
          EXPECT_GT(values.size(), 20u);
          for (int f = 0; f < now.n_faces(); ++f) EXPECT_EQ(std::floor(cells[f] / 1000), now.label(f));
        });
  }
}

Point centre(const StepChanges& changes, const std::array<UserVertex, 3>& t) {
  return (changes.after(t[0]) + changes.after(t[1]) + changes.after(t[2])) / 3.0;
}

TEST(CellTransfer, CopiesTheNearest) {
  auto cells = random_cells(two_labels(12).n_faces());
  int compared = 0;
  run_steps(
      {},
      [&](const StepChanges& changes) {
        const auto update = copy_nearest(changes, cells);
        std::size_t i = 0;
        for (const auto& patch : changes.patches)
          for (const auto& to : patch.faces) {
            const auto distance = [&](const FaceChange& from) {
              return from.label_before == to.label_after
                         ? glm::length(centre(changes, from.before) - centre(changes, to.after))
                         : HUGE_VAL;
            };
            const auto nearest = std::ranges::min_element(patch.faces, {}, distance);
            EXPECT_EQ(update.values[i++], cells[nearest->face]);
            ++compared;
          }
        update.apply(cells);
      },
      [](const MeshData&) {});
  EXPECT_GT(compared, 500);
}

TEST(CellTransfer, AsksTheUser) {
  std::vector<double> cells(two_labels(12).n_faces(), 1.0);
  int asked = 0;
  run_steps(
      {},
      [&](const StepChanges& changes) {
        transfer_by(
            [&](const StepChanges&, const ChangedPatch& patch, std::span<const double> before,
                std::span<double> after) {
              ASSERT_EQ(before.size(), patch.faces.size());
              ASSERT_EQ(after.size(), patch.faces.size());
              for (size_t i = 0; i < before.size(); ++i) {
                EXPECT_EQ(before[i], cells[patch.faces[i].face]);
                after[i] = before[i] + 1;
              }
              ++asked;
            },
            changes, cells)
            .apply(cells);
      },
      [](const MeshData&) {});
  EXPECT_GT(asked, 10);
  EXPECT_GT(*std::ranges::max_element(cells), 5);
}

TEST(CellTransfer, LeavesAFaceThatKeepsItsCornersAlone) {
  auto cells = random_cells(two_labels(12).n_faces());
  const auto at_first = cells;
  auto data = two_labels(12);
  Stepper stepper = stepper_on(data, {});
  stepper.observe([&](const StepChanges& changes) { remap_amounts(changes, cells).apply(cells); });
  auto next = data.points;
  next[2 * 13 + 8] = {0.76, 0.27};
  ASSERT_TRUE(stepper.step(next, 0.5));
  const auto now = stepper.mesh().domain();
  int kept = 0;
  for (int f = 0; f < now.n_faces(); ++f) {
    if (now.triangles[f] != data.triangles[f]) continue;
    EXPECT_EQ(cells[f], at_first[f]);
    ++kept;
  }
  EXPECT_GT(kept, 200);
  EXPECT_NE(cells, at_first);
}

TEST(CellTransfer, RefusesAnotherNumberOfValues) {
  Stepper stepper = stepper_on(two_labels(12), {});
  std::vector<double> few(1);
  stepper.observe([&](const StepChanges& changes) { remap_amounts(changes, few).apply(few); });
  std::mt19937 random(1);
  EXPECT_THROW((void)stepper.step(kicked(stepper, 0.1, random), 0.5), InputError);
  EXPECT_EQ(stepper.steps_done(), 0);
}

// Corners of one in the other and crossings of sides, sorted around their middle: the common part is convex.
double overlap_by_its_corners(std::array<Point, 3> s, std::array<Point, 3> t) {
  if (area(s[0], s[1], s[2]) < 0) std::swap(s[1], s[2]);
  if (area(t[0], t[1], t[2]) < 0) std::swap(t[1], t[2]);
  const auto is_in = [](const Point& p, const std::array<Point, 3>& in) {
    return area(in[0], in[1], p) >= 0 && area(in[1], in[2], p) >= 0 && area(in[2], in[0], p) >= 0;
  };
  std::vector<Point> corners;
  for (int i = 0; i < 3; ++i) {
    if (is_in(s[i], t)) corners.push_back(s[i]);
    if (is_in(t[i], s)) corners.push_back(t[i]);
    for (int j = 0; j < 3; ++j) {
      const Point &a = s[i], &b = s[(i + 1) % 3], &c = t[j], &d = t[(j + 1) % 3];
      const double at_a = area(c, d, a), at_b = area(c, d, b);
      if (at_a * at_b < 0 && area(a, b, c) * area(a, b, d) < 0)
        corners.push_back(a + (b - a) * (at_a / (at_a - at_b)));
    }
  }
  Point middle(0.0);
  for (const auto& p : corners) middle += p / static_cast<double>(corners.size());
  std::ranges::sort(corners, {}, [&](const Point& p) { return std::atan2(p.y - middle.y, p.x - middle.x); });
  double sum = 0.0;
  for (size_t i = 0; i < corners.size(); ++i)
    sum += area(middle, corners[i], corners[(i + 1) % corners.size()]);
  return sum;
}

TEST(CellTransfer, OverlapsAreTheAreasOfIntersections) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> anywhere(-1.0, 1.0);
  int empty = 0, whole = 0;
  for (int n = 0; n < 3000; ++n) {
    std::array<Point, 3> s, t;
    for (auto& p : s) p = {anywhere(random), anywhere(random)};
    for (auto& p : t) p = {0.3 * anywhere(random), 0.3 * anywhere(random)};
    const double expected = overlap_by_its_corners(s, t);
    EXPECT_NEAR(overlap_area(s, t), expected, 1e-13);
    EXPECT_NEAR(overlap_area(t, s), expected, 1e-13);
    empty += expected == 0.0;
    whole += std::abs(expected - std::abs(area(t[0], t[1], t[2]))) < 1e-13;
  }
  EXPECT_GT(empty, 100);
  EXPECT_GT(whole, 20);
}

}  // namespace
}  // namespace kinemesh
