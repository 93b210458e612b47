// `--set key=value`: changes to a scenario before it is interpreted. Internal to sim/.
#pragma once

#include <toml++/toml.h>
#include <string>

namespace kinemesh {

// assignment: "time.dt=0.1", "motion.0.rate=2". Keys are TOML's dotted keys, in which a number reaches into a
// list and its length appends; missing tables are made. The value is TOML, or, where that fails, a text
// without its quotes. Throws InputError that names the override.
void apply_override(toml::table& scenario, const std::string& assignment);

}  // namespace kinemesh
