#include "core/io/assembler.h"
#include "core/io/codecs.h"
#include "core/io/scanner.h"
#include "core/io/text_buffer.h"

namespace kinemesh::io {
namespace {

class OffReader {
 public:
  OffReader(std::string_view text, const std::string& file, const ReadOptions& options)
      : scanner_(text, file, '#'), mesh_(file, options) {}

  ReadResult read() {
    read_header();
    const int n_vertices = scanner_.count("number of vertices", 6);
    const int n_faces = scanner_.count("number of faces", 8);
    if (!scanner_.at_line_end()) scanner_.integer("number of edges");
    scanner_.expect_line_end("the counts");
    mesh_.mesh().points.reserve(n_vertices);
    for (int i = 0; i < n_vertices; ++i) read_vertex();
    for (int i = 0; i < n_faces; ++i) read_face();
    scanner_.expect_end("the last face");
    return mesh_.finish();
  }

 private:
  void read_header() {
    const std::string_view word = scanner_.word("OFF");
    if (word != "OFF" && word != "COFF")
      scanner_.fail(in_quotes(word) + " begins the file, expected OFF or COFF");
    has_colours_ = word == "COFF";
  }

  void read_vertex() {
    const double x = scanner_.number("x of a vertex");
    const double y = scanner_.number_here("y of a vertex");
    const double z = scanner_.number_here("z of a vertex");
    mesh_.add_point(x, y, z, scanner_.line());
    if (has_colours_) {
      scanner_.skip_line();
    } else {
      scanner_.expect_line_end("the coordinates of a vertex");
    }
  }

  void read_face() {
    const int n = scanner_.count("number of a face's corners", 2);
    corners_.clear();
    for (int i = 0; i < n; ++i) corners_.push_back(scanner_.integer_here("vertex number"));
    mesh_.add_face(corners_, scanner_.line());
    scanner_.skip_line();  // a colour may follow
  }

  Scanner scanner_;
  Assembler mesh_;
  bool has_colours_ = false;
  std::vector<int> corners_;
};

}  // namespace

ReadResult read_off(std::string_view text, const std::string& file, const ReadOptions& options) {
  return OffReader(text, file, options).read();
}

std::string write_off(const MeshData& mesh) {
  TextBuffer text(48 * mesh.points.size() + 32 * mesh.triangles.size());
  text << "OFF\n" << mesh.n_vertices() << ' ' << mesh.n_faces() << " 0\n";
  for (const Point& p : mesh.points) text << p.x << ' ' << p.y << " 0\n";
  for (const Triangle& t : mesh.triangles) text << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  return text.take();
}

}  // namespace kinemesh::io
