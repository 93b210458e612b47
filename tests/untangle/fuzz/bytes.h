// Meshes and motions out of a fuzzer's bytes.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kinemesh/mesh.h"
#include "kinemesh/mesh_data.h"

namespace kinemesh::test {

class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), end_(data + size) {}
  bool empty() const { return data_ == end_; }
  int below(int n) { return empty() ? 0 : *data_++ % n; }  // pre: 0 < n <= 256

 private:
  const std::uint8_t* data_;
  const std::uint8_t* end_;
};

// A few cells of a lattice, some missing, some with labels.
MeshData lattice_cells(Bytes& bytes);

// Moves vertices by up to three half cells.
void move_on_lattice(Mesh& mesh, Bytes& bytes);

}  // namespace kinemesh::test
