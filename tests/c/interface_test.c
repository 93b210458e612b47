/* The C interface as a C program meets it. Argument: a folder to write to. */
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

static kinemesh_mesh* square(void) {
  kinemesh_mesh* mesh = NULL;
  CHECK(kinemesh_mesh_create(n_vertices, points, n_faces, triangles, NULL, &mesh) == KINEMESH_OK);
  return mesh;
}

static kinemesh_stepper* stepper_on(kinemesh_mesh* mesh, const kinemesh_options* options) {
  kinemesh_stepper* stepper = NULL;
  CHECK(kinemesh_stepper_create(mesh, options, &stepper) == KINEMESH_OK);
  kinemesh_mesh_destroy(mesh); /* the stepper has its own */
  return stepper;
}

static double area(const double* xy, const int32_t* t) {
  const double *a = xy + 2 * t[0], *b = xy + 2 * t[1], *c = xy + 2 * t[2];
  return ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
}

static void check_upright(const kinemesh_stepper* stepper) {
  double xy[2 * n_vertices], total = 0;
  int32_t t[3 * n_faces], face;
  CHECK(kinemesh_stepper_n_vertices(stepper) == n_vertices && kinemesh_stepper_n_faces(stepper) == n_faces);
  CHECK(kinemesh_stepper_get(stepper, xy, t, NULL) == KINEMESH_OK);
  for (face = 0; face < n_faces; ++face) {
    CHECK(area(xy, t + 3 * face) > 0);
    total += area(xy, t + 3 * face);
  }
  CHECK(total > 9 - 1e-12 && total < 9 + 1e-12);
}

typedef struct {
  int32_t faces[3 * n_faces]; /* kept up to date by what the observer is told */
  int calls, patches;
  int answer;
} observed;

static int watch(const kinemesh_changes* changes, void* user) {
  observed* seen = user;
  int32_t p, i;
  ++seen->calls;
  for (p = 0; p < changes->n_patches && seen->answer == 0; ++p) {
    const kinemesh_patch* patch = &changes->patches[p];
    for (i = 0; i < patch->n_faces; ++i) {
      int32_t* face = seen->faces + 3 * patch->faces[i];
      CHECK(memcmp(face, patch->before + 3 * i, sizeof(int32_t) * 3) == 0);
      memcpy(face, patch->after + 3 * i, sizeof(int32_t) * 3);
      CHECK(area(changes->xy_before, patch->before + 3 * i) > 0);
      CHECK(area(changes->xy_after, patch->after + 3 * i) > 0);
      CHECK(patch->labels_before[i] == 0 && patch->labels_after[i] == 0);
    }
    CHECK(patch->n_vertices > 3 && patch->vertices[0] >= 0);
    ++seen->patches;
  }
  return seen->answer;
}

static void takes_steps_and_tells_of_them(void) {
  kinemesh_stepper* stepper = stepper_on(square(), NULL);
  double xy[2 * n_vertices], *own;
  int32_t now[3 * n_faces];
  kinemesh_step record;
  observed seen = {{0}, 0, 0, 0};
  memcpy(seen.faces, triangles, sizeof triangles);
  memcpy(xy, points, sizeof points);
  CHECK(kinemesh_stepper_observe(stepper, watch, &seen) == KINEMESH_OK);

  xy[13] = 0.5; /* vertex 6 through the edge 4 5 */
  CHECK(kinemesh_stepper_step(stepper, xy, 0.25, &record) == KINEMESH_OK);
  CHECK(record.step == 1 && record.time == 0.25 && record.dt == 0.25 && record.n_faces == n_faces);
  CHECK(record.inverted == 1 && record.regions == 1 && record.replaced == 6 && record.flat == 0);
  CHECK(record.min_area > 0 && record.min_angle_deg > 0);
  check_upright(stepper);

  own = kinemesh_stepper_positions(stepper);
  CHECK(own != NULL && memcmp(own, xy, sizeof xy) == 0);
  own[13] = 2.5; /* and back up beyond where it was */
  CHECK(kinemesh_stepper_repair(stepper, 0.25, NULL) == KINEMESH_OK);
  CHECK(kinemesh_stepper_time(stepper) == 0.5);
  check_upright(stepper);

  CHECK(seen.calls == 2 && seen.patches >= 2);
  CHECK(kinemesh_stepper_get(stepper, NULL, now, NULL) == KINEMESH_OK);
  CHECK(memcmp(now, seen.faces, sizeof now) == 0);
  kinemesh_stepper_destroy(stepper);
}

static void moves_a_border_and_what_is_inside_follows(void) {
  kinemesh_stepper* stepper = stepper_on(square(), NULL);
  kinemesh_step record;
  double xy[2 * n_vertices];
  const int32_t corner[] = {2}, twice[] = {2, 2}, none_such[] = {7};
  const double there[] = {3.5, 3.25, 3.5, 3.25};
  CHECK(kinemesh_stepper_step_border(stepper, 1, corner, there, 0.5, &record) == KINEMESH_OK);
  CHECK(record.step == 1 && record.time == 0.5 && record.min_angle_deg > 0);
  CHECK(kinemesh_stepper_get(stepper, xy, NULL, NULL) == KINEMESH_OK);
  CHECK(xy[4] == 3.5 && xy[5] == 3.25);
  CHECK(xy[0] == 0 && xy[1] == 0 && xy[2] == 3 && xy[3] == 0 && xy[6] == 0 && xy[7] == 3);
  CHECK(xy[12] > points[12] && xy[13] > points[13]);
  CHECK(kinemesh_stepper_step_border(stepper, 2, twice, there, 0.5, NULL) == KINEMESH_BAD_INPUT);
  CHECK(strstr(kinemesh_error(), "comes twice") != NULL);
  CHECK(kinemesh_stepper_step_border(stepper, 1, none_such, there, 0.5, NULL) == KINEMESH_BAD_INPUT);
  CHECK(kinemesh_stepper_step_border(stepper, 1, corner, NULL, 0.5, NULL) == KINEMESH_BAD_INPUT);
  CHECK(kinemesh_stepper_time(stepper) == 0.5);
  kinemesh_stepper_destroy(stepper);
}

static void leaves_everything_as_it_was_when_it_fails(void) {
  kinemesh_stepper* stepper = stepper_on(square(), NULL);
  double xy[2 * n_vertices], *own = kinemesh_stepper_positions(stepper);
  int32_t now[3 * n_faces];
  observed seen = {{0}, 0, 0, 1};
  memcpy(xy, points, sizeof points);

  xy[12] = xy[10], xy[13] = xy[11]; /* 6 onto 5 */
  CHECK(kinemesh_stepper_step(stepper, xy, 0.25, NULL) == KINEMESH_NO_VALID_MESH);
  CHECK(strstr(kinemesh_error(), "5") && strstr(kinemesh_error(), "6"));
  own[12] = own[10], own[13] = own[11];
  CHECK(kinemesh_stepper_repair(stepper, 0.25, NULL) == KINEMESH_NO_VALID_MESH);
  CHECK(memcmp(own, points, sizeof points) == 0);
  CHECK(kinemesh_stepper_step(stepper, xy, -1, NULL) == KINEMESH_BAD_INPUT);
  CHECK(kinemesh_stepper_step(NULL, xy, 1, NULL) == KINEMESH_BAD_INPUT);
  CHECK(strcmp(kinemesh_error(), "stepper is NULL, an address expected") == 0);

  CHECK(kinemesh_stepper_observe(stepper, watch, &seen) == KINEMESH_OK);
  CHECK(kinemesh_stepper_observe(stepper, NULL, NULL) == KINEMESH_BAD_INPUT);
  memcpy(xy, points, sizeof points);
  xy[13] = 0.5;
  CHECK(kinemesh_stepper_step(stepper, xy, 0.25, NULL) == KINEMESH_VETOED);
  CHECK(seen.calls == 1);
  CHECK(kinemesh_stepper_get(stepper, xy, now, NULL) == KINEMESH_OK);
  CHECK(memcmp(xy, points, sizeof points) == 0 && memcmp(now, triangles, sizeof triangles) == 0);
  CHECK(kinemesh_stepper_time(stepper) == 0);
  kinemesh_stepper_destroy(stepper);
}

static void refuses_what_is_no_mesh(void) {
  kinemesh_mesh* mesh = NULL;
  kinemesh_stepper* stepper = NULL;
  kinemesh_options options = kinemesh_default_options();
  int32_t broken[3 * n_faces];
  double tangled[2 * n_vertices];
  memcpy(broken, triangles, sizeof triangles);
  broken[4] = n_vertices;
  CHECK(kinemesh_mesh_create(n_vertices, points, n_faces, broken, NULL, &mesh) == KINEMESH_BAD_INPUT);
  CHECK(strstr(kinemesh_error(), "face 1") && mesh == NULL);
  CHECK(kinemesh_mesh_create(-1, points, n_faces, triangles, NULL, &mesh) == KINEMESH_BAD_INPUT);
  CHECK(kinemesh_mesh_create(n_vertices, points, n_faces, triangles, NULL, NULL) == KINEMESH_BAD_INPUT);
  CHECK(kinemesh_mesh_read("no/such.off", &mesh) == KINEMESH_BAD_INPUT && mesh == NULL);

  mesh = square();
  options.strategy = "wishing";
  CHECK(kinemesh_stepper_create(mesh, &options, &stepper) == KINEMESH_BAD_INPUT && stepper == NULL);
  CHECK(strstr(kinemesh_error(), "wishing") && strstr(kinemesh_error(), "global"));
  kinemesh_mesh_destroy(mesh);
  kinemesh_mesh_destroy(NULL);
  kinemesh_stepper_destroy(NULL);

  memcpy(tangled, points, sizeof points);
  tangled[13] = 0.5;
  CHECK(kinemesh_mesh_create(n_vertices, tangled, n_faces, triangles, NULL, &mesh) == KINEMESH_OK);
  CHECK(kinemesh_stepper_create(mesh, NULL, &stepper) == KINEMESH_BAD_INPUT);
  CHECK(strstr(kinemesh_error(), "kinemesh_mesh_untangle"));
  CHECK(kinemesh_mesh_untangle(mesh, NULL) == KINEMESH_OK);
  stepper = stepper_on(mesh, NULL);
  check_upright(stepper);
  kinemesh_stepper_destroy(stepper);
}

static void keeps_markers_and_labels(const char* folder) {
  char file[4096];
  const int32_t labels[n_faces] = {1, 1, 1, 1, 2, 2, 2, 2}, line[] = {0, 1, 4, 5}, more[] = {5, 6};
  int32_t back[n_faces];
  kinemesh_mesh *mesh = NULL, *copy = NULL;
  kinemesh_options options = kinemesh_default_options();
  kinemesh_stepper* stepper;
  CHECK(kinemesh_mesh_create(n_vertices, points, n_faces, triangles, labels, &mesh) == KINEMESH_OK);
  CHECK(kinemesh_mesh_add_marker(mesh, "line", 2, line) == KINEMESH_OK);
  CHECK(kinemesh_mesh_add_marker(mesh, "line", 1, more) == KINEMESH_OK);
  options.quality = "delaunay";
  stepper = stepper_on(mesh, &options);
  CHECK(kinemesh_stepper_mesh(stepper, &copy) == KINEMESH_OK);
  sprintf(file, "%.4000s/labels.msh", folder);
  CHECK(kinemesh_mesh_write(copy, file) == KINEMESH_OK);
  kinemesh_mesh_destroy(copy);
  CHECK(kinemesh_mesh_read(file, &copy) == KINEMESH_OK);
  CHECK(kinemesh_mesh_n_faces(copy) == n_faces && kinemesh_mesh_n_vertices(copy) == n_vertices);
  kinemesh_mesh_get(copy, NULL, NULL, back);
  CHECK(memcmp(back, labels, sizeof back) == 0);
  CHECK(kinemesh_mesh_write(copy, "mesh.unheard-of") == KINEMESH_BAD_INPUT);
  kinemesh_mesh_destroy(copy);
  kinemesh_stepper_destroy(stepper);
}

int main(int argc, char** argv) {
  CHECK(argc == 2);
  CHECK(strlen(kinemesh_version()) > 4);
  takes_steps_and_tells_of_them();
  moves_a_border_and_what_is_inside_follows();
  leaves_everything_as_it_was_when_it_fails();
  refuses_what_is_no_mesh();
  keeps_markers_and_labels(argv[1]);
  return 0;
}
