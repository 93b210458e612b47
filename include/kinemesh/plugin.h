/* A motion of your own from a shared library, for the field "plugin" of a scenario: plain C, for any compiler
 * and language. The library has one function with C linkage, kinemesh_motion_plugin; examples/plugin shows a
 * whole one.
 *
 * Strings end with a zero. A function that can fail returns 0 if all is well; otherwise it puts a line into
 * `message`, which holds `size` bytes and is empty before, and the step or the scenario is refused with it.
 */
#ifndef KINEMESH_MOTION_PLUGIN_H
#define KINEMESH_MOTION_PLUGIN_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Of this interface. Another one is refused. */
#define KINEMESH_PLUGIN_VERSION 1

enum {
  KINEMESH_PLUGIN_VELOCITY = 1, /* v(x, t), length per time, integrated in time */
  KINEMESH_PLUGIN_DISPLACEMENT =
      2 /* d(X, t), length, from the initial position X; a step adds d(X, t + dt) - d(X, t) */
};

/* What the scenario's [[motion]] says beside field, library, on and blend. */
typedef struct kinemesh_plugin_parameter {
  const char* name;
  const char* text;      /* NULL unless it is a text */
  const double* numbers; /* otherwise: one number, or a list of them */
  size_t n_numbers;
} kinemesh_plugin_parameter;

typedef struct kinemesh_plugin {
  uint32_t version; /* KINEMESH_PLUGIN_VERSION */
  uint32_t kind;    /* KINEMESH_PLUGIN_VELOCITY or KINEMESH_PLUGIN_DISPLACEMENT */

  /* Checks the parameters, sorted by name, which live until it returns, and makes what evaluate needs. Called
   * for each [[motion]], perhaps several times. May be NULL: no parameters, and no state. */
  int (*create)(const kinemesh_plugin_parameter* parameters, size_t n_parameters, void** state, char* message,
                size_t size);

  /* The velocity or displacement at one position and time. A pure function of its arguments: called from
   * several threads at once, and in any order. A result that is not finite fails the step, like an error. */
  int (*evaluate)(const void* state, double t, const double position[2], double result[2], char* message,
                  size_t size);

  void (*destroy)(void* state); /* may be NULL */
} kinemesh_plugin;

/* Yours. The result lives as long as the library is loaded. */
#ifdef _WIN32
__declspec(dllexport)
#elif defined(__GNUC__)
__attribute__((visibility("default")))
#endif
    const kinemesh_plugin* kinemesh_motion_plugin(void);

#ifdef __cplusplus
}
#endif

#endif
