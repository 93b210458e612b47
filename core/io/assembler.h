// What all readers share: collects a mesh with the lines of its parts, and checks the whole at the end.
#pragma once

#include <array>
#include <string>
#include <unordered_map>
#include <vector>

#include "kinemesh/mesh_io.h"

namespace kinemesh::io {

class Assembler {
 public:
  Assembler(std::string file, const ReadOptions& options) : file_(std::move(file)), options_(options) {}

  MeshData& mesh() { return mesh_; }  // readers fill in points and label_names directly
  int n_vertices() const { return mesh_.n_vertices(); }

  // Vertex numbers are checked in finish(), `line` is named if they or the face turn out wrong; 0: no line.
  void add_triangle(const Triangle& corners, int line, int label = 0);
  // All of a file, one to a line. Pre: none has been added.
  void add_triangles(std::vector<Triangle> triangles, int first_line);
  void add_quad(const std::array<int, 4>& corners, int line,
                int label = 0);                              // refused unless they are to be split
  void add_face(const std::vector<int>& corners, int line);  // refuses any but 3 or 4 corners

  int marker(std::string_view name, int line);  // its number; added where it is new, refused where no name
  void reserve_marker(int marker, std::size_t n_more);  // for so many more edges
  void add_marker_edge(int marker, const Edge& edge, int line);

  // Refuses z other than 0: `number` is that of the vertex, from 0.
  void add_point(double x, double y, double z, int line);

  void note(std::string text) { notes_.push_back(std::move(text)); }
  [[noreturn]] void fail(int line, const std::string& what) const { throw InputError(file_, line, what); }

  ReadResult finish();

 private:
  struct Quad {
    int face;  // its first triangle, the second follows
    std::array<int, 4> corners;
  };
  void check_markers() const;
  void check_marker_edge(int marker, std::size_t edge) const;
  void choose_diagonals();
  void check_and_wind();

  std::string file_;
  ReadOptions options_;
  MeshData mesh_;
  std::vector<int> face_line_;
  std::vector<Quad> quads_;
  std::unordered_map<std::string, int> marker_of_name_;
  std::vector<std::vector<int>> marker_line_;  // per marker and edge
  std::vector<std::string> notes_;
};

// Refuses names that no file format could keep: empty ones, and those with control characters.
void check_name(std::string_view name);

}  // namespace kinemesh::io
