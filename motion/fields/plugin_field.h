// Fields from shared libraries; kinemesh/plugin.h is what such a library includes.
#pragma once

#include <string>

#include "kinemesh/field.h"
#include "kinemesh/parameters.h"

namespace kinemesh {

// Loads the library and hands the parameters on. The library stays loaded as long as the field lives.
//
// The field throws std::runtime_error, naming library, place and time, where the plug-in's evaluate returns
// an error or throws; a step fails by that, and leaves no trace.
// Throws ParameterError (key "library") that names the library and why: no such file, nothing that can be
// loaded, no function kinemesh_motion_plugin, another version of the interface, parameters that it refuses.
AnyField make_plugin_field(const std::string& library, const FieldParameters& parameters);

}  // namespace kinemesh
