// Plug-ins that do what the test asks them to. SAMPLE_VERSION and SAMPLE_KIND make those that are refused.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "kinemesh/plugin.h"

#ifndef SAMPLE_VERSION
#define SAMPLE_VERSION KINEMESH_PLUGIN_VERSION
#endif
#ifndef SAMPLE_KIND
#define SAMPLE_KIND KINEMESH_PLUGIN_VELOCITY
#endif

namespace {

struct State {
  double rate = 1.0, center[2] = {0.0, 0.0};
  double until = INFINITY;  // then it does what `mode` says
  char mode[16] = "";
};

int create(const kinemesh_plugin_parameter* parameters, size_t n, void** state, char* message, size_t size) {
  State made;
  for (size_t i = 0; i < n; ++i) {
    const auto& p = parameters[i];
    if (!std::strcmp(p.name, "rate") && p.n_numbers == 1) {
      made.rate = p.numbers[0];
    } else if (!std::strcmp(p.name, "center") && p.n_numbers == 2) {
      std::memcpy(made.center, p.numbers, sizeof made.center);
    } else if (!std::strcmp(p.name, "until") && p.n_numbers == 1) {
      made.until = p.numbers[0];
    } else if (!std::strcmp(p.name, "mode") && p.text && std::strlen(p.text) < sizeof made.mode) {
      std::strcpy(made.mode, p.text);
      if (!std::strcmp(p.text, "throw early")) throw std::runtime_error("too early");
    } else {
      std::snprintf(message, size, "no parameter %s\nthat is known", p.name);
      return 1;
    }
  }
  *state = new State(made);
  return 0;
}

// rate (x - center x, -(y - center y))
int evaluate(const void* state, double t, const double x[2], double v[2], char* message, size_t size) {
  const State& s = *static_cast<const State*>(state);
  v[0] = s.rate * (x[0] - s.center[0]);
  v[1] = -s.rate * (x[1] - s.center[1]);
  if (t < s.until) return 0;
  if (!std::strcmp(s.mode, "throw")) throw std::runtime_error("out of sorts");
  if (!std::strcmp(s.mode, "throw int")) throw 5;
  if (!std::strcmp(s.mode, "nan")) return v[0] = NAN, 0;
  if (!std::strcmp(s.mode, "silent")) return 7;
  if (!std::strcmp(s.mode, "long")) return std::memset(message, 'x', size), 1;  // without its end
  std::snprintf(message, size, "the sea is\nrough");
  return 2;
}

void destroy(void* state) {
  delete static_cast<State*>(state);
}

constexpr kinemesh_plugin sample{SAMPLE_VERSION, SAMPLE_KIND, create, evaluate, destroy};

}  // namespace

#ifdef SAMPLE_WITHOUT_ENTRY
extern "C" const kinemesh_plugin* another_name() {
  return &sample;
}
#else
const kinemesh_plugin* kinemesh_motion_plugin(void) {
  return &sample;
}
#endif
