#include "sim/setup.h"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <unordered_set>

#include "core/build.h"
#include "core/io/mesh_io.h"
#include "core/shapes.h"
#include "core/validate.h"
#include "motion/recorded.h"
#include "motion/registry.h"
#include "motion/restriction.h"
#include "sim/shared_fields.h"
#include "sim/toml_table.h"

namespace kinemesh {
namespace {

MeshData shape_of(const MeshSpec& spec) {
  try {
    return make_shape(spec.shape, {.vertices = spec.vertices, .seed = spec.seed, .k = spec.k});
  } catch (const InputError& error) {
    throw error_at(spec.where, error.what());
  }
}

ReadResult data_of(const MeshSpec& spec) {
  return spec.file.empty() ? ReadResult{shape_of(spec), {}}
                           : read_mesh(spec.file, {.split_quads = spec.split_quads});
}

std::string name_of(const MeshSpec& spec) {
  return spec.file.empty() ? "shape " + spec.shape : spec.file.string();
}

[[noreturn]] void refuse_invalid(const MeshSpec& spec, const Defect& defect) {
  const bool is_tangled = defect.kind == DefectKind::InvertedFace || defect.kind == DefectKind::FlatFace;
  throw InputError(name_of(spec), 0,
                   defect.message() + (is_tangled ? "; `kinemesh untangle` makes a valid mesh of it" : ""));
}

Mesh mesh_of(const MeshSpec& spec, const MeshData& data) {
  try {
    Mesh mesh = build_mesh(data, {.frame = spec.frame, .fixed = {}});
    if (const auto defect = validate(mesh)) refuse_invalid(spec, *defect);
    return mesh;
  } catch (const NoEmbedding& error) {
    refuse_invalid(spec, error.defect());
  } catch (const InputError& error) {
    if (!error.file().empty()) throw;
    throw InputError(name_of(spec), 0, error.what());
  }
}

using MarkerNames = std::unordered_set<std::string_view>;

[[noreturn]] void refuse_marker(const Mesh& mesh, const std::string& name, const Where& where) {
  const auto& names = mesh.marker_names();
  throw error_at(where, "no marker '" + name + "' in the mesh" +
                            (names.empty() ? ", which has none" : suggestion(name, names)));
}

// A record fits one mesh and some times only.
void require_record(const AnyField& field, const Mesh& mesh, const Scenario& scenario, const Where& where) {
  const auto* displacement = std::get_if<std::shared_ptr<const DisplacementField>>(&field);
  const auto* record = displacement ? dynamic_cast<const RecordedPositions*>(displacement->get()) : nullptr;
  if (!record) return;
  try {
    record->require_initial(mesh.user_positions());
    record->require_times(0.0, scenario.time.end);
  } catch (const InputError& error) {
    throw error_at(where, error.what());
  }
}

// Terms of the motion; markers that are moved by one of them are added to `border` where it does not name
// them.
std::vector<MotionTerm> terms_of(const Scenario& scenario, const Mesh& mesh, BorderConditions& border) {
  std::vector<MotionTerm> terms;
  const MarkerNames names(mesh.marker_names().begin(), mesh.marker_names().end());
  SharedFields fields;
  for (const MotionSpec& motion : scenario.motions) {
    terms.push_back({fields.of(motion), parse_restriction(motion.on, motion.blend)});
    require_record(terms.back().field, mesh, scenario, motion.where_of("file"));
    if (const auto* on = std::get_if<OnMarker>(&terms.back().where.on)) {
      if (!names.contains(on->name)) refuse_marker(mesh, on->name, motion.where_of("on"));
      border.by_marker.emplace(on->name, BorderCondition::Moving);
    }
  }
  return terms;
}

BorderConditions border_of(const Scenario& scenario, const Mesh& mesh) {
  const MarkerNames names(mesh.marker_names().begin(), mesh.marker_names().end());
  for (const auto& [marker, where] : scenario.border.marker_where)
    if (marker != "default" && !names.contains(marker)) refuse_marker(mesh, marker, where);
  return scenario.border.conditions;
}

// "motion.1.on" is about that key of the second [[motion]], anything else about a marker in [border].
Where where_of(const Scenario& scenario, std::string_view key) {
  if (key.starts_with("motion.")) {
    size_t index = 0;
    const char* end = std::from_chars(key.data() + 7, key.data() + key.size(), index).ptr;
    if (index < scenario.motions.size() && end != key.data() + key.size())
      return scenario.motions[index].where_of(key.substr(static_cast<size_t>(end - key.data()) + 1));
  }
  const auto found = scenario.border.marker_where.find(key);
  return found == scenario.border.marker_where.end() ? Where{scenario.file.string(), 0} : found->second;
}

// The first vertex of the convex hull that may leave it: one that moves freely, or slides along a slanted
// line, where rounding takes it off the line. Along x or y it stays exactly.
std::optional<int> leaving_hull_vertex(const Mesh& mesh, const Freedom& freedom) {
  for (int h = 0; h < 2 * mesh.n_edges(); ++h)
    if (const int v = mesh.to(h); mesh.face_of(h) == none && (freedom.of(v) == BorderCondition::Moving ||
                                                              freedom.allowed(v, {1.0, 0.0}).y != 0.0))
      return v;
  return std::nullopt;
}

void require_still_hull(const Scenario& scenario, const Mesh& mesh, const BorderConditions& border) {
  if (!mesh.frame().empty()) return;
  const Freedom freedom(mesh, border);
  const auto vertex = leaving_hull_vertex(mesh, freedom);
  if (!vertex) return;
  const bool is_sliding = freedom.of(*vertex) == BorderCondition::Slide;
  throw error_at(scenario.mesh.where,
                 "frame = 0, but the outer border " +
                     std::string(is_sliding ? "slides along a slanted line" : "may move") + " at vertex " +
                     std::to_string(mesh.user_vertex(*vertex)) +
                     "; a frame above 0 or a fixed border expected");
}

}  // namespace

StepperOptions stepper_options(const RepairSpec& repair) {
  return {.strategy = repair.strategy,
          .allow_escaped = repair.allow_escaped,
          .retain = repair.retain,
          .quality = repair.quality};
}

SetUp set_up(const Scenario& scenario) {
  ReadResult read = data_of(scenario.mesh);
  SetUp made = set_up(scenario, mesh_of(scenario.mesh, read.mesh));
  made.notes = std::move(read.notes);
  return made;
}

SetUp set_up(const Scenario& scenario, Mesh mesh) {
  BorderConditions border = border_of(scenario, mesh);
  auto terms = terms_of(scenario, mesh, border);
  try {
    require_still_hull(scenario, mesh, border);
    Motion motion(mesh, std::move(terms), std::move(border), scenario.time.integrator);
    return {std::move(mesh), std::move(motion), {}};
  } catch (const ParameterError& error) {
    throw error_at(where_of(scenario, error.key()), error.what());
  }
}

}  // namespace kinemesh
