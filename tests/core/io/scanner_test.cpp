#include "core/io/scanner.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <limits>

namespace kinemesh::io {
namespace {

double number(std::string_view word) {
  return to_number(word, "number");
}

std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Number, EveryDoubleSurvivesItsShortestText) {
  EXPECT_TRUE(rc::check("bits", [](std::uint64_t bits) {
    const double x = std::bit_cast<double>(bits);
    RC_PRE(std::isfinite(x));
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, x).ptr;
    RC_ASSERT(std::bit_cast<std::uint64_t>(number({text, static_cast<std::size_t>(end - text)})) == bits);
  }));
}

TEST(Number, FormsThatParse) {
  EXPECT_EQ(number("+1"), 1.0);
  EXPECT_EQ(number("1."), 1.0);
  EXPECT_EQ(number(".5"), 0.5);
  EXPECT_EQ(number("-.5E+01"), -5.0);
  EXPECT_EQ(number("1e+2"), 100.0);
  EXPECT_EQ(number("0e99999999999999999999"), 0.0);
  EXPECT_EQ(number(std::string(400, '0') + "1"), 1.0);
}

TEST(Number, TooSmallIsZeroWithItsSign) {
  for (const char* text : {"1e-400", "0.0000001e-330", "1e-99999999999999999999"})
    EXPECT_EQ(number(text), 0.0) << text;
  EXPECT_EQ(number("0." + std::string(400, '0') + "1"), 0.0);
  EXPECT_TRUE(std::signbit(number("-1e-400")));
  EXPECT_EQ(number("4.9406564584124654e-324"), 5e-324);
  EXPECT_EQ(number("1" + std::string(350, '0') + "e-800"), 0.0);
}

TEST(Number, TooLargeIsRefused) {
  const std::string long_number = "1" + std::string(400, '0');
  for (const std::string& text : {std::string("1e400"), std::string("-1e309"), std::string("1.8e308"),
                                  long_number, long_number + "e-5", "0.001e" + std::string(30, '9')}) {
    EXPECT_NE(refusal([&] { number(text); }).find("larger than any double"), std::string::npos) << text;
  }
  EXPECT_EQ(number(long_number + "e-400"), 1.0);
}

TEST(Number, NotFiniteIsRefused) {
  for (const char* text : {"nan", "NaN", "inf", "-inf", "Infinity", "+inf", "-nan(0x1)"}) {
    EXPECT_NE(refusal([&] { number(text); }).find("not finite"), std::string::npos) << text;
  }
}

TEST(Number, OtherWordsAreRefused) {
  for (const char* text :
       {"", "+", "-", "+-1", "++1", "-+1", "1,5", "0x10", "1d5", "1e", "1e+", "one", "1.2.3", "1_0"}) {
    EXPECT_NE(refusal([&] { number(text); }).find("is not a number, expected number"), std::string::npos)
        << text;
  }
}

TEST(Integer, FormsAndRefusals) {
  EXPECT_EQ(to_integer("+7", "count"), 7);
  EXPECT_EQ(to_integer("-9223372036854775808", "count"), std::numeric_limits<long long>::min());
  for (const char* text : {"", "1.0", "1e3", "+-1", "0x1", "7a"}) {
    EXPECT_NE(refusal([&] { to_integer(text, "count"); }).find("not a whole number"), std::string::npos)
        << text;
  }
  EXPECT_NE(refusal([] { to_integer("9223372036854775808", "count"); }).find("out of range"),
            std::string::npos);
}

TEST(Scanner, CountsLinesAndSkipsComments) {
  Scanner scanner("one # two\n\n  # three\r\n four\tfive", "file", '#');
  EXPECT_EQ(scanner.word("a word"), "one");
  EXPECT_EQ(scanner.line(), 1);
  EXPECT_TRUE(scanner.at_line_end());
  EXPECT_EQ(scanner.word("a word"), "four");
  EXPECT_EQ(scanner.line(), 4);
  EXPECT_FALSE(scanner.at_line_end());
  EXPECT_EQ(scanner.rest_of_line(), "five");
  EXPECT_TRUE(scanner.at_end());
  EXPECT_EQ(refusal([&] { scanner.word("a sixth"); }), "file:4: the file ends, expected a sixth");
}

TEST(Scanner, RefusesCountsTheRestCannotHold) {
  EXPECT_EQ(Scanner("3 1 2 3", "file").count("count", 2), 3);
  EXPECT_EQ(refusal([] { Scanner("5 1 2 3", "file").count("count", 2); }),
            "file:1: 5 as count is more than the rest of the file can hold");
  EXPECT_EQ(refusal([] { Scanner("-1", "file").count("count", 2); }),
            "file:1: -1 is negative, expected count");
  EXPECT_EQ(refusal([] { Scanner("9999999999", "file").count("count", 2); }),
            "file:1: 9999999999 is more than 268435455, the largest count");
}

TEST(Scanner, QuotesStrangeBytes) {
  EXPECT_EQ(in_quotes("a\x01\xff"), "'a\\x01\\xff'");
  EXPECT_EQ(in_quotes(std::string(100, 'x')), "'" + std::string(40, 'x') + "...'");
}

}  // namespace
}  // namespace kinemesh::io
