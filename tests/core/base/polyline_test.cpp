#include "kinemesh/detail/polyline.h"

#include <gtest/gtest.h>

#include <limits>

#include "kinemesh/error.h"

namespace kinemesh::test {
namespace {

TEST(Polyline, GoesOnStraightWhereItIsOpen) {
  const Polyline line({{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}});
  EXPECT_FALSE(line.is_closed());
  EXPECT_EQ(line.length(), 3.0);
  EXPECT_EQ(line.at(2.5), Point(2.0, 0.5));
  EXPECT_EQ(line.at(-1.0), Point(-1.0, 0.0));
  EXPECT_EQ(line.at(5.0), Point(2.0, 3.0));
  EXPECT_EQ(line.parameter_near({2.5, -0.5}), 2.0);
  EXPECT_EQ(line.parameter_near({2.5, 4.0}), 6.0);
  EXPECT_EQ(line.tangent_near({3.0, 0.5}), Point(0.0, 1.0));
  EXPECT_EQ(line.way(2.5, 0.0), -2.5);
}

TEST(Polyline, GoesRoundWhereItIsClosed) {
  const Polyline square({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}, {0.0, 0.0}});
  EXPECT_TRUE(square.is_closed());
  EXPECT_EQ(square.length(), 4.0);
  EXPECT_EQ(square.at(4.5), Point(0.5, 0.0));
  EXPECT_EQ(square.at(-0.5), Point(0.0, 0.5));
  EXPECT_EQ(square.parameter_near({-1.0, 0.25}), 3.75);
  EXPECT_EQ(square.way(3.5, 0.5), 1.0);
  EXPECT_EQ(square.way(0.5, 3.5), -1.0);
}

TEST(Polyline, HasTwoPointsAtLeastAndSegmentsOfALength) {
  EXPECT_THROW(Polyline({}), InputError);
  EXPECT_THROW(Polyline({{1.0, 2.0}}), InputError);
  EXPECT_THROW(Polyline({{1.0, 2.0}, {1.0, 2.0}}), InputError);
  EXPECT_THROW(Polyline({{1.0, 2.0}, {std::numeric_limits<double>::quiet_NaN(), 2.0}}), InputError);
}

}  // namespace
}  // namespace kinemesh::test
