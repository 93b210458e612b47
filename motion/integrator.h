// Explicit one-step methods for dx/dt = v(x, t).
#pragma once

#include <string_view>

#include "kinemesh/motion.h"

namespace kinemesh {

// "euler", "heun" or "rk4". Throws ParameterError (key "integrator").
Integrator parse_integrator(std::string_view name);
const char* to_string(Integrator integrator);

// The way from x at t to where v(x, t) leads at t + dt; Velocity: Point(const Point&, double).
template <class Velocity>
Point integrate(Integrator integrator, const Velocity& v, const Point& x, double t, double dt) {
  const Point k1 = v(x, t);
  if (integrator == Integrator::Euler) return dt * k1;
  if (integrator == Integrator::Heun) return 0.5 * dt * (k1 + v(x + dt * k1, t + dt));
  const Point k2 = v(x + 0.5 * dt * k1, t + 0.5 * dt);
  const Point k3 = v(x + 0.5 * dt * k2, t + 0.5 * dt);
  const Point k4 = v(x + dt * k3, t + dt);
  return dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

}  // namespace kinemesh
