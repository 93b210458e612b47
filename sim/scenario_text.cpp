// The scenario written out.
#include <toml++/toml.h>
#include <sstream>

#include "sim/scenario.h"

namespace kinemesh {
namespace {

const char* to_string(BorderCondition condition) {
  switch (condition) {
    case BorderCondition::Moving:
      return "moving";
    case BorderCondition::Slide:
      return "slide";
    case BorderCondition::Fixed:
      break;
  }
  return "fixed";
}

toml::array as_array(std::span<const double> numbers) {
  toml::array list;
  for (const double number : numbers) list.push_back(number);
  return list;
}

class Writer {
 public:
  void header(const char* text) { out_ << (out_.tellp() > 0 ? "\n" : "") << text << "\n"; }
  void line(const std::string& key, const std::string& text) { write(key, toml::value<std::string>(text)); }
  void line(const std::string& key, double number) { write(key, toml::value<double>(number)); }
  void line(const std::string& key, std::int64_t number) { write(key, toml::value<std::int64_t>(number)); }
  void line(const std::string& key, bool value) { write(key, toml::value<bool>(value)); }
  void line(const std::string& key, std::span<const double> numbers) { write(key, as_array(numbers)); }
  std::string text() const { return out_.str(); }

 private:
  // A key of other characters than letters, digits, - and _ needs quotes: let the library decide.
  template <class Value>
  void write(const std::string& key, const Value& value) {
    toml::table pair;
    pair.insert(key, value);
    out_ << pair << "\n";
  }

  std::ostringstream out_;
};

void write(Writer& out, const MeshSpec& mesh) {
  out.header("[mesh]");
  if (!mesh.file.empty()) {
    out.line("file", std::filesystem::absolute(mesh.file).string());
  } else {
    out.line("shape", mesh.shape);
    out.line("vertices", std::int64_t{mesh.vertices});
    out.line("seed", static_cast<std::int64_t>(mesh.seed));
    if (mesh.shape == "umbilic") out.line("k", std::int64_t{mesh.k});
  }
  out.line("frame", mesh.frame);
}

void write(Writer& out, const MotionSpec& motion) {
  out.header("[[motion]]");
  out.line("field", motion.field);
  for (const auto& [key, value] : motion.parameters)
    std::visit([&out, &key = key](const auto& v) { out.line(key, v); }, value);
  out.line("on", motion.on);
  if (motion.blend) out.line("blend", *motion.blend);
}

void write(Writer& out, const BorderSpec& border) {
  out.header("[border]");
  out.line("default", std::string(to_string(border.conditions.otherwise)));
  for (const auto& [marker, condition] : border.conditions.by_marker)
    out.line(marker, std::string(to_string(condition)));
}

// The two of which the third follows without another rounding.
void write(Writer& out, const TimeSpec& time) {
  out.header("[time]");
  const bool is_end_implied = time.end == time.dt * time.steps;
  const bool is_dt_implied = !is_end_implied && time.dt == time.end / time.steps;
  if (!is_dt_implied) out.line("dt", time.dt);
  if (!is_end_implied) out.line("end", time.end);
  if (is_end_implied || is_dt_implied) out.line("steps", std::int64_t{time.steps});
  out.line("integrator", std::string(to_string(time.integrator)));
}

void write(Writer& out, const RepairSpec& repair) {
  out.header("[repair]");
  out.line("strategy", repair.strategy);
  out.line("quality", repair.quality);
  out.line("allow_escaped", repair.allow_escaped);
}

void write(Writer& out, const OutputSpec& output) {
  out.header("[output]");
  out.line("every", std::int64_t{output.every});
  out.line("checkpoint", std::int64_t{output.checkpoint});
}

}  // namespace

std::string to_toml(const Scenario& scenario) {
  Writer out;
  write(out, scenario.mesh);
  for (const auto& motion : scenario.motions) write(out, motion);
  write(out, scenario.border);
  write(out, scenario.time);
  write(out, scenario.repair);
  write(out, scenario.output);
  return out.text();
}

}  // namespace kinemesh
