// Short words for the tests of repairs.
#pragma once

#include <string>

#include "kinemesh/build.h"
#include "kinemesh/strategy.h"
#include "kinemesh/validate.h"

namespace kinemesh::test {

inline RepairOutcome repair(Mesh& mesh, bool allow_escaped = false, const std::string& strategy = "global") {
  return make_strategy(strategy)->repair(mesh, RepairOptions{.allow_escaped = allow_escaped});
}

inline void place(Mesh& mesh, int user, const Point& p) {
  mesh.positions()[mesh.vertex_of_user(UserVertex(user))] = p;
}

inline Point position_of(const Mesh& mesh, int user) {
  return mesh.position(mesh.vertex_of_user(UserVertex(user)));
}

// The domain's faces among these, by the user's numbers, ascending.
std::vector<int> user_faces(const Mesh& mesh, const std::vector<Face>& faces);

inline std::string message(const std::optional<Defect>& defect) {
  return defect ? defect->message() : "";
}

}  // namespace kinemesh::test
