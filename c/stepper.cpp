// The stepper: options in, steps and their records out.
#include "kinemesh/stepper.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "c/handles.h"
#include "c/sized.h"
#include "kinemesh/build.h"
#include "kinemesh/setup.h"
#include "kinemesh/validate.h"

using namespace kinemesh;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr kinemesh_options default_options{.size = sizeof(kinemesh_options),
                                           .strategy = "global",
                                           .quality = "none",
                                           .angle = 25.0,
                                           .frame = 0.25,
                                           .allow_escaped = 0,
                                           .retain = 0,
                                           .max_region_share = 0.0};

// Of the first version.
constexpr std::size_t least_options = offsetof(kinemesh_options, max_region_share);

kinemesh_options chosen(const kinemesh_options* options) {
  if (!options) return default_options;
  return read(sized(options, least_options, "options"), default_options, "options");
}

double region_limit(double share) {
  if (share == infinity || not_negative(share, "options->max_region_share") == 0.0) return infinity;
  return share;
}

StepperOptions stepper_options(const kinemesh_options& options) {
  return {.strategy = options.strategy ? options.strategy : "global",
          .allow_escaped = options.allow_escaped != 0,
          .retain = options.retain != 0,
          .quality = options.quality ? options.quality : "none",
          .angle = options.angle,
          .max_region_share = region_limit(options.max_region_share)};
}

// So that step_border lets the interior follow as advance does.
StepperOptions stepper_options(const Scenario& scenario, const Motion& motion) {
  StepperOptions options = kinemesh::stepper_options(scenario.repair, motion);
  if (motion.interior().follow != Follow::None) options.interior = motion.interior();
  return options;
}

Mesh valid_mesh(const MeshData& data, double frame, const char* name) {
  Mesh mesh = build_mesh(data, {.frame = not_negative(frame, name), .fixed = {}});
  if (const auto defect = validate(mesh)) {
    const bool is_tangled = defect->kind == DefectKind::InvertedFace || defect->kind == DefectKind::FlatFace;
    throw Failure(KINEMESH_BAD_INPUT,
                  defect->message() + (is_tangled ? "; kinemesh_mesh_untangle makes a valid mesh of it" : ""),
                  defect);
  }
  return mesh;
}

kinemesh_step c_step(const StepRecord& record, const Mesh& mesh) {
  const RepairRecord& repair = record.repair;
  return {.step = record.step,
          .vertices = record.vertices,
          .faces = record.faces,
          .time = record.time,
          .dt = record.dt,
          .inverted = repair.inverted,
          .degenerate = repair.degenerate,
          .components = repair.components,
          .regions = static_cast<std::int32_t>(repair.regions.size()),
          .replaced = repair.replaced,
          .escaped = repair.escaped,
          .doubled_edges = repair.doubled_edges,
          .quality_flips = repair.quality_flips,
          .quality_moves = repair.quality_moves,
          .region_faces = repair.region_faces(),
          .region_faces_max = repair.region_faces_max(),
          .explored = repair.explored(),
          .crease_edges = repair.crease_edges(),
          .retries = repair.retries(),
          .region_share = static_cast<double>(repair.region_faces()) / mesh.n_faces(),
          .min_angle_deg = record.min_angle_deg,
          .min_area = record.min_area,
          .move_ms = record.move_ms,
          .interior_ms = record.interior_ms,
          .detect_ms = repair.detect_ms,
          .explore_ms = repair.explore_ms,
          .triangulate_ms = repair.triangulate_ms,
          .splice_ms = repair.splice_ms,
          .quality_ms = repair.quality_ms,
          .measure_ms = record.measure_ms,
          .total_ms = record.total_ms};
}

kinemesh_region c_region(const RegionRecord& region) {
  return {.seed = region.seed,
          .n_faces = static_cast<std::int32_t>(region.user_faces.size()),
          .padding_faces = region.padding_faces(),
          .kept = static_cast<std::int32_t>(region.kept.size()),
          .inverted = region.inverted,
          .degenerate = region.degenerate,
          .components = region.components,
          .explored = region.explored,
          .crease_edges = region.crease_edges,
          .retries = region.retries,
          .border_edges = region.border_edges,
          .gamma_first_stable = region.gamma_first_stable,
          .gamma = region.gamma,
          .rounds = region.rounds,
          .grown = region.grown,
          .self_overlap = region.self_overlap,
          .fallback = region.fallback,
          .centre = {region.centre.x, region.centre.y}};
}

[[noreturn]] void refuse(const StepOutcome& outcome) {
  if (outcome.defect) kinemesh::refuse(*outcome.defect);
  throw Failure(KINEMESH_REGIONS_TOO_LARGE, outcome.message());
}

// step_to(stepper, end time), dt after all steps before. The lengths of steps are added up as if without
// rounding (Knuth's two-sum), so that two of dt / 2 end when one of dt does.
template <class StepTo>
kinemesh_status step(kinemesh_stepper* stepper, double dt, kinemesh_step* record, const StepTo& step_to) {
  return guarded([&] {
    const Using s(stepper, "stepper");
    const double time = s->stepper.time(), added = s->time_rest + not_negative(dt, "dt"), end = time + added;
    const double added_there = end - time;
    StepOutcome outcome = step_to(*stepper, end);
    if (!outcome) refuse(outcome);
    s->time_rest = (time - (end - added_there)) + (added - added_there);
    outcome.record.dt = dt;
    if (record) *record = c_step(outcome.record, s->stepper.mesh());
    s->regions = std::move(outcome.record.repair.regions);
  });
}

}  // namespace

kinemesh_status kinemesh_set_default_options(kinemesh_options* options) {
  return guarded([&] { write(default_options, sized(options, least_options, "options")); });
}

kinemesh_status kinemesh_stepper_create(const kinemesh_mesh* mesh, const kinemesh_options* options,
                                        kinemesh_stepper** stepper) {
  return guarded([&] {
    auto& result = cleared(stepper, "stepper");
    const Using m(mesh, "mesh");
    const kinemesh_options asked = chosen(options);
    const StepperOptions ours = stepper_options(asked);
    result = new kinemesh_stepper{Stepper(valid_mesh(m->data, asked.frame, "options->frame"), ours)};
  });
}

kinemesh_status kinemesh_stepper_create_scenario(const kinemesh_mesh* mesh, const char* scenario,
                                                 double frame, kinemesh_stepper** stepper) {
  return guarded([&] {
    auto& result = cleared(stepper, "stepper");
    const Using m(mesh, "mesh");
    const Scenario parsed = parse_motions(required(scenario, "scenario"), "scenario");
    SetUp made = set_up(parsed, valid_mesh(m->data, frame, "frame"));
    const StepperOptions options = stepper_options(parsed, made.motion);
    result = new kinemesh_stepper{Stepper(std::move(made.mesh), options), std::move(made.motion)};
  });
}

kinemesh_status kinemesh_stepper_destroy(kinemesh_stepper* stepper) {
  return guarded([&] { destroy(stepper, "stepper"); });
}

kinemesh_status kinemesh_stepper_step(kinemesh_stepper* stepper, const double* xy, double dt,
                                      kinemesh_step* record) {
  return step(stepper, dt, record, [&](kinemesh_stepper& s, double end) {
    const auto n = static_cast<std::size_t>(s.stepper.mesh().n_user_vertices());
    return s.stepper.step_to(points(array(xy, 2 * n, "xy")), end);
  });
}

kinemesh_status kinemesh_stepper_step_border(kinemesh_stepper* stepper, int32_t n, const int32_t* vertices,
                                             const double* xy, double dt, kinemesh_step* record) {
  return step(stepper, dt, record, [&](kinemesh_stepper& s, double end) {
    const auto n_vertices = static_cast<std::size_t>(s.stepper.mesh().n_user_vertices());
    const std::size_t named = count(n, "n");
    if (named > n_vertices)
      throw InputError("n is " + std::to_string(n) + ", at most the mesh's " + std::to_string(n_vertices) +
                       " vertices expected");
    const auto to = points(array(xy, 2 * named, "xy"));
    std::vector<UserVertex> which;
    for (const std::int32_t vertex : array(vertices, named, "vertices")) which.emplace_back(vertex);
    return s.stepper.step_border_to(which, to, end);
  });
}

kinemesh_status kinemesh_stepper_advance(kinemesh_stepper* stepper, double dt, kinemesh_step* record) {
  return step(stepper, dt, record, [](kinemesh_stepper& s, double end) {
    if (!s.motion) throw InputError("stepper: one of kinemesh_stepper_create_scenario expected");
    return s.stepper.step_to(*s.motion, end);
  });
}

double* kinemesh_stepper_positions(kinemesh_stepper* stepper) {
  return guarded_or<double*>(nullptr,
                             [&] { return &Using(stepper, "stepper")->stepper.positions().data()->x; });
}

kinemesh_status kinemesh_stepper_repair(kinemesh_stepper* stepper, double dt, kinemesh_step* record) {
  return step(stepper, dt, record,
              [](kinemesh_stepper& s, double end) { return s.stepper.step_to(s.stepper.positions(), end); });
}

int32_t kinemesh_stepper_n_vertices(const kinemesh_stepper* stepper) {
  return guarded_or<int32_t>(none,
                             [&] { return Using(stepper, "stepper")->stepper.mesh().n_user_vertices(); });
}

int32_t kinemesh_stepper_n_faces(const kinemesh_stepper* stepper) {
  return guarded_or<int32_t>(none, [&] { return Using(stepper, "stepper")->stepper.mesh().n_user_faces(); });
}

double kinemesh_stepper_time(const kinemesh_stepper* stepper) {
  return guarded_or(std::nan(""), [&] { return Using(stepper, "stepper")->stepper.time(); });
}

kinemesh_status kinemesh_stepper_get(const kinemesh_stepper* stepper, double* xy, int32_t* triangles,
                                     int32_t* labels) {
  return guarded([&] { copy(Using(stepper, "stepper")->stepper.mesh().domain(), xy, triangles, labels); });
}

kinemesh_status kinemesh_stepper_face_numbers(const kinemesh_stepper* stepper, int32_t* numbers) {
  return guarded([&] {
    const Using s(stepper, "stepper");
    required(numbers, "numbers");
    for (const Face face : s->stepper.mesh().faces_in_user_order())
      *numbers++ = s->stepper.mesh().user_face(face);
  });
}

kinemesh_status kinemesh_stepper_mesh(const kinemesh_stepper* stepper, kinemesh_mesh** mesh) {
  return guarded([&] {
    auto& result = cleared(mesh, "mesh");
    result = new kinemesh_mesh{Using(stepper, "stepper")->stepper.mesh().domain()};
  });
}

kinemesh_status kinemesh_stepper_get_region(const kinemesh_stepper* stepper, int32_t number,
                                            kinemesh_region* region, int32_t* faces) {
  return guarded([&] {
    const Using s(stepper, "stepper");
    const RegionRecord& found = s->regions[index(number, s->regions.size(), "number")];
    if (region) *region = c_region(found);
    if (faces) std::ranges::copy(found.user_faces, faces);
  });
}
