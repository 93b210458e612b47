#include "kinemesh/compare.h"

#include <fmt/core.h>
#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>

#include "kinemesh/error.h"
#include "kinemesh/setup.h"
#include "sim/cli/bench_directory.h"
#include "sim/cli/bench_plots.h"
#include "sim/cli/bench_score.h"
#include "sim/cli/commands.h"
#include "sim/cli/console.h"
#include "sim/cli/numbers.h"
#include "sim/compare/bench_bound.h"
#include "sim/run/csv_log.h"
#include "sim/step/threads.h"

namespace kinemesh::cli {
namespace {

namespace fs = std::filesystem;

struct BenchArguments {
  std::string scenario;
  std::vector<std::string> strategies;
  std::vector<std::string> overrides;
  std::string sweep;
  std::string directory;
  bool force = false;
  bool bound = false;
  int threads = 0;
};

constexpr int most_bound_samples = 200;  // of a step

// A field that holds a comma or a quote is quoted.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

// bench.csv and bench_regions.csv: the columns of steps.csv and regions.csv, the strategy before them, the
// swept key behind.
class BenchLog {
 public:
  BenchLog(const fs::path& directory, const std::string& key)
      : steps_(directory / "bench.csv", header(steps_csv_header, key)),
        regions_(directory / "bench_regions.csv", header(regions_csv_header, key)) {}

  void write(const Round& round, const std::string& value) {
    const auto& [strategy, record, mesh, held] = round;
    const std::string end = value.empty() ? "" : "," + csv_field(value);
    int number = 0;
    for (const auto& region : record.repair.regions)
      regions_.write(fmt::format("{},{}{}", strategy, regions_csv_row(record.step, number++, region), end));
    steps_.write(fmt::format("{},{}{}", strategy, steps_csv_row(record), end));
  }

 private:
  static std::string header(const char* columns, const std::string& key) {
    return fmt::format("strategy,{}{}", columns, key.empty() ? "" : "," + csv_field(key));
  }

  LineFile steps_, regions_;
};

// bench_bound.csv.
class BoundLog {
 public:
  BoundLog(const fs::path& directory, const std::string& key)
      : file_(
            directory / "bench_bound.csv",
            "step,seed,faces,upright,inverted,components,depth,crossings,complexity,rounds,explore_us,bound" +
                (key.empty() ? "" : "," + csv_field(key))) {}

  void write(int step, const BoundSample& s, const std::string& value) {
    file_.write(fmt::format("{},{},{},{},{},{},{},{},{},{},{:.3f},{}{}", step, int{s.seed}, s.faces(),
                            s.upright, s.inverted, s.components, s.depth, s.crossings, s.complexity, s.rounds,
                            s.explore_us, s.bound(), value.empty() ? "" : "," + csv_field(value)));
  }

 private:
  LineFile file_;
};

// Of this process, in MiB.
double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void require_distinct(const std::vector<std::string>& strategies) {
  std::set<std::string> seen;
  for (const auto& strategy : strategies) {
    (void)make_strategy(strategy);  // throws where there is none
    if (!seen.insert(strategy).second) throw InputError("--strategies: " + strategy + " comes twice");
  }
}

fs::path directory_of(const BenchArguments& arguments) {
  return arguments.directory.empty() ? fs::path(fs::path(arguments.scenario).stem().string() + "-bench")
                                     : fs::path(arguments.directory);
}

// All scenarios are read before the first one runs.
std::vector<Scenario> scenarios_of(const BenchArguments& arguments, const Sweep& sweep) {
  std::vector<Scenario> all;
  for (const auto& value : sweep.values) {
    auto overrides = arguments.overrides;
    if (!sweep.key.empty()) overrides.push_back(sweep.key + "=" + value);
    all.push_back(load_scenario(arguments.scenario, overrides));
  }
  return all;
}

// The first one as it is to be run; the others are set up once for nothing, as what is wrong with them has to
// be said before the first file is written.
SetUp check_all(std::span<const Scenario> scenarios) {
  for (const Scenario& scenario : scenarios.subspan(1)) (void)set_up(scenario);
  return set_up(scenarios.front());
}

// All rounds, to a folder that is open. Returns the exit code.
int compare(const BenchArguments& arguments, const Sweep& sweep, std::span<const Scenario> scenarios,
            SetUp first) {
  const fs::path directory = directory_of(arguments);
  BenchLog log(directory, sweep.key);
  BenchPlots plots(fs::path(arguments.scenario).stem().string(), sweep.key);
  std::optional<BoundLog> bound_log;
  if (arguments.bound) bound_log.emplace(directory, sweep.key);
  int code = done;
  fmt::print(
      "medians of the steps in ms; step: without the move; rebuild: CGAL's triangulation / step;\n"
      "B/vert.: bytes held per vertex after the last step\n");
  for (std::size_t i = 0; i < scenarios.size(); ++i) {
    std::vector<Score> scores(arguments.strategies.size());
    std::size_t turn = 0;
    const auto measure_bound = [&](int step, const Mesh& tangled) {
      for (const auto& sample : sample_bound(tangled, most_bound_samples)) {
        bound_log->write(step, sample, sweep.values[i]);
        plots.add(sample);
      }
    };
    const auto view = bound_log ? TangledMeshViewer(measure_bound) : TangledMeshViewer();
    const auto stopped = compare_strategies(
        scenarios[i], i == 0 ? std::move(first) : set_up(scenarios[i]), arguments.strategies,
        [&](const Round& round) {
          scores[turn++ % scores.size()].add(round);
          log.write(round, sweep.values[i]);
          plots.add(round, sweep.values[i]);
        },
        view);
    fmt::print("\n");
    print_line(sweep.key.empty() ? scenarios[i].name() : sweep.key + " = " + sweep.values[i]);
    print_scores(arguments.strategies, scores);
    if (!stopped) continue;
    std::fflush(stdout);
    print_error(fmt::format("{}: {}", arguments.scenario, *stopped));
    code = not_valid;
  }
  fmt::print("\npeak memory {:.0f} MiB for all strategies together\n", peak_memory());
  print_line((directory / "bench.csv").string());
  print_line(plots.write(directory));
  return code;
}

int bench(const BenchArguments& arguments) {
  require_distinct(arguments.strategies);
  const Sweep sweep = arguments.sweep.empty() ? Sweep{"", {""}} : parse_sweep(arguments.sweep);
  const auto scenarios = scenarios_of(arguments, sweep);
  const ThreadLimit threads(arguments.threads);
  SetUp first = check_all(scenarios);
  const FolderLock lock = open_bench_directory(directory_of(arguments), scenarios, arguments.force);
  try {
    return compare(arguments, sweep, scenarios, std::move(first));
  } catch (const InputError& error) {  // by a field, for one: not before anything was written
    print_error(fmt::format("{}: {}", arguments.scenario, error.what()));
    return not_valid;
  }
}

}  // namespace

void add_bench(CLI::App& program, Action& action) {
  const auto arguments = std::make_shared<BenchArguments>();
  CLI::App& command = *program.add_subcommand("bench", "Compare strategies on the same motion");
  command.add_option("SCENARIO", arguments->scenario, "What moves and how: a TOML file")->required();
  command.add_option("--strategies", arguments->strategies, "Names, parted by commas")
      ->required()
      ->delimiter(',');
  command.add_option("--sweep", arguments->sweep,
                     "For several values of a key: key=v1,v2, as in time.dt=0.1,0.2");
  command.add_option("-o,--output", arguments->directory,
                     "Folder for the results; default: the scenario's name and -bench");
  command
      .add_option("--set", arguments->overrides, "Change the scenario: key=value, as in mesh.vertices=100000")
      ->type_size(1)
      ->allow_extra_args(false);
  command.add_flag("--bound", arguments->bound,
                   "Also explore from single faces; hold the time against Theorem 4.4");
  command.add_flag("--force", arguments->force, "Replace the benchmark that is in the folder");
  command.add_option("--threads", arguments->threads, "Threads to use; default: all cores")
      ->transform(integer_within(1, 1024));
  command.footer(
      "Each strategy is given the same positions at each step, and every mesh is validated outside what is\n"
      "timed. Writes bench.csv, the columns of steps.csv behind the strategy's name, bench_regions.csv, and\n"
      "plots: scripts for gnuplot, and SVG where it is installed.");
  command.callback([arguments, &action] { action = [arguments] { return bench(*arguments); }; });
}

}  // namespace kinemesh::cli
