#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <sstream>
#include <vector>

#include "kinemesh/mesh_io.h"
#include "kinemesh/registry.h"
#include "kinemesh/shapes.h"
#include "kinemesh/strategy.h"
#include "sim/cli/commands.h"
#include "untangle/quality/quality_pass.h"

namespace kinemesh::cli {
namespace {

constexpr std::size_t page_width = 100;

// `head`, then `text` from column `indent` on, broken between words.
void print_entry(const std::string& head, std::size_t indent, const std::string& text) {
  std::string line = fmt::format("{:<{}}", head, indent);
  if (head.size() + 2 > indent) {
    fmt::print("{}\n", head);
    line = std::string(indent, ' ');
  }
  bool is_empty = true;  // of words
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!is_empty && line.size() + 1 + word.size() > page_width) {
      fmt::print("{}\n", line);
      line = std::string(indent, ' ');
      is_empty = true;
    }
    line += (is_empty ? "" : " ") + word;
    is_empty = false;
  }
  fmt::print("{}\n", line);
}

const char* spelling(ParameterKind kind) {
  switch (kind) {
    case ParameterKind::Number:
      return "number";
    case ParameterKind::PositiveNumber:
      return "number > 0";
    case ParameterKind::NonNegativeNumber:
      return "number >= 0";
    case ParameterKind::Vector:
      return "[x, y]";
    case ParameterKind::Direction:
      return "[x, y], not both 0";
    case ParameterKind::Size:
      return "[width, height] or one number for both";
    case ParameterKind::Numbers:
      return "[a, b, ...]";
    case ParameterKind::Points:
      return "[[x, y], ...]";
    case ParameterKind::Seed:
      return "integer >= 0";
    case ParameterKind::OptionalFile:
      return "file, or none";
    case ParameterKind::Text:
      return "text";
    case ParameterKind::File:
      return "file";
  }
  return "";
}

void print_field(const FieldInfo& field) {
  print_entry("  " + field.name, 16, field.description);
  for (const ParameterInfo& parameter : field.parameters) {
    const std::string otherwise = parameter.otherwise ? "; default " + to_string(*parameter.otherwise) : "";
    print_entry("    " + parameter.name, 20,
                fmt::format("{}; {}{}", parameter.meaning, spelling(parameter.kind), otherwise));
  }
}

void print_shape(const ShapeInfo& shape) {
  print_entry("  " + shape.name, 16,
              fmt::format("{}; markers {}; at least {} vertices", shape.description,
                          fmt::join(shape.markers, ", "), shape.min_vertices));
}

void print_format(const FormatInfo& format) {
  const char* ways = format.can_read && format.can_write ? "read, written"
                     : format.can_read                   ? "read"
                                                         : "written";
  print_entry("  " + std::string(format.extension), 16,
              fmt::format("{}: {} ({})", format.name, format.description, ways));
}

// As docs/scenarios.md has them.
struct FieldGroup {
  const char* title;
  std::vector<std::string> names;
};

void list_fields() {
  const FieldGroup groups[] = {
      {"Fields: velocities, integrated together",
       {"rotation", "zalesak", "translate", "shear", "swirl", "taylor-green", "gresho", "twist", "vortices",
        "expression", "grid"}},
      {"Fields: displacements from the initial positions, exact in time whatever the step",
       {"rotor", "rigid", "pitch", "plunge", "displacement", "recorded"}},
      {"Fields: noise, of a [[motion]] only", {"jitter", "brownian"}}};
  auto left = fields();  // others are plug-ins, or a program has registered them
  for (const auto& [title, names] : groups) {
    fmt::print("{}\n", title);
    for (const std::string& name : names) {
      const auto field = std::ranges::find(left, name, &FieldInfo::name);
      print_field(*field);
      left.erase(field);
    }
    fmt::print("\n");
  }
  fmt::print("Fields: your own, velocities or displacements\n");
  for (const FieldInfo& field : left) print_field(field);
}

void list_tables() {
  fmt::print("Tables of a scenario that say what moves\n");
  print_entry("  [[body]]", 16,
              "borders or a solid part, `on` marker:NAME or label:N, that move exactly as told: `motion` is "
              "a list of fields; no noise");
  print_entry("  [[motion]]", 16,
              "for the rest: one field, `on` all, marker:NAME, label:N or disc:[x,y,r], faded by `blend`");
  print_entry("  [interior]", 16,
              "`follow`, how the mesh between follows: harmonic (the default where there is a body), "
              "elastic, or none (else); `stiffness` by label");
  print_entry("  [border]", 16, "by marker, and `default`: fixed, moving or slide");
  print_entry(
      "  [repair]", 16,
      "`strategy`, and `quality`: angles (the default where there is a body), with `angle` in degrees, or "
      "another one of those below");
}

int list() {
  list_tables();
  fmt::print("\n");
  list_fields();
  fmt::print("\nStrategies: ways to repair a step\n");
  for (const StrategyInfo& strategy : strategies())
    print_entry("  " + strategy.name, 16, strategy.description);
  fmt::print("\nQualities: what is done for the shape of the faces after each repair\n");
  for (const QualityInfo& quality : qualities()) print_entry("  " + quality.name, 16, quality.description);
  fmt::print("\nShapes: meshes a scenario can start from\n");
  for (const ShapeInfo& shape : shapes()) print_shape(shape);
  fmt::print("\nFormats: mesh files, by extension\n");
  for (const FormatInfo& format : formats()) print_format(format);
  return done;
}

}  // namespace

void add_list(CLI::App& program, Action& action) {
  CLI::App& command =
      *program.add_subcommand("list", "Name the fields, strategies, qualities, shapes and formats there are");
  command.callback([&action] { action = list; });
}

}  // namespace kinemesh::cli
