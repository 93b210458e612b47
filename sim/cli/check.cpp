#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "kinemesh/check.h"
#include "kinemesh/safe_step.h"
#include "sim/cli/commands.h"
#include "sim/cli/console.h"
#include "sim/cli/id_json.h"
#include "sim/cli/mesh_arguments.h"

namespace kinemesh::cli {
namespace {

using Json = nlohmann::ordered_json;

struct CheckArguments {
  MeshInput mesh;
  std::string toward;  // the mesh after a step
  bool json = false;
};

void print_culprits(const CheckReport& report) {
  for (const Defect& defect : report.culprits) print_line("  " + defect.message());
  const auto named = [&](DefectKind kind) {
    return std::count_if(report.culprits.begin(), report.culprits.end(),
                         [&](const Defect& defect) { return defect.kind == kind; });
  };
  const auto unnamed =
      report.inverted - named(DefectKind::InvertedFace) + report.degenerate - named(DefectKind::FlatFace);
  if (unnamed > 0) print_line(fmt::format("  and {} more inverted or flat faces", unnamed));
}

void print_table(const std::string& path, const CheckReport& report) {
  const auto row = [](const char* name, const auto& value, const std::string& remark = "") {
    print_line(fmt::format("  {:<20}{:>12}{}", name, value, remark));
  };
  print_line(path);
  row("vertices", report.vertices,
      report.isolated_vertices > 0 ? fmt::format("  ({} in no face)", report.isolated_vertices) : "");
  row("faces", report.faces);
  row("inverted", report.inverted);
  row("degenerate", report.degenerate);
  row("inverted components", report.inverted_components);
  row("connected parts", report.connected_parts);
  row("border loops", report.border_loops);
  row("minimum angle", fmt::format("{:.4g}", report.min_angle_deg), " degrees");
  row("minimum area", fmt::format("{:.4g}", report.min_area));
  for (const MarkerCount& marker : report.markers)
    print_line(fmt::format("  marker {}: {} edges", marker.name, marker.edges));
  print_line(report.valid ? "valid" : "not valid:");
  print_culprits(report);
}

Json to_json(const Defect& defect) {
  return {{"kind", to_string(defect.kind)},
          {"faces", defect.faces},
          {"vertices", defect.vertices},
          {"edges", defect.edges},
          {"where", {defect.where.x, defect.where.y}},
          {"message", defect.message()}};
}

// The query of --toward: how much of the way to the other file's positions no face is flat on.
struct Way {
  std::string path;
  std::optional<SafeStep> first;  // nothing: all of it
};

Way way_to(const CheckArguments& arguments, const MeshData& from) {
  const MeshInput toward{arguments.toward, arguments.mesh.split_quads};
  const MeshData to = read(toward);
  if (to.n_vertices() != from.n_vertices())
    throw InputError(arguments.toward, 0,
                     fmt::format("{} vertices, {} as in {} expected", to.n_vertices(), from.n_vertices(),
                                 arguments.mesh.path));
  return {arguments.toward, max_safe_step(from.triangles, from.points, to.points)};
}

// The shortest decimal that reads back as the same number.
void print_way(const Way& way) {
  if (way.first)
    print_line(fmt::format("safe step toward {}: {} of it, then face {} is flat", way.path, way.first->share,
                           way.first->face));
  else
    print_line(fmt::format("safe step toward {}: all of it", way.path));
}

Json to_json(const Way& way) {
  return {{"toward", way.path},
          {"max_safe_step", way.first ? way.first->share : 1.0},
          {"first_flat_face", way.first ? Json(way.first->face) : Json(nullptr)}};
}

Json to_json(const std::string& path, const CheckReport& report) {
  Json markers = Json::array(), culprits = Json::array();
  for (const MarkerCount& marker : report.markers)
    markers.push_back({{"name", marker.name}, {"edges", marker.edges}});
  for (const Defect& defect : report.culprits) culprits.push_back(to_json(defect));
  return {{"schema", "kinemesh-check-1"},
          {"mesh", path},
          {"valid", report.valid},
          {"vertices", report.vertices},
          {"isolated_vertices", report.isolated_vertices},
          {"faces", report.faces},
          {"inverted", report.inverted},
          {"degenerate", report.degenerate},
          {"inverted_components", report.inverted_components},
          {"connected_parts", report.connected_parts},
          {"border_loops", report.border_loops},
          {"markers", markers},
          {"min_angle_deg", report.min_angle_deg},
          {"min_area", report.min_area},
          {"culprits", culprits}};
}

int run_check(const CheckArguments& arguments) {
  const MeshData data = read(arguments.mesh);
  const CheckReport report = check_mesh(data);
  const auto way = arguments.toward.empty() ? std::nullopt : std::optional(way_to(arguments, data));
  if (arguments.json) {
    Json json = to_json(arguments.mesh.path, report);
    if (way) json.update(to_json(*way));
    fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
  } else {
    print_table(arguments.mesh.path, report);
    if (way) print_way(*way);
  }
  return report.valid ? done : not_valid;
}

}  // namespace

void add_check(CLI::App& program, Action& action) {
  const auto arguments = std::make_shared<CheckArguments>();
  CLI::App& command = *program.add_subcommand("check", "Say whether a mesh is valid, and measure it");
  add_mesh_input(command, arguments->mesh);
  command.add_flag("--json", arguments->json, "Print one JSON object instead of a table");
  command.add_option("--toward", arguments->toward,
                     "Say how much of the way to this mesh's positions is safe");
  command.footer(
      "Exit code 1 if the mesh is not valid: inverted or flat faces, borders that cross or touch, parts\n"
      "that overlap, or a marker's edge that no face has.\n"
      "--json: {\"schema\": \"kinemesh-check-1\", \"mesh\", \"valid\", \"vertices\", \"isolated_vertices\", "
      "\"faces\",\n"
      "\"inverted\", \"degenerate\", \"inverted_components\", \"connected_parts\", \"border_loops\",\n"
      "\"markers\": [{\"name\", \"edges\"}], \"min_angle_deg\", \"min_area\",\n"
      "\"culprits\": [{\"kind\", \"faces\", \"vertices\", \"edges\": [[from, to]], \"where\": [x, y], "
      "\"message\"}]}\n"
      "with --toward also \"toward\", \"max_safe_step\" from 0 to 1, \"first_flat_face\" or null.\n"
      "Culprits are the first of each kind. Face and vertex numbers: order in the file, from 0.");
  command.callback([arguments, &action] { action = [arguments] { return run_check(*arguments); }; });
}

}  // namespace kinemesh::cli
