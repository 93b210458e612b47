#include "tests/untangle/repairs.h"

#include <algorithm>

namespace kinemesh::test {

std::vector<int> user_faces(const Mesh& mesh, const std::vector<Face>& faces) {
  std::vector<int> numbers;
  for (const Face f : faces) {
    if (!mesh.is_padding(f)) numbers.push_back(mesh.user_face(f));
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

}  // namespace kinemesh::test
