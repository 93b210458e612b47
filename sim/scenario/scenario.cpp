#include "kinemesh/scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "core/io/atomic_file.h"
#include "kinemesh/registry.h"
#include "kinemesh/shapes.h"
#include "kinemesh/strategy.h"
#include "motion/border.h"
#include "motion/integrator.h"
#include "motion/interior/stiffness.h"
#include "motion/restriction.h"
#include "sim/scenario/overrides.h"
#include "sim/scenario/shared_fields.h"
#include "sim/scenario/toml_table.h"
#include "sim/scenario/toml_text.h"
#include "untangle/quality/quality_pass.h"

namespace kinemesh {
namespace {

constexpr int most = std::numeric_limits<int>::max();

template <class Items>
std::vector<std::string> names_of(const Items& items) {
  std::vector<std::string> names;
  for (const auto& item : items) names.push_back(item.name);
  return names;
}

void require_one_of(const TomlTable& table, std::string_view key, const std::string& name,
                    const std::vector<std::string>& names) {
  if (std::ranges::find(names, name) == names.end())
    table.fail(key, "unknown: '" + name + "'" + suggestion(name, names));
}

// A whole section, or an empty one where it is absent.
TomlTable section(TomlTable& root, std::string_view key) {
  static const toml::table nothing;
  const auto* table = root.table(key);
  return {table ? *table : nothing, "[" + std::string(key) + "]"};
}

void read_file_source(TomlTable& table, const std::string& file, const std::filesystem::path& folder,
                      MeshSpec& mesh) {
  for (const std::string_view key : {"shape", "vertices", "seed", "k"})
    if (table.has(key)) table.fail(key, "belongs to a shape, but 'file' is given");
  if (file.empty()) table.fail("file", "the name of a mesh file expected");
  mesh.file = (folder / file).lexically_normal();
  mesh.split_quads = table.boolean("split_quads").value_or(mesh.split_quads);
}

void read_shape_source(TomlTable& table, const std::string& shape, MeshSpec& mesh) {
  require_one_of(table, "shape", shape, names_of(shapes()));
  if (table.has("split_quads")) table.fail("split_quads", "belongs to a file, but 'shape' is given");
  mesh.shape = shape;
  mesh.vertices = static_cast<int>(table.integer("vertices", 3, most).value_or(mesh.vertices));
  mesh.seed =
      static_cast<std::uint64_t>(table.integer("seed", 0).value_or(static_cast<std::int64_t>(mesh.seed)));
  const auto k = table.integer("k", 2, 32);
  if (k && shape != "umbilic") table.fail("k", "belongs to the shape umbilic");
  mesh.k = static_cast<int>(k.value_or(mesh.k));
}

MeshSpec read_mesh_spec(TomlTable& table, const std::filesystem::path& folder) {
  MeshSpec mesh;
  mesh.where = table.where();
  const auto file = table.text("file"), shape = table.text("shape");
  if (file) {
    read_file_source(table, *file, folder, mesh);
  } else if (shape) {
    mesh.where = table.where("shape");
    read_shape_source(table, *shape, mesh);
  } else {
    throw error_at(table.where(), "[mesh]: file or shape expected");
  }
  mesh.frame = table.not_negative("frame").value_or(mesh.frame);
  mesh.frame_where = table.where("frame");
  table.refuse_other_keys();
  return mesh;
}

// Calls f() and gives its error the line of the key it is about: a parameter, or the file it names.
template <class F>
void with_lines(const MotionSpec& motion, const F& f) {
  try {
    f();
  } catch (const ParameterError& error) {
    throw error_at(motion.where_of(error.key()), error.what());
  } catch (const InputError& error) {
    if (error.file().empty()) throw error_at(motion.where, error.what());
    throw error_at(motion.where_of("file"), std::string("file: ") + error.what());
  }
}

void read_blend(TomlTable& table, MotionSpec& motion) {
  const auto value = table.value("blend");
  if (!value) return;
  const auto* pair = std::get_if<std::vector<double>>(&*value);
  if (!pair || pair->size() != 2) table.fail("blend", "two distances expected: [full, zero]");
  motion.blend = {(*pair)[0], (*pair)[1]};
}

void check_motion(const MotionSpec& motion, SharedFields& fields) {
  with_lines(motion, [&] {
    static_cast<void>(fields.of(motion));
    for (const std::string& part : motion.on) parse_restriction(part, motion.blend);
  });
}

void add_defaults(MotionSpec& motion) {
  for (const auto& field : fields()) {
    if (field.name != motion.field) continue;
    for (const auto& parameter : field.parameters)
      if (parameter.otherwise) motion.parameters.try_emplace(parameter.name, *parameter.otherwise);
  }
}

// Files are named relative to the scenario.
void resolve_files(const std::filesystem::path& folder, MotionSpec& motion) {
  for (const auto& field : fields()) {
    if (field.name != motion.field) continue;
    for (const auto& parameter : field.parameters) {
      const auto given = motion.parameters.find(parameter.name);
      if (!is_file(parameter.kind) || given == motion.parameters.end()) continue;
      if (auto* name = std::get_if<std::string>(&given->second); name && !name->empty())
        *name = (folder / *name).lexically_normal().string();
    }
  }
}

// The field and its parameters; `others` are keys that are none.
void read_field(TomlTable& table, const std::string& name, const std::vector<std::string>& others,
                const std::filesystem::path& folder, MotionSpec& motion) {
  motion.where = table.where();
  for (const auto& key : table.keys()) motion.key_where[key] = table.where(key);
  const auto field = table.text("field");
  if (!field) throw error_at(motion.where, name + ": field expected, one `kinemesh list` names");
  motion.field = *field;
  require_one_of(table, "field", motion.field, names_of(fields()));
  for (const auto& key : table.keys())
    if (key != "field" && std::ranges::find(others, key) == others.end())
      motion.parameters.emplace(key, *table.value(key));
  resolve_files(folder, motion);
}

MotionSpec read_motion(const toml::table& source, const std::filesystem::path& folder, SharedFields& shared) {
  TomlTable table(source, "[[motion]]");
  MotionSpec motion;
  motion.on = table.texts("on").value_or(motion.on);
  read_blend(table, motion);
  read_field(table, "[[motion]]", {"on", "blend"}, folder, motion);
  check_motion(motion, shared);
  add_defaults(motion);
  return motion;
}

std::vector<MotionSpec> read_motions(TomlTable& root, const std::filesystem::path& folder) {
  std::vector<MotionSpec> motions;
  SharedFields shared;
  for (const auto* table : root.tables("motion")) motions.push_back(read_motion(*table, folder, shared));
  return motions;
}

BodyScenario read_body(const toml::table& source, const std::filesystem::path& folder, SharedFields& shared) {
  TomlTable table(source, "[[body]]");
  BodyScenario body;
  body.where = table.where();
  for (const auto& key : table.keys()) body.key_where[key] = table.where(key);
  const auto on = table.texts("on");
  if (!on) throw error_at(body.where, "[[body]]: on expected, marker:NAME or label:N");
  body.on = *on;
  for (const auto* motion : table.tables("motion")) {
    TomlTable inner(*motion, "[[body]] motion");
    MotionSpec& spec = body.motions.emplace_back();
    read_field(inner, "[[body]] motion", {}, folder, spec);
    check_motion(spec, shared);
    add_defaults(spec);
  }
  table.refuse_other_keys();
  return body;
}

std::vector<BodyScenario> read_bodies(TomlTable& root, const std::filesystem::path& folder) {
  std::vector<BodyScenario> bodies;
  SharedFields shared;
  for (const auto* table : root.tables("body")) bodies.push_back(read_body(*table, folder, shared));
  return bodies;
}

void read_stiffness(const toml::table& source, InteriorSpec& interior) {
  TomlTable table(source, "[interior] stiffness");
  for (const auto& key : table.keys()) {
    int label = 0;
    const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), label);
    if (error != std::errc() || end != key.data() + key.size())
      throw error_at(table.where(key),
                     "interior.stiffness." + key + ": a label, that is an integer, expected");
    const double value = *table.number(key);
    if (!(value >= least_stiffness && value <= most_stiffness))
      throw error_at(table.where(key),
                     fmt::format("interior.stiffness.{}: {}, a number from {} to {} expected", key, value,
                                 least_stiffness, most_stiffness));
    interior.options.stiffness[label] = value;
    interior.label_where[label] = table.where(key);
  }
}

InteriorSpec read_interior(TomlTable& table, bool has_bodies) {
  InteriorSpec interior;
  interior.where = table.where();
  const auto follow = table.text("follow").value_or(has_bodies ? "harmonic" : "none");
  require_one_of(table, "follow", follow, {"harmonic", "elastic", "none"});
  interior.options.follow = follow == "harmonic"  ? Follow::Harmonic
                            : follow == "elastic" ? Follow::Elastic
                                                  : Follow::None;
  if (const auto* stiffness = table.table("stiffness")) {
    if (follow == "none") table.fail("stiffness", "belongs to an interior that follows");
    read_stiffness(*stiffness, interior);
  }
  table.refuse_other_keys();
  return interior;
}

BorderCondition read_condition(TomlTable& table, const std::string& key) {
  try {
    return parse_border_condition(*table.text(key), key);
  } catch (const ParameterError& error) {
    throw error_at(table.where(key), error.what());
  }
}

BorderSpec read_border(TomlTable& table) {
  BorderSpec border;
  for (const auto& key : table.keys()) {
    border.marker_where[key] = table.where(key);
    const auto condition = read_condition(table, key);
    if (key == "default")
      border.conditions.otherwise = condition;
    else
      border.conditions.by_marker[key] = condition;
  }
  return border;
}

Integrator read_integrator(TomlTable& table) {
  const auto name = table.text("integrator");
  if (!name) return Integrator::Rk4;
  try {
    return parse_integrator(*name);
  } catch (const ParameterError& error) {
    throw error_at(table.where("integrator"), error.what());
  }
}

void complete(const TomlTable& table, const std::optional<double>& end, const std::optional<double>& dt,
              const std::optional<std::int64_t>& steps, TimeSpec& time) {
  time.steps = static_cast<int>(steps.value_or(0));
  time.dt = dt ? *dt : *end / time.steps;
  time.end = end ? *end : *dt * time.steps;
  if (!std::isfinite(time.end)) table.fail("steps", "steps times dt overflows");
  if (time.dt == 0.0) table.fail("steps", "so many steps to so early an end are of no length");
  if (steps) return;
  const auto needed = steps_to_reach(*end, *dt);
  if (!needed) table.fail("dt", "too short, it takes more than " + std::to_string(most) + " steps");
  time.steps = *needed;
}

constexpr double halvings = 1024.0;  // of dt, where min_dt is not given

AdaptiveSpec read_adaptive(const toml::table& source, const TimeSpec& time) {
  TomlTable table(source, "[time] adaptive");
  AdaptiveSpec adaptive;
  adaptive.max_region_share = table.positive("max_region_share");
  adaptive.min_dt = table.positive("min_dt").value_or(time.dt / halvings);
  adaptive.max_dt = table.positive("max_dt").value_or(time.dt);
  table.refuse_other_keys();
  if (adaptive.min_dt > time.dt) table.fail("min_dt", "a number not above dt expected");
  if (adaptive.max_dt < time.dt) table.fail("max_dt", "a number not below dt expected");
  if (!steps_to_reach(time.end, adaptive.min_dt))
    table.fail("min_dt", "too short, it takes more than " + std::to_string(most) + " steps");
  return adaptive;
}

TimeSpec read_time(TomlTable& table) {
  TimeSpec time;
  const auto end = table.positive("end"), dt = table.positive("dt");
  const auto steps = table.integer("steps", 1, most);
  time.integrator = read_integrator(table);
  const auto* adaptive = table.table("adaptive");
  table.refuse_other_keys();
  if (end.has_value() + dt.has_value() + steps.has_value() != 2)
    throw error_at(table.where(), "[time]: two of end, dt and steps expected");
  complete(table, end, dt, steps, time);
  if (adaptive) time.adaptive = read_adaptive(*adaptive, time);
  return time;
}

// Below 60 degrees; said with quality "angles" only.
std::optional<double> read_angle(TomlTable& table, const std::string& quality) {
  const auto angle = table.positive("angle");
  if (angle && quality != "angles") table.fail("angle", "has a meaning with quality = 'angles' only");
  if (angle && !(*angle < 60.0)) table.fail("angle", "degrees below 60 expected");
  return angle;
}

RepairSpec read_repair(TomlTable& table, bool has_bodies) {
  RepairSpec repair;
  if (has_bodies) repair.quality = "angles";
  repair.strategy = table.text("strategy").value_or(repair.strategy);
  require_one_of(table, "strategy", repair.strategy, names_of(strategies()));
  repair.quality = table.text("quality").value_or(repair.quality);
  require_one_of(table, "quality", repair.quality, names_of(qualities()));
  repair.angle = read_angle(table, repair.quality).value_or(repair.angle);
  repair.allow_escaped = table.boolean("allow_escaped").value_or(repair.allow_escaped);
  repair.retain = table.boolean("retain").value_or(repair.retain);
  table.refuse_other_keys();
  return repair;
}

OutputSpec read_output(TomlTable& table) {
  OutputSpec output;
  output.every = static_cast<int>(table.integer("every", 0, most).value_or(output.every));
  output.checkpoint = static_cast<int>(table.integer("checkpoint", 0, most).value_or(output.checkpoint));
  output.patches = table.boolean("patches").value_or(output.patches);
  table.refuse_other_keys();
  return output;
}

toml::table parse_toml(std::string_view text, const std::string& file) {
  check_toml(text, file);
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    throw InputError(file, static_cast<int>(error.source().begin.line), std::string(error.description()));
  }
}

constexpr std::string_view tables_of_motions[] = {"body", "motion", "interior", "border", "repair"};

void read_what_moves(TomlTable& root, const std::filesystem::path& folder, Scenario& scenario) {
  scenario.bodies = read_bodies(root, folder);
  scenario.motions = read_motions(root, folder);
  const bool has_bodies = !scenario.bodies.empty();
  if (!has_bodies && scenario.motions.empty())
    throw error_at(root.where(), "at least one [[body]] or [[motion]] expected");
  auto interior = section(root, "interior"), border = section(root, "border"),
       repair = section(root, "repair");
  scenario.interior = read_interior(interior, has_bodies);
  scenario.border = read_border(border);
  scenario.repair = read_repair(repair, has_bodies);
}

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return std::filesystem::absolute(file).parent_path();
}

Scenario read_scenario(const toml::table& document, const std::filesystem::path& file) {
  TomlTable root(document, "");
  Scenario scenario;
  scenario.file = file;
  auto mesh = section(root, "mesh"), time = section(root, "time"), output = section(root, "output");
  for (const std::string_view key : tables_of_motions) root.known(key);
  root.refuse_other_keys();
  for (const std::string_view key : {"mesh", "time"})
    if (!root.has(key)) throw error_at(root.where(), "[" + std::string(key) + "] expected");
  const auto folder = folder_of(file);
  scenario.mesh = read_mesh_spec(mesh, folder);
  read_what_moves(root, folder, scenario);
  scenario.time = read_time(time);
  scenario.output = read_output(output);
  return scenario;
}

}  // namespace

Where MotionSpec::where_of(std::string_view key) const {
  const auto found = key_where.find(key);
  return found == key_where.end() ? where : found->second;
}

Where BodyScenario::where_of(std::string_view key) const {
  const auto found = key_where.find(key);
  return found == key_where.end() ? where : found->second;
}

double TimeSpec::time_after(int step) const {
  return step >= steps ? end : step * dt;
}

std::optional<int> steps_to_reach(double end, double dt) {
  const double ratio = end / dt;
  if (!(ratio < most)) return std::nullopt;
  // end, dt and the ratio are rounded once each: what exceeds a whole number by less is not a step.
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * ratio;
  return std::max(1, static_cast<int>(std::ceil(ratio - rounding)));
}

Scenario parse_scenario(std::string_view text, const std::filesystem::path& file,
                        std::span<const std::string> overrides) {
  auto document = parse_toml(text, file.string());
  for (const auto& assignment : overrides) apply_override(document, assignment);
  return read_scenario(document, file);
}

Scenario parse_motions(std::string_view text, const std::filesystem::path& file) {
  const auto document = parse_toml(text, file.string());
  TomlTable root(document, "");
  for (const std::string_view key : {"mesh", "time", "output"})
    if (root.has(key)) root.fail(key, "belongs to a run, not expected where the mesh is there already");
  for (const std::string_view key : tables_of_motions) root.known(key);
  root.refuse_other_keys();
  Scenario scenario;
  scenario.file = file;
  read_what_moves(root, folder_of(file), scenario);
  return scenario;
}

Scenario load_scenario(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return parse_scenario(read_file(file), file, overrides);
}

}  // namespace kinemesh
