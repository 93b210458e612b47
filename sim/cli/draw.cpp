#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/io/atomic_file.h"
#include "kinemesh/local.h"
#include "kinemesh/svg.h"
#include "sim/cli/commands.h"
#include "sim/cli/console.h"
#include "sim/cli/file_arguments.h"
#include "sim/cli/mesh_arguments.h"
#include "sim/cli/numbers.h"
#include "sim/draw/png.h"
#include "sim/draw/region_figure.h"
#include "sim/draw/step_of_run.h"

namespace kinemesh::cli {
namespace {

using Json = nlohmann::json;

struct DrawArguments {
  MeshInput mesh;
  std::string output;
  std::string region;        // a report of untangle
  int number = none;         // of a region in it; none: the largest
  int step = none;           // of a run
  std::vector<double> zoom;  // x0, y0, x1, y1
  double width = 1000.0;
  std::string title;

  std::optional<ViewBox> view() const {
    if (zoom.empty()) return std::nullopt;
    return ViewBox{{zoom[0], zoom[1]}, {zoom[2], zoom[3]}};
  }
};

bool is_png(const std::string& output) {
  std::string extension = std::filesystem::path(output).extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](char c) { return c < 'A' || c > 'Z' ? c : c + 32; });
  if (extension != ".svg" && extension != ".png") throw InputError(output, 0, ".svg or .png expected");
  return extension == ".png";
}

void check(const DrawArguments& arguments) {
  (void)is_png(arguments.output);
  check_files({{"MESH", arguments.mesh.path}, {"--region", arguments.region}},
              {{"--output", arguments.output}});
  require_regular_or_nothing(arguments.output);
  if (arguments.step != none) require_none_of_run(arguments.output, arguments.mesh.path);
  if (arguments.step == none && std::filesystem::is_directory(arguments.mesh.path))
    throw InputError(arguments.mesh.path, 0, "a folder: --step says which of the run's steps to draw");
  const auto& z = arguments.zoom;
  if (!z.empty() && !(z[0] < z[2] && z[1] < z[3]))
    throw InputError("--zoom: X0,Y0,X1,Y1 expected, lower left and upper right");
  if (arguments.step != none && !arguments.region.empty())
    throw InputError("--step draws a run, --region a mesh file: one of them expected");
  if (arguments.number != none && arguments.region.empty()) throw InputError("--number goes with --region");
}

// What of a report a figure needs.
struct ReportedRegions {
  std::string strategy;
  std::vector<UserFace> seeds;
  std::vector<std::vector<UserFace>> faces;
};

// A report is four deep; what is much deeper takes much more memory than it has bytes.
Json parse_report(const std::string& file) {
  constexpr int deepest = 256;
  const auto check_depth = [&](int depth, Json::parse_event_t, const Json&) {
    if (depth > deepest) throw InputError(file, 0, fmt::format("nested more than {} deep", deepest));
    return true;
  };
  return Json::parse(read_file(file), check_depth, false);
}

UserFace to_face(const Json& number) {
  const auto face = number.is_number_integer() ? number.get<std::int64_t>() : -2;
  if (face < none || face > std::numeric_limits<int>::max())
    throw InputError("damaged: " + number.dump() + " is no number of a face");
  return UserFace(static_cast<int>(face));
}

ReportedRegions read_regions(const std::string& file) {
  const Json json = parse_report(file);
  if (!json.is_object() || json.value("schema", Json()) != "kinemesh-untangle-1")
    throw InputError(file, 0, "the report of kinemesh untangle expected");
  try {
    ReportedRegions regions{json.at("strategy"), {}, {}};
    for (const Json& region : json.at("regions")) {
      regions.seeds.push_back(to_face(region.at("seed")));
      auto& faces = regions.faces.emplace_back();
      for (const Json& face : region.at("faces")) faces.push_back(to_face(face));
    }
    if (regions.faces.empty()) throw InputError("no region in it: the mesh was not tangled");
    return regions;
  } catch (const Json::exception& error) {
    throw InputError(file, 0, std::string("damaged: ") + error.what());
  } catch (const InputError& error) {
    throw InputError(file, 0, error.what());
  }
}

int chosen(const DrawArguments& arguments, const ReportedRegions& regions) {
  const int n = static_cast<int>(regions.faces.size());
  if (arguments.number == none)
    return static_cast<int>(std::ranges::max_element(regions.faces, {}, &std::vector<UserFace>::size) -
                            regions.faces.begin());
  if (arguments.number < 0 || arguments.number >= n)
    throw InputError(
        fmt::format("--number {}: {} has regions 0 to {}", arguments.number, arguments.region, n - 1));
  return arguments.number;
}

// As untangle has repaired it.
RegionRecord repair_again(Mesh& mesh, const ReportedRegions& reported, int number,
                          const DrawArguments& arguments) {
  const auto by_user = mesh.faces_in_user_order();
  const auto is_face = [&](UserFace face) { return 0 <= face && face < static_cast<int>(by_user.size()); };
  std::vector<Face> seeds;
  const bool is_local = reported.strategy == "local" && std::ranges::all_of(reported.seeds, is_face);
  const bool has_seed = reported.seeds[number] == none || is_face(reported.seeds[number]);
  for (const UserFace seed : reported.seeds)
    if (is_local) seeds.push_back(by_user[seed]);
  const RepairOutcome outcome = is_local ? LocalUntangling().repair_seeds(mesh, seeds, {})
                                         : make_strategy(reported.strategy)->repair(mesh, {});
  const auto& regions = outcome.record.regions;
  const auto same = [&](const RegionRecord& r) {
    return std::ranges::equal(r.user_faces, reported.faces[number]);
  };
  const auto found = std::ranges::find_if(regions, same);
  if (!outcome || found == regions.end() || !has_seed)
    throw InputError(arguments.region, 0, "is not the report of untangling " + arguments.mesh.path);
  return *found;
}

std::string figure_of_region(const DrawArguments& arguments) {
  const MeshData data = read(arguments.mesh);
  const Mesh before = build(arguments.mesh, data);
  const ReportedRegions reported = read_regions(arguments.region);
  const int number = chosen(arguments, reported);
  Mesh after = before;
  const RegionRecord region = repair_again(after, reported, number, arguments);
  draw::RegionFigure figure{before, after, {region.faces.begin(), region.faces.end()}};
  const UserFace seed = reported.seeds[number];
  figure.seed = seed == none ? none : before.faces_in_user_order()[seed];
  figure.is_local = reported.strategy == "local";
  figure.view = arguments.view();
  figure.width = arguments.width;
  return draw::format_region_figure(figure);
}

std::string figure_of_step(const DrawArguments& arguments) {
  const draw::StepOfRun found = draw::step_of_run(arguments.mesh.path, arguments.step);
  SvgOptions options;
  options.replaced = found.replaced;
  options.replaced_label = "replaced or flipped";
  options.width = arguments.width;
  options.view = arguments.view();
  options.title = arguments.title.empty() ? fmt::format("step {}, time {:.6g}", arguments.step, found.time)
                                          : arguments.title;
  return format_svg(found.mesh, options);
}

std::string figure_of_mesh(const DrawArguments& arguments) {
  SvgOptions options;
  options.width = arguments.width;
  options.view = arguments.view();
  options.title = arguments.title;
  return format_svg(read(arguments.mesh), options);
}

int draw_figure(const DrawArguments& arguments) {
  check(arguments);
  const std::string svg = !arguments.region.empty() ? figure_of_region(arguments)
                          : arguments.step != none  ? figure_of_step(arguments)
                                                    : figure_of_mesh(arguments);
  write_file_atomically(arguments.output, is_png(arguments.output) ? draw::png_of(svg) : svg);
  print_line("written: " + arguments.output);
  return done;
}

}  // namespace

void add_draw(CLI::App& program, Action& action) {
  const auto arguments = std::make_shared<DrawArguments>();
  CLI::App& command = *program.add_subcommand("draw", "Draw a mesh, a region's repair or a run's step");
  add_mesh_input(command, arguments->mesh);
  command.add_option("-o,--output", arguments->output, "File to write: .svg or .png")->required();
  command.add_option("--region", arguments->region,
                     "Draw a region of this report of `kinemesh untangle` in four pictures");
  command.add_option("--number", arguments->number, "Which region of the report; default: the largest")
      ->transform(integer());
  command
      .add_option("--step", arguments->step, "MESH is the folder of a run with patches.bin: draw this step")
      ->transform(integer_within(0, std::numeric_limits<int>::max()).description("NONNEGATIVE"));
  command.add_option("--zoom", arguments->zoom, "What to show: X0,Y0,X1,Y1 in the mesh's units")
      ->delimiter(',')
      ->expected(4)
      ->transform(finite_number());
  command.add_option("--width", arguments->width, "Pixels")
      ->transform(number_within(64.0, 16384.0))
      ->capture_default_str();
  command.add_option("--title", arguments->title, "Text above a mesh or step");
  command.footer(
      "The four pictures: inverted triangles, the seed darker; their shadow X; R*, the triangles that go;\n"
      "the new triangles. Replaced triangles of a step are amber, inverted ones red.");
  command.callback([arguments, &action] { action = [arguments] { return draw_figure(*arguments); }; });
}

}  // namespace kinemesh::cli
