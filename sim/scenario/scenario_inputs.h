// The files a scenario is made of: what no command may overwrite or delete.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <set>
#include <string>
#include <utility>

#include "kinemesh/scenario.h"

namespace kinemesh {

// The scenario, its mesh, and what its motions read: tables, libraries, series with the meshes they name, and
// any file that a text parameter is the name of.
class ScenarioInputs {
 public:
  explicit ScenarioInputs(const Scenario& scenario);

  // Whether `file` is one of them, under this name or, through links of either kind, another.
  bool contain(const std::filesystem::path& file) const;

 private:
  void add(const std::filesystem::path& file);
  void add_series(const std::filesystem::path& file);
  void add_named_by(const MotionSpec& motion, const std::filesystem::path& folder);
  void add_named(const std::string& text, const std::filesystem::path& folder);

  std::set<std::pair<dev_t, ino_t>> files_;
};

}  // namespace kinemesh
