#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "sim/cli/check_report.h"
#include "sim/cli/commands.h"
#include "sim/cli/mesh_arguments.h"

namespace kinemesh::cli {
namespace {

using Json = nlohmann::ordered_json;

struct CheckArguments {
  MeshInput mesh;
  bool json = false;
};

void print_culprits(const CheckReport& report) {
  for (const Defect& defect : report.culprits) fmt::print("  {}\n", defect.message());
  const auto named = [&](DefectKind kind) {
    return std::count_if(report.culprits.begin(), report.culprits.end(),
                         [&](const Defect& defect) { return defect.kind == kind; });
  };
  const auto unnamed =
      report.inverted - named(DefectKind::InvertedFace) + report.degenerate - named(DefectKind::FlatFace);
  if (unnamed > 0) fmt::print("  and {} more inverted or flat faces\n", unnamed);
}

void print_table(const std::string& path, const CheckReport& report) {
  const auto row = [](const char* name, const auto& value, const std::string& remark = "") {
    fmt::print("  {:<20}{:>12}{}\n", name, value, remark);
  };
  fmt::print("{}\n", path);
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
    fmt::print("  marker {}: {} edges\n", marker.name, marker.edges);
  fmt::print("{}\n", report.valid ? "valid" : "not valid:");
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

int check_mesh(const CheckArguments& arguments) {
  const CheckReport report = check(read(arguments.mesh));
  if (arguments.json)
    fmt::print("{}\n",
               to_json(arguments.mesh.path, report).dump(2, ' ', false, Json::error_handler_t::replace));
  else
    print_table(arguments.mesh.path, report);
  return report.valid ? done : not_valid;
}

}  // namespace

void add_check(CLI::App& program, Action& action) {
  const auto arguments = std::make_shared<CheckArguments>();
  CLI::App& command = *program.add_subcommand("check", "Say whether a mesh is valid, and measure it");
  add_mesh_input(command, arguments->mesh);
  command.add_flag("--json", arguments->json, "Print one JSON object instead of a table");
  command.footer(
      "Exit code 1 if the mesh is not valid: inverted or flat faces, borders that cross or touch, parts\n"
      "that overlap, or a marker's edge that no face has.\n"
      "--json: {\"schema\": \"kinemesh-check-1\", \"mesh\", \"valid\", \"vertices\", \"isolated_vertices\", "
      "\"faces\",\n"
      "\"inverted\", \"degenerate\", \"inverted_components\", \"connected_parts\", \"border_loops\",\n"
      "\"markers\": [{\"name\", \"edges\"}], \"min_angle_deg\", \"min_area\",\n"
      "\"culprits\": [{\"kind\", \"faces\", \"vertices\", \"edges\": [[from, to]], \"where\": [x, y], "
      "\"message\"}]}\n"
      "Culprits are the first of each kind. Face and vertex numbers: order in the file, from 0.");
  command.callback([arguments, &action] { action = [arguments] { return check_mesh(*arguments); }; });
}

}  // namespace kinemesh::cli
