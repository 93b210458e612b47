// What people are shown is one line of well-formed text that no terminal obeys.
#include "core/base/printable.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "core/base/utf8.h"

namespace kinemesh {
namespace {

// By the code points, from the standards' lists rather than from our ranges.
bool has_power(char32_t c) {
  const bool is_control = c < 0x20 || (0x7F <= c && c <= 0x9F);
  const bool parts_lines = c == 0x2028 || c == 0x2029;
  const bool turns_text = c == 0x061C || c == 0x200E || c == 0x200F || (0x202A <= c && c <= 0x202E) ||
                          (0x2066 <= c && c <= 0x2069);
  const bool is_forbidden_in_xml = c == 0xFFFE || c == 0xFFFF;
  return is_control || parts_lines || turns_text || is_forbidden_in_xml;
}

std::string encoded(char32_t c) {
  const auto rest = [&](int shift) { return static_cast<char>(0x80 | (c >> shift & 0x3F)); };
  if (c < 0x80) return {static_cast<char>(c)};
  if (c < 0x800) return {static_cast<char>(0xC0 | c >> 6), rest(0)};
  if (c < 0x10000) return {static_cast<char>(0xE0 | c >> 12), rest(6), rest(0)};
  return {static_cast<char>(0xF0 | c >> 18), rest(12), rest(6), rest(0)};
}

TEST(Printable, EveryCharacterIsKeptOrSpeltOut) {
  for (char32_t c = 0; c <= 0x10FFFF; ++c) {
    if (0xD800 <= c && c <= 0xDFFF) continue;  // no characters
    const std::string text = encoded(c), shown = printable(text);
    ASSERT_EQ(utf8_length(text), text.size()) << std::hex << static_cast<unsigned>(c);
    ASSERT_EQ(utf8_character(text), c);
    if (shown == text) {
      ASSERT_FALSE(has_power(c)) << std::hex << static_cast<unsigned>(c);
    } else {
      ASSERT_EQ(shown[0], '\\');
      ASSERT_TRUE(std::ranges::all_of(shown, [](char d) { return d >= ' ' && d < 0x7F; })) << shown;
    }
  }
}

TEST(Printable, EscapesTellWhatWasThere) {
  EXPECT_EQ(printable("\x1b]0;title\x07"), "\\x1b]0;title\\x07");
  EXPECT_EQ(printable("a\nb\rc\td"), "a\\nb\\rc\\td");
  EXPECT_EQ(printable("na\xefve"), "na\\xefve");
  EXPECT_EQ(printable("\xe2\x80\xae"
                      "abc"),
            "\\u202eabc");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\u009b31m");
  EXPECT_EQ(printable("\xf0\x9f\xbf\xbf"), "\\U0001ffff");
  EXPECT_EQ(printable(std::string_view("\0x", 2)), "\\x00x");
}

TEST(Printable, OrdinaryTextIsKept) {
  for (const std::string text : {"", "wall", "C:\\meshes\\n", "Flügel", "крыло", "翼 🛩", "a'b\"c`d$e"})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, IsCutBetweenCharacters) {
  EXPECT_EQ(printable("wall", 4), "wall");
  EXPECT_EQ(printable("walls", 4), "wall...");
  EXPECT_EQ(printable("\xc3\xa9\xc3\xa9\xc3\xa9", 2), "\xc3\xa9\xc3\xa9...");
  EXPECT_EQ(printable("a\n", 2), "a\\...");
  EXPECT_EQ(printable("", 0), "");
}

TEST(Printable, WhatIsNoUtf8IsSpeltOutByteForByte) {
  for (const std::string text :
       {"\x80", "\xc0\x80", "\xe0\x80\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xc3", "\xe2\x80"}) {
    std::string expected;
    for (const char c : text) {
      constexpr char digits[] = "0123456789abcdef";
      const auto byte = static_cast<unsigned char>(c);
      expected += {'\\', 'x', digits[byte / 16], digits[byte % 16]};
    }
    EXPECT_EQ(printable(text), expected);
  }
}

RC_GTEST_PROP(Printable, OfAnyBytesIsWellFormedAndStaysAsItIs, (const std::string& bytes)) {
  const std::string shown = printable(bytes);
  RC_ASSERT(is_utf8(shown));
  RC_ASSERT(printable(shown) == shown);
  for (std::string_view rest = shown; !rest.empty(); rest.remove_prefix(utf8_length(rest)))
    RC_ASSERT(!has_power(utf8_character(rest.substr(0, utf8_length(rest)))));
}

}  // namespace
}  // namespace kinemesh
