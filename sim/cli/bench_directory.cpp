#include "sim/cli/bench_directory.h"

#include <algorithm>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/atomic_file.h"
#include "core/io/file_error.h"
#include "sim/cli/bench_plots.h"
#include "sim/run/run_directory.h"
#include "sim/scenario/scenario_inputs.h"

namespace kinemesh::cli {
namespace {

namespace fs = std::filesystem;

// A file's name within the folder, and what one of ours has within its first lines.
struct BenchFile {
  std::string name;
  std::string_view mark;
};

std::vector<BenchFile> bench_files() {
  std::vector<BenchFile> files{{"bench.csv", "strategy,step,time"},
                               {"bench_regions.csv", "strategy,step,region"},
                               {"bench_bound.csv", "step,seed,faces,upright"}};
  for (const std::string plot : bench_plot_names) {
    files.push_back({"plots/" + plot + ".gp", "# Makes "});
    files.push_back({"plots/" + plot + ".svg", "GNUPLOT"});
  }
  return files;
}

// Nothing is lost with an empty one, which a killed process may leave.
bool has_mark(const fs::path& file, std::string_view mark) {
  std::string head(1000, ' ');
  std::ifstream stream(file, std::ios::binary);
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  return stream.gcount() == 0 || head.find(mark) != std::string::npos;
}

void require_folder_or_nothing(const fs::path& path) {
  const auto status = fs::symlink_status(path);
  if (fs::exists(status) && !fs::is_directory(status)) throw InputError(path.string(), 0, "is not a folder");
}

void require_own(const fs::path& file, std::string_view mark, const std::vector<ScenarioInputs>& inputs,
                 bool force) {
  require_regular_or_nothing(file);
  if (!fs::exists(file)) return;
  if (std::ranges::any_of(inputs, [&](const ScenarioInputs& all) { return all.contain(file); }))
    throw InputError(file.string(), 0,
                     "is an input of the scenario, and would be replaced; -o names another folder");
  if (!force)
    throw InputError(
        file.parent_path().string(), 0,
        "holds a benchmark (" + file.filename().string() + "); --force replaces it, -o names another folder");
  if (!has_mark(file, mark))
    throw InputError(file.string(), 0, "is in the way: it is not of a benchmark, and not replaced");
}

void check_bench_directory(const fs::path& directory, std::span<const Scenario> scenarios, bool force) {
  if (!fs::exists(directory)) return;
  if (!fs::is_directory(directory)) throw InputError(directory.string(), 0, "is not a folder");
  require_folder_or_nothing(directory / "plots");
  const std::vector<ScenarioInputs> inputs(scenarios.begin(), scenarios.end());
  for (const auto& [name, mark] : bench_files()) require_own(directory / name, mark, inputs, force);
}

void make(const fs::path& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) io::fail(directory, "cannot be made", error.value());
}

}  // namespace

FolderLock open_bench_directory(const fs::path& directory, std::span<const Scenario> scenarios, bool force) {
  check_bench_directory(directory, scenarios, force);
  make(directory);
  FolderLock lock(directory);
  check_bench_directory(directory, scenarios, force);  // another process may have come between
  remove_leftovers(directory);
  for (const auto& [name, mark] : bench_files()) fs::remove(directory / name);
  if (force) remove_report(directory);
  return lock;
}

}  // namespace kinemesh::cli
