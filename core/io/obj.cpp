#include <algorithm>
#include <array>
#include <limits>

#include "core/io/assembler.h"
#include "core/io/codecs.h"
#include "core/io/scanner.h"
#include "core/io/text_buffer.h"

namespace kinemesh::io {
namespace {

constexpr std::array<std::string_view, 12> skipped_keywords{"vt", "vn", "vp",     "g",      "o",  "s",
                                                            "l",  "p",  "mtllib", "usemtl", "mg", "lod"};

class ObjReader {
 public:
  ObjReader(std::string_view text, const std::string& file, const ReadOptions& options)
      : scanner_(text, file, '#'), mesh_(file, options) {}

  ReadResult read() {
    while (!scanner_.at_end()) read_statement();
    if (largest_ > mesh_.mesh().n_vertices()) {
      mesh_.fail(line_of_largest_, "vertex " + std::to_string(largest_) + " does not exist, expected 1 to " +
                                       std::to_string(mesh_.mesh().n_vertices()));
    }
    return mesh_.finish();
  }

 private:
  void read_statement() {
    const std::string_view keyword = scanner_.word("a statement");
    if (keyword == "v") {
      read_vertex();
    } else if (keyword == "f") {
      read_face();
    } else if (std::find(skipped_keywords.begin(), skipped_keywords.end(), keyword) ==
               skipped_keywords.end()) {
      scanner_.fail("unknown statement " + in_quotes(keyword) +
                    ", expected v, f or one of those without geometry");
    }
    scanner_.skip_line();
  }

  // "v x y z", and then perhaps a weight or a colour, which are skipped.
  void read_vertex() {
    const double x = scanner_.number_here("x of a vertex");
    const double y = scanner_.number_here("y of a vertex");
    const double z = scanner_.number_here("z of a vertex");
    mesh_.add_point(x, y, z, scanner_.line());
  }

  void read_face() {
    corners_.clear();
    while (!scanner_.at_line_end()) corners_.push_back(read_corner());
    mesh_.add_face(corners_, scanner_.line());
  }

  // "v", "v/vt", "v//vn", "v/vt/vn": from 1, or backwards from -1. A face may come before its vertices.
  int read_corner() {
    const std::string_view word = scanner_.word("vertex number");
    const int n = mesh_.mesh().n_vertices();
    const long long number = corner_number(word.substr(0, word.find('/')));
    if (number == 0 || number < -n || number > most_items) {
      scanner_.fail("vertex " + std::to_string(number) + " does not exist, " + std::to_string(n) +
                    " came before, expected numbers from 1 up or from -1 down");
    }
    if (number < 0) return static_cast<int>(n + number);
    if (number > largest_) {
      largest_ = static_cast<int>(number);
      line_of_largest_ = scanner_.line();
    }
    return static_cast<int>(number - 1);
  }
  long long corner_number(std::string_view word) const {
    try {
      return to_integer(word, "vertex number");
    } catch (const InputError& error) {
      scanner_.fail(error.what());
    }
  }

  Scanner scanner_;
  Assembler mesh_;
  std::vector<int> corners_;
  int largest_ = 0;  // vertex number in a face, from 1
  int line_of_largest_ = 0;
};

}  // namespace

ReadResult read_obj(std::string_view text, const std::string& file, const ReadOptions& options) {
  return ObjReader(text, file, options).read();
}

std::string write_obj(const MeshData& mesh) {
  TextBuffer text(48 * mesh.points.size() + 32 * mesh.triangles.size());
  for (const Point& p : mesh.points) text << "v " << p.x << ' ' << p.y << " 0\n";
  for (const Triangle& t : mesh.triangles)
    text << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  return text.take();
}

}  // namespace kinemesh::io
