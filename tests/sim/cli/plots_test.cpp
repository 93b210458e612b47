// The plots of a benchmark say whatever text they are given, and gnuplot does nothing else.
#include "sim/cli/bench_plots.h"

#include <cstdlib>
#include <map>
#include <pugixml.hpp>

#include "core/base/printable.h"
#include "core/base/utf8.h"
#include "kinemesh/build.h"
#include "kinemesh/shapes.h"
#include "program.h"

namespace kinemesh::testing {
namespace {

namespace fs = std::filesystem;

bool has_gnuplot() {
  static const bool has = std::system("gnuplot --version > /dev/null 2>&1") == 0;
  return has;
}

// All text of an SVG that is well-formed.
std::string text_of(const fs::path& file) {
  const std::string svg = read_text(file);
  EXPECT_TRUE(is_utf8(svg)) << file;
  EXPECT_EQ(svg.find_first_of(std::string("\x01\x02\x03\x04\x05\x06\x07\x08\x0b\x0c\x0e\x0f\x1b\x7f")),
            std::string::npos);
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(svg.c_str())) << file << ":\n" << svg.substr(0, 2000);
  std::string text;
  for (const auto& node : document.select_nodes("//text()")) text += node.node().value();
  return text;
}

class Plots : public ProgramTest {
 protected:
  // As a benchmark with a strategy of this name, and a value for each of `values`, would.
  void plot(const std::string& title, const std::string& key, const std::vector<std::string>& values,
            const std::string& strategy = "global") {
    cli::BenchPlots plots(title, key);
    StepRecord record;
    record.step = 1;
    record.total_ms = 2.0;
    record.accepted = true;
    for (const std::string& value : values) plots.add({strategy, record, mesh_, 0}, value);
    fs::create_directories(path("bench"));
    said_ = plots.write(path("bench"));
  }

  std::string file(const std::string& name) const { return path("bench/plots/" + name); }

  void expect_nothing_else() const {
    EXPECT_EQ(files(), std::vector<std::string>{"bench"});
    for (const auto& entry : fs::recursive_directory_iterator(path("bench")))
      EXPECT_TRUE(entry.is_directory() || entry.path().extension() == ".gp" ||
                  entry.path().extension() == ".svg")
          << entry.path();
  }

  Mesh mesh_ = build_mesh(make_shape("square", {.vertices = 20}));
  std::string said_;
};

// What would do something if it were not quoted for gnuplot, once anywhere and once in the folder of the
// plots.
std::vector<std::string> hostile_texts(const fs::path& folder) {
  const std::string touch = "touch " + (folder / "PWNED").string();
  std::vector<std::string> texts{"`" + touch + "`",
                                 "$(" + touch + ")",
                                 "\"`" + touch + "`\"",
                                 "' `" + touch + "` '",
                                 "'.system(\"" + touch + "\").'",
                                 "\".system('" + touch + "').\"",
                                 "'\n!" + touch + "\n'",
                                 "\n!" + touch + "\n",
                                 "\r\n`" + touch + "`\r\n",
                                 "@macro",
                                 "'; system('" + touch + "'); print '",
                                 "\\",
                                 "\\'",
                                 "''",
                                 "'",
                                 "\"",
                                 "\\\"`" + touch + "`\\\"",
                                 "%s%d%n",
                                 "{/Bold x}_2^3",
                                 "$curve0",
                                 "#",
                                 "x # y",
                                 "a\\\nb",
                                 "<b>&amp;</b>]]><!--",
                                 "end",
                                 "\nend\n",
                                 "",
                                 " ",
                                 "*",
                                 "[0:1]",
                                 "columnheader",
                                 "\xc3\xa9t\xc3\xa9",
                                 "\xe2\x80\xae"
                                 "turned",
                                 "\xff\xfe"};
  for (const std::string quote : {"'", "''", "'''", "\"", "\\'", "\\\\'"})
    texts.push_back(quote + "`" + touch + "`" + quote);
  return texts;
}

TEST_F(Plots, ShowEveryTextAndExecuteNone) {
  if (!has_gnuplot()) GTEST_SKIP() << "no gnuplot";
  for (const std::string& text : hostile_texts(path(""))) {
    SCOPED_TRACE(printable(text));
    plot(text, text, {text + "!", text + " again"}, text);
    const std::string shown = text_of(file("steps.svg"));
    const std::string lines = printable(text);
    EXPECT_NE(shown.find(lines), std::string::npos) << shown;
    EXPECT_NE(shown.find(lines + ", " + lines + " again"), std::string::npos) << shown;
    plot("title", "key " + text, {"1", "2"}, text);  // a sweep over numbers: the key is a label
    EXPECT_NE(text_of(file("sweep.svg")).find(lines), std::string::npos);
    expect_nothing_else();
    ASSERT_FALSE(HasFailure());
  }
}

TEST_F(Plots, ShowEveryByte) {
  if (!has_gnuplot()) GTEST_SKIP() << "no gnuplot";
  for (int first = 1; first < 256; first += 32) {
    std::vector<std::string> values;
    std::string all;
    for (int byte = first; byte < std::min(256, first + 32); ++byte) {
      all += static_cast<char>(byte);
      values.push_back("a" + std::string(1, static_cast<char>(byte)) + "`touch PWNED`");
    }
    plot(all, "key", values);
    const std::string shown = text_of(file("steps.svg"));
    EXPECT_NE(shown.find(printable(all)), std::string::npos) << printable(all) << " in " << shown;
    for (const std::string& value : values)
      EXPECT_NE(shown.find("global, " + printable(value)), std::string::npos) << printable(value);
    expect_nothing_else();
  }
}

TEST_F(Plots, TextsAreOneLineOfTheScript) {
  plot("a\nb'c`d", "key", {"x"});
  const auto lines = lines_of(read_text(file("steps.gp")));
  EXPECT_NE(std::ranges::find(lines, "set title 'a\\nb'.\"'\".'c`d'"), lines.end());
}

// Settings of the user and the environment change nothing.
TEST_F(Plots, ReadNoSettings) {
  if (!has_gnuplot()) GTEST_SKIP() << "no gnuplot";
  const std::string command = "system('touch " + path("PWNED").string() + "')\n";
  fs::create_directories(path("home/.config/gnuplot"));
  fs::create_directories(path("bench/plots"));
  for (const char* name :
       {"home/.gnuplot", "home/.config/gnuplot/gnuplotrc", "bench/plots/.gnuplot", "gnuplotrc"})
    write(name, command);
  const Environment environment({{"HOME", path("home")},
                                 {"XDG_CONFIG_HOME", path("home/.config")},
                                 {"GNUPLOT_SHARE_DIR", path("")},
                                 {"GNUTERM", "svg; " + command},
                                 {"GNUPLOT_LIB", "|touch " + path("PWNED").string()}});
  plot("title", "", {""});
  EXPECT_EQ(said_, path("bench/plots").string());
  EXPECT_NE(text_of(file("steps.svg")).find("title"), std::string::npos);
  EXPECT_FALSE(fs::exists(path("PWNED")));
}

TEST_F(Plots, OfManyCurvesShowSome) {
  std::vector<std::string> values;
  for (int i = 0; i < 40000; ++i) values.push_back("v" + std::to_string(i));
  plot("many", "key", values);
  const std::string script = read_text(file("steps.gp"));
  EXPECT_LT(script.size(), 20000u);
  EXPECT_NE(script.find("set title 'many: 40 of 40000 curves'"), std::string::npos) << script.substr(0, 500);
  for (auto& value : values) value.erase(0, 1);
  plot("many", "key", values);
  EXPECT_LT(read_text(file("sweep.gp")).size(), 200000u);
}

class NamedPlots : public ProgramTest {};

// All the way from the scenario's name.
TEST_F(NamedPlots, ScenariosMayHaveAnyName) {
  const std::string scenario =
      "[mesh]\nshape = \"square\"\nvertices = 60\n[[motion]]\nfield = \"rotor\"\ncenter = [0.5, 0.5]\n"
      "radius = 0.3\nrate = 6.283\n[time]\ndt = 0.02\nsteps = 2\n";
  for (const std::string name :
       {"s`touch PWNED`", "s'`touch PWNED`'", "s$(touch PWNED)", "s\"`touch PWNED`\"", "s\n!touch PWNED\n",
        "s@m%d\\", "'.system('touch PWNED').'", "s\x1b[31m\xff"}) {
    SCOPED_TRACE(printable(name));
    write(name + ".toml", scenario);
    const Result result =
        run({"bench", "./" + name + ".toml", "--strategies", "global", "-o", "b", "--force"});
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(result.out.find('\x1b'), std::string::npos);
    fs::remove(path(name + ".toml"));
    EXPECT_EQ(files(), std::vector<std::string>{"b"});
    for (const auto& entry : fs::recursive_directory_iterator(path("b")))
      EXPECT_NE(entry.path().filename(), "PWNED");
    if (has_gnuplot()) {
      EXPECT_NE(text_of(path("b/plots/steps.svg")).find(printable(name)), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace kinemesh::testing
