/* A motion of one's own: flow towards a point from above and below, and away from it to both sides,
 * v = rate (x - center x, -(y - center y)).
 *
 *   cc -shared -fPIC -I WHERE/INCLUDE/kinemesh/IS saddle.c -o saddle.so
 *   kinemesh run saddle.toml
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kinemesh/plugin.h"

typedef struct saddle {
  double rate, x, y;
} saddle;

static int refuse(const char* name, char* message, size_t size) {
  snprintf(message, size, "unknown parameter %s, expected rate (a number) or center ([x, y])", name);
  return 1;
}

static int create(const kinemesh_plugin_parameter* parameters, size_t n, void** state, char* message,
                  size_t size) {
  saddle made = {1.0, 0.5, 0.5};
  for (size_t i = 0; i < n; ++i) {
    const kinemesh_plugin_parameter* p = &parameters[i];
    if (strcmp(p->name, "rate") == 0 && p->n_numbers == 1) {
      made.rate = p->numbers[0];
    } else if (strcmp(p->name, "center") == 0 && p->n_numbers == 2) {
      made.x = p->numbers[0];
      made.y = p->numbers[1];
    } else {
      return refuse(p->name, message, size);
    }
  }
  *state = malloc(sizeof made);
  if (!*state) return 1;
  memcpy(*state, &made, sizeof made);
  return 0;
}

static int evaluate(const void* state, double t, const double position[2], double result[2], char* message,
                    size_t size) {
  const saddle* s = state;
  result[0] = s->rate * (position[0] - s->x);
  result[1] = -s->rate * (position[1] - s->y);
  (void)t, (void)message, (void)size; /* steady, and cannot fail */
  return 0;
}

const kinemesh_plugin* kinemesh_motion_plugin(void) {
  static const kinemesh_plugin plugin = {KINEMESH_PLUGIN_VERSION, KINEMESH_PLUGIN_VELOCITY, create, evaluate,
                                         free};
  return &plugin;
}
