// The scenario written out.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "kinemesh/scenario.h"
#include "motion/integrator.h"

namespace kinemesh {
namespace {

// The shortest decimal that reads back as the same number, and reads as a floating-point one.
std::string to_text(double number) {
  const std::string text = fmt::format("{}", number);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string to_text(std::span<const double> numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : ", ") + to_text(number);
  return "[" + text + "]";
}

std::string to_text(const std::vector<Point>& points) {
  std::string text;
  for (const Point& p : points) text += (text.empty() ? "" : ", ") + to_text(std::array{p.x, p.y});
  return "[" + text + "]";
}

bool is_control(char c) {
  return (c >= 0 && c < ' ') || c == 127;
}

// In single quotes as it is, or in double ones with escapes where it has single quotes or control characters.
// Always in one line.
std::string to_text(const std::string& text) {
  if (text.find('\'') == std::string::npos && std::ranges::none_of(text, is_control)) return "'" + text + "'";
  std::string escaped;
  for (const char c : text) {
    if (is_control(c)) {
      escaped += fmt::format("\\u{:04X}", c);
    } else {
      if (c == '"' || c == '\\') escaped += '\\';
      escaped += c;
    }
  }
  return '"' + escaped + '"';
}

// One text, or a list of several.
std::string to_text(const std::vector<std::string>& texts) {
  if (texts.size() == 1) return to_text(texts.front());
  std::string list;
  for (const std::string& text : texts) list += (list.empty() ? "" : ", ") + to_text(text);
  return "[" + list + "]";
}

std::string to_text(std::int64_t number) {
  return std::to_string(number);
}

std::string to_text(bool value) {
  return value ? "true" : "false";
}

std::string to_text(const AdaptiveSpec& adaptive) {
  const auto share = adaptive.max_region_share;
  return fmt::format("{{{}min_dt = {}, max_dt = {}}}",
                     share ? "max_region_share = " + to_text(*share) + ", " : "", to_text(adaptive.min_dt),
                     to_text(adaptive.max_dt));
}

// A key that is not of letters, digits, - and _ alone needs quotes.
std::string key_text(const std::string& key) {
  const auto is_bare = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  return !key.empty() && std::ranges::all_of(key, is_bare) ? key : to_text(key);
}

class Writer {
 public:
  void header(const char* text) { text_ += (text_.empty() ? "" : "\n") + std::string(text) + "\n"; }

  template <class Value>
  void line(const std::string& key, const Value& value) {
    text_ += key_text(key) + " = " + to_text(value) + "\n";
  }

  void raw_line(const std::string& key, const std::string& value) { text_ += key + " = " + value + "\n"; }

  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

void write(Writer& out, const MeshSpec& mesh) {
  out.header("[mesh]");
  if (!mesh.file.empty()) {
    out.line("file", std::filesystem::absolute(mesh.file).string());
    out.line("split_quads", mesh.split_quads);
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
  if (motion.blend) out.line("blend", std::span<const double>(*motion.blend));
}

// { field = "pitch", center = [0.25, 0.0], ... }
std::string inline_text(const MotionSpec& motion) {
  std::string text = "{field = " + to_text(motion.field);
  for (const auto& [key, value] : motion.parameters)
    text += ", " + key_text(key) + " = " + std::visit([](const auto& v) { return to_text(v); }, value);
  return text + "}";
}

void write(Writer& out, const BodyScenario& body) {
  out.header("[[body]]");
  out.line("on", body.on);
  std::string list;
  for (const MotionSpec& motion : body.motions) list += (list.empty() ? "" : ", ") + inline_text(motion);
  out.raw_line("motion", "[" + list + "]");
}

// Nothing where nothing follows and no body is there, which is the default.
void write(Writer& out, const InteriorSpec& interior, bool has_bodies) {
  const auto& [follow, stiffness, tolerance, most] = interior.options;
  if (follow == Follow::None && !has_bodies) return;
  out.header("[interior]");
  out.line("follow", std::string(to_string(follow)));
  std::string list;
  for (const auto& [label, value] : stiffness)
    list += (list.empty() ? "" : ", ") + std::to_string(label) + " = " + to_text(value);
  if (!list.empty()) out.raw_line("stiffness", "{" + list + "}");
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
  if (time.adaptive) out.line("adaptive", *time.adaptive);
}

void write(Writer& out, const RepairSpec& repair) {
  out.header("[repair]");
  out.line("strategy", repair.strategy);
  out.line("quality", repair.quality);
  if (repair.quality == "angles") out.line("angle", repair.angle);
  out.line("allow_escaped", repair.allow_escaped);
  out.line("retain", repair.retain);
}

void write(Writer& out, const OutputSpec& output) {
  out.header("[output]");
  out.line("every", std::int64_t{output.every});
  out.line("checkpoint", std::int64_t{output.checkpoint});
  out.line("patches", output.patches);
}

}  // namespace

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

const char* to_string(Follow follow) {
  return follow == Follow::Harmonic ? "harmonic" : follow == Follow::Elastic ? "elastic" : "none";
}

std::string to_toml(const Scenario& scenario) {
  Writer out;
  write(out, scenario.mesh);
  for (const auto& body : scenario.bodies) write(out, body);
  for (const auto& motion : scenario.motions) write(out, motion);
  write(out, scenario.interior, !scenario.bodies.empty());
  write(out, scenario.border);
  write(out, scenario.time);
  write(out, scenario.repair);
  write(out, scenario.output);
  return out.text();
}

std::optional<std::string> scenario_difference(const std::string& there, const std::string& here) {
  if (there == here) return std::nullopt;
  std::istringstream lines(there), other_lines(here);
  for (std::string line, other; true;) {
    const bool is_line = static_cast<bool>(std::getline(lines, line));
    const bool is_other = static_cast<bool>(std::getline(other_lines, other));
    if (is_line && is_other && line == other) continue;
    return (is_line ? line : "no more lines") + " there, " + (is_other ? other : "no more lines") + " here";
  }
}

}  // namespace kinemesh
