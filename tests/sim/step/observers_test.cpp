// What observers are told is all that happened, and what they veto did not happen.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <stdexcept>

#include "kinemesh/build.h"
#include "kinemesh/stepper.h"
#include "kinemesh/validate.h"
#include "tests/sim/helpers.h"
#include "tests/sim/step/kicks.h"

namespace kinemesh {
namespace {

using test::all_ways;
using test::grid_with_hole;
using test::kicked;
using test::numbers_of;
using test::snapshot;
using test::stepper_on;
using test::two_labels;

// Directed edges of the faces without their opposites, and how often each label occurs.
struct Outline {
  std::map<UserEdge, int> border;
  std::map<int, int> labels;
  std::vector<UserVertex> vertices;
  bool operator==(const Outline&) const = default;

  void add(const std::array<UserVertex, 3>& t, int label) {
    for (int k = 0; k < 3; ++k) {
      const UserEdge side{t[k], t[(k + 1) % 3]}, opposite{side[1], side[0]};
      if (const auto other = border.find(opposite); other != border.end()) {
        if (--other->second == 0) border.erase(other);
      } else {
        ++border[side];
      }
      vertices.push_back(t[k]);
    }
    ++labels[label];
  }
  void finish() {
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  }
};

void expect_self_contained(const ChangedPatch& patch) {
  Outline before, after;
  for (const auto& change : patch.faces) {
    before.add(change.before, change.label_before);
    after.add(change.after, change.label_after);
  }
  before.finish();
  after.finish();
  EXPECT_EQ(before, after);
  EXPECT_EQ(patch.vertices, after.vertices);
}

// Keeps arrays of its own up to date by what it is told and nothing else.
struct Replica {
  MeshData data;
  int rewritten = 0, patches = 0;

  void follow(const StepChanges& changes) {
    std::vector<int> regions;
    for (const auto& patch : changes.patches) {
      expect_self_contained(patch);
      ++patches;
      regions.insert(regions.end(), patch.regions.begin(), patch.regions.end());
      for (const auto& change : patch.faces) apply(change);
    }
    for (const UserVertex u : Numbers<UserVertex>(data.n_vertices())) {
      EXPECT_EQ(changes.before(u), data.points[u]);
      data.points[u] = changes.after(u);
    }
    expect_each_region_once(changes, std::move(regions));
  }

  void apply(const FaceChange& change) {
    ASSERT_LT(change.face, data.n_faces());
    EXPECT_EQ(numbers_of(change.before), data.triangles[change.face]);
    EXPECT_EQ(change.label_before, data.labels[change.face]);
    data.triangles[change.face] = numbers_of(change.after);
    data.labels[change.face] = change.label_after;
    ++rewritten;
  }

  static void expect_each_region_once(const StepChanges& changes, std::vector<int> told) {
    std::sort(told.begin(), told.end());
    std::vector<int> expected;
    for (size_t r = 0; r < changes.repair.regions.size(); ++r) {
      const auto& region = changes.repair.regions[r];
      if (std::any_of(region.faces.begin(), region.faces.end(), [&](Face f) {
            return !changes.mesh.is_padding(f) &&
                   !std::binary_search(region.kept.begin(), region.kept.end(), f);
          }))
        expected.push_back(static_cast<int>(r));
    }
    EXPECT_EQ(told, expected);
  }
};

TEST(Observers, AreToldAllThatChangesAndNothingElseDoes) {
  for (const auto& options : all_ways()) {
    SCOPED_TRACE(test::name_of(options));
    std::mt19937 random(17);
    const auto data = two_labels(12);
    Stepper stepper = stepper_on(data, options);
    Replica replica{data};
    stepper.observe([&](const StepChanges& changes) { replica.follow(changes); });
    int flips = 0;
    for (int n = 0; n < 12; ++n) {
      const auto outcome = stepper.step(kicked(stepper, 0.02 + 0.008 * n, random), 0.5);
      ASSERT_TRUE(outcome) << outcome.defect->message();
      flips += outcome.record.repair.quality_flips;
      const auto domain = stepper.mesh().domain();
      ASSERT_EQ(domain.triangles, replica.data.triangles);
      ASSERT_EQ(domain.labels, replica.data.labels);
      ASSERT_EQ(domain.points, replica.data.points);
      ASSERT_FALSE(validate(stepper.mesh()));
    }
    EXPECT_GT(replica.rewritten, 50);
    EXPECT_GE(replica.patches, 12);
    if (options.quality == "angles") continue;  // flips where that helps
    EXPECT_EQ(flips > 0,
              options.quality == "delaunay" && options.strategy != "remesh");  // which is Delaunay already
  }
}

// Vertices are where the caller wants them, or were there before the quality pass moved them.
void expect_moves(const StepChanges& changes, const std::vector<Point>& wanted) {
  std::map<UserVertex, Point> moved;
  for (const auto& [vertex, before] : changes.moved_by_quality) moved.emplace(vertex, before);
  ASSERT_EQ(moved.size(), changes.moved_by_quality.size());
  EXPECT_TRUE(std::ranges::is_sorted(changes.moved_by_quality, {}, &QualityMove::vertex));
  for (const UserVertex u : Numbers<UserVertex>(static_cast<int>(wanted.size())))
    EXPECT_EQ(moved.contains(u) ? moved.at(u) : changes.after(u), wanted[u]) << u;
}

TEST(Observers, AreToldWhatTheQualityPassMoves) {
  for (const char* quality : {"none", "delaunay", "smooth", "angles"}) {
    SCOPED_TRACE(quality);
    std::mt19937 random(29);
    Stepper stepper = stepper_on(two_labels(12), {.quality = quality});
    std::vector<Point> next;
    std::size_t moved = 0;
    stepper.observe([&](const StepChanges& changes) {
      expect_moves(changes, next);
      moved += changes.moved_by_quality.size();
      EXPECT_GE(changes.repair.quality_moves, static_cast<int>(changes.moved_by_quality.size()));
    });
    for (int n = 0; n < 12; ++n) {
      next = kicked(stepper, 0.05, random);
      ASSERT_TRUE(stepper.step(next, 0.5));
    }
    EXPECT_EQ(moved > 50, quality == std::string("smooth") || quality == std::string("angles"));
  }
}

// Those that may fail, too, and whatever is registered one day.
TEST(Observers, AreToldAllThatAnyStrategyChanges) {
  for (const auto& strategy : strategies()) {
    if (strategy.name == "throwing") continue;  // of another test
    SCOPED_TRACE(strategy.name);
    std::mt19937 random(23);
    const auto data = two_labels(12);
    Stepper stepper = stepper_on(data, {.strategy = strategy.name});
    Replica replica{data};
    stepper.observe([&](const StepChanges& changes) { replica.follow(changes); });
    for (int n = 0; n < 12; ++n) {
      const auto before = snapshot(stepper.mesh());
      const auto outcome = stepper.step(kicked(stepper, 0.05, random), 0.5);
      if (!outcome) {
        ASSERT_EQ(snapshot(stepper.mesh()), before);
      }
      const auto domain = stepper.mesh().domain();
      ASSERT_EQ(domain.triangles, replica.data.triangles);
      ASSERT_EQ(domain.labels, replica.data.labels);
      ASSERT_EQ(domain.points, replica.data.points);
    }
  }
}

TEST(Observers, WhatTheyVetoDidNotHappen) {
  for (const auto& options : all_ways()) {
    SCOPED_TRACE(test::name_of(options));
    std::mt19937 random(7);  // no two vertices end in one corner
    Stepper stepper = stepper_on(two_labels(12), options), undisturbed = stepper_on(two_labels(12), options);
    bool is_against = false;
    stepper.observe([&](const StepChanges&) {
      if (is_against) throw std::runtime_error("no");
    });
    for (int n = 0; n < 12; ++n) {
      const auto before = snapshot(stepper.mesh());
      is_against = true;
      EXPECT_THROW((void)stepper.step(kicked(stepper, 0.1, random), 0.5), std::runtime_error);
      ASSERT_EQ(snapshot(stepper.mesh()), before);
      ASSERT_EQ(stepper.steps_done(), n);
      is_against = false;
      const auto next = kicked(stepper, 0.1, random);
      ASSERT_TRUE(stepper.step(next, 0.5));
      ASSERT_TRUE(undisturbed.step(next, 0.5));
      ASSERT_EQ(snapshot(stepper.mesh()), snapshot(undisturbed.mesh()));
      ASSERT_FALSE(validate(stepper.mesh()));
    }
    EXPECT_EQ(stepper.time(), 6.0);
  }
}

// Where faces that stay lie on either side of an edge, the rest touches itself there: then all goes.
TEST(Retaining, GivesUpWhereTheRestTouchesItself) {
  for (const unsigned seed : {6u, 7u, 8u, 9u}) {
    std::mt19937 random(seed);
    StepperOptions options{.strategy = "local"};
    options.retain = true;
    Stepper stepper = stepper_on(two_labels(12), options);
    for (int n = 0; n < 12; ++n) {
      (void)stepper.step(kicked(stepper, 0.1, random), 0.5);
      ASSERT_FALSE(validate(stepper.mesh())) << seed << " " << n;
    }
  }
}

TEST(Observers, AreNotCalledForAStepThatFails) {
  Stepper stepper = stepper_on(two_labels(8), {});
  int calls = 0;
  stepper.observe([&](const StepChanges&) { ++calls; });
  auto next = stepper.mesh().user_positions();
  next[10] = next[11];
  EXPECT_FALSE(stepper.step(next, 0.5));
  EXPECT_EQ(calls, 0);
  EXPECT_TRUE(stepper.step(stepper.mesh().user_positions(), 0.5));
  EXPECT_EQ(calls, 1);
}

TEST(Observers, SeeAStepThatChangesNoFace) {
  Stepper stepper = stepper_on(two_labels(8), {});
  stepper.observe([](const StepChanges& changes) {
    EXPECT_TRUE(changes.patches.empty());
    EXPECT_EQ(changes.step, 1);
    EXPECT_EQ(changes.time, 0.5);
    EXPECT_EQ(changes.dt, 0.5);
  });
  EXPECT_TRUE(stepper.step(stepper.mesh().user_positions(), 0.5));
}

TEST(Observers, HaveToBeCallable) {
  Stepper stepper = stepper_on(two_labels(4), {});
  EXPECT_THROW(stepper.observe(nullptr), InputError);
  EXPECT_TRUE(stepper.step(stepper.mesh().user_positions(), 0.5));
}

// A vertex that escapes takes faces from padding to the domain, or the other way.
TEST(Observers, SeeFacesThatLeaveTheDomain) {
  const auto data = grid_with_hole(8, 3, 5);
  Stepper stepper = stepper_on(data, {.allow_escaped = true});
  std::map<UserFace, Triangle> faces;
  for (const UserFace f : Numbers<UserFace>(data.n_faces())) faces[f] = data.triangles[f];
  int changed_sides = 0;
  stepper.observe([&](const StepChanges& changes) {
    for (const auto& patch : changes.patches)
      for (const auto& change : patch.faces) {
        changed_sides += change.label_before != change.label_after;
        if (change.label_before != padding_label) {
          EXPECT_EQ(faces.at(change.face), numbers_of(change.before));
        }
        faces.erase(change.face);
        if (change.label_after != padding_label) faces[change.face] = numbers_of(change.after);
      }
  });
  auto next = data.points;
  next[2 * 9 + 2] = {0.5, 0.5};  // into the hole
  const auto outcome = stepper.step(next, 0.5);
  ASSERT_TRUE(outcome) << outcome.defect->message();
  EXPECT_EQ(outcome.record.repair.escaped, 1);
  EXPECT_GT(changed_sides, 0);
  std::vector<Triangle> told;
  for (const auto& [number, corners] : faces) told.push_back(corners);
  EXPECT_EQ(told, stepper.mesh().domain().triangles);
}

TEST(Stepper, HoldsPositionsToBeMovedInPlace) {
  Stepper stepper = stepper_on(two_labels(8), {}), other = stepper_on(two_labels(8), {});
  const auto x = stepper.positions();
  EXPECT_EQ(std::vector<Point>(x.begin(), x.end()), stepper.mesh().user_positions());
  x[13] = {0.6, 0.3};  // through several faces
  const auto next = std::vector<Point>(x.begin(), x.end());
  ASSERT_TRUE(stepper.repair(0.5));
  ASSERT_TRUE(other.step(next, 0.5));
  EXPECT_EQ(snapshot(stepper.mesh()), snapshot(other.mesh()));
  EXPECT_EQ(stepper.time(), 0.5);

  x[13] = x[14];  // impossible: the move is taken back
  EXPECT_FALSE(stepper.repair());
  EXPECT_EQ(x[13], Point(0.6, 0.3));
  EXPECT_EQ(std::vector<Point>(x.begin(), x.end()), stepper.mesh().user_positions());
}

}  // namespace
}  // namespace kinemesh
