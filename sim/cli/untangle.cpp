#include "kinemesh/check.h"
#include "kinemesh/strategy.h"

#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "core/io/atomic_file.h"
#include "kinemesh/local.h"
#include "sim/cli/commands.h"
#include "sim/cli/console.h"
#include "sim/cli/file_arguments.h"
#include "sim/cli/id_json.h"
#include "sim/cli/mesh_arguments.h"
#include "sim/cli/numbers.h"
#include "untangle/walk/stuck.h"

namespace kinemesh::cli {
namespace {

using Json = nlohmann::ordered_json;

struct UntangleArguments {
  MeshInput mesh;
  std::string output;
  std::string strategy = "global";
  std::string report;
  bool retain = false;
  std::vector<int> seeds;  // the user's numbers; empty: all tangles
};

// What a report compares: the file as it was read and as it was written.
struct BeforeAndAfter {
  FaceCount before, after;
  int moved_vertices = 0;
};

int count_moved(const MeshData& before, const MeshData& after) {
  int moved = 0;
  for (std::size_t v = 0; v < before.points.size(); ++v) moved += before.points[v] != after.points[v];
  return moved;
}

Json to_json(const RegionRecord& region) {
  return {{"seed", region.seed},
          {"faces", region.user_faces},
          {"padding_faces", region.padding_faces()},
          {"inverted", region.inverted},
          {"components", region.components},
          {"gamma_first_stable", region.gamma_first_stable},
          {"gamma", region.gamma},
          {"explored", region.explored},
          {"crease_edges", region.crease_edges},
          {"retries", region.retries},
          {"self_overlap", region.self_overlap}};
}

Json to_json(const UntangleArguments& arguments, const Mesh& mesh, const RepairRecord& record,
             const BeforeAndAfter& faces) {
  Json regions = Json::array();
  for (const RegionRecord& region : record.regions) regions.push_back(to_json(region));
  return {{"schema", "kinemesh-untangle-1"},
          {"strategy", arguments.strategy},
          {"vertices", mesh.n_user_vertices()},
          {"faces", mesh.n_user_faces()},
          {"inverted_before", faces.before.inverted},
          {"degenerate_before", faces.before.degenerate},
          {"inverted_after", faces.after.inverted},
          {"doubled_edges", faces.after.inverted + faces.after.degenerate > 0 ? record.doubled_edges : 0},
          {"regions", regions}};
}

void print_summary(const UntangleArguments& arguments, const Mesh& mesh, const RepairRecord& record,
                   const BeforeAndAfter& faces) {
  std::set<Face> touched;  // regions that are replaced in turn may share faces
  for (const RegionRecord& region : record.regions) {
    for (const Face face : region.faces) {
      const bool kept = std::binary_search(region.kept.begin(), region.kept.end(), face);
      if (!kept && !mesh.is_padding(face)) touched.insert(face);
    }
  }
  fmt::print("{} inverted and {} flat faces before, {} and {} after\n", faces.before.inverted,
             faces.before.degenerate, faces.after.inverted, faces.after.degenerate);
  fmt::print("{} of {} faces replaced, in {} region{}\n", touched.size(), mesh.n_user_faces(),
             record.regions.size(), record.regions.size() == 1 ? "" : "s");
  if (faces.moved_vertices > 0)
    fmt::print("{} of {} vertices moved\n", faces.moved_vertices, mesh.n_user_vertices());
  print_line("written: " + arguments.output);
}

// hint: what else may be tried.
int no_valid_mesh(const UntangleArguments& arguments, const Defect& defect, const std::string& hint = "") {
  print_error(fmt::format("{}: {}: {}; nothing was written{}", arguments.mesh.path,
                          is_stuck(defect) ? "stays tangled" : "no valid mesh exists", defect.message(),
                          hint));
  return not_valid;
}

constexpr const char* none_by_optimize = "; --strategy optimize, which moves vertices, finds none either";

// Whether vertices that may move make a valid mesh possible. Pre: the mesh is as it was read.
std::string hint_at_optimize(const UntangleArguments& arguments, Mesh& mesh) {
  if (arguments.strategy == "optimize") return "";
  return make_strategy("optimize")->repair(mesh, {})
             ? "; with --strategy optimize, which moves vertices, there is one"
             : none_by_optimize;
}

RepairOutcome repair_seeds(const UntangleArguments& arguments, Mesh& mesh) {
  const auto faces = mesh.faces_in_user_order();
  std::vector<Face> seeds;
  for (const int seed : arguments.seeds) {
    if (seed < 0 || seed >= mesh.n_user_faces()) {
      throw InputError(
          fmt::format("--seed {}: {} has faces 0 to {}", seed, arguments.mesh.path, faces.size() - 1));
    }
    seeds.push_back(faces[seed]);
  }
  return LocalUntangling().repair_seeds(mesh, seeds, {.retain = arguments.retain});
}

int untangle(const UntangleArguments& arguments) try {
  if (!arguments.seeds.empty() && arguments.strategy != "local") {
    throw InputError("--seed goes with --strategy local only");
  }
  require_writable(arguments.output);
  check_files({{"MESH", arguments.mesh.path}},
              {{"--output", arguments.output}, {"--report", arguments.report}});
  const std::unique_ptr<Strategy> strategy = make_strategy(arguments.strategy);
  const MeshData data = read(arguments.mesh);
  Mesh mesh = build(arguments.mesh, data);
  const RepairOutcome outcome = arguments.seeds.empty()
                                    ? strategy->repair(mesh, RepairOptions{.retain = arguments.retain})
                                    : repair_seeds(arguments, mesh);
  if (!outcome) return no_valid_mesh(arguments, *outcome.defect, hint_at_optimize(arguments, mesh));

  const MeshData repaired = mesh.domain();
  const BeforeAndAfter faces{count_bad_faces(data), count_bad_faces(repaired), count_moved(data, repaired)};
  const bool is_valid = faces.after.inverted + faces.after.degenerate == 0;
  if (outcome.record.doubled_edges > 0 && !is_valid) {
    print_note(
        fmt::format("{}: {} edges join vertices that another edge joins too, as the mesh is still tangled",
                    arguments.output, outcome.record.doubled_edges));
  }
  StagedFile output = stage_mesh(arguments.output, repaired);
  if (!arguments.report.empty()) {
    const Json report = to_json(arguments, mesh, outcome.record, faces);
    StagedFile(follow_links(arguments.report), report.dump(1) + "\n").commit();
  }
  output.commit();
  print_summary(arguments, mesh, outcome.record, faces);
  return is_valid ? done : not_valid;
} catch (const NoEmbedding& error) {
  return no_valid_mesh(arguments, error.defect(), arguments.strategy == "optimize" ? "" : none_by_optimize);
}

}  // namespace

void add_untangle(CLI::App& program, Action& action) {
  const auto arguments = std::make_shared<UntangleArguments>();
  CLI::App& command = *program.add_subcommand("untangle", "Make the faces of a tangled mesh upright again");
  add_mesh_input(command, arguments->mesh);
  command.add_option("-o,--output", arguments->output, "File to write, unless no valid mesh exists")
      ->required();
  command.add_option("--strategy", arguments->strategy, "How; `kinemesh list` names the strategies")
      ->capture_default_str();
  command
      .add_option("--seed", arguments->seeds,
                  "Untangle only the regions of these inverted faces; for local only")
      ->delimiter(',')
      ->transform(integer());
  command.add_flag("--retain", arguments->retain, "Keep upright faces of a region that need not be replaced");
  command.add_option("--report", arguments->report, "File for what was done, as JSON");
  command.footer(
      "No vertex is added or lost, all keep their order, and only optimize moves some. Faces outside the\n"
      "replaced regions keep their line in the file; new faces take the lines of those they replace.\n"
      "Report: {\"schema\": \"kinemesh-untangle-1\", \"strategy\", \"vertices\", \"faces\", "
      "\"inverted_before\",\n"
      "\"degenerate_before\", \"inverted_after\", \"doubled_edges\", \"regions\": [{\"seed\", \"faces\",\n"
      "\"padding_faces\", \"inverted\", \"components\", \"gamma_first_stable\", \"gamma\", \"explored\",\n"
      "\"crease_edges\", \"retries\", \"self_overlap\"}]}. A region's faces are those of the file in\n"
      "it, sorted; --retain leaves some of them in place. Its seed is the smallest of them that was\n"
      "inverted or flat, or -1 if all such faces are padding. `remesh` has one region with all faces.");
  command.callback([arguments, &action] { action = [arguments] { return untangle(*arguments); }; });
}

}  // namespace kinemesh::cli
