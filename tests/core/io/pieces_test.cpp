// Files long enough to be read in several pieces: the same mesh and the same refusal as from front to back.
#include "core/io/pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "kinemesh/shapes.h"
#include "tests/core/io/meshes.h"

namespace kinemesh {
namespace {

using io::cut_lines;
using io::cut_words;

std::string counted_lines(int n) {
  std::string text;
  for (int i = 0; i < n; ++i) text += std::to_string(i) + (i % 3 == 0 ? "\r\n" : "\n");
  return text;
}

// Whether the pieces hold the first n of counted_lines.
void expect_lines(const std::vector<io::Lines>& pieces, int n, std::size_t n_pieces) {
  ASSERT_GE(pieces.size(), n_pieces);
  int line = 0;
  for (const auto& [text, first, end] : pieces) {
    EXPECT_EQ(first, line);
    io::Scanner scanner(text, "lines");
    for (; line < end; ++line) ASSERT_EQ(scanner.integer("number"), line);
    EXPECT_TRUE(scanner.at_end());
  }
  EXPECT_EQ(line, n);
}

TEST(Pieces, LinesAreCutAtTheirEnds) {
  const std::string text = counted_lines(100'000);
  expect_lines(cut_lines(text, 100'000), 100'000, 5);
  expect_lines(cut_lines(text, 60'000), 60'000, 3);
  expect_lines(cut_lines(text, 1), 1, 1);
  expect_lines(cut_lines(text.substr(0, text.size() - 1), 100'000), 100'000, 5);  // the last one does not end
}

TEST(Pieces, ThereAreNoneOfTooFewLines) {
  EXPECT_TRUE(cut_lines(counted_lines(30'000), 30'001).empty());
  EXPECT_TRUE(cut_lines("", 1).empty());
  EXPECT_TRUE(cut_lines("1\n", 0).empty());
}

TEST(Pieces, WordsStayWhole) {
  std::string text = counted_lines(50'000), joined;
  std::replace(text.begin(), text.end(), '\n', '\t');
  text += std::string(200'000, '7');  // one word across pieces
  for (const std::string_view piece : cut_words(text)) {
    EXPECT_TRUE(joined.empty() || joined.ends_with('\t') || joined.ends_with('\r'));
    joined += piece;
  }
  EXPECT_EQ(joined, text);
}

// An SU2 file: its elements from line 3 on, behind them a line, and its points.
class LongFile : public ::testing::Test {
 protected:
  static std::size_t begin_of(const std::string& text, int line) {
    std::size_t begin = 0;
    for (int i = 1; i < line; ++i) begin = text.find('\n', begin) + 1;
    return begin;
  }
  static std::string with_line(std::string text, int before, const std::string& line) {
    return text.insert(begin_of(text, before), line + "\n");
  }
  static std::string with_word(std::string text, int line, const std::string& word) {
    const std::size_t begin = begin_of(text, line);
    return text.replace(begin, text.find(' ', begin) - begin, word);
  }

  const MeshData mesh = make_square(20'000);
  const std::string text = format_mesh(mesh, Format::Su2);
  const int elements = 3, points = elements + mesh.n_faces() + 1;
};

TEST_F(LongFile, IsReadAsItWasWritten) {
  EXPECT_TRUE(same(mesh, parse(text, Format::Su2).mesh, Format::Su2));
}

TEST_F(LongFile, MayHaveOtherLinesInBetween) {
  for (const std::string line : {"", "% comment", " \t\r"}) {
    for (const int before : {elements, elements + 12'345, points - 1, points, points + 9'999})
      EXPECT_TRUE(same(mesh, parse(with_line(text, before, line), Format::Su2).mesh, Format::Su2)) << before;
  }
}

TEST_F(LongFile, NamesTheFirstMistake) {
  const int first = elements + 20'000, second = elements + 30'000, third = points + 15'000;
  const std::string once = with_word(text, third, "x"), twice = with_word(once, second, "5.5"),
                    thrice = with_word(twice, first, "10");
  expect_refused(once, Format::Su2, third, "'x' is not a number, expected x of a point");
  expect_refused(twice, Format::Su2, second, "'5.5' is not a whole number, expected type of an element");
  expect_refused(thrice, Format::Su2, first, "element type 10 is a tetrahedron");
  expect_refused(with_line(thrice, first, "5 0 1"), Format::Su2, first,
                 "the line ends, expected vertex number");
}

TEST_F(LongFile, MayNotEndEarly) {
  expect_refused(text.substr(0, begin_of(text, points - 5)), Format::Su2, points - 5,
                 "the file ends, expected type of an element");
}

TEST(LongVtu, NamesTheFirstMistake) {
  std::string coordinates,
      header =
          "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>\n<Piece NumberOfPoints=\"20000\" "
          "NumberOfCells=\"0\"><Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" "
          "format=\"ascii\">\n";
  for (int i = 0; i < 20'000; ++i)
    coordinates += i == 12'000 ? "0 nan 0\n" : i == 19'000 ? "0 y 0\n" : "0.25 0.5 0\n";
  const std::string end = "</DataArray></Points></Piece></UnstructuredGrid></VTKFile>\n";
  expect_refused(header + coordinates + end, Format::Vtu, 4 + 12'000, "'nan' is not finite");
}

}  // namespace
}  // namespace kinemesh
