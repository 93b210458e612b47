#include "sim/bench.h"

#include <fmt/core.h>
#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>

#include "core/error.h"
#include "sim/cli/commands.h"
#include "sim/cli/console.h"
#include "sim/csv_log.h"
#include "sim/run_directory.h"
#include "sim/threads.h"

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
  int threads = 0;
};

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// What a strategy did over all steps, at one value of the sweep.
struct Score {
  int steps = 0, failed = 0;
  double replaced = 0.0;  // share of all faces, summed over the steps
  double min_angle_deg = 180.0;
  std::vector<double> detect, explore, triangulate, splice, quality, step;  // ms; the step without the move

  void add(const Round& round) {
    const auto& r = round.record.repair;
    ++steps;
    failed += !round.record.accepted;
    if (!round.record.accepted) return;
    replaced += static_cast<double>(r.replaced) / round.mesh.n_faces();
    min_angle_deg = std::min(min_angle_deg, round.record.min_angle_deg);
    detect.push_back(r.detect_ms);
    explore.push_back(r.explore_ms);
    triangulate.push_back(r.triangulate_ms);
    splice.push_back(r.splice_ms);
    quality.push_back(r.quality_ms);
    step.push_back(round.record.total_ms - round.record.move_ms);
  }
};

// A field that holds a comma or a quote is quoted.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
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
    const auto& [strategy, record, mesh] = round;
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

void print_header() {
  fmt::print("{:<10}{:>6}{:>11}{:>9}{:>9}{:>9}{:>9}{:>9}{:>10}{:>9}{:>9}\n", "", "steps", "replaced %",
             "detect", "explore", "re-mesh", "splice", "quality", "step ms", "rebuild", "angle");
}

// rebuild_ms: of CGAL's triangulation alone; 0: not known.
void print_score(const std::string& strategy, const Score& s, double rebuild_ms) {
  const int n = s.steps - s.failed;
  const double step_ms = median(s.step);
  fmt::print("{:<10}{:>6}{:>11.3g}{:>9.3g}{:>9.3g}{:>9.3g}{:>9.3g}{:>9.3g}{:>10.4g}{:>9}{:>9.3g}\n", strategy,
             n, n > 0 ? 100.0 * s.replaced / n : 0.0, median(s.detect), median(s.explore),
             median(s.triangulate), median(s.splice), median(s.quality), step_ms,
             rebuild_ms > 0.0 && step_ms > 0.0 ? fmt::format("{:.3g}x", rebuild_ms / step_ms) : "-",
             n > 0 ? s.min_angle_deg : 0.0);
  if (s.failed > 0) fmt::print("{:<10}{:>6} without valid mesh\n", "", s.failed);
}

void print_scores(const std::vector<std::string>& strategies, const std::vector<Score>& scores) {
  double rebuild_ms = 0.0;
  for (std::size_t i = 0; i < strategies.size(); ++i)
    if (strategies[i] == "remesh") rebuild_ms = median(scores[i].triangulate);
  print_header();
  for (std::size_t i = 0; i < strategies.size(); ++i) print_score(strategies[i], scores[i], rebuild_ms);
}

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

fs::path open_directory(const BenchArguments& arguments) {
  const fs::path directory = arguments.directory.empty()
                                 ? fs::path(fs::path(arguments.scenario).stem().string() + "-bench")
                                 : fs::path(arguments.directory);
  if (fs::exists(directory / "bench.csv") && !arguments.force)
    throw InputError(directory.string(), 0, "holds a benchmark; --force replaces it");
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) throw InputError(directory.string(), 0, "cannot be made: " + error.message());
  remove_report(directory);
  return directory;
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

int bench(const BenchArguments& arguments) {
  require_distinct(arguments.strategies);
  const Sweep sweep = arguments.sweep.empty() ? Sweep{"", {""}} : parse_sweep(arguments.sweep);
  const auto scenarios = scenarios_of(arguments, sweep);
  const fs::path directory = open_directory(arguments);
  const ThreadLimit threads(arguments.threads);
  BenchLog log(directory, sweep.key);
  int code = done;
  fmt::print("medians of the steps in ms; step: without the move; rebuild: CGAL's triangulation / step\n");
  for (std::size_t i = 0; i < scenarios.size(); ++i) {
    std::vector<Score> scores(arguments.strategies.size());
    std::size_t turn = 0;
    const auto stopped = compare_strategies(scenarios[i], arguments.strategies, [&](const Round& round) {
      scores[turn++ % scores.size()].add(round);
      log.write(round, sweep.values[i]);
    });
    fmt::print("\n{}\n", sweep.key.empty() ? scenarios[i].name() : sweep.key + " = " + sweep.values[i]);
    print_scores(arguments.strategies, scores);
    if (!stopped) continue;
    std::fflush(stdout);
    print_error(fmt::format("{}: {}", arguments.scenario, *stopped));
    code = not_valid;
  }
  fmt::print("\npeak memory {:.0f} MiB for all strategies together\n{}\n", peak_memory(),
             (directory / "bench.csv").string());
  return code;
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
  command.add_flag("--force", arguments->force, "Replace the benchmark that is in the folder");
  command.add_option("--threads", arguments->threads, "Threads to use; default: all cores")
      ->check(CLI::Range(1, 1024));
  command.footer(
      "Each strategy is given the same positions at each step, and every mesh is validated outside what is\n"
      "timed. Writes bench.csv, the columns of steps.csv behind the strategy's name, and bench_regions.csv.");
  command.callback([arguments, &action] { action = [arguments] { return bench(*arguments); }; });
}

}  // namespace kinemesh::cli
