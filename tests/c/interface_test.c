/* The C interface as a C program meets it. Argument: a folder to write to. */
#include <kinemesh.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "square.h"

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
  CHECK(changes->size == sizeof *changes && !changes->vertex_map && !changes->face_map);
  CHECK(changes->n_vertices_before == n_vertices && changes->n_vertices_after == n_vertices);
  CHECK(changes->n_faces_before == n_faces && changes->n_faces_after == n_faces);
  for (p = 0; p < changes->n_patches && seen->answer == 0; ++p) {
    const kinemesh_faces *before = &changes->patches[p]->before, *after = &changes->patches[p]->after;
    const kinemesh_patch* patch = changes->patches[p];
    for (i = 0; i < before->n; ++i) {
      CHECK(memcmp(seen->faces + 3 * before->faces[i], before->triangles + 3 * i, sizeof(int32_t) * 3) == 0);
      CHECK(area(changes->xy_before, before->triangles + 3 * i) > 0 && before->labels[i] == 0);
    }
    for (i = 0; i < after->n; ++i) {
      memcpy(seen->faces + 3 * after->faces[i], after->triangles + 3 * i, sizeof(int32_t) * 3);
      CHECK(area(changes->xy_after, after->triangles + 3 * i) > 0 && after->labels[i] == 0);
    }
    CHECK(patch->n_vertices > 3 && patch->vertices[0] >= 0);
    ++seen->patches;
  }
  return seen->answer;
}

static void takes_steps_and_tells_of_them(void) {
  kinemesh_stepper* stepper = stepper_on(square(), NULL);
  double xy[2 * n_vertices], *own;
  int32_t now[3 * n_faces], n;
  kinemesh_step record;
  observed seen = {{0}, 0, 0, 0};
  memcpy(seen.faces, triangles, sizeof triangles);
  memcpy(xy, points, sizeof points);
  CHECK(kinemesh_stepper_observe(stepper, watch, &seen) == KINEMESH_OK);

  xy[13] = 0.5; /* vertex 6 through the edge 4 5 */
  CHECK(kinemesh_stepper_step(stepper, xy, 0.25, &record) == KINEMESH_OK);
  CHECK(record.step == 1 && record.time == 0.25 && record.dt == 0.25 && record.faces == n_faces);
  CHECK(record.inverted == 1 && record.regions == 1 && record.replaced == 6 && record.degenerate == 0);
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

  for (n = 0; n < 100; ++n) { /* the naive sum is off by more than its last bit */
    CHECK(kinemesh_stepper_repair(stepper, 0.1, &record) == KINEMESH_OK && record.dt == 0.1);
  }
  CHECK(kinemesh_stepper_time(stepper) == 10.5);
  CHECK(kinemesh_stepper_repair(stepper, -1e-300, NULL) == KINEMESH_BAD_INPUT);
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

/* Around a hole of radius 1, up to radius 3: rings of vertices, those of the hole first; markers hole and
 * rim. */
enum { around = 16, rings = 5, n_ring = around * rings, n_ring_faces = 2 * around * (rings - 1) };

static kinemesh_mesh* ring(void) {
  const double pi = acos(-1.0);
  double xy[2 * n_ring];
  int32_t faces[3 * n_ring_faces], hole[2 * around], rim[2 * around], i, k, *f = faces;
  kinemesh_mesh* mesh = NULL;
  for (k = 0; k < rings; ++k) {
    for (i = 0; i < around; ++i) {
      const int32_t next = (i + 1) % around, a = k * around + i, b = k * around + next;
      xy[2 * a] = (1 + 0.5 * k) * cos(2 * pi * i / around);
      xy[2 * a + 1] = (1 + 0.5 * k) * sin(2 * pi * i / around);
      if (k + 1 < rings) {
        *f++ = a, *f++ = a + around, *f++ = b + around;
        *f++ = a, *f++ = b + around, *f++ = b;
      }
      hole[2 * i] = i, hole[2 * i + 1] = next;
      rim[2 * i] = (rings - 1) * around + i, rim[2 * i + 1] = (rings - 1) * around + next;
    }
  }
  CHECK(kinemesh_mesh_create(n_ring, xy, n_ring_faces, faces, NULL, &mesh) == KINEMESH_OK);
  CHECK(kinemesh_mesh_add_marker(mesh, "hole", around, hole) == KINEMESH_OK);
  CHECK(kinemesh_mesh_add_marker(mesh, "rim", around, rim) == KINEMESH_OK);
  return mesh;
}

static const char turning_hole[] =
    "[[body]]\n"
    "on = 'marker:hole'\n"
    "motion = [{ field = 'rigid', x = 't', y = '0.5 * t^2', angle = '3 * t' }]\n"
    "[border]\n"
    "rim = 'fixed'\n";

static kinemesh_stepper* stepper_of(const char* scenario) {
  kinemesh_mesh* mesh = ring();
  kinemesh_stepper* stepper = NULL;
  CHECK(kinemesh_stepper_create_scenario(mesh, scenario, 0.25, &stepper) == KINEMESH_OK);
  kinemesh_mesh_destroy(mesh);
  return stepper;
}

static int is_about(double a, double b) {
  return fabs(a - b) < 1e-14;
}

/* Vertices of the hole are a body's, and not moved for their angles. */
static int count_moved(const kinemesh_changes* changes, void* user) {
  int32_t i, v;
  for (i = 0; i < changes->n_moved; ++i) {
    v = changes->moved[i];
    CHECK(v >= around && v < n_ring);
    CHECK(memcmp(changes->xy_moved + 2 * i, changes->xy_after + 2 * v, 2 * sizeof(double)) != 0);
  }
  *(int32_t*)user = changes->n_moved;
  return 0;
}

static void moves_bodies_exactly_and_the_interior_follows(void) {
  kinemesh_mesh* mesh = ring();
  kinemesh_stepper *stepper = stepper_of(turning_hole), *halved = stepper_of(turning_hole);
  kinemesh_step record;
  double start[2 * n_ring], xy[2 * n_ring], half[2 * n_ring];
  int32_t faces[3 * n_ring_faces], n, i, moved = 0, moves = 0;
  CHECK(kinemesh_stepper_observe(stepper, count_moved, &moved) == KINEMESH_OK);
  kinemesh_mesh_get(mesh, start, NULL, NULL);
  for (n = 1; n <= 10; ++n) {
    const double t = n * 0.1, c = cos(3 * t), s = sin(3 * t);
    CHECK(kinemesh_stepper_advance(stepper, 0.1, &record) == KINEMESH_OK);
    CHECK(record.step == n && record.time == t && kinemesh_stepper_time(stepper) == t);
    CHECK(record.min_angle_deg > 5 && record.min_area > 0);
    CHECK(record.quality_moves >= moved && (record.quality_moves > 0) == (moved > 0));
    moves += moved;
    CHECK(kinemesh_stepper_advance(halved, 0.05, NULL) == KINEMESH_OK);
    CHECK(kinemesh_stepper_advance(halved, 0.05, NULL) == KINEMESH_OK);
    CHECK(kinemesh_stepper_time(halved) == t);
    CHECK(kinemesh_stepper_get(stepper, xy, faces, NULL) == KINEMESH_OK);
    CHECK(kinemesh_stepper_get(halved, half, NULL, NULL) == KINEMESH_OK);
    CHECK(memcmp(xy, half, sizeof *xy * 2 * around) == 0); /* the body, bit for bit */
    for (i = 0; i < around; ++i) {
      CHECK(is_about(xy[2 * i], c * start[2 * i] - s * start[2 * i + 1] + t));
      CHECK(is_about(xy[2 * i + 1], s * start[2 * i] + c * start[2 * i + 1] + 0.5 * t * t));
    }
    i = 2 * around * (rings - 1); /* the rim */
    CHECK(memcmp(xy + i, start + i, sizeof *xy * 2 * around) == 0);
    for (i = 0; i < n_ring_faces; ++i) CHECK(area(xy, faces + 3 * i) > 0);
  }
  CHECK(moves > 0);
  kinemesh_mesh_destroy(mesh);
  kinemesh_stepper_destroy(stepper);
  kinemesh_stepper_destroy(halved);
}

/* A body, and a border that somebody else moves between its steps. */
static void takes_other_steps_between(void) {
  kinemesh_stepper* stepper =
      stepper_of("[[body]]\non = 'marker:hole'\nmotion = [{ field = 'rigid', y = 't' }]\n");
  const int32_t vertex[] = {0};
  const double there[] = {1.125, 0.125};
  double xy[2 * n_ring];
  CHECK(kinemesh_stepper_step_border(stepper, 1, vertex, there, 0, NULL) == KINEMESH_OK);
  CHECK(kinemesh_stepper_get(stepper, xy, NULL, NULL) == KINEMESH_OK);
  CHECK(xy[0] == 1.125 && xy[1] == 0.125);
  CHECK(kinemesh_stepper_advance(stepper, 0.25, NULL) == KINEMESH_OK);
  CHECK(kinemesh_stepper_get(stepper, xy, NULL, NULL) == KINEMESH_OK);
  CHECK(xy[0] == 1 && xy[1] == 0.25);
  kinemesh_stepper_destroy(stepper);
}

static void refuses_scenarios_with_the_line_and_the_key(void) {
  static const struct {
    const char *text, *told;
  } bad[] = {
      {"", "at least one [[body]] or [[motion]] expected"},
      {"[[body]]\nmotion = []\n", "scenario:1: [[body]]: on expected"},
      {"[[body]]\non = 'marker:hol'\n", "scenario:2: no marker 'hol' in the mesh, did you mean 'hole'?"},
      {"[[body]]\non = 'marker:hole'\nmove = []\n", "scenario:3: unknown key 'move' in [[body]]"},
      {"[[body]]\non = 'marker:hole'\nmotion = [{ field = 'rigid', x = 'sin(' }]\n", "scenario:3: "},
      {"[[body]]\non = 'marker:hole'\nmotion = [{ field = 'rigid', file = 'none.csv' }]\n", "none.csv"},
      {"[[body]]\non = 'marker:hole'\n[border]\nhole = 'fixed'\n", "scenario:4: the marker 'hole'"},
      {"[[body]]\non = 'marker:hole'\n[interior]\nfollow = 'me'\n", "scenario:4: follow: unknown: 'me'"},
      {"[[body]]\non = 'marker:hole'\n[repair]\nangle = 90\n", "scenario:4: angle: degrees below 60"},
      {"[[body]]\non = 'marker:hole'\n[mesh]\nshape = 'disk'\n", "scenario:3: mesh: "},
      {"[[body]]\non = 'marker:hole'\n[time]\ndt = 1\n", "scenario:3: time: "},
      {"[[body]]\non = 'marker:hole'\n[output]\nevery = 1\n", "scenario:3: output: "},
      {"[[body]]\non = 'marker:hole'\n[borders]\n", "scenario:3: unknown key 'borders'"},
      {"[[body]\n", "scenario:1: "},
  };
  kinemesh_mesh* mesh = ring();
  kinemesh_stepper* stepper = NULL;
  size_t i;
  for (i = 0; i < sizeof bad / sizeof *bad; ++i) {
    CHECK(kinemesh_stepper_create_scenario(mesh, bad[i].text, 0.25, &stepper) == KINEMESH_BAD_INPUT);
    CHECK(stepper == NULL && strstr(kinemesh_error(), bad[i].told) && !strchr(kinemesh_error(), '\n'));
  }
  CHECK(kinemesh_stepper_create_scenario(mesh, NULL, 0.25, &stepper) == KINEMESH_BAD_INPUT);
  CHECK(kinemesh_stepper_create_scenario(NULL, turning_hole, 0.25, &stepper) == KINEMESH_BAD_INPUT);
  CHECK(kinemesh_stepper_create_scenario(mesh, turning_hole, 0.25, NULL) == KINEMESH_BAD_INPUT);
  CHECK(kinemesh_stepper_create_scenario(mesh, turning_hole, -1, &stepper) == KINEMESH_BAD_INPUT);
  kinemesh_mesh_destroy(mesh);
}

/* The body runs into the rim, has no place, or nothing moves at all. */
static void leaves_everything_as_it_was_when_bodies_cannot_move(void) {
  static const struct {
    const char *path, *told;
    kinemesh_status status;
  } cases[] = {{"9 * t", "crosses", KINEMESH_NO_VALID_MESH},
               {"t < 0.25 ? t : sqrt(-1)", "body marker:hole", KINEMESH_BAD_INPUT}};
  kinemesh_stepper* stepper;
  double before[2 * n_ring], xy[2 * n_ring];
  int32_t faces[3 * n_ring_faces], now[3 * n_ring_faces];
  char text[200];
  size_t i;
  for (i = 0; i < 2; ++i) {
    sprintf(text, "[[body]]\non = 'marker:hole'\nmotion = [{ field = 'rigid', x = '%s' }]\n", cases[i].path);
    stepper = stepper_of(text);
    CHECK(kinemesh_stepper_advance(stepper, 0.1, NULL) == KINEMESH_OK);
    CHECK(kinemesh_stepper_get(stepper, before, faces, NULL) == KINEMESH_OK);
    CHECK(kinemesh_stepper_advance(stepper, 0.3, NULL) == cases[i].status);
    CHECK(strstr(kinemesh_error(), cases[i].told));
    CHECK(kinemesh_stepper_advance(stepper, -0.1, NULL) == KINEMESH_BAD_INPUT);
    CHECK(kinemesh_stepper_get(stepper, xy, now, NULL) == KINEMESH_OK);
    CHECK(memcmp(xy, before, sizeof xy) == 0 && memcmp(now, faces, sizeof now) == 0);
    CHECK(kinemesh_stepper_time(stepper) == 0.1);
    CHECK(kinemesh_stepper_advance(stepper, 0.05, NULL) == KINEMESH_OK);
    kinemesh_stepper_destroy(stepper);
  }
  stepper = stepper_on(ring(), NULL);
  CHECK(kinemesh_stepper_advance(stepper, 0.1, NULL) == KINEMESH_BAD_INPUT);
  CHECK(strstr(kinemesh_error(), "kinemesh_stepper_create_scenario"));
  CHECK(kinemesh_stepper_advance(NULL, 0.1, NULL) == KINEMESH_BAD_INPUT);
  kinemesh_stepper_destroy(stepper);
}

static void check_culprits(int32_t kind, int32_t culprit_vertices, int32_t culprit_faces) {
  const kinemesh_defect* culprits = kinemesh_culprits();
  CHECK(culprits->size == sizeof *culprits && culprits->kind == kind);
  CHECK(culprits->n_vertices == culprit_vertices && culprits->n_faces == culprit_faces);
}

/* A bow tie: no faces on these vertices are a mesh. */
static void tells_not_valid_from_impossible(void) {
  double crossed[2 * n_vertices];
  kinemesh_mesh* mesh = NULL;
  memcpy(crossed, points, sizeof points);
  crossed[2] = 3, crossed[3] = 3.5; /* 0-1 across 2-3 */
  crossed[4] = 3, crossed[5] = 0;
  crossed[6] = 0, crossed[7] = 2.75;
  CHECK(kinemesh_mesh_create(n_vertices, crossed, n_faces, triangles, NULL, &mesh) == KINEMESH_OK);
  CHECK(kinemesh_mesh_validate(mesh) == KINEMESH_NO_VALID_MESH);
  CHECK(kinemesh_culprits()->kind == KINEMESH_CROSSING_EDGES && kinemesh_culprits()->n_edges == 2);
  CHECK(strstr(kinemesh_error(), "crosses"));
  kinemesh_mesh_destroy(mesh);
}

static void refuses_steps_that_replace_too_much(void) {
  kinemesh_options options = kinemesh_default_options();
  kinemesh_step record;
  kinemesh_stepper* stepper = stepper_on(square(), NULL);
  double xy[2 * n_vertices], now[2 * n_vertices], share;
  memcpy(xy, points, sizeof points);
  xy[13] = 0.5;
  CHECK(kinemesh_stepper_step(stepper, xy, 1, &record) == KINEMESH_OK);
  share = record.region_share;
  CHECK(share > 0 && share < 1 && record.region_faces >= record.replaced);
  kinemesh_stepper_destroy(stepper);

  options.max_region_share = share; /* is still allowed */
  stepper = stepper_on(square(), &options);
  CHECK(kinemesh_stepper_step(stepper, xy, 1, NULL) == KINEMESH_OK);
  kinemesh_stepper_destroy(stepper);

  options.max_region_share = 0.99 * share;
  stepper = stepper_on(square(), &options);
  CHECK(kinemesh_stepper_step(stepper, xy, 1, NULL) == KINEMESH_REGIONS_TOO_LARGE);
  CHECK(strstr(kinemesh_error(), "max_region_share"));
  check_culprits(KINEMESH_NO_DEFECT, 0, 0);
  CHECK(kinemesh_stepper_get(stepper, now, NULL, NULL) == KINEMESH_OK);
  CHECK(memcmp(now, points, sizeof points) == 0 && kinemesh_stepper_time(stepper) == 0);
  check_upright(stepper);
  kinemesh_stepper_destroy(stepper);

  options.max_region_share = HUGE_VAL; /* none, as 0 is */
  kinemesh_stepper_destroy(stepper_on(square(), &options));
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
  check_culprits(KINEMESH_COINCIDENT_VERTICES, 2, 0);
  CHECK(kinemesh_culprits()->vertices[0] + kinemesh_culprits()->vertices[1] == 5 + 6);
  CHECK(kinemesh_culprits()->where[0] == 2 && kinemesh_culprits()->where[1] == 1);
  own[12] = own[10], own[13] = own[11];
  CHECK(kinemesh_stepper_repair(stepper, 0.25, NULL) == KINEMESH_NO_VALID_MESH);
  CHECK(memcmp(own, points, sizeof points) == 0);
  CHECK(kinemesh_stepper_step(stepper, xy, -1, NULL) == KINEMESH_BAD_INPUT);
  check_culprits(KINEMESH_NO_DEFECT, 0, 0);
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

/* The triangle 4 5 6 turned inside out, its sides to be kept: no edge may flip, no vertex move, but there is
 * a mesh. */
static kinemesh_mesh* square_with_lines(const double* xy) {
  static const int32_t lines[] = {4, 5, 5, 6, 6, 4};
  kinemesh_mesh* mesh = NULL;
  CHECK(kinemesh_mesh_create(n_vertices, xy, n_faces, triangles, NULL, &mesh) == KINEMESH_OK);
  CHECK(kinemesh_mesh_add_marker(mesh, "line", 3, lines) == KINEMESH_OK);
  return mesh;
}

static void tells_stuck_from_impossible(void) {
  static const char* const strategies[] = {"flips", "optimize"};
  kinemesh_options options = kinemesh_default_options();
  kinemesh_mesh* mesh;
  kinemesh_stepper* stepper;
  double turned[2 * n_vertices], xy[2 * n_vertices], nowhere[2 * n_vertices];
  int i;
  memcpy(turned, points, sizeof points);
  turned[13] = 0.5;
  for (i = 0; i < 2; ++i) {
    mesh = square_with_lines(turned);
    CHECK(kinemesh_mesh_untangle(mesh, strategies[i]) == KINEMESH_STUCK);
    CHECK(strstr(kinemesh_error(), "stuck"));
    CHECK(kinemesh_mesh_untangle(mesh, "global") == KINEMESH_OK);
    kinemesh_mesh_destroy(mesh);

    options.strategy = strategies[i];
    stepper = stepper_on(square_with_lines(points), &options);
    CHECK(kinemesh_stepper_step(stepper, turned, 1, NULL) == KINEMESH_STUCK);
    CHECK(strstr(kinemesh_error(), "stuck"));
    CHECK(kinemesh_stepper_get(stepper, xy, NULL, NULL) == KINEMESH_OK);
    CHECK(memcmp(xy, points, sizeof points) == 0 && kinemesh_stepper_time(stepper) == 0);
    kinemesh_stepper_destroy(stepper);
  }

  stepper = stepper_on(square(), NULL);
  memcpy(nowhere, points, sizeof points);
  nowhere[12] = sqrt(-1.0);
  CHECK(kinemesh_stepper_step(stepper, nowhere, 1, NULL) == KINEMESH_BAD_INPUT);
  CHECK(strstr(kinemesh_error(), "vertex 6"));
  nowhere[12] = HUGE_VAL;
  CHECK(kinemesh_stepper_step(stepper, nowhere, 1, NULL) == KINEMESH_BAD_INPUT);
  check_upright(stepper);
  kinemesh_stepper_destroy(stepper);
}

/* Before the arrays are looked at. */
static void refuses_more_than_numbers_go(void) {
  kinemesh_mesh* mesh = NULL;
  const int32_t most = (1 << 28) - 1;
  CHECK(kinemesh_mesh_create(n_vertices, points, most + 1, triangles, NULL, &mesh) == KINEMESH_BAD_INPUT);
  CHECK(strstr(kinemesh_error(), "268435455") && mesh == NULL);
  CHECK(kinemesh_mesh_create(INT32_MAX, points, n_faces, triangles, NULL, &mesh) == KINEMESH_BAD_INPUT);
  CHECK(strstr(kinemesh_error(), "268435455") && mesh == NULL);
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
  CHECK(kinemesh_mesh_validate(mesh) == KINEMESH_NOT_VALID);
  CHECK(strstr(kinemesh_error(), kinemesh_culprits()->kind == KINEMESH_FLAT_FACE ? "no area" : "inverted"));
  check_culprits(KINEMESH_INVERTED_FACE, 3, 1);
  CHECK(area(tangled, triangles + 3 * kinemesh_culprits()->faces[0]) < 0);
  CHECK(kinemesh_mesh_untangle(mesh, NULL) == KINEMESH_OK);
  CHECK(kinemesh_mesh_validate(mesh) == KINEMESH_OK);
  stepper = stepper_on(mesh, NULL);
  check_upright(stepper);
  kinemesh_stepper_destroy(stepper);
}

/* The one marker: 0-1 and 4-5, and 5-6 added; a file may turn edges round and sort them. */
static void check_line(const kinemesh_mesh* mesh) {
  static const int32_t line[] = {0, 1, 4, 5, 5, 6};
  int32_t edges[6], i, k, found = 0;
  CHECK(kinemesh_mesh_n_markers(mesh) == 1 && strcmp(kinemesh_mesh_marker_name(mesh, 0), "line") == 0);
  CHECK(kinemesh_mesh_marker_n_edges(mesh, 0) == 3);
  CHECK(kinemesh_mesh_get_marker(mesh, 0, edges) == KINEMESH_OK);
  for (i = 0; i < 6; i += 2)
    for (k = 0; k < 6; k += 2)
      found += (edges[i] == line[k] && edges[i + 1] == line[k + 1]) ||
               (edges[i] == line[k + 1] && edges[i + 1] == line[k]);
  CHECK(found == 3);
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
  CHECK(kinemesh_mesh_name_label(mesh, 1, "lower") == KINEMESH_OK);
  check_line(mesh);
  options.quality = "delaunay";
  stepper = stepper_on(mesh, &options);
  CHECK(kinemesh_stepper_mesh(stepper, &copy) == KINEMESH_OK);
  sprintf(file, "%.4000s/labels.msh", folder);
  CHECK(kinemesh_mesh_write(copy, file) == KINEMESH_OK);
  kinemesh_mesh_destroy(copy);
  CHECK(kinemesh_mesh_read(file, &copy) == KINEMESH_OK);
  CHECK(kinemesh_mesh_n_faces(copy) == n_faces && kinemesh_mesh_n_vertices(copy) == n_vertices);
  CHECK(kinemesh_mesh_get(copy, NULL, NULL, back) == KINEMESH_OK);
  CHECK(memcmp(back, labels, sizeof back) == 0);
  check_line(copy);
  CHECK(strcmp(kinemesh_mesh_label_name(copy, 1), "lower") == 0 && !*kinemesh_mesh_label_name(copy, 2));
  sprintf(file, "%.4000s/drawing.svg", folder);
  CHECK(kinemesh_mesh_write(copy, file) == KINEMESH_OK);
  CHECK(kinemesh_mesh_write(copy, "mesh.unheard-of") == KINEMESH_BAD_INPUT);
  kinemesh_mesh_destroy(copy);
  kinemesh_stepper_destroy(stepper);
}

int main(int argc, char** argv) {
  CHECK(argc == 2);
  CHECK(strlen(kinemesh_version()) > 4);
  takes_steps_and_tells_of_them();
  moves_a_border_and_what_is_inside_follows();
  moves_bodies_exactly_and_the_interior_follows();
  takes_other_steps_between();
  refuses_scenarios_with_the_line_and_the_key();
  leaves_everything_as_it_was_when_bodies_cannot_move();
  leaves_everything_as_it_was_when_it_fails();
  tells_not_valid_from_impossible();
  refuses_steps_that_replace_too_much();
  tells_stuck_from_impossible();
  refuses_more_than_numbers_go();
  refuses_what_is_no_mesh();
  keeps_markers_and_labels(argv[1]);
  return 0;
}
