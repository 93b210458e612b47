/* What callers do wrong: each is an error code and a message, and what they hold goes on working. */
#include <kinemesh.h>
#include <math.h>
#include <pthread.h>
#include <stddef.h>
#include <string.h>

#include "observers.h"
#include "square.h"

#define CHECK_REFUSED(call, told)                           \
  do {                                                      \
    CHECK((call) == KINEMESH_BAD_INPUT);                    \
    CHECK(strstr(kinemesh_error(), told));                  \
    CHECK(kinemesh_culprits()->kind == KINEMESH_NO_DEFECT); \
  } while (0)

static kinemesh_mesh* mesh;
static kinemesh_stepper* stepper;

static void refuses_null(void) {
  kinemesh_mesh* made = NULL;
  kinemesh_stepper* stepping = NULL;
  double share;
  int32_t face, edges[2] = {0, 1};
  CHECK_REFUSED(kinemesh_mesh_create(7, NULL, 8, triangles, NULL, &made), "xy is NULL");
  CHECK_REFUSED(kinemesh_mesh_create(7, points, 8, NULL, NULL, &made), "triangles is NULL");
  CHECK_REFUSED(kinemesh_mesh_create(7, points, 8, triangles, NULL, NULL), "mesh is NULL");
  CHECK_REFUSED(kinemesh_mesh_read(NULL, &made), "file is NULL");
  CHECK_REFUSED(kinemesh_mesh_read("a.off", NULL), "mesh is NULL");
  CHECK_REFUSED(kinemesh_mesh_write(NULL, "a.off"), "mesh is NULL");
  CHECK_REFUSED(kinemesh_mesh_write(mesh, NULL), "file is NULL");
  CHECK_REFUSED(kinemesh_mesh_get(NULL, NULL, NULL, NULL), "mesh is NULL");
  CHECK_REFUSED(kinemesh_mesh_add_marker(NULL, "a", 1, edges), "mesh is NULL");
  CHECK_REFUSED(kinemesh_mesh_add_marker(mesh, NULL, 1, edges), "name is NULL");
  CHECK_REFUSED(kinemesh_mesh_add_marker(mesh, "a", 1, NULL), "edges is NULL");
  CHECK_REFUSED(kinemesh_mesh_get_marker(NULL, 0, edges), "mesh is NULL");
  CHECK_REFUSED(kinemesh_mesh_get_marker(mesh, 0, NULL), "edges is NULL");
  CHECK_REFUSED(kinemesh_mesh_name_label(NULL, 0, "a"), "mesh is NULL");
  CHECK_REFUSED(kinemesh_mesh_name_label(mesh, 0, NULL), "name is NULL");
  CHECK_REFUSED(kinemesh_mesh_validate(NULL), "mesh is NULL");
  CHECK_REFUSED(kinemesh_mesh_untangle(NULL, NULL), "mesh is NULL");
  CHECK_REFUSED(kinemesh_max_safe_step(7, NULL, points, 8, triangles, &share, &face), "xy0 is NULL");
  CHECK_REFUSED(kinemesh_max_safe_step(7, points, NULL, 8, triangles, &share, &face), "xy1 is NULL");
  CHECK_REFUSED(kinemesh_max_safe_step(7, points, points, 8, NULL, &share, &face), "triangles is NULL");
  CHECK_REFUSED(kinemesh_max_safe_step(7, points, points, 8, triangles, NULL, &face), "share is NULL");
  CHECK_REFUSED(kinemesh_max_safe_step(7, points, points, 8, triangles, &share, NULL), "face is NULL");
  CHECK_REFUSED(kinemesh_set_default_options(NULL), "options is NULL");
  CHECK_REFUSED(kinemesh_stepper_create(NULL, NULL, &stepping), "mesh is NULL");
  CHECK_REFUSED(kinemesh_stepper_create(mesh, NULL, NULL), "stepper is NULL");
  CHECK_REFUSED(kinemesh_stepper_create_scenario(NULL, "", 0, &stepping), "mesh is NULL");
  CHECK_REFUSED(kinemesh_stepper_create_scenario(mesh, NULL, 0, &stepping), "scenario is NULL");
  CHECK_REFUSED(kinemesh_stepper_create_scenario(mesh, "", 0, NULL), "stepper is NULL");
  CHECK_REFUSED(kinemesh_stepper_step(NULL, points, 1, NULL), "stepper is NULL");
  CHECK_REFUSED(kinemesh_stepper_step(stepper, NULL, 1, NULL), "xy is NULL");
  CHECK_REFUSED(kinemesh_stepper_step_border(NULL, 1, edges, points, 1, NULL), "stepper is NULL");
  CHECK_REFUSED(kinemesh_stepper_step_border(stepper, 1, NULL, points, 1, NULL), "vertices is NULL");
  CHECK_REFUSED(kinemesh_stepper_step_border(stepper, 1, edges, NULL, 1, NULL), "xy is NULL");
  CHECK_REFUSED(kinemesh_stepper_advance(NULL, 1, NULL), "stepper is NULL");
  CHECK_REFUSED(kinemesh_stepper_repair(NULL, 1, NULL), "stepper is NULL");
  CHECK_REFUSED(kinemesh_stepper_get(NULL, NULL, NULL, NULL), "stepper is NULL");
  CHECK_REFUSED(kinemesh_stepper_mesh(NULL, &made), "stepper is NULL");
  CHECK_REFUSED(kinemesh_stepper_mesh(stepper, NULL), "mesh is NULL");
  CHECK_REFUSED(kinemesh_stepper_get_region(NULL, 0, NULL, NULL), "stepper is NULL");
  CHECK_REFUSED(kinemesh_stepper_observe(NULL, throws, NULL), "stepper is NULL");
  CHECK_REFUSED(kinemesh_stepper_observe(stepper, NULL, NULL), "observer is NULL");
  CHECK_REFUSED(kinemesh_remap_amounts(NULL, points, &share), "changes is NULL");
  CHECK_REFUSED(kinemesh_remap_averages(NULL, points, &share), "changes is NULL");
  CHECK_REFUSED(kinemesh_copy_nearest(NULL, points, &share), "changes is NULL");
  CHECK(made == NULL && stepping == NULL);
  CHECK(kinemesh_mesh_destroy(NULL) == KINEMESH_OK && kinemesh_stepper_destroy(NULL) == KINEMESH_OK);
}

/* Functions that return no status. */
static void returns_what_no_call_that_works_returns(void) {
  CHECK(kinemesh_mesh_n_vertices(NULL) == -1 && strstr(kinemesh_error(), "mesh is NULL"));
  CHECK(kinemesh_mesh_n_faces(NULL) == -1 && kinemesh_mesh_n_markers(NULL) == -1);
  CHECK(kinemesh_mesh_marker_name(NULL, 0) == NULL && kinemesh_mesh_marker_n_edges(NULL, 0) == -1);
  CHECK(kinemesh_mesh_label_name(NULL, 0) == NULL);
  CHECK(kinemesh_stepper_n_vertices(NULL) == -1 && strstr(kinemesh_error(), "stepper is NULL"));
  CHECK(kinemesh_stepper_n_faces(NULL) == -1 && kinemesh_stepper_positions(NULL) == NULL);
  CHECK(isnan(kinemesh_stepper_time(NULL)));
  CHECK(kinemesh_defect_name(0) == NULL && kinemesh_defect_name(16) == NULL);
  CHECK(strcmp(kinemesh_defect_name(KINEMESH_NON_FINITE_POSITION), "non-finite position") == 0);
  CHECK(strcmp(kinemesh_defect_name(KINEMESH_COVERAGE), "coverage") == 0);
  CHECK(kinemesh_strategy_name(-1) == NULL && kinemesh_quality_name(1000000) == NULL);
}

static void refuses_numbers_out_of_range(void) {
  const int32_t edges[] = {0, 7}, negative[] = {-1, 0}, all[] = {0, 1, 2, 3, 4, 5, 6, 0};
  double xy[2 * n_vertices], share;
  int32_t face, wrong[3 * n_faces];
  kinemesh_mesh* made = NULL;
  kinemesh_stepper* stepping = NULL;
  CHECK_REFUSED(kinemesh_mesh_create(-1, points, 8, triangles, NULL, &made), "n_vertices is -1");
  CHECK_REFUSED(kinemesh_mesh_create(7, points, -8, triangles, NULL, &made), "n_faces is -8");
  CHECK_REFUSED(kinemesh_mesh_add_marker(mesh, "a", -1, edges), "n_edges is -1");
  CHECK_REFUSED(kinemesh_mesh_add_marker(mesh, "a", 1, edges), "edges[1] is 7");
  CHECK_REFUSED(kinemesh_mesh_add_marker(mesh, "a", 1, negative), "edges[0] is -1");
  CHECK(kinemesh_mesh_n_markers(mesh) == 1);
  CHECK_REFUSED(kinemesh_mesh_get_marker(mesh, 1, wrong), "marker is 1, a number from 0 and below 1");
  CHECK(kinemesh_mesh_marker_name(mesh, -1) == NULL && strstr(kinemesh_error(), "marker is -1"));
  CHECK(kinemesh_mesh_marker_n_edges(mesh, 1) == -1);
  CHECK_REFUSED(kinemesh_stepper_get_region(stepper, 0, NULL, NULL), "number is 0");
  CHECK_REFUSED(kinemesh_stepper_step_border(stepper, -1, all, points, 1, NULL), "n is -1");
  CHECK_REFUSED(kinemesh_stepper_step_border(stepper, 8, all, points, 1, NULL), "n is 8, at most");
  CHECK_REFUSED(kinemesh_stepper_step(stepper, points, -1e-300, NULL), "dt is -1e-300");
  CHECK_REFUSED(kinemesh_stepper_repair(stepper, sqrt(-1.0), NULL), "dt is ");
  CHECK_REFUSED(kinemesh_stepper_step(stepper, points, HUGE_VAL, NULL), "dt is inf");
  CHECK_REFUSED(kinemesh_stepper_create_scenario(mesh, "[[body]]\non = 'marker:line'\n", -1, &stepping),
                "frame is -1");
  CHECK_REFUSED(kinemesh_stepper_create_scenario(mesh, "[[body]]\non = 'marker:line'\n", HUGE_VAL, &stepping),
                "frame is inf");
  memcpy(wrong, triangles, sizeof triangles);
  wrong[3] = -1;
  CHECK_REFUSED(kinemesh_max_safe_step(7, points, points, 8, wrong, &share, &face), "face 1");
  CHECK_REFUSED(kinemesh_max_safe_step(-7, points, points, 8, triangles, &share, &face), "n_vertices is -7");
  memcpy(xy, points, sizeof points);
  xy[3] = sqrt(-1.0);
  CHECK_REFUSED(kinemesh_max_safe_step(7, points, xy, 8, triangles, &share, &face), "vertex 1");
  CHECK(kinemesh_mesh_create(7, xy, 8, triangles, NULL, &made) == KINEMESH_BAD_INPUT && made == NULL);
  CHECK(kinemesh_culprits()->kind == KINEMESH_NON_FINITE_POSITION && kinemesh_culprits()->vertices[0] == 1);
  CHECK(kinemesh_mesh_create(0, NULL, 0, NULL, NULL, &made) == KINEMESH_OK); /* what a file cannot hold */
  CHECK(kinemesh_mesh_add_marker(made, "none", 0, NULL) == KINEMESH_OK);
  CHECK(kinemesh_mesh_get_marker(made, 0, NULL) == KINEMESH_OK);
  CHECK_REFUSED(kinemesh_mesh_validate(made), "no faces");
  CHECK_REFUSED(kinemesh_stepper_create(made, NULL, &stepping), "no faces");
  CHECK_REFUSED(kinemesh_mesh_untangle(mesh, "wishing"), "wishing");
  kinemesh_mesh_destroy(made);
  CHECK(kinemesh_max_safe_step(0, NULL, NULL, 0, NULL, &share, &face) == KINEMESH_OK);
  CHECK(share == 1 && face == -1);
  CHECK(kinemesh_stepper_step_border(stepper, 0, NULL, NULL, 0, NULL) == KINEMESH_OK);
}

/* Callers that were compiled with other versions, and those that forget. */
static void reads_options_of_every_size(void) {
  struct {
    kinemesh_options known;
    double unknown;
  } newer;
  kinemesh_options options = kinemesh_default_options();
  kinemesh_stepper* made = NULL;
  CHECK(options.size == sizeof options && strcmp(options.strategy, "global") == 0);
  CHECK(strcmp(options.quality, "none") == 0 && options.angle == 25 && options.frame == 0.25);
  CHECK(!options.allow_escaped && !options.retain && options.max_region_share == 0);

  options.size = 0;
  CHECK_REFUSED(kinemesh_stepper_create(mesh, &options, &made), "options->size is 0");
  options.size = offsetof(kinemesh_options, retain);
  CHECK_REFUSED(kinemesh_stepper_create(mesh, &options, &made), "sizeof *options");
  options.size = (size_t)-1;
  CHECK_REFUSED(kinemesh_stepper_create(mesh, &options, &made), "sizeof *options");
  CHECK_REFUSED(kinemesh_set_default_options(&options), "sizeof *options");

  options.max_region_share = -1; /* an older caller has something else there */
  options.size = offsetof(kinemesh_options, max_region_share);
  CHECK(kinemesh_set_default_options(&options) == KINEMESH_OK && options.max_region_share == -1);
  CHECK(kinemesh_stepper_create(mesh, &options, &made) == KINEMESH_OK);
  CHECK(kinemesh_stepper_destroy(made) == KINEMESH_OK);

  memset(&newer, 0, sizeof newer);
  newer.known.size = sizeof newer;
  CHECK(kinemesh_stepper_create(mesh, &newer.known, &made) == KINEMESH_OK);
  CHECK(kinemesh_stepper_destroy(made) == KINEMESH_OK);
  newer.unknown = 1;
  CHECK_REFUSED(kinemesh_stepper_create(mesh, &newer.known, &made), "does not know");
  CHECK(kinemesh_set_default_options(&newer.known) == KINEMESH_OK);
  CHECK(newer.known.size == sizeof newer.known && newer.unknown == 1);

  options = kinemesh_default_options();
  options.frame = sqrt(-1.0);
  CHECK_REFUSED(kinemesh_stepper_create(mesh, &options, &made), "options->frame is ");
  options = kinemesh_default_options();
  options.max_region_share = -0.5;
  CHECK_REFUSED(kinemesh_stepper_create(mesh, &options, &made), "options->max_region_share is -0.5");
  options.max_region_share = sqrt(-1.0);
  CHECK_REFUSED(kinemesh_stepper_create(mesh, &options, &made), "options->max_region_share is ");
  options = kinemesh_default_options();
  options.quality = "angles";
  options.angle = sqrt(-1.0);
  CHECK_REFUSED(kinemesh_stepper_create(mesh, &options, &made), "angle");
  options.quality = "perfect";
  CHECK_REFUSED(kinemesh_stepper_create(mesh, &options, &made), "perfect");
  CHECK(made == NULL);
}

static void writes_records(void) {
  kinemesh_step record;
  kinemesh_region region;
  double xy[2 * n_vertices];
  int32_t faces[n_faces];
  memcpy(xy, points, sizeof points);
  xy[13] = 0.5;
  memset(&record, 7, sizeof record); /* as a caller leaves it */
  CHECK(kinemesh_stepper_step(stepper, xy, 1, &record) == KINEMESH_OK);
  CHECK(record.inverted == 1 && record.degenerate == 0 && record.time == 1 && record.total_ms > 0);
  memset(&region, 7, sizeof region);
  CHECK(kinemesh_stepper_get_region(stepper, 0, &region, faces) == KINEMESH_OK);
  CHECK(region.n_faces == 6 && region.inverted == 1 && region.fallback == 0 && faces[0] == 0);
}

/* All that an observer may try with the stepper it observes. */
static int meddle(const kinemesh_changes* changes, void* user) {
  kinemesh_mesh* made = NULL;
  const int32_t corner[] = {0};
  CHECK(kinemesh_stepper_step(stepper, points, 1, NULL) == KINEMESH_BUSY);
  CHECK(strstr(kinemesh_error(), "stepper is in use"));
  CHECK(kinemesh_stepper_step_border(stepper, 1, corner, points, 1, NULL) == KINEMESH_BUSY);
  CHECK(kinemesh_stepper_advance(stepper, 1, NULL) == KINEMESH_BUSY);
  CHECK(kinemesh_stepper_repair(stepper, 1, NULL) == KINEMESH_BUSY);
  CHECK(kinemesh_stepper_get(stepper, NULL, NULL, NULL) == KINEMESH_BUSY);
  CHECK(kinemesh_stepper_mesh(stepper, &made) == KINEMESH_BUSY && made == NULL);
  CHECK(kinemesh_stepper_get_region(stepper, 0, NULL, NULL) == KINEMESH_BUSY);
  CHECK(kinemesh_stepper_observe(stepper, meddle, NULL) == KINEMESH_BUSY);
  CHECK(kinemesh_stepper_positions(stepper) == NULL && isnan(kinemesh_stepper_time(stepper)));
  CHECK(kinemesh_stepper_n_vertices(stepper) == -1 && kinemesh_stepper_n_faces(stepper) == -1);
  CHECK(kinemesh_stepper_destroy(stepper) == KINEMESH_BUSY);
  CHECK(kinemesh_mesh_n_faces(mesh) == n_faces); /* others are not in use */
  ++*(int*)user;
  return changes->step == 1 ? 0 : (int)kinemesh_stepper_destroy(stepper);
}

static void goes_on_when_an_observer_meddles(void) {
  double xy[2 * n_vertices];
  int32_t now[3 * n_faces], after[3 * n_faces];
  int calls = 0;
  memcpy(xy, points, sizeof points);
  xy[13] = 0.5;
  CHECK(kinemesh_stepper_observe(stepper, meddle, &calls) == KINEMESH_OK);
  CHECK(kinemesh_stepper_step(stepper, xy, 1, NULL) == KINEMESH_OK && calls == 1);
  CHECK(kinemesh_stepper_get(stepper, NULL, now, NULL) == KINEMESH_OK);
  CHECK(kinemesh_stepper_step(stepper, points, 1, NULL) == KINEMESH_VETOED && calls == 2);
  CHECK(strstr(kinemesh_error(), "returned 9 in step 2: stepper is in use"));
  CHECK(kinemesh_stepper_get(stepper, NULL, after, NULL) == KINEMESH_OK);
  CHECK(memcmp(now, after, sizeof now) == 0 && kinemesh_stepper_time(stepper) == 1);
}

static void takes_the_step_back_when_an_observer_throws(void) {
  double xy[2 * n_vertices], now[2 * n_vertices];
  int32_t faces[3 * n_faces], throw_what;
  memcpy(xy, points, sizeof points);
  xy[13] = 0.5;
  CHECK(kinemesh_stepper_observe(stepper, throws, &throw_what) == KINEMESH_OK);
  throw_what = THROW_EXCEPTION;
  CHECK(kinemesh_stepper_step(stepper, xy, 1, NULL) == KINEMESH_VETOED);
  CHECK(strcmp(kinemesh_error(), "an observer threw in step 1: the solver is out of breath") == 0);
  throw_what = THROW_NUMBER;
  CHECK(kinemesh_stepper_step(stepper, xy, 1, NULL) == KINEMESH_VETOED);
  CHECK(strcmp(kinemesh_error(), "an observer threw in step 1") == 0);
  CHECK(kinemesh_stepper_get(stepper, now, faces, NULL) == KINEMESH_OK);
  CHECK(memcmp(now, points, sizeof points) == 0 && memcmp(faces, triangles, sizeof triangles) == 0);
  throw_what = THROW_NOTHING;
  CHECK(kinemesh_stepper_step(stepper, xy, 1, NULL) == KINEMESH_OK && kinemesh_stepper_time(stepper) == 1);
}

/* The changes of a step gone by, to be handed over once more. */
static const kinemesh_changes* gone;
static kinemesh_changes copied;
static const double ones[n_faces] = {1, 1, 1, 1, 1, 1, 1, 1};

static int keep(const kinemesh_changes* changes, void* user) {
  double now[n_faces];
  CHECK_REFUSED(kinemesh_remap_amounts(&copied, ones, now), "changes are none");
  CHECK_REFUSED(kinemesh_remap_amounts(changes, NULL, now), "before is NULL");
  CHECK_REFUSED(kinemesh_remap_amounts(changes, ones, NULL), "after is NULL");
  CHECK(kinemesh_remap_amounts(changes, ones, now) == KINEMESH_OK);
  gone = changes, copied = *changes;
  return user != NULL;
}

static void refuses_changes_that_are_gone(void) {
  double xy[2 * n_vertices], now[n_faces];
  memcpy(xy, points, sizeof points);
  xy[13] = 0.5;
  CHECK(kinemesh_stepper_observe(stepper, keep, NULL) == KINEMESH_OK);
  CHECK(kinemesh_stepper_step(stepper, xy, 1, NULL) == KINEMESH_OK && gone != NULL);
  CHECK_REFUSED(kinemesh_remap_amounts(gone, ones, now), "changes are none");
  CHECK_REFUSED(kinemesh_remap_averages(gone, ones, now), "changes are none");
  CHECK_REFUSED(kinemesh_copy_nearest(&copied, ones, now), "changes are none");
}

typedef struct {
  const kinemesh_changes* changes;
  kinemesh_status remapped, stepped, destroyed;
} helper;

static void* help(void* of) {
  helper* h = of;
  double now[n_faces];
  h->remapped = kinemesh_remap_averages(h->changes, ones, now);
  h->stepped = kinemesh_stepper_step(stepper, points, 1, NULL);
  h->destroyed = kinemesh_stepper_destroy(stepper);
  return NULL;
}

/* Another thread, while the step is under way for sure. */
static int call_for_help(const kinemesh_changes* changes, void* user) {
  pthread_t thread;
  helper* h = user;
  h->changes = changes;
  CHECK(pthread_create(&thread, NULL, help, h) == 0 && pthread_join(thread, NULL) == 0);
  return 0;
}

static void sees_another_thread_come_in_between(void) {
  helper h = {NULL, KINEMESH_BUG, KINEMESH_BUG, KINEMESH_BUG};
  double xy[2 * n_vertices];
  memcpy(xy, points, sizeof points);
  xy[13] = 0.5;
  CHECK(kinemesh_stepper_observe(stepper, call_for_help, &h) == KINEMESH_OK);
  CHECK(kinemesh_stepper_step(stepper, xy, 1, NULL) == KINEMESH_OK);
  CHECK(h.remapped == KINEMESH_OK && h.stepped == KINEMESH_BUSY && h.destroyed == KINEMESH_BUSY);
  CHECK(kinemesh_stepper_time(stepper) == 1);
}

/* A mesh and a stepper for each. */
static void with_handles(void (*test)(void)) {
  const int32_t line[] = {0, 1};
  mesh = square();
  CHECK(kinemesh_mesh_add_marker(mesh, "line", 1, line) == KINEMESH_OK);
  stepper = stepper_on(square(), NULL);
  test();
  CHECK(kinemesh_mesh_validate(mesh) == KINEMESH_OK);
  CHECK(kinemesh_stepper_get(stepper, NULL, NULL, NULL) == KINEMESH_OK);
  CHECK(kinemesh_stepper_destroy(stepper) == KINEMESH_OK && kinemesh_mesh_destroy(mesh) == KINEMESH_OK);
}

int main(void) {
  with_handles(refuses_null);
  with_handles(returns_what_no_call_that_works_returns);
  with_handles(refuses_numbers_out_of_range);
  with_handles(reads_options_of_every_size);
  with_handles(writes_records);
  with_handles(goes_on_when_an_observer_meddles);
  with_handles(takes_the_step_back_when_an_observer_throws);
  with_handles(refuses_changes_that_are_gone);
  with_handles(sees_another_thread_come_in_between);
  return 0;
}
