// Files of named sections: what was written comes back, and all else is refused by name.
#include "sim/run/sections.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "tests/sim/run/section_file.h"

namespace kinemesh::binary {
namespace {

using test::SectionFile;
using testing::HasSubstr;
using testing::StartsWith;

constexpr FileKind kind{"KMEXAMPL", "example", "throw it away"};

std::string example() {
  SectionWriter writer;
  writer({"text", 3}, std::string("ab"), 258);
  writer({"empty", 1});
  writer({"numbers", 7}, 1.0, std::vector<Edge>{{1, -1}}, true);
  return std::move(writer).file(kind);
}

// What is said of a file that should be the example.
std::string error_of(std::string_view file) {
  try {
    SectionReader reader(kind, file);
    std::string text;
    int number = 0;
    double real = 0.0;
    std::vector<Edge> edges;
    bool is_true = false;
    reader({"text", 3}, text, number);
    reader({"empty", 1});
    reader({"numbers", 7}, real, edges, is_true);
    reader.expect_end();
    const bool is_same =
        text == "ab" && number == 258 && real == 1.0 && edges == std::vector<Edge>{{1, -1}} && is_true;
    return is_same ? "none" : "other values";
  } catch (const InputError& error) {
    return error.what();
  }
}

std::string error_with(const std::function<void(SectionFile&)>& change) {
  SectionFile file = test::taken_apart(example());
  change(file);
  return error_of(test::joined(file));
}

TEST(Sections, ComeBack) {
  EXPECT_EQ(error_of(example()), "none");
}

TEST(Sections, AreLaidOutAsDocumented) {
  const SectionFile file{"KMEXAMPL",
                         6,
                         {{"text", 3, std::string("\x02\0\0\0\0\0\0\0ab\x02\x01\0\0", 14)},
                          {"empty", 1, ""},
                          {"numbers", 7,
                           std::string("\0\0\0\0\0\0\xf0\x3f"
                                       "\x01\0\0\0\0\0\0\0\x01\0\0\0\xff\xff\xff\xff\x01",
                                       25)}}};
  EXPECT_EQ(example(), test::joined(file));
}

TEST(Sections, ComeInAnyOrder) {
  EXPECT_EQ(error_with([](SectionFile& file) { std::swap(file.sections[0], file.sections[2]); }), "none");
}

TEST(Sections, AreRefusedByName) {
  EXPECT_EQ(error_with([](SectionFile& file) { file["text"].version = 4; }),
            "section 'text' has version 4, this program reads 3");
  EXPECT_EQ(error_with([](SectionFile& file) { file["text"].name = "texts"; }), "has no section 'text'");
  EXPECT_EQ(error_with([](SectionFile& file) { file.sections.erase(file.sections.begin() + 1); }),
            "has no section 'empty'");
  EXPECT_EQ(error_with([](SectionFile& file) { file["bodies"].contents = "xyz"; }),
            "section 'bodies' is unknown to this program");
  EXPECT_EQ(error_with([](SectionFile& file) { file["\n\x1b[31m"].version = 2; }),
            "section '\\n\\x1b[31m' is unknown to this program");
  EXPECT_EQ(error_with([](SectionFile& file) { file.sections.push_back(file["empty"]); }),
            "is damaged: it has section 'empty' twice");
}

TEST(Sections, HoldExactlyWhatIsRead) {
  EXPECT_EQ(error_with([](SectionFile& file) { file["numbers"].contents += 'x'; }),
            "section 'numbers': more bytes than expected");
  EXPECT_EQ(error_with([](SectionFile& file) { file["text"].contents.pop_back(); }),
            "section 'text': ends too early");
  EXPECT_EQ(error_with([](SectionFile& file) { file["empty"].contents = "x"; }),
            "section 'empty': more bytes than expected");
}

TEST(Sections, CountsThatLieTakeNoMemory) {
  for (const int byte : {0, 3, 6, 7}) {
    EXPECT_EQ(error_with([&](SectionFile& file) { file["numbers"].contents[8 + byte] = '\x7f'; }),
              "section 'numbers': a count it has no room for");
    EXPECT_EQ(error_with([&](SectionFile& file) { file["text"].contents[byte] = '\x7f'; }),
              "section 'text': a count it has no room for");
  }
}

// The length of the table, that of a section, and the number of sections.
TEST(Sections, LengthsThatLieTakeNoMemory) {
  const std::string whole = example();
  const std::size_t table_length = whole[12];
  const auto lying = [&](std::size_t place, char value) {
    std::string file = whole;
    file[place] = value;
    const std::string head = file.substr(0, 20 + table_length);
    return error_of(head + test::crc_of(head) + file.substr(24 + table_length));
  };
  for (const int byte : {0, 1, 3, 7}) {
    std::string file = whole;
    file[12 + byte] = '\x7f';
    EXPECT_THAT(error_of(file), StartsWith("is damaged")) << byte;
    EXPECT_THAT(lying(20 + byte, '\x7f'), StartsWith("is damaged: its table of contents: ")) << byte;
    EXPECT_THAT(lying(28 + byte, '\x7f'), StartsWith("is damaged: its table of contents: ")) << byte;
    EXPECT_THAT(lying(28 + 8 + 4 + 4 + byte, '\x7f'),
                testing::AllOf(StartsWith("is damaged"), HasSubstr("more, in section 'text', expected")));
  }
}

TEST(Sections, AnOlderFileIsRefusedWithWhatToDo) {
  for (char layout = 1; layout <= 5; ++layout) {
    std::string old = example();
    old[8] = layout;
    EXPECT_EQ(error_of(old), "has layout " + std::to_string(int{layout}) +
                                 ", this program reads 6: an older version has written it; throw it away");
  }
  EXPECT_EQ(error_with([](SectionFile& file) { file.layout = 7; }),
            "has layout 7, this program reads 6: it is damaged, or a later version has written it");
  EXPECT_EQ(error_with([](SectionFile& file) { file.magic = "KMCHKPT\n"; }), "is no example");
}

TEST(Sections, AreRefusedWithAnyBitChanged) {
  const std::string whole = example();
  for (std::size_t i = 0; i < whole.size(); ++i)
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = whole;
      damaged[i] = static_cast<char>(damaged[i] ^ 1 << bit);
      EXPECT_THAT(error_of(damaged), StartsWith(i < 8    ? "is no example"
                                                : i < 12 ? "has layout "
                                                         : "is damaged"))
          << i << " " << bit;
    }
}

TEST(Sections, AreRefusedWithAnyFourBytesChanged) {
  const std::string whole = example();
  std::mt19937_64 random(1);
  for (std::size_t i = 0; i + 4 <= whole.size(); ++i)
    for (int n = 0; n < 100; ++n) {
      std::string damaged = whole;
      for (int k = 0; k < 4; ++k) damaged[i + k] = static_cast<char>(random());
      EXPECT_EQ(error_of(damaged) == "none", damaged == whole) << i;
    }
}

TEST(Sections, AreRefusedWithAnyOtherLength) {
  const std::string whole = example();
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_THAT(error_of(whole.substr(0, length)), StartsWith(length < 8 ? "is no example" : "is damaged"));
  EXPECT_EQ(error_of(whole + '\0'), "is damaged: " + std::to_string(whole.size() + 1) + " bytes long, " +
                                        std::to_string(whole.size()) + " expected");
}

}  // namespace
}  // namespace kinemesh::binary
