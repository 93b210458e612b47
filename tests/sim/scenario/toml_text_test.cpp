// Scenarios and overrides that are nested too deep, or are dear to parse, are refused before the parser sees
// them.
#include "sim/scenario/toml_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <toml++/toml.h>

#include <chrono>

#include "kinemesh/error.h"
#include "kinemesh/scenario.h"

namespace kinemesh {
namespace {

using testing::HasSubstr;

const std::string too_deep = "nested more than 256 deep";

std::string repeated(const std::string& text, int n) {
  std::string all;
  for (int i = 0; i < n; ++i) all += text;
  return all;
}

// Names with dots between.
std::string dotted(int n) {
  return repeated("a.", n - 1) + "a";
}

std::string error_of(const std::string& text) {
  try {
    check_toml(text, "a.toml");
    return "none";
  } catch (const InputError& error) {
    return error.what();
  }
}

struct Nested {
  const char* name;
  std::string (*text)(int depth);  // in line 3
};

void PrintTo(const Nested& nested, std::ostream* out) {
  *out << nested.name;
}

class TomlText : public testing::TestWithParam<Nested> {};

TEST_P(TomlText, IsAsDeepAsItMayBeAndNoDeeper) {
  const std::string good = "# a\n\n" + GetParam().text(256), bad = "# a\n\n" + GetParam().text(257);
  EXPECT_EQ(error_of(good), "none");
  EXPECT_NO_THROW(toml::parse(std::string_view(good)));
  EXPECT_EQ(error_of(bad), "a.toml:3: " + too_deep);
  EXPECT_EQ(error_of("# a\n\n" + GetParam().text(100'000)), "a.toml:3: " + too_deep);
}

const Nested kinds[] = {
    {"Header", [](int n) { return "[" + dotted(n) + "]\nb = 1\n"; }},
    {"HeaderOfAList", [](int n) { return "[[" + dotted(n) + "]]\nb = 1\n"; }},
    {"HeaderWithBlanks", [](int n) { return "  [ " + repeated("a . ", n - 1) + "a ] # b\n"; }},
    {"QuotedHeader", [](int n) { return "[" + repeated("\"]#.\\\"\".", n - 1) + "']#\"'" + "]\n"; }},
    {"DottedKey", [](int n) { return dotted(n) + " = 1\n"; }},
    {"QuotedKey", [](int n) { return repeated("'=[.'.", n - 1) + "\"=\\\"\" = 1\n"; }},
    {"Lists", [](int n) { return "a = " + repeated("[", n) + repeated("]", n) + "\n"; }},
    {"ListsBesideEachOther",
     [](int n) { return "a = " + repeated("[[],", n - 1) + "[]" + repeated("]", n - 1) + "\n"; }},
    {"InlineTables",
     [](int n) { return "a = " + repeated("{a = ", n - 1) + "{}" + repeated("}", n - 1) + "\n"; }},
    {"LaterKeysOfInlineTables",
     [](int n) { return "a = " + repeated("{b = {}, a = ", n - 1) + "{}" + repeated("}", n - 1) + "\n"; }},
    {"DottedKeysInInlineTables",
     [](int n) {
       return "a = " + repeated("{a.b = ", n / 2) + repeated("[", n % 2) + "1" + repeated("]", n % 2) +
              repeated("}", n / 2) + "\n";
     }},
    {"KeysAndListsTogether",
     [](int n) {
       return dotted(100) + " = {" + dotted(56) + " = " + repeated("[", n - 155) + repeated("]", n - 155) +
              "}\n";
     }},
    {"BehindStringsOfAllKinds",
     [](int n) {
       return "a = [\"[\\\"[#\", '[\\', \"\"\"[[\\\"\"\"[\"\"\"\"\", '''['['''''," + repeated("[", n - 1) +
              repeated("]", n - 1) + "]\n";
     }},
    {"BehindEmptyStrings",
     [](int n) {
       return "a = [\"\", '', \"\"\"\"\"\", ''''''," + repeated("[", n - 1) + repeated("]", n - 1) + "]\n";
     }},
    {"BehindAComment",
     [](int n) { return "a = " + repeated("[", n) + " # ]]]]]]]]]]\n" + repeated("]", n) + "\n"; }},
};

INSTANTIATE_TEST_SUITE_P(All, TomlText, testing::ValuesIn(kinds),
                         [](const auto& param) { return std::string(param.param.name); });

TEST(TomlText, HeaderKeyAndValueCountTogether) {
  const std::string text = "[" + dotted(100) + "] #\n" + dotted(101) + " = " + repeated("[", 56);
  EXPECT_EQ(error_of(text + repeated("]", 56)), "none");
  EXPECT_EQ(error_of(text + "[]" + repeated("]", 56)), "a.toml:2: " + too_deep);
}

TEST(TomlText, BracketsInStringsAndCommentsAreNoNesting) {
  const std::string open = repeated("[{a.", 300);
  for (const std::string& text :
       {"# " + open + "\na = 1\n", "a = '" + open + "'\n", "a = \"" + open + "\"\n",
        "a = '''\n" + open + "\n'''\n", "a = \"\"\"\n" + open + "\\\"\"\" \"\"\"\n", "'" + open + "' = 1\n",
        "[\"" + open + "\"]\n", "a = \"\\\"" + open + "\"\n"}) {
    EXPECT_EQ(error_of(text), "none") << text;
    EXPECT_NO_THROW(toml::parse(std::string_view(text)));
  }
}

TEST(TomlText, AByteOrderMarkHidesNothing) {
  EXPECT_EQ(error_of("\xEF\xBB\xBF[" + dotted(257) + "]"), "a.toml:1: " + too_deep);
}

TEST(TomlText, ManyTablesByDotsAreRefused) {
  std::string keys, headers, lists, inlined = "a = [";
  for (int i = 0; i < 2100; ++i) {
    const std::string n = std::to_string(i);
    keys += "a" + n + ".b = 1\n";
    headers += "[a" + n + ".b]\n";
    lists += "[[a" + n + "]]\n";
    inlined += "{a.b = 1},";
  }
  for (const std::string& text : {keys, headers, lists})
    EXPECT_THAT(error_of(text), HasSubstr("a.toml:2049: more"));
  EXPECT_THAT(error_of(inlined + "]"), HasSubstr("more than 2048 tables"));
  EXPECT_THAT(error_of(repeated("[[a]]\nb.c = 1\n", 2100)), HasSubstr("more than 2048 tables"));
}

TEST(TomlText, ManyOfAScenariosOwnTablesAreNot) {
  EXPECT_EQ(error_of(repeated("[[motion]]\nfield = 'swirl'\n", 10'000)), "none");
  std::string border;
  for (int i = 0; i < 10'000; ++i) border += "border.a" + std::to_string(i) + " = 'fixed'\n";
  EXPECT_EQ(error_of(border), "none");
  EXPECT_EQ(error_of("motion = [" + repeated("{field = 'swirl', on = 'all'},", 10'000) + "]\n"), "none");
}

TEST(TomlText, ValuesThatTakeFarMoreMemoryThanTheTextAreRefused) {
  EXPECT_THAT(error_of("a = [" + repeated("[0],", 2'000'000) + "]"), HasSubstr("so many values"));
  EXPECT_EQ(error_of("a = [" + repeated("[0.25, 0.75],", 2'000'000) + "]"), "none");
}

TEST(TomlText, ManyHeadersAndKeysAreQuick) {
  std::string text;
  for (int i = 0; i < 200'000; ++i) text += "[a" + std::to_string(i) + "]\nb = 1\n";
  const auto before = std::chrono::steady_clock::now();
  EXPECT_THROW((void)parse_scenario(text, "a.toml"), InputError);
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(10));
}

const std::string scenario =
    "[mesh]\nshape = 'square'\n[[motion]]\nfield = 'swirl'\n[time]\ndt = 0.1\nsteps = 10\n";

std::string scenario_error(const std::string& more, const std::vector<std::string>& overrides = {}) {
  try {
    (void)parse_scenario(scenario + more, "a.toml", overrides);
    return "none";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(TomlText, DeepScenariosAreRefused) {
  EXPECT_EQ(scenario_error("[" + dotted(35'000) + "]\n"), "a.toml:8: " + too_deep);
  EXPECT_THAT(scenario_error("[" + dotted(256) + "]\n"), HasSubstr("unknown key 'a'"));
}

TEST(TomlText, DeepOverridesAreRefused) {
  EXPECT_EQ(scenario_error("", {"a.b=" + repeated("[", 300) + repeated("]", 300)}).substr(0, 11),
            "--set a.b=[");
  for (const std::string& deep :
       {dotted(35'000) + "=1", "a=" + repeated("{a=", 35'000), dotted(200) + "={" + dotted(200)}) {
    const std::string error = scenario_error("", {deep});
    EXPECT_THAT(error, HasSubstr("...: " + too_deep));
    EXPECT_LT(error.size(), 200u);
  }
  EXPECT_THAT(scenario_error("", {dotted(256) + "=1"}), HasSubstr("unknown key 'a'"));
  EXPECT_EQ(scenario_error("", {"motion.0.on=label:1"}), "none");
}

}  // namespace
}  // namespace kinemesh
