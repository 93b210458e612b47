// What needs no handle.
#include "kinemesh.h"

#include "c/arguments.h"
#include "c/errors.h"
#include "kinemesh/mesh_data.h"
#include "kinemesh/safe_step.h"
#include "kinemesh/strategy.h"
#include "untangle/quality/quality_pass.h"

using namespace kinemesh;

namespace {

// As long as the thread asks for no other.
template <class Info>
const char* name_at(const std::vector<Info>& all, std::int32_t number) {
  static thread_local std::string name;
  const auto i = static_cast<std::size_t>(number);
  if (number < 0 || i >= all.size()) return nullptr;
  name = all[i].name;
  return name.c_str();
}

}  // namespace

const char* kinemesh_version(void) {
  return KINEMESH_VERSION;
}

const char* kinemesh_strategy_name(int32_t number) {
  return guarded_or<const char*>(nullptr, [&] { return name_at(strategies(), number); });
}

const char* kinemesh_quality_name(int32_t number) {
  return guarded_or<const char*>(nullptr, [&] { return name_at(qualities(), number); });
}

kinemesh_status kinemesh_max_safe_step(int32_t n_vertices, const double* xy0, const double* xy1,
                                       int32_t n_faces, const int32_t* triangles, double* share,
                                       int32_t* face) {
  return guarded([&] {
    const auto vertices = count(n_vertices, "n_vertices"), faces = count(n_faces, "n_faces");
    check_size(vertices, "vertices");
    check_size(faces, "faces");
    required(share, "share");
    required(face, "face");
    const auto first =
        max_safe_step(triangles_of(array(triangles, 3 * faces, "triangles")),
                      points(array(xy0, 2 * vertices, "xy0")), points(array(xy1, 2 * vertices, "xy1")));
    *share = first ? first->share : 1.0;
    *face = first ? first->face : none;
  });
}
