#include "tests/fuzz/subjects.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>

#include "kinemesh/build.h"
#include "kinemesh/mesh_io.h"
#include "kinemesh/run.h"
#include "kinemesh/shapes.h"
#include "motion/fields/recorded.h"
#include "motion/fields/sampled_grid.h"
#include "sim/draw/step_of_run.h"
#include "sim/report/table.h"
#include "sim/run/checkpoint.h"
#include "sim/run/failed_step.h"
#include "sim/run/patches.h"
#include "tests/fuzz/reader_check.h"
#include "tests/fuzz/vtu_sample.h"
#include "tests/sim/run/section_file.h"

namespace kinemesh {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

void write(const fs::path& file, const std::string& content) {
  std::ofstream(file, std::ios::binary) << content;
}

MeshData sample_mesh() {
  MeshData mesh = make_grid(3, 2);
  for (int face = 0; face < mesh.n_faces(); ++face) mesh.labels.push_back(face % 2 == 0 ? 7 : 2);
  mesh.label_names = {{2, "inside"}, {7, "outside"}};
  return mesh;
}

const char* const scenario = R"([mesh]
shape = "square"
vertices = 60
frame = 0.25  # of its diagonal

[[motion]]
field = "rotor"
center = [0.5, 0.5]
radius = 0.3
rate = 6.0

[[motion]]
field = "jitter"
amplitude = 0.3

[border]
default = "fixed"

[time]
dt = 0.05
steps = 3

[output]
every = 1
patches = true
)";

const char* const other_scenario =
    R"toml(motion = [{field = "vortices", points = [[0, 0], [1, 1]], strengths = [1, -1], core = 0.1},  # two
  {field = "expression", u = "x*y - ((t))", v = '-1', on = "disc:[0, 0, 1]", blend = [0.1, 0.2]},
  {field = "grid", file = "grid.csv"}]
mesh.file = "sample.off"
mesh.split_quads = true
border.'far field' = "slide"
border."\u0061" = """
moving"""
[time]
end = 1e0
dt = 0.1
integrator = "heun"
adaptive.min_dt = 0.01
[repair]
strategy = "local"
quality = "delaunay"
retain = false
)toml";

const char* const gmsh4 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
2
1 1 "wall"
2 2 "body"
$EndPhysicalNames
$Entities
0 1 1 0
1 0 0 0 1 1 0 2 1 3 0
1 0 0 0 1 1 0 1 2 1 1
$EndEntities
$Nodes
2 4 1 4
2 1 0 3
1
2
3
0 0 0
1 0 0
1 1 0
1 1 0 1
4
0 1 0
$EndNodes
$Elements
2 4 1 4
1 1 1 2
1 1 2
2 2 3
2 1 2 2
3 1 2 3
4 1 3 4
$EndElements
)";

const char* const recorded =
    "time,vertex,x,y\n0,0,0.25,0.5\n0,1,1,0\n0,2,1,1\n0.1,0,0.26,0.5\n0.1,1,1,0\n0.1,2,1,1\n";
const char* const grid = "# sampled\nt,x,y,u,v\n0,0,0,1,0\n0,1,0,1,0.5\n0,0,1,1,0\n0,1,1,1,0.5\n";
const char* const bench =
    "strategy,step,plan,time\nglobal,1,\"a, \"\"b\"\"\",0.5\nlocal,1,\"two\nlines\",nan\n";

Subject text_subject(const std::string& name, const std::string& sample,
                     std::function<std::string(const std::string&)> read) {
  return {name, [sample](Dice& dice) { return mutated_text(sample, dice); }, std::move(read)};
}

std::string read_mesh_text(const std::string& text, Format format) {
  std::string wrong = check_reader(text, format);
  if (wrong.empty())
    static_cast<void>(parse_mesh(text, format, "input", {.split_quads = true}));  // or refused
  return wrong;
}

Subject mesh_subject(const std::string& name, Format format, const std::string& sample) {
  return text_subject(name, sample,
                      [format](const std::string& text) { return read_mesh_text(text, format); });
}

Subject vtu_subject(const std::string& name, VtuEncoding encoding) {
  const MeshData mesh = sample_mesh();
  return {name, [=](Dice& dice) { return mutated_vtu(mesh, encoding, dice); },
          [](const std::string& text) { return read_mesh_text(text, Format::Vtu); }};
}

std::string read_scenario(const fs::path& file, const std::string& text,
                          const std::vector<std::string>& overrides) {
  const std::string written = to_toml(parse_scenario(text, file, overrides));
  return to_toml(parse_scenario(written, file)) == written ? "" : "written and read again it is another one";
}

// Now and then another section, another version, one too few or too many.
void change_sections(std::vector<test::RawSection>& sections, Dice& dice) {
  const auto place = sections.begin() + static_cast<std::ptrdiff_t>(dice.below(sections.size()));
  switch (dice.below(5)) {
    case 0:
      place->name = mutated_bytes(place->name, dice);
      break;
    case 1:
      place->version = static_cast<std::uint32_t>(dice.next());
      break;
    case 2:
      sections.erase(place);
      break;
    case 3:
      sections.push_back(test::RawSection(*place));
      break;
    default:
      place->contents = dice.one_of(sections).contents;
  }
}

// A file of sections with some of them changed and all lengths and checksums right again; now and then just
// broken.
std::string mutated_sections(const std::string& sample, Dice& dice) {
  if (dice.one_in(16)) return mutated_bytes(sample, dice);
  auto file = test::taken_apart(sample);
  if (dice.one_in(8)) change_sections(file.sections, dice);
  do {
    std::string& contents = file.sections[dice.below(file.sections.size())].contents;
    contents = mutated_bytes(contents, dice);
  } while (dice.one_in(3));
  return test::joined(file);
}

Checkpoint sample_checkpoint() {
  const Mesh mesh = build_mesh(sample_mesh(), {.frame = 0.25, .fixed = {1}});
  Checkpoint checkpoint;
  checkpoint.program = "1";
  checkpoint.scenario = "a = 1\n";
  checkpoint.base = base_of(mesh);
  checkpoint.initial = state_of(mesh, checkpoint.base.order);
  checkpoint.mesh = checkpoint.initial;
  checkpoint.time = 0.5;
  checkpoint.step = 5;
  checkpoint.series = {.replaced = std::vector<std::uint8_t>(mesh.n_faces(), 1),
                       .region = std::vector<int>(mesh.n_faces(), none),
                       .entries = {{0.1, "mesh_000000.vtu"}},
                       .last_written = 5};
  checkpoint.logs = {100, 12};
  return checkpoint;
}

Subject checkpoint_subject(const fs::path& folder) {
  const std::string sample = format_checkpoint(sample_checkpoint());
  return {"checkpoint", [=](Dice& dice) { return mutated_sections(sample, dice); },
          [=](const std::string& content) {
            write(folder / "checkpoint.bin", content);
            (void)last_checkpoint(folder, "a = 1\n");
            return std::string();
          }};
}

// Tangled: vertex 5 is beyond its neighbours.
std::string sample_failed_step() {
  const Mesh mesh = build_mesh(sample_mesh(), {.frame = 0.25, .fixed = {}});
  FailedStep step;
  step.base = base_of(mesh);
  step.mesh = state_of(mesh, step.base.order);
  step.moved = mesh.user_positions();
  step.moved[5] += Point(0.5, 0.1);
  step.end_time = 0.1;
  step.options.quality = "angles";
  step.options.freedom.held.assign(mesh.n_vertices(), 0);
  step.options.freedom.tangents[3] = {1.0, 0.0};
  step.options.freedom.curves.emplace_back(
      std::vector<Point>{mesh.position(Vertex(0)), mesh.position(Vertex(1)), mesh.position(Vertex(2))});
  step.options.freedom.curve_of[1] = 0;
  return format_failed_step(step);
}

Subject failed_step_subject() {
  const std::string sample = sample_failed_step();
  return {"failed_step", [=](Dice& dice) { return mutated_sections(sample, dice); },
          [](const std::string& content) {
            (void)replay(parse_failed_step(content));
            return std::string();
          }};
}

// Blocks of patches.bin, each with its length in front and a line feed behind.
std::string mutated_patches(const std::string& sample, Dice& dice) {
  std::string out = sample.substr(0, 12);
  for (std::size_t at = 12; at + 8 < sample.size();) {
    std::uint64_t n = 0;
    std::memcpy(&n, sample.data() + at, 8);
    std::string block = sample.substr(at + 8, n);
    if (dice.one_in(3)) block = mutated_bytes(block, dice);
    const std::uint64_t size = block.size();
    out.append(reinterpret_cast<const char*>(&size), 8);
    out += block + '\n';
    at += 8 + n + 1;
  }
  return dice.one_in(16) ? mutated_bytes(out, dice) : out;
}

Subject patches_subject(const fs::path& folder) {
  const std::string sample = content_of(folder / "run" / "patches.bin");
  return {"patches", [=](Dice& dice) { return mutated_patches(sample, dice); },
          [=](const std::string& content) {
            write(folder / "patches.bin", content);
            PatchesReader reader(folder / "patches.bin");
            while (reader.next()) {
            }
            (void)format_mesh(draw::step_of_run(folder, 3).mesh, Format::Svg);
            return std::string();
          }};
}

Subject log_subject(const fs::path& folder, const std::string& name, const std::string& sample) {
  return text_subject(name, sample, [=](const std::string& text) {
    write(folder / "log.csv", text);
    const auto table = report::read_table(folder / "log.csv", {},
                                          [](const std::string& column) { return column == "plan"; });
    for (const auto& [column, values] : table.numbers)
      if (values.size() != table.size) return "column " + column + " is of another length";
    return std::string();
  });
}

Subject positions_subject(const fs::path& folder, const std::string& name, const std::string& file,
                          const std::string& sample) {
  return text_subject(name, sample, [=](const std::string& text) {
    write(folder / file, text);
    const RecordedPositions positions(folder / file);
    return positions.times().empty() ? "no times" : std::string();
  });
}

void run_sample(const fs::path& folder) {
  RunObserver observer;
  RunOptions options;
  options.directory = folder / "run";
  options.force = true;
  options.stop_on_signals = false;
  (void)run(parse_scenario(scenario, folder / "run.toml"), options, observer);
}

void add_meshes(std::vector<Subject>& all) {
  const MeshData mesh = sample_mesh();
  for (const Format format : {Format::Off, Format::Obj, Format::Ply, Format::Su2})
    all.push_back(mesh_subject(std::string(formats()[static_cast<std::size_t>(format)].name), format,
                               format_mesh(mesh, format)));
  all.push_back(mesh_subject("msh2", Format::Gmsh, format_mesh(mesh, Format::Gmsh)));
  all.push_back(mesh_subject("msh4", Format::Gmsh, gmsh4));
  all.push_back(vtu_subject("vtu_ascii", VtuEncoding::Ascii));
  all.push_back(vtu_subject("vtu_base64", VtuEncoding::Base64));
  all.push_back(vtu_subject("vtu_raw", VtuEncoding::Raw));
  all.push_back(vtu_subject("vtu_zlib", VtuEncoding::Zlib));
}

void add_scenarios(std::vector<Subject>& all, const fs::path& folder) {
  const fs::path file = folder / "scenario.toml";
  for (const auto& [name, sample] : {std::pair("toml", scenario), std::pair("toml_inline", other_scenario)})
    all.push_back(
        text_subject(name, sample, [=](const std::string& text) { return read_scenario(file, text, {}); }));
  all.push_back(text_subject("set", "motion.0.center = [0.25, 0.5]",
                             [=](const std::string& text) { return read_scenario(file, scenario, {text}); }));
}

}  // namespace

std::vector<Subject> subjects(const fs::path& folder) {
  run_sample(folder);
  write(folder / "grid.csv", grid);
  std::vector<Subject> all;
  add_meshes(all);
  all.push_back(positions_subject(folder, "recorded_csv", "recorded.csv", recorded));
  all.push_back(positions_subject(folder / "run", "recorded_pvd", "mutant.pvd",
                                  content_of(folder / "run" / "mesh.pvd")));
  all.push_back(text_subject("grid_csv", grid, [](const std::string& text) {
    (void)SampledGrid(parse_grid(text, "grid.csv")).velocity({0.3, 0.4}, 0.5);
    return std::string();
  }));
  add_scenarios(all, folder);
  all.push_back(checkpoint_subject(folder));
  all.push_back(patches_subject(folder));
  all.push_back(failed_step_subject());
  all.push_back(log_subject(folder, "steps_csv", content_of(folder / "run" / "steps.csv")));
  all.push_back(log_subject(folder, "regions_csv", content_of(folder / "run" / "regions.csv")));
  all.push_back(log_subject(folder, "bench_csv", bench));
  return all;
}

}  // namespace kinemesh
