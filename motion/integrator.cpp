#include "motion/integrator.h"

#include <string>

#include "kinemesh/parameters.h"

namespace kinemesh {

Integrator parse_integrator(std::string_view name) {
  for (const auto integrator : {Integrator::Euler, Integrator::Heun, Integrator::Rk4})
    if (name == to_string(integrator)) return integrator;
  throw ParameterError("integrator",
                       "unknown integrator \"" + std::string(name) + "\", expected euler, heun or rk4");
}

const char* to_string(Integrator integrator) {
  switch (integrator) {
    case Integrator::Euler:
      return "euler";
    case Integrator::Heun:
      return "heun";
    case Integrator::Rk4:
      return "rk4";
  }
  return "";
}

}  // namespace kinemesh
