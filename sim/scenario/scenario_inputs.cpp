#include "sim/scenario/scenario_inputs.h"

#include <sys/stat.h>

#include <optional>
#include <variant>

#include "core/io/pvd.h"

namespace kinemesh {
namespace {

namespace fs = std::filesystem;

std::optional<std::pair<dev_t, ino_t>> identity_of(const fs::path& file) {
  struct stat status;
  if (::stat(file.c_str(), &status) != 0) return std::nullopt;
  return std::pair(status.st_dev, status.st_ino);
}

}  // namespace

ScenarioInputs::ScenarioInputs(const Scenario& scenario) {
  add(scenario.file);
  add(scenario.mesh.file);
  const fs::path folder = fs::absolute(scenario.file).parent_path();
  for (const MotionSpec& motion : scenario.motions) add_named_by(motion, folder);
  for (const BodyScenario& body : scenario.bodies)
    for (const MotionSpec& motion : body.motions) add_named_by(motion, folder);
}

void ScenarioInputs::add_named_by(const MotionSpec& motion, const fs::path& folder) {
  for (const auto& [name, value] : motion.parameters)
    if (const auto* text = std::get_if<std::string>(&value)) add_named(*text, folder);
}

bool ScenarioInputs::contain(const fs::path& file) const {
  const auto identity = identity_of(file);
  return identity && files_.contains(*identity);
}

void ScenarioInputs::add(const fs::path& file) {
  if (const auto identity = identity_of(file)) files_.insert(*identity);
}

// A series that cannot be read has no meshes: whoever needs them says so.
void ScenarioInputs::add_series(const fs::path& file) try {
  for (const PvdEntry& entry : read_pvd(file)) add(file.parent_path() / entry.file);
} catch (const InputError&) {
}

// Plug-ins read files under names of their own choice: relative to the scenario, or to where the program
// runs.
void ScenarioInputs::add_named(const std::string& text, const fs::path& folder) {
  for (const fs::path& file : {folder / text, fs::path(text)}) {
    add(file);
    if (file.extension() == ".pvd") add_series(file);
  }
}

}  // namespace kinemesh
