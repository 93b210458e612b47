// What a step changes, as C observers see it, and what becomes of values of faces.
#include <algorithm>
#include <deque>
#include <mutex>

#include "c/handles.h"
#include "kinemesh/cell_transfer.h"
#include "kinemesh/step_changes.h"

using namespace kinemesh;

namespace {

std::int32_t size_of(const auto& all) {
  return static_cast<std::int32_t>(all.size());
}

// The faces of a patch before a step, or after it.
class FaceList {
 public:
  void add(UserFace face, const UserTriangle& corners, int label) {
    if (label == padding_label) return;
    faces_.push_back(face);
    triangles_.insert(triangles_.end(), corners.begin(), corners.end());
    labels_.push_back(label);
  }
  kinemesh_faces shown() const {
    return {.n = size_of(faces_),
            .faces = faces_.data(),
            .triangles = triangles_.data(),
            .labels = labels_.data()};
  }

 private:
  std::vector<std::int32_t> faces_, triangles_, labels_;
};

class ShownPatch {
 public:
  explicit ShownPatch(const ChangedPatch& patch)
      : vertices_(patch.vertices.begin(), patch.vertices.end()),
        regions_(patch.regions.begin(), patch.regions.end()) {
    for (const auto& change : patch.faces) {
      before_.add(change.face, change.before, change.label_before);
      after_.add(change.face, change.after, change.label_after);
    }
    shown_ = {.size = sizeof(kinemesh_patch),
              .before = before_.shown(),
              .after = after_.shown(),
              .n_vertices = size_of(vertices_),
              .vertices = vertices_.data(),
              .n_regions = size_of(regions_),
              .regions = regions_.data()};
  }
  ShownPatch(const ShownPatch&) = delete;
  ShownPatch& operator=(const ShownPatch&) = delete;
  const kinemesh_patch& shown() const { return shown_; }

 private:
  FaceList before_, after_;
  std::vector<std::int32_t> vertices_, regions_;
  kinemesh_patch shown_;
};

// What an observer is shown as long as it lives, and how to find it again when C hands it back.
class ShownChanges {
 public:
  explicit ShownChanges(const StepChanges& changes);
  ~ShownChanges() {
    const std::lock_guard lock(mutex_);
    std::erase(alive_, this);
  }
  ShownChanges(const ShownChanges&) = delete;
  ShownChanges& operator=(const ShownChanges&) = delete;

  const kinemesh_changes& shown() const { return shown_; }
  const StepChanges& changes() const { return changes_; }

  // Whether an array of n_faces values, by number, is one before the step and after it.
  bool keeps_faces() const {
    return shown_.n_faces_before == shown_.n_faces_after && last_face_ == shown_.n_faces_after - 1;
  }

  // Looks at nothing that `shown` points to: it may be gone.
  static const ShownChanges& of(const kinemesh_changes* shown) {
    const std::lock_guard lock(mutex_);
    const auto found =
        std::ranges::find(alive_, required(shown, "changes"), [](const auto* s) { return &s->shown_; });
    if (found == alive_.end())
      throw InputError("changes are none that an observer is being shown, these expected");
    return **found;
  }

 private:
  inline static std::mutex mutex_;
  inline static std::vector<const ShownChanges*> alive_;

  const StepChanges& changes_;
  std::deque<ShownPatch> patches_;
  std::vector<const kinemesh_patch*> patch_pointers_;
  std::vector<double> before_, after_, moved_from_;
  std::vector<std::int32_t> moved_;
  int last_face_ = none;  // the largest number after the step
  kinemesh_changes shown_;
};

ShownChanges::ShownChanges(const StepChanges& changes) : changes_(changes) {
  const Mesh& mesh = changes.mesh;
  const int n_vertices = mesh.n_user_vertices();
  int n_faces_before = mesh.n_user_faces();
  for (const auto& patch : changes.patches) {
    const kinemesh_patch& shown = patches_.emplace_back(patch).shown();
    patch_pointers_.push_back(&shown);
    n_faces_before += shown.before.n - shown.after.n;
  }
  for (const Face f : mesh.faces()) last_face_ = std::max<int>(last_face_, mesh.user_face(f));
  before_ = flat(mesh.in_user_order(changes.positions_before));
  after_ = flat(mesh.user_positions());
  for (const auto& [vertex, from] : changes.moved_by_quality) {
    moved_.push_back(vertex);
    moved_from_.insert(moved_from_.end(), {from.x, from.y});
  }
  shown_ = {.size = sizeof(kinemesh_changes),
            .step = changes.step,
            .time = changes.time,
            .dt = changes.dt,
            .n_vertices_before = n_vertices,
            .n_vertices_after = n_vertices,
            .n_faces_before = n_faces_before,
            .n_faces_after = mesh.n_user_faces(),
            .vertex_map = nullptr,
            .face_map = nullptr,
            .n_patches = size_of(patch_pointers_),
            .patches = patch_pointers_.data(),
            .xy_before = before_.data(),
            .xy_after = after_.data(),
            .n_moved = size_of(moved_),
            .moved = moved_.data(),
            .xy_moved = moved_from_.data()};
  const std::lock_guard lock(mutex_);
  alive_.push_back(this);
}

// What C returns, or C++ throws.
int answer(kinemesh_observer observer, const kinemesh_changes& shown, void* user) {
  try {
    return observer(&shown, user);
  } catch (const std::exception& error) {
    throw Failure(KINEMESH_VETOED,
                  "an observer threw in step " + std::to_string(shown.step) + ": " + error.what());
  } catch (...) {
    throw Failure(KINEMESH_VETOED, "an observer threw in step " + std::to_string(shown.step));
  }
}

// An observer whose own calls failed most likely vetoes for what the last one said.
void show(const StepChanges& changes, kinemesh_observer observer, void* user) {
  const ShownChanges alive(changes);
  const unsigned failures = n_failures();
  const int answered = answer(observer, alive.shown(), user);
  if (answered == 0) return;
  throw Failure(KINEMESH_VETOED, "an observer returned " + std::to_string(answered) + " in step " +
                                     std::to_string(changes.step) +
                                     (n_failures() != failures ? ": " + std::string(kinemesh_error()) : ""));
}

// `compute` is one of kinemesh/cell_transfer.h.
template <class Compute>
kinemesh_status transfer(const kinemesh_changes* changes, const double* before, double* after,
                         const Compute& compute) {
  return guarded([&] {
    const ShownChanges& alive = ShownChanges::of(changes);
    if (!alive.keeps_faces())
      throw InputError(
          "changes: faces have entered or left the domain with vertices that escaped, the same "
          "faces of the domain expected");
    const auto n = static_cast<std::size_t>(alive.shown().n_faces_after);
    const CellUpdate update = compute(alive.changes(), array(before, n, "before"));
    array(after, n, "after");
    if (after != before) std::copy_n(before, n, after);
    update.apply({after, n});
  });
}

}  // namespace

kinemesh_status kinemesh_stepper_observe(kinemesh_stepper* stepper, kinemesh_observer observer, void* user) {
  return guarded([&] {
    required(observer, "observer");
    Using(stepper, "stepper")->stepper.observe([observer, user](const StepChanges& changes) {
      show(changes, observer, user);
    });
  });
}

kinemesh_status kinemesh_remap_amounts(const kinemesh_changes* changes, const double* before, double* after) {
  return transfer(changes, before, after, remap_amounts);
}

kinemesh_status kinemesh_remap_averages(const kinemesh_changes* changes, const double* before,
                                        double* after) {
  return transfer(changes, before, after, remap_averages);
}

kinemesh_status kinemesh_copy_nearest(const kinemesh_changes* changes, const double* before, double* after) {
  return transfer(changes, before, after, copy_nearest);
}
