/* A small mesh, and what tests in C check with. */
#ifndef TESTS_C_SQUARE_H
#define TESTS_C_SQUARE_H

#include <kinemesh.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CHECK(condition)                                                                     \
  do {                                                                                       \
    if (!(condition)) {                                                                      \
      fprintf(stderr, "%s:%d: %s (%s)\n", __FILE__, __LINE__, #condition, kinemesh_error()); \
      exit(1);                                                                               \
    }                                                                                        \
  } while (0)

/* A triangle 4 5 6 inside a square; the lower half has another label. */
static const double points[] = {0, 0, 3, 0, 3, 3, 0, 3, 1, 1, 2, 1, 1.5, 2};
static const int32_t triangles[] = {4, 5, 6, 0, 1, 5, 0, 5, 4, 1, 2, 5, 2, 6, 5, 2, 3, 6, 3, 0, 4, 3, 4, 6};
enum { n_vertices = 7, n_faces = 8 };

static inline kinemesh_mesh* square(void) {
  kinemesh_mesh* mesh = NULL;
  CHECK(kinemesh_mesh_create(n_vertices, points, n_faces, triangles, NULL, &mesh) == KINEMESH_OK);
  return mesh;
}

static inline kinemesh_stepper* stepper_on(kinemesh_mesh* mesh, const kinemesh_options* options) {
  kinemesh_stepper* stepper = NULL;
  CHECK(kinemesh_stepper_create(mesh, options, &stepper) == KINEMESH_OK);
  kinemesh_mesh_destroy(mesh); /* the stepper has its own */
  return stepper;
}

static inline double area(const double* xy, const int32_t* t) {
  const double *a = xy + 2 * t[0], *b = xy + 2 * t[1], *c = xy + 2 * t[2];
  return ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
}

#endif
