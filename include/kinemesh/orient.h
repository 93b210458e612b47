// Makes an arbitrary list of triangles an oriented 2-manifold, or says which face keeps it from being one.
#pragma once

#include <string>
#include <vector>

#include "kinemesh/error.h"
#include "kinemesh/mesh_data.h"

#pragma GCC visibility push(default)
namespace kinemesh {

// A face that cannot be part of a planar mesh.
class FaceError : public InputError {
 public:
  FaceError(int face, const std::string& what)
      : InputError("face " + std::to_string(face) + ": " + what), face_(face), reason_(what) {}
  int face() const { return face_; }
  const std::string& reason() const { return reason_; }  // what(), without the face's number

 private:
  int face_;
  std::string reason_;
};

// Winds faces consistently by walking across edges, the first face of each connected part leading, and turns
// a part over whose signed areas sum below zero. Rotation of a face's corners is kept; a turned face swaps
// its last two. Returns one note per kind of change, for the user. Cost: O(n).
// Throws FaceError: vertex number out of range, repeated vertex, repeated face, more than two faces at an
// edge, or an edge across which the winding cannot be made consistent (a Moebius strip).
std::vector<std::string> make_consistent(MeshData& data);

}  // namespace kinemesh
#pragma GCC visibility pop
