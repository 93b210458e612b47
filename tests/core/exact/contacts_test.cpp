// Contacts of segments and triangles against exact clipping, on small grids where degeneracy is the rule.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "kinemesh/predicates.h"
#include "tests/core/exact/exact_oracle.h"

namespace kinemesh {
namespace {

using Random = std::mt19937_64;

// Six vertices of a small grid; a case takes its segments and triangles from them, so that vertices are
// shared often.
struct Vertices {
  std::array<Point, 6> place;

  Vertices(Random& random, int size) {
    for (Point& p : place) {
      p = {static_cast<double>(random() % static_cast<unsigned>(size + 1)),
           static_cast<double>(random() % static_cast<unsigned>(size + 1))};
    }
  }

  Segment segment(int a, int b) const { return {place[a], place[b], a, b}; }
  NumberedTriangle corners(int a, int b, int c) const { return {{place[a], place[b], place[c]}, {a, b, c}}; }
};

std::array<int, 6> shuffled(Random& random) {
  std::array<int, 6> order{0, 1, 2, 3, 4, 5};
  for (int i = 5; i > 0; --i) std::swap(order[i], order[random() % static_cast<unsigned>(i + 1)]);
  return order;
}

std::string text(const Vertices& vertices) {
  std::string result;
  for (const Point& p : vertices.place)
    result += " (" + std::to_string(p.x) + "," + std::to_string(p.y) + ")";
  return result;
}

// Another place, size and orientation of the same figure, exact.
Point transformed(const Point& p, int how) {
  switch (how) {
    case 1:
      return {-p.y, p.x};
    case 2:
      return {p.y, p.x};
    case 3:
      return p * 0x1p-1074;
    case 4:
      return p * 0x1p-530;
    case 5:
      return p * 0x1p1020;
    case 6:
      return {p.x * 0x1p900, p.y * 0x1p-900};
    case 7:
      return p + Point{0x1p50, -0x1p51};
    default:
      return p;
  }
}
constexpr int n_transformations = 8;

Segment transformed(Segment s, int how) {
  return {transformed(s.a, how), transformed(s.b, how), s.va, s.vb};
}

NumberedTriangle transformed(NumberedTriangle t, int how) {
  for (Point& p : t.p) p = transformed(p, how);
  return t;
}

Segment reversed(const Segment& s) {
  return {s.b, s.a, s.vb, s.va};
}

NumberedTriangle turned(const NumberedTriangle& t) {
  return {{t.p[1], t.p[2], t.p[0]}, {t.v[1], t.v[2], t.v[0]}};
}
NumberedTriangle flipped(const NumberedTriangle& t) {
  return {{t.p[1], t.p[0], t.p[2]}, {t.v[1], t.v[0], t.v[2]}};
}

// Runs `check(vertices, order)` on seeded cases: grids of 3x3 to 7x7 points, each also transformed by the
// check.
template <class Check>
void sweep(int cases, std::uint64_t seed, Check check) {
  Random random(seed);
  for (int i = 0; i < cases && !testing::Test::HasFailure(); ++i) {
    const Vertices vertices(random, 2 + i % 5);
    check(vertices, shuffled(random));
    if (testing::Test::HasFailure()) ADD_FAILURE() << "case " << i << ":" << text(vertices);
  }
}

TEST(Contacts, of_segments) {
  int touching = 0;
  for (int n_shared = 0; n_shared <= 2; ++n_shared) {
    sweep(20000, 1 + n_shared, [&](const Vertices& vertices, const std::array<int, 6>& v) {
      const Segment s = vertices.segment(v[0], v[1]);
      const Segment t = vertices.segment(v[2 - n_shared], v[3 - n_shared]);
      const bool expected = oracle::segments_touch(s, t);
      touching += expected ? 1 : 0;
      for (int how = 0; how < n_transformations; ++how) {
        const Segment a = transformed(s, how), b = transformed(t, how);
        EXPECT_EQ(segments_touch(a, b), expected) << how;
        EXPECT_EQ(segments_touch(b, reversed(a)), expected) << how;
      }
    });
  }
  EXPECT_GT(touching, 10000);
  EXPECT_LT(touching, 30000);
}

TEST(Contacts, crossing_segments) {
  int crossing = 0;
  sweep(20000, 5, [&](const Vertices& vertices, const std::array<int, 6>& v) {
    const Segment s = vertices.segment(v[0], v[1]), t = vertices.segment(v[2], v[3]);
    const bool expected = oracle::segments_cross(s.a, s.b, t.a, t.b);
    crossing += expected ? 1 : 0;
    for (int how = 0; how < n_transformations; ++how) {
      const Segment a = transformed(s, how), b = transformed(t, how);
      EXPECT_EQ(segments_cross(a.a, a.b, b.a, b.b), expected) << how;
      EXPECT_EQ(segments_cross(b.b, b.a, a.a, a.b), expected) << how;
    }
  });
  EXPECT_GT(crossing, 1000);
}

TEST(Contacts, of_points) {
  sweep(20000, 6, [](const Vertices& vertices, const std::array<int, 6>&) {
    const auto& p = vertices.place;
    const oracle::Hull point = oracle::hull(p[0], p[0]);
    const bool on = !oracle::intersection(point, oracle::hull(p[1], p[2])).empty();
    const std::array<Point, 3> t{p[1], p[2], p[3]};
    const bool in = !oracle::intersection(point, oracle::hull(t)).empty() && !on_segment(p[0], p[1], p[2]) &&
                    !on_segment(p[0], p[2], p[3]) && !on_segment(p[0], p[3], p[1]);
    for (int how = 0; how < n_transformations; ++how) {
      std::array<Point, 6> q;
      std::transform(p.begin(), p.end(), q.begin(), [&](const Point& x) { return transformed(x, how); });
      EXPECT_EQ(on_segment(q[0], q[1], q[2]), on) << how;
      EXPECT_EQ(strictly_inside(q[0], {q[1], q[2], q[3]}), in) << how;
      EXPECT_EQ(strictly_inside(q[0], {q[2], q[1], q[3]}), in) << how;
    }
  });
}

TEST(Contacts, of_a_segment_with_a_triangle) {
  int touching = 0;
  for (int n_shared = 0; n_shared <= 2; ++n_shared) {
    sweep(15000, 10 + n_shared, [&](const Vertices& vertices, const std::array<int, 6>& v) {
      const Segment s = vertices.segment(v[0], v[1]);
      const NumberedTriangle t = vertices.corners(v[2 - n_shared], v[3 - n_shared], v[4 - n_shared]);
      const bool expected = oracle::touches(s, t);
      touching += expected ? 1 : 0;
      for (int how = 0; how < n_transformations; ++how) {
        const Segment a = transformed(s, how);
        const NumberedTriangle b = transformed(t, how);
        EXPECT_EQ(touches(a, b), expected) << how;
        EXPECT_EQ(touches(reversed(a), turned(b)), expected) << how;
        EXPECT_EQ(touches(a, flipped(b)), expected) << how;
      }
    });
  }
  EXPECT_GT(touching, 10000);
  EXPECT_LT(touching, 30000);
}

// The walk's rules (ii) and (iii), side by side: this is what touches(Segment, NumberedTriangle) has to
// decide in one go.
TEST(Contacts, of_a_segment_are_its_contacts_with_the_sides_and_the_interior) {
  for (int n_shared = 0; n_shared <= 1; ++n_shared) {
    sweep(15000, 20 + n_shared, [&](const Vertices& vertices, const std::array<int, 6>& v) {
      const Segment s = vertices.segment(v[0], v[1]);
      const NumberedTriangle t = vertices.corners(v[2 - n_shared], v[3 - n_shared], v[4 - n_shared]);
      bool by_sides = strictly_inside(s.a, t.p) || strictly_inside(s.b, t.p);
      for (int k = 0; k < 3; ++k) {
        const Segment g = vertices.segment(t.v[k], t.v[(k + 1) % 3]);
        by_sides = by_sides || oracle::segments_touch(s, g);
      }
      EXPECT_EQ(touches(s, t), by_sides);
    });
  }
}

TEST(Contacts, of_triangles) {
  int touching = 0;
  for (int n_shared = 0; n_shared <= 3; ++n_shared) {
    sweep(10000, 30 + n_shared, [&](const Vertices& vertices, const std::array<int, 6>& v) {
      const NumberedTriangle s = vertices.corners(v[0], v[1], v[2]);
      const NumberedTriangle t = vertices.corners(v[3 - n_shared], v[4 - n_shared], v[5 - n_shared]);
      const bool expected = oracle::touches(s, t);
      touching += expected ? 1 : 0;
      for (int how = 0; how < n_transformations; ++how) {
        const NumberedTriangle a = transformed(s, how), b = transformed(t, how);
        EXPECT_EQ(touches(a, b), expected) << how;
        EXPECT_EQ(touches(flipped(b), turned(a)), expected) << how;
      }
    });
  }
  EXPECT_GT(touching, 10000);
  EXPECT_LT(touching, 30000);
}

TEST(Contacts, overlapping_interiors) {
  int overlapping = 0;
  for (int n_shared = 0; n_shared <= 3; ++n_shared) {
    sweep(10000, 40 + n_shared, [&](const Vertices& vertices, const std::array<int, 6>& v) {
      const NumberedTriangle s = vertices.corners(v[0], v[1], v[2]);
      const NumberedTriangle t = vertices.corners(v[3 - n_shared], v[4 - n_shared], v[5 - n_shared]);
      const bool expected = oracle::interiors_overlap(s.p, t.p);
      overlapping += expected ? 1 : 0;
      for (int how = 0; how < n_transformations; ++how) {
        const NumberedTriangle a = transformed(s, how), b = transformed(t, how);
        EXPECT_EQ(interiors_overlap(a.p, b.p), expected) << how;
        EXPECT_EQ(interiors_overlap(flipped(b).p, turned(a).p), expected) << how;
      }
    });
  }
  EXPECT_GT(overlapping, 10000);
}

TEST(Contacts, different_vertices_at_one_place) {
  const Point o{0, 0}, p{1, 0}, q{0, 1};
  EXPECT_TRUE(segments_touch({o, p, 0, 1}, {o, q, 2, 3}));
  EXPECT_FALSE(segments_touch({o, p, 0, 1}, {o, q, 0, 3}));
  EXPECT_TRUE(segments_touch({o, o, 0, 1}, {o, q, 0, 3}));
  EXPECT_TRUE(touches(Segment{o, o, 0, 9}, NumberedTriangle{{o, p, q}, {0, 1, 2}}));
  EXPECT_FALSE(touches(Segment{o, {-1, 0}, 0, 9}, NumberedTriangle{{o, p, q}, {0, 1, 2}}));
  EXPECT_TRUE(touches(Segment{o, {-1, 0}, 8, 9}, NumberedTriangle{{o, p, q}, {0, 1, 2}}));
}

TEST(Contacts, shared_corner_on_the_opposite_side_of_a_flat_triangle) {
  const NumberedTriangle flat{{Point{0, 0}, {-1, 0}, {1, 0}}, {0, 1, 2}};
  EXPECT_TRUE(touches(Segment{{0, 0}, {0, 1}, 0, 9}, flat));
  EXPECT_FALSE(touches(Segment{{1, 0}, {0, 1}, 2, 9}, flat));
  EXPECT_FALSE(touches(Segment{{-1, 0}, {1, 0}, 1, 2}, flat));  // a side
}

}  // namespace
}  // namespace kinemesh
