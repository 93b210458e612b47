#include "sim/run/run_directory.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/io/atomic_file.h"
#include "kinemesh/mesh_io.h"

namespace kinemesh {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 10> fixed_names = {
    "scenario.toml",   "run.json",       "steps.csv",           "regions.csv",
    "mesh.pvd",        "checkpoint.bin", "checkpoint_prev.bin", "checkpoint_next.bin",
    "failed_step.bin", "patches.bin"};

bool is_mesh_of_series(std::string_view name) {
  if (!name.starts_with("mesh_") || !name.ends_with(".vtu") || name.size() < 15) return false;
  const auto number = name.substr(5, name.size() - 9);
  return std::ranges::all_of(number, [](char c) { return '0' <= c && c <= '9'; });
}

bool is_last_mesh(const std::string& name) {
  return name.starts_with("final.") && fs::path(name).stem() == "final" && format_of(name).has_value();
}

bool is_there(const fs::path& path) {
  return fs::exists(fs::symlink_status(path));
}

bool holds_run(const fs::path& directory) {
  return std::ranges::any_of(std::array{"run.json", "scenario.toml", "steps.csv"},
                             [&](const char* name) { return is_there(directory / name); });
}

// What is in the folder's run.json; nothing that is an object where there is none.
nlohmann::json record_in(const fs::path& directory) {
  const fs::path file = directory / "run.json";
  require_regular_or_nothing(file);
  return is_there(file) ? nlohmann::json::parse(read_file(file), nullptr, false) : nlohmann::json();
}

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw InputError(path.string(), 0, what);
}

// In the order of their names.
template <class Predicate>
std::vector<fs::path> files_that(const fs::path& directory, const Predicate& is_wanted) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(directory))
    if (is_wanted(entry.path().filename().string())) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

// Calls f() and tells of the file system's errors in our words.
template <class F>
void with_file_errors(const fs::path& directory, const F& f) {
  try {
    f();
  } catch (const fs::filesystem_error& error) {
    fail(error.path1().empty() ? directory : error.path1(), error.code().message());
  }
}

// The resolved scenario of an earlier run may be run again: it stays as it is.
bool is_this_scenario(const fs::path& file, const Scenario& scenario) {
  std::error_code ignored;
  return file.filename() == "scenario.toml" && fs::equivalent(file, scenario.file, ignored) &&
         read_file(file) == to_toml(scenario);
}

void require_own(const fs::path& file, const Scenario& scenario, const ScenarioInputs& inputs,
                 const std::set<std::string>& own) {
  require_regular_or_nothing(file);
  if (inputs.contain(file) && !is_this_scenario(file, scenario))
    fail(file,
         "the run would replace this file, an input of the scenario; give it another name, or another folder "
         "with -o");
  if (!own.contains(file.filename().string()))
    fail(file,
         "is in the way: the run writes a file of this name, and no run has written this one (run.json does "
         "not "
         "list it)");
}

}  // namespace

std::string mesh_file_name(int step) {
  return fmt::format("mesh_{:06}.vtu", step);
}

bool is_run_file(const std::string& name) {
  return std::ranges::find(fixed_names, name) != fixed_names.end() || is_mesh_of_series(name) ||
         is_last_mesh(name);
}

// Whatever else may stand there is not believed.
std::set<std::string> files_of_run(const fs::path& directory) {
  std::set<std::string> names;
  const auto record = record_in(directory);
  if (!record.is_object() || !record.contains("files")) return names;
  for (const auto& name : record["files"])
    if (name.is_string() && is_run_file(name.get<std::string>())) names.insert(name.get<std::string>());
  return names;
}

bool holds_finished_run(const fs::path& directory) {
  const auto record = record_in(directory);
  return record.is_object() && record.value("state", nlohmann::json()) == "done";
}

void require_run_of(const std::string& scenario, const fs::path& directory) {
  const fs::path file = directory / "scenario.toml";
  require_regular_or_nothing(file);
  if (!fs::exists(file)) return;
  if (const auto differs = scenario_difference(read_file(file), scenario))
    fail(file, "the run in this folder is of another scenario: " + *differs);
}

void check_run_directory(const fs::path& directory, const Scenario& scenario, bool may_be_there) {
  std::error_code error;
  const auto status = fs::status(directory, error);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status)) fail(directory, "is not a folder");
  if (holds_run(directory) && !may_be_there)
    fail(directory,
         "holds a run already; --resume goes on with it, --force replaces it, -o names another folder");
  const ScenarioInputs inputs(scenario);
  const auto own = files_of_run(directory);
  with_file_errors(directory, [&] {
    for (const auto& file : files_that(directory, is_run_file)) require_own(file, scenario, inputs, own);
  });
}

void clear_run_directory(const fs::path& directory, const Scenario& scenario) {
  const auto is_other = [](const std::string& name) { return is_run_file(name) && name != "run.json"; };
  with_file_errors(directory, [&] {
    for (const char* name : {"checkpoint.bin", "checkpoint_prev.bin"}) fs::remove(directory / name);
    for (const auto& file : files_that(directory, is_other))
      if (!is_this_scenario(file, scenario)) fs::remove(file);
  });
}

// By its head; somebody else's page may have the name, too.
bool is_report(const fs::path& file) {
  if (!fs::is_regular_file(fs::symlink_status(file))) return false;
  std::string head(300, ' ');
  std::ifstream(file, std::ios::binary).read(head.data(), static_cast<std::streamsize>(head.size()));
  return head.find("<title>kinemesh report</title>") != std::string::npos;
}

void remove_report(const fs::path& directory) {
  const fs::path file = directory / "report.html";
  with_file_errors(directory, [&] {
    if (is_report(file)) fs::remove(file);
  });
}

void remove_later_meshes(const fs::path& directory, std::span<const std::string> kept) {
  const auto is_later = [&](const std::string& name) {
    return is_last_mesh(name) || name == "failed_step.bin" ||
           (is_mesh_of_series(name) && std::ranges::find(kept, name) == kept.end());
  };
  with_file_errors(directory, [&] {
    for (const auto& file : files_that(directory, is_later)) fs::remove(file);
  });
}

}  // namespace kinemesh
