#include "motion/fields/expression.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <cmath>

namespace kinemesh {
namespace {

using testing::AllOf;
using testing::HasSubstr;

double value(const std::string& text, double x = 0.0, double y = 0.0, double t = 0.0) {
  return Formula("u", text)(Point(x, y), t);
}

TEST(Formula, KnowsPositionTimeAndTheUsualFunctions) {
  EXPECT_EQ(value("x + 10*y + 100*t", 1, 2, 3), 321.0);
  EXPECT_DOUBLE_EQ(value("-sin(pi*x)^2 * sin(2*pi*y)", 0.3, 0.1),
                   -std::pow(std::sin(M_PI * 0.3), 2) * std::sin(2 * M_PI * 0.1));
  EXPECT_EQ(value("x < 0.5 ? 1 : 2", 0.4), 1.0);
  EXPECT_EQ(value("(x == 1) && (y >= 2)", 1, 2), 1.0);
  EXPECT_DOUBLE_EQ(value("exp(1) + sqrt(4) + abs(-3) + min(1,2)"), std::exp(1.0) + 6.0);
}

TEST(Formula, MayBeInfinite) {
  EXPECT_TRUE(std::isinf(value("1/x")));
}

TEST(Formula, EvaluatesInManyThreads) {
  const Formula f("u", "x*1000 + y - t");
  std::atomic<int> wrong = 0;
  tbb::parallel_for(0, 200'000, [&](int i) {
    if (f(Point(i, i % 7), i % 3) != 1000.0 * i + i % 7 - i % 3) ++wrong;
  });
  EXPECT_EQ(wrong, 0);
}

std::string refusal(const std::string& text) {
  try {
    Formula("dx", text);
  } catch (const ParameterError& error) {
    EXPECT_EQ(error.key(), "dx");
    return error.what();
  }
  ADD_FAILURE() << text << " was accepted";
  return {};
}

TEST(Formula, RefusesByNameAndPosition) {
  EXPECT_THAT(refusal("1 + foo"),
              AllOf(HasSubstr("dx = \"1 + foo\": "), HasSubstr("foo"), HasSubstr("at character 5")));
  EXPECT_THAT(refusal("sin(x"), AllOf(HasSubstr("arenthesis"), HasSubstr("at character 6")));
  EXPECT_THAT(refusal("x + * y"), HasSubstr("at character 5"));
  EXPECT_THAT(refusal("x +"), HasSubstr("at character 4"));
  EXPECT_THAT(refusal(""), HasSubstr("at character 1"));
  EXPECT_THAT(refusal("x, y"), AllOf(HasSubstr("more than one formula"), HasSubstr("at character 2")));
  EXPECT_THAT(refusal("1 + (x = 3)"), AllOf(HasSubstr("assignment"), HasSubstr("at character 8")));
  EXPECT_THAT(refusal("x += 3"), HasSubstr("at character 4"));
  EXPECT_THAT(refusal("\"text\""), HasSubstr("at character"));
}

TEST(ExpressionFields, TakeOneFormulaPerComponent) {
  const ExpressionVelocity velocity("-y", "x*t");
  EXPECT_EQ(velocity.velocity({2.0, 3.0}, 5.0), Point(-3.0, 10.0));
  const ExpressionDisplacement displacement("0.1*sin(t)", "x");
  EXPECT_EQ(displacement.displacement({2.0, 3.0}, 0.0), Point(0.0, 2.0));
  EXPECT_EQ(displacement.name(), "displacement");
}

TEST(ExpressionFields, NameTheComponentThatIsWrong) {
  const auto key = [](auto&& make) {
    try {
      make();
    } catch (const ParameterError& error) {
      return error.key();
    }
    return std::string();
  };
  EXPECT_EQ(key([] { ExpressionVelocity("1", "+"); }), "v");
  EXPECT_EQ(key([] { ExpressionDisplacement("(", "1"); }), "dx");
}

}  // namespace
}  // namespace kinemesh
