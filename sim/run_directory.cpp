#include "sim/run_directory.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/io/atomic_file.h"
#include "core/io/mesh_io.h"

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

// write_file_atomically was interrupted.
bool is_half_written(std::string_view name) {
  return name.starts_with(".kinemesh-") && name.ends_with(".tmp");
}

bool holds_run(const fs::path& directory) {
  return std::ranges::any_of(std::array{"run.json", "scenario.toml", "steps.csv"},
                             [&](const char* name) { return fs::exists(directory / name); });
}

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw InputError(path.string(), 0, what);
}

template <class Predicate>
std::vector<fs::path> files_that(const fs::path& directory, const Predicate& is_wanted) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(directory))
    if (!entry.is_directory() && is_wanted(entry.path().filename().string())) files.push_back(entry.path());
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

void refuse_to_replace(const fs::path& input, const fs::path& directory) {
  std::error_code ignored;
  if (!fs::equivalent(fs::absolute(input).parent_path(), directory, ignored)) return;
  if (is_run_file(input.filename().string()))
    fail(input, "the run would replace this file; give it another name, or another folder with -o");
}

// Of `kinemesh report`: somebody else's page may have the name, too.
bool is_report(const fs::path& file) {
  std::string head(300, ' ');
  std::ifstream(file, std::ios::binary).read(head.data(), static_cast<std::streamsize>(head.size()));
  return head.find("<title>kinemesh report</title>") != std::string::npos;
}

}  // namespace

std::string mesh_file_name(int step) {
  return fmt::format("mesh_{:06}.vtu", step);
}

bool is_run_file(const std::string& name) {
  return std::ranges::find(fixed_names, name) != fixed_names.end() || is_mesh_of_series(name) ||
         is_last_mesh(name) || is_half_written(name);
}

bool holds_finished_run(const fs::path& directory) {
  if (!fs::exists(directory / "run.json")) return false;
  const auto json = nlohmann::json::parse(read_file(directory / "run.json"), nullptr, false);
  return json.is_object() && json.value("state", nlohmann::json()) == "done";
}

void require_run_of(const std::string& scenario, const fs::path& directory) {
  const fs::path file = directory / "scenario.toml";
  if (!fs::exists(file)) return;
  if (const auto differs = scenario_difference(read_file(file), scenario))
    fail(file, "the run in this folder is of another scenario: " + *differs);
}

void check_run_directory(const fs::path& directory, const Scenario& scenario, bool force) {
  std::error_code error;
  const auto status = fs::status(directory, error);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status)) fail(directory, "is not a folder");
  if (holds_run(directory) && !force)
    fail(directory,
         "holds a run already; --resume goes on with it, --force replaces it, -o names another folder");
  // The resolved scenario of an earlier run may be run again: it is written as it was.
  if (!fs::exists(directory / "run.json")) refuse_to_replace(scenario.file, directory);
  if (!scenario.mesh.file.empty()) refuse_to_replace(scenario.mesh.file, directory);
}

void clear_run_directory(const fs::path& directory) {
  const auto is_not_scenario = [](const std::string& name) {
    return is_run_file(name) && name != "scenario.toml";
  };
  with_file_errors(directory, [&] {
    fs::create_directories(directory);
    for (const char* name : {"run.json", "checkpoint.bin", "checkpoint_prev.bin"})
      fs::remove(directory / name);
    for (const auto& file : files_that(directory, is_not_scenario)) fs::remove(file);
    fs::remove(directory / "scenario.toml");
  });
  remove_report(directory);
}

void remove_report(const fs::path& directory) {
  const fs::path file = directory / "report.html";
  with_file_errors(directory, [&] {
    if (is_report(file)) fs::remove(file);
  });
}

void remove_later_meshes(const fs::path& directory, std::span<const std::string> kept) {
  const auto is_later = [&](const std::string& name) {
    return is_last_mesh(name) || is_half_written(name) || name == "failed_step.bin" ||
           (is_mesh_of_series(name) && std::ranges::find(kept, name) == kept.end());
  };
  with_file_errors(directory, [&] {
    for (const auto& file : files_that(directory, is_later)) fs::remove(file);
  });
}

}  // namespace kinemesh
