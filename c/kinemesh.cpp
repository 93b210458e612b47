#include "kinemesh.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "kinemesh/build.h"
#include "kinemesh/mesh_io.h"
#include "kinemesh/orient.h"
#include "kinemesh/stepper.h"
#include "kinemesh/validate.h"
#include "sim/scenario/setup.h"
#include "untangle/walk/stuck.h"

struct kinemesh_mesh {
  kinemesh::MeshData data;
};

struct kinemesh_stepper {
  kinemesh::Stepper stepper;
  std::optional<kinemesh::Motion> motion = std::nullopt;  // of a scenario
  double time_rest = 0.0;                                 // what rounding has taken from the stepper's time
};

namespace {

using namespace kinemesh;

static_assert(std::is_same_v<std::int32_t, int>);
static_assert(sizeof(Point) == 2 * sizeof(double) && sizeof(Triangle) == 3 * sizeof(std::int32_t));

thread_local std::string last_error;

class NoValidMesh : public std::runtime_error {
  using runtime_error::runtime_error;
};

class Stuck : public std::runtime_error {
  using runtime_error::runtime_error;
};

class Vetoed : public std::runtime_error {
  using runtime_error::runtime_error;
};

// Assigning a text may need memory, too.
kinemesh_status fail(kinemesh_status status, const char* what) noexcept {
  try {
    last_error = what;
  } catch (const std::bad_alloc&) {
    last_error.clear();
  }
  return status;
}

// Runs `work` and turns what it throws into a status.
template <class Work>
kinemesh_status guarded(const Work& work) noexcept {
  try {
    work();
    return KINEMESH_OK;
  } catch (const NoValidMesh& error) {
    return fail(KINEMESH_NO_VALID_MESH, error.what());
  } catch (const Stuck& error) {
    return fail(KINEMESH_STUCK, error.what());
  } catch (const NoEmbedding& error) {
    return fail(KINEMESH_NO_VALID_MESH, error.what());
  } catch (const InputError& error) {
    return fail(KINEMESH_BAD_INPUT, error.what());
  } catch (const ResourceError& error) {
    return fail(KINEMESH_NO_RESOURCES, error.what());
  } catch (const Vetoed& error) {
    return fail(KINEMESH_VETOED, error.what());
  } catch (const std::bad_alloc&) {
    return fail(KINEMESH_OUT_OF_MEMORY, "out of memory");
  } catch (const std::exception& error) {
    return fail(KINEMESH_BUG, error.what());
  } catch (...) {
    return fail(KINEMESH_BUG, "an unknown exception");
  }
}

// Of a step or a repair that has failed.
[[noreturn]] void refuse(const Defect& defect) {
  if (defect.kind == DefectKind::NonFinitePosition) throw InputError(defect.message());
  if (is_stuck(defect)) throw Stuck(defect.message());
  throw NoValidMesh(defect.message());
}

template <class T>
T* required(T* pointer, const char* name) {
  if (!pointer) throw InputError(std::string(name) + " is NULL, an address expected");
  return pointer;
}

// Where a new handle goes; NULL until all has gone well.
template <class Handle>
Handle*& cleared(Handle** handle, const char* name) {
  *required(handle, name) = nullptr;
  return *handle;
}

std::size_t size(std::int32_t n, const char* name) {
  if (n < 0) throw InputError(std::string(name) + " is " + std::to_string(n) + ", at least 0 expected");
  return static_cast<std::size_t>(n);
}

std::vector<Point> points(const double* xy, std::size_t n) {
  std::vector<Point> all(n);
  for (std::size_t i = 0; i < n; ++i) all[i] = {xy[2 * i], xy[2 * i + 1]};
  return all;
}

std::vector<Triangle> triangles_of(const std::int32_t* corners, std::size_t n) {
  std::vector<Triangle> all(n);
  for (std::size_t i = 0; i < n; ++i) all[i] = {corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]};
  return all;
}

void copy(std::span<const Point> points, double* xy) {
  for (const Point& p : points) {
    *xy++ = p.x;
    *xy++ = p.y;
  }
}

void copy(const MeshData& data, double* xy, std::int32_t* triangles, std::int32_t* labels) {
  if (xy) copy(data.points, xy);
  for (int f = 0; f < data.n_faces(); ++f) {
    for (int k = 0; triangles && k < 3; ++k) *triangles++ = data.triangles[f][k];
    if (labels) *labels++ = data.label(f);
  }
}

Mesh valid_mesh(const MeshData& data, double frame) {
  Mesh mesh = build_mesh(data, {.frame = frame, .fixed = {}});
  if (const auto defect = validate(mesh)) {
    const bool is_tangled = defect->kind == DefectKind::InvertedFace || defect->kind == DefectKind::FlatFace;
    throw InputError(defect->message() +
                     (is_tangled ? "; kinemesh_mesh_untangle makes a valid mesh of it" : ""));
  }
  return mesh;
}

StepperOptions stepper_options(const kinemesh_options& options) {
  return {.strategy = options.strategy ? options.strategy : "global",
          .allow_escaped = options.allow_escaped != 0,
          .retain = options.retain != 0,
          .quality = options.quality ? options.quality : "none",
          .angle = options.angle};
}

// So that step_border lets the interior follow as advance does.
StepperOptions stepper_options(const Scenario& scenario, const Motion& motion) {
  StepperOptions options = stepper_options(scenario.repair, motion);
  if (motion.interior().follow != Follow::None) options.interior = motion.interior();
  return options;
}

kinemesh_step c_record(const StepRecord& record) {
  const auto& repair = record.repair;
  return {.step = record.step,
          .time = record.time,
          .dt = record.dt,
          .n_faces = record.faces,
          .inverted = repair.inverted,
          .flat = repair.degenerate,
          .regions = static_cast<std::int32_t>(repair.regions.size()),
          .replaced = repair.replaced,
          .flips = repair.quality_flips,
          .moves = repair.quality_moves,
          .min_angle_deg = record.min_angle_deg,
          .min_area = record.min_area};
}

// step_to(end time), dt after all steps before. The lengths of steps are added up as if without rounding
// (Knuth's two-sum), so that two of dt / 2 end when one of dt does.
template <class StepTo>
void advance(kinemesh_stepper& stepper, double dt, kinemesh_step* record, const StepTo& step_to) {
  const double time = stepper.stepper.time(), added = stepper.time_rest + dt, end = time + added;
  const double added_there = end - time;
  const StepOutcome outcome = step_to(dt < 0.0 ? std::numeric_limits<double>::quiet_NaN() : end);
  if (!outcome) refuse(*outcome.defect);
  stepper.time_rest = (time - (end - added_there)) + (added - added_there);
  if (!record) return;
  *record = c_record(outcome.record);
  record->dt = dt;
}

// A patch as the arrays C is shown.
struct FlatPatch {
  std::vector<std::int32_t> faces, before, after, labels_before, labels_after;
  std::span<const int> vertices;

  explicit FlatPatch(const ChangedPatch& patch) : vertices(patch.vertices) {
    for (const auto& change : patch.faces) {
      faces.push_back(change.face);
      before.insert(before.end(), change.before.begin(), change.before.end());
      after.insert(after.end(), change.after.begin(), change.after.end());
      labels_before.push_back(change.label_before);
      labels_after.push_back(change.label_after);
    }
  }
  kinemesh_patch shown() const {
    return {.n_faces = static_cast<std::int32_t>(faces.size()),
            .faces = faces.data(),
            .before = before.data(),
            .after = after.data(),
            .labels_before = labels_before.data(),
            .labels_after = labels_after.data(),
            .n_vertices = static_cast<std::int32_t>(vertices.size()),
            .vertices = vertices.data()};
  }
};

void show(const StepChanges& changes, kinemesh_observer observer, void* user) {
  const int n = changes.mesh.n_user_vertices();
  std::vector<double> before, after;
  for (int v = 0; v < n; ++v) {
    before.insert(before.end(), {changes.before(v).x, changes.before(v).y});
    after.insert(after.end(), {changes.after(v).x, changes.after(v).y});
  }
  const std::vector<FlatPatch> flat(changes.patches.begin(), changes.patches.end());
  std::vector<kinemesh_patch> patches;
  for (const auto& patch : flat) patches.push_back(patch.shown());
  std::vector<std::int32_t> moved;
  std::vector<double> from;
  for (const auto& [vertex, there] : changes.moved_by_quality) {
    moved.push_back(vertex);
    from.insert(from.end(), {there.x, there.y});
  }
  const kinemesh_changes shown{.step = changes.step,
                               .time = changes.time,
                               .dt = changes.dt,
                               .n_patches = static_cast<std::int32_t>(patches.size()),
                               .patches = patches.data(),
                               .xy_before = before.data(),
                               .xy_after = after.data(),
                               .n_moved = static_cast<std::int32_t>(moved.size()),
                               .moved = moved.data(),
                               .xy_moved = from.data()};
  if (const int answer = observer(&shown, user))
    throw Vetoed("an observer returned " + std::to_string(answer) + " in step " +
                 std::to_string(changes.step));
}

}  // namespace

const char* kinemesh_error(void) {
  return last_error.c_str();
}

const char* kinemesh_version(void) {
  return KINEMESH_VERSION;
}

kinemesh_status kinemesh_mesh_create(int32_t n_vertices, const double* xy, int32_t n_faces,
                                     const int32_t* triangles, const int32_t* labels, kinemesh_mesh** mesh) {
  return guarded([&] {
    auto& result = cleared(mesh, "mesh");
    const auto vertices = size(n_vertices, "n_vertices"), faces = size(n_faces, "n_faces");
    check_size(vertices, "vertices");
    check_size(faces, "faces");
    auto made = std::make_unique<kinemesh_mesh>();
    made->data.points = points(required(xy, "xy"), vertices);
    made->data.triangles = triangles_of(required(triangles, "triangles"), faces);
    if (labels) made->data.labels.assign(labels, labels + faces);
    make_consistent(made->data);
    result = made.release();
  });
}

kinemesh_status kinemesh_mesh_read(const char* file, kinemesh_mesh** mesh) {
  return guarded([&] {
    auto& result = cleared(mesh, "mesh");
    result = new kinemesh_mesh{read_mesh(required(file, "file")).mesh};
  });
}

kinemesh_status kinemesh_mesh_write(const kinemesh_mesh* mesh, const char* file) {
  return guarded([&] { write_mesh(required(file, "file"), required(mesh, "mesh")->data); });
}

kinemesh_status kinemesh_mesh_add_marker(kinemesh_mesh* mesh, const char* name, int32_t n_edges,
                                         const int32_t* edges) {
  return guarded([&] {
    auto markers = required(mesh, "mesh")->data.markers;
    Marker added{required(name, "name"), {}};
    for (std::size_t i = 0; i < size(n_edges, "n_edges"); ++i)
      added.edges.push_back({required(edges, "edges")[2 * i], edges[2 * i + 1]});
    const auto same = std::find_if(markers.begin(), markers.end(),
                                   [&](const Marker& marker) { return marker.name == added.name; });
    if (same == markers.end())
      markers.push_back(std::move(added));
    else
      same->edges.insert(same->edges.end(), added.edges.begin(), added.edges.end());
    mesh->data.markers.swap(markers);
  });
}

kinemesh_status kinemesh_mesh_untangle(kinemesh_mesh* mesh, const char* strategy) {
  return guarded([&] {
    Mesh work = build_mesh(required(mesh, "mesh")->data);
    const auto outcome = make_strategy(strategy ? strategy : "global")->repair(work, {});
    if (!outcome) refuse(*outcome.defect);
    mesh->data = work.domain();
  });
}

int32_t kinemesh_mesh_n_vertices(const kinemesh_mesh* mesh) {
  return mesh->data.n_vertices();
}

int32_t kinemesh_mesh_n_faces(const kinemesh_mesh* mesh) {
  return mesh->data.n_faces();
}

void kinemesh_mesh_get(const kinemesh_mesh* mesh, double* xy, int32_t* triangles, int32_t* labels) {
  copy(mesh->data, xy, triangles, labels);
}

void kinemesh_mesh_destroy(kinemesh_mesh* mesh) {
  delete mesh;
}

kinemesh_options kinemesh_default_options(void) {
  return {
      .strategy = "global", .quality = "none", .angle = 25.0, .frame = 0.25, .allow_escaped = 0, .retain = 0};
}

kinemesh_status kinemesh_stepper_create(const kinemesh_mesh* mesh, const kinemesh_options* options,
                                        kinemesh_stepper** stepper) {
  return guarded([&] {
    auto& result = cleared(stepper, "stepper");
    const kinemesh_options chosen = options ? *options : kinemesh_default_options();
    result = new kinemesh_stepper{
        Stepper(valid_mesh(required(mesh, "mesh")->data, chosen.frame), stepper_options(chosen))};
  });
}

kinemesh_status kinemesh_stepper_create_scenario(const kinemesh_mesh* mesh, const char* scenario,
                                                 double frame, kinemesh_stepper** stepper) {
  return guarded([&] {
    auto& result = cleared(stepper, "stepper");
    required(mesh, "mesh");
    const Scenario parsed = parse_motions(required(scenario, "scenario"), "scenario");
    SetUp made = set_up(parsed, valid_mesh(mesh->data, frame));
    const StepperOptions options = stepper_options(parsed, made.motion);
    result = new kinemesh_stepper{Stepper(std::move(made.mesh), options), std::move(made.motion)};
  });
}

void kinemesh_stepper_destroy(kinemesh_stepper* stepper) {
  delete stepper;
}

kinemesh_status kinemesh_stepper_step(kinemesh_stepper* stepper, const double* xy, double dt,
                                      kinemesh_step* record) {
  return guarded([&] {
    auto& s = required(stepper, "stepper")->stepper;
    const auto to = points(required(xy, "xy"), s.mesh().n_user_vertices());
    advance(*stepper, dt, record, [&](double end) { return s.step_to(to, end); });
  });
}

kinemesh_status kinemesh_stepper_step_border(kinemesh_stepper* stepper, int32_t n, const int32_t* vertices,
                                             const double* xy, double dt, kinemesh_step* record) {
  return guarded([&] {
    auto& s = required(stepper, "stepper")->stepper;
    const std::size_t count = size(n, "n");
    const std::span<const int> named(count > 0 ? required(vertices, "vertices") : nullptr, count);
    const auto to = points(count > 0 ? required(xy, "xy") : nullptr, count);
    advance(*stepper, dt, record, [&](double end) { return s.step_border_to(named, to, end); });
  });
}

kinemesh_status kinemesh_stepper_advance(kinemesh_stepper* stepper, double dt, kinemesh_step* record) {
  return guarded([&] {
    const auto& motion = required(stepper, "stepper")->motion;
    if (!motion) throw InputError("a stepper of kinemesh_stepper_create_scenario expected");
    advance(*stepper, dt, record, [&](double end) { return stepper->stepper.step_to(*motion, end); });
  });
}

double* kinemesh_stepper_positions(kinemesh_stepper* stepper) {
  double* first = nullptr;
  (void)guarded([&] { first = &required(stepper, "stepper")->stepper.positions().data()->x; });
  return first;
}

kinemesh_status kinemesh_stepper_repair(kinemesh_stepper* stepper, double dt, kinemesh_step* record) {
  return guarded([&] {
    auto& s = required(stepper, "stepper")->stepper;
    advance(*stepper, dt, record, [&](double end) { return s.step_to(s.positions(), end); });
  });
}

int32_t kinemesh_stepper_n_vertices(const kinemesh_stepper* stepper) {
  return stepper->stepper.mesh().n_user_vertices();
}

int32_t kinemesh_stepper_n_faces(const kinemesh_stepper* stepper) {
  return stepper->stepper.mesh().n_user_faces();
}

double kinemesh_stepper_time(const kinemesh_stepper* stepper) {
  return stepper->stepper.time();
}

kinemesh_status kinemesh_stepper_get(const kinemesh_stepper* stepper, double* xy, int32_t* triangles,
                                     int32_t* labels) {
  return guarded([&] { copy(required(stepper, "stepper")->stepper.mesh().domain(), xy, triangles, labels); });
}

kinemesh_status kinemesh_stepper_mesh(const kinemesh_stepper* stepper, kinemesh_mesh** mesh) {
  return guarded([&] {
    auto& result = cleared(mesh, "mesh");
    result = new kinemesh_mesh{required(stepper, "stepper")->stepper.mesh().domain()};
  });
}

kinemesh_status kinemesh_stepper_observe(kinemesh_stepper* stepper, kinemesh_observer observer, void* user) {
  return guarded([&] {
    required(observer, "observer");
    required(stepper, "stepper")->stepper.observe([observer, user](const StepChanges& changes) {
      show(changes, observer, user);
    });
  });
}
