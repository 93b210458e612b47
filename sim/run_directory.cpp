#include "sim/run_directory.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/io/mesh_io.h"

namespace kinemesh {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 7> fixed_names = {"scenario.toml",      "run.json", "steps.csv",
                                                         "regions.csv",        "mesh.pvd", "checkpoint.bin",
                                                         "checkpoint_prev.bin"};

bool is_mesh_of_series(std::string_view name) {
  if (!name.starts_with("mesh_") || !name.ends_with(".vtu") || name.size() < 15) return false;
  const auto number = name.substr(5, name.size() - 9);
  return std::ranges::all_of(number, [](char c) { return '0' <= c && c <= '9'; });
}

bool is_last_mesh(const std::string& name) {
  return name.starts_with("final.") && fs::path(name).stem() == "final" && format_of(name).has_value();
}

bool holds_run(const fs::path& directory) {
  return std::ranges::any_of(std::array{"run.json", "scenario.toml", "steps.csv"},
                             [&](const char* name) { return fs::exists(directory / name); });
}

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw InputError(path.string(), 0, what);
}

std::vector<fs::path> run_files(const fs::path& directory) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(directory))
    if (!entry.is_directory() && is_run_file(entry.path().filename().string())) files.push_back(entry.path());
  return files;
}

void refuse_to_replace(const fs::path& input, const fs::path& directory) {
  std::error_code ignored;
  if (!fs::equivalent(fs::absolute(input).parent_path(), directory, ignored)) return;
  if (is_run_file(input.filename().string()))
    fail(input, "the run would replace this file; give it another name, or another folder with -o");
}

}  // namespace

std::string mesh_file_name(int step) {
  return fmt::format("mesh_{:06}.vtu", step);
}

bool is_run_file(const std::string& name) {
  return std::ranges::find(fixed_names, name) != fixed_names.end() || is_mesh_of_series(name) ||
         is_last_mesh(name);
}

void check_run_directory(const fs::path& directory, const Scenario& scenario, bool force) {
  std::error_code error;
  const auto status = fs::status(directory, error);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status)) fail(directory, "is not a folder");
  if (holds_run(directory) && !force)
    fail(directory, "holds a run already; --force replaces it, -o names another folder");
  // The resolved scenario of an earlier run may be run again: it is written as it was.
  if (!fs::exists(directory / "run.json")) refuse_to_replace(scenario.file, directory);
  if (!scenario.mesh.file.empty()) refuse_to_replace(scenario.mesh.file, directory);
}

void clear_run_directory(const fs::path& directory) {
  try {
    fs::create_directories(directory);
    for (const auto& file : run_files(directory)) fs::remove(file);
  } catch (const fs::filesystem_error& error) {
    fail(error.path1().empty() ? directory : error.path1(), error.code().message());
  }
}

}  // namespace kinemesh
