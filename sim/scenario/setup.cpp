#include "kinemesh/setup.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <string_view>
#include <unordered_set>

#include "kinemesh/build.h"
#include "kinemesh/mesh_io.h"
#include "kinemesh/registry.h"
#include "kinemesh/shapes.h"
#include "kinemesh/validate.h"
#include "motion/body.h"
#include "motion/border.h"
#include "motion/fields/prescribed_path.h"
#include "motion/fields/recorded.h"
#include "motion/interior/interior.h"
#include "motion/restriction.h"
#include "sim/scenario/shared_fields.h"
#include "sim/scenario/toml_table.h"

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

// What a field reads from a file fits some times only; and a record, which `fits` is asked for, some places.
template <class Fits>
void require_file(const AnyField& field, double end, const Where& where, const Fits& fits) {
  const auto* displacement = std::get_if<std::shared_ptr<const DisplacementField>>(&field);
  if (!displacement) return;
  try {
    if (const auto* table = dynamic_cast<const TablePath*>(displacement->get()))
      table->require_times(0.0, end);
    if (const auto* record = dynamic_cast<const RecordedPositions*>(displacement->get())) {
      fits(*record);
      record->require_times(0.0, end);
    }
  } catch (const InputError& error) {
    throw error_at(where, error.what());
  }
}

std::vector<MotionTerm> terms_of(const Scenario& scenario, const Mesh& mesh) {
  std::vector<MotionTerm> terms;
  const MarkerNames names(mesh.marker_names().begin(), mesh.marker_names().end());
  SharedFields fields;
  for (const MotionSpec& motion : scenario.motions) {
    MotionTerm& term = terms.emplace_back();
    term.field = fields.of(motion);
    require_file(term.field, scenario.time.end, motion.where_of("file"),
                 [&](const RecordedPositions& record) { record.require_initial(mesh.user_positions()); });
    for (const std::string& part : motion.on) {
      const Restriction restriction = parse_restriction(part, motion.blend);
      const auto* on = std::get_if<OnMarker>(&restriction.on);
      if (on && !names.contains(on->name)) refuse_marker(mesh, on->name, motion.where_of("on"));
      if (&part == &motion.on.front())
        term.where = restriction;
      else
        term.also.push_back(restriction);
    }
  }
  return terms;
}

// A marker that [border] holds still cannot be a body's.
std::vector<BodySpec> bodies_of(const Scenario& scenario, const Mesh& mesh, const BorderConditions& border) {
  std::vector<BodySpec> bodies;
  const MarkerNames names(mesh.marker_names().begin(), mesh.marker_names().end());
  SharedFields fields;
  for (const BodyScenario& body : scenario.bodies) {
    BodySpec& spec = bodies.emplace_back(BodySpec{body.on, {}});
    for (const std::string& part : body.on) {
      if (!part.starts_with("marker:")) continue;
      const std::string marker = part.substr(7);
      if (!names.contains(marker)) refuse_marker(mesh, marker, body.where_of("on"));
      const auto condition = border.by_marker.find(marker);
      if (condition != border.by_marker.end() && condition->second != BorderCondition::Moving)
        throw error_at(
            scenario.border.marker_where.at(marker),
            "the marker '" + marker + "' is of a body, which moves it; \"moving\" or nothing expected");
    }
    for (const MotionSpec& motion : body.motions) spec.motion.push_back(fields.of(motion));
  }
  return bodies;
}

// A body's record holds its vertices, and may hold others.
void require_body_files(const Scenario& scenario, const Motion& motion, const std::vector<BodySpec>& bodies) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    std::vector<Point> places;
    for (const Vertex v : motion.bodies()[b].vertices()) places.push_back(motion.initial_positions()[v]);
    for (std::size_t i = 0; i < bodies[b].motion.size(); ++i)
      require_file(bodies[b].motion[i], scenario.time.end, scenario.bodies[b].motions[i].where_of("file"),
                   [&](const RecordedPositions& record) { record.require_all(places); });
  }
}

void require_labels(const InteriorSpec& interior, const Mesh& mesh) {
  if (interior.label_where.empty()) return;
  std::set<int> labels;
  for (const Face f : mesh.faces())
    if (!mesh.is_padding(f)) labels.insert(mesh.label(f));
  for (const auto& [label, where] : interior.label_where)
    if (!labels.contains(label))
      throw error_at(where, fmt::format("interior.stiffness.{}: no label {} in the mesh, expected one of: {}",
                                        label, label, fmt::join(labels, ", ")));
}

// Whether a body has vertices that the motion names, and nobody but bodies and fixed borders has any.
bool is_idle(const MotionSpec& spec, const Mesh& mesh, const Motion& motion) {
  bool meets_body = false;
  for (const std::string& part : spec.on) {
    const auto named = weights(mesh, parse_restriction(part, spec.blend));
    for (const Vertex v : mesh.vertices()) {
      if (!named.empty() && named[v] == 0.0) continue;
      if (motion.body_of(v) == none && motion.freedom().of(v) != BorderCondition::Fixed) return false;
      meets_body |= motion.body_of(v) != none;
    }
  }
  return meets_body;
}

void add_notes_on_idle_motions(const Scenario& scenario, const Mesh& mesh, const Motion& motion,
                               std::vector<std::string>& notes) {
  if (motion.bodies().empty()) return;
  for (const MotionSpec& spec : scenario.motions)
    if (is_idle(spec, mesh, motion))
      notes.push_back(
          error_at(spec.where_of("on"), fmt::format("on: {} moves nothing, as bodies own all of {}",
                                                    spec.field, fmt::join(spec.on, ", ")))
              .what());
}

BorderConditions border_of(const Scenario& scenario, const Mesh& mesh) {
  const MarkerNames names(mesh.marker_names().begin(), mesh.marker_names().end());
  for (const auto& [marker, where] : scenario.border.marker_where)
    if (marker != "default" && !names.contains(marker)) refuse_marker(mesh, marker, where);
  return scenario.border.conditions;
}

// Of "motion.1.on": that key of the second of these; nothing for another prefix.
template <class Items>
std::optional<Where> where_in(const Items& items, std::string_view prefix, std::string_view key) {
  if (!key.starts_with(prefix)) return std::nullopt;
  size_t index = 0;
  const char* end = std::from_chars(key.data() + prefix.size(), key.data() + key.size(), index).ptr;
  if (index >= items.size() || end == key.data() + key.size()) return std::nullopt;
  return items[index].where_of(key.substr(static_cast<size_t>(end - key.data()) + 1));
}

// What is about no [[motion]] and no [[body]] is about a marker in [border].
Where where_of(const Scenario& scenario, std::string_view key) {
  if (const auto where = where_in(scenario.motions, "motion.", key)) return *where;
  if (const auto where = where_in(scenario.bodies, "body.", key)) return *where;
  const auto found = scenario.border.marker_where.find(key);
  return found == scenario.border.marker_where.end() ? Where{scenario.file.string(), 0} : found->second;
}

// The first vertex of the convex hull that may leave it: one that moves freely, or slides along a slanted
// line, where rounding takes it off the line. Along x or y it stays exactly.
std::optional<Vertex> leaving_hull_vertex(const Mesh& mesh, const Freedom& freedom) {
  const auto leaves = [&](Vertex v) {
    return freedom.of(v) == BorderCondition::Moving ||
           freedom.allowed(v, mesh.position(v), {1.0, 0.0}).y != 0.0;
  };
  const auto found = std::ranges::find_if(mesh.hull(), leaves);
  return found == mesh.hull().end() ? std::nullopt : std::optional(*found);
}

void require_still_hull(const Scenario& scenario, const Mesh& mesh, const Freedom& freedom) {
  if (!mesh.frame().empty()) return;
  const auto vertex = leaving_hull_vertex(mesh, freedom);
  if (!vertex) return;
  const bool is_sliding = freedom.of(*vertex) == BorderCondition::Slide;
  throw error_at(scenario.mesh.frame_where,
                 "frame = 0, but the outer border " +
                     std::string(is_sliding ? "slides along a slanted line" : "may move") + " at vertex " +
                     std::to_string(mesh.user_vertex(*vertex)) +
                     "; a frame above 0 or a fixed border expected");
}

}  // namespace

namespace {

VertexFreedom freedom_of(const Motion& motion) {
  VertexFreedom freedom;
  const auto initial = motion.initial_positions();
  if (!motion.bodies().empty()) freedom.held.assign(initial.size(), false);
  for (const Body& body : motion.bodies())
    for (const Vertex v : body.vertices()) freedom.held[v] = true;
  const auto may_slide = [&](Vertex v) {
    return motion.freedom().of(v) == BorderCondition::Slide && motion.body_of(v) == none;
  };
  for (const SlideLine& line : motion.freedom().lines()) {
    if (line.is_straight()) {
      for (const Vertex v : line.vertices())
        if (may_slide(v)) freedom.tangents.emplace(v, motion.freedom().tangent(v, initial[v]));
    } else {
      for (const Vertex v : line.inner_vertices())
        if (may_slide(v)) freedom.curve_of.emplace(v, static_cast<int>(freedom.curves.size()));
      freedom.curves.push_back(line);
    }
  }
  return freedom;
}

}  // namespace

StepperOptions stepper_options(const RepairSpec& repair, const Motion& motion) {
  return {.strategy = repair.strategy,
          .allow_escaped = repair.allow_escaped,
          .retain = repair.retain,
          .quality = repair.quality,
          .angle = repair.angle,
          .freedom = freedom_of(motion)};
}

SetUp set_up(const Scenario& scenario) {
  ReadResult read = data_of(scenario.mesh);
  SetUp made = set_up(scenario, mesh_of(scenario.mesh, read.mesh));
  made.notes.insert(made.notes.begin(), read.notes.begin(), read.notes.end());
  return made;
}

SetUp set_up(const Scenario& scenario, Mesh mesh) {
  BorderConditions border = border_of(scenario, mesh);
  require_labels(scenario.interior, mesh);
  const auto bodies = bodies_of(scenario, mesh, border);
  auto terms = terms_of(scenario, mesh);
  try {
    Motion motion(mesh, std::move(terms), std::move(border), scenario.time.integrator, bodies,
                  scenario.interior.options);
    require_still_hull(scenario, mesh, motion.freedom());
    require_body_files(scenario, motion, bodies);
    auto notes = motion.notes();
    add_notes_on_idle_motions(scenario, mesh, motion, notes);
    return {std::move(mesh), std::move(motion), std::move(notes)};
  } catch (const ParameterError& error) {
    throw error_at(where_of(scenario, error.key()), error.what());
  }
}

}  // namespace kinemesh
