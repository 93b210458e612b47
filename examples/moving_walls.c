/* From C: a wall that a solver moves, and one that moves as a text says; the mesh between follows, and so do
 * values of its faces. */
#include <kinemesh.h>
#include <math.h>
#include <stdio.h>

enum { n = 20, n_vertices = (n + 1) * (n + 1), n_faces = 2 * n * n };

/* The unit square; markers bottom, right and top. */
static kinemesh_status make_square(kinemesh_mesh** mesh) {
  static double xy[2 * n_vertices];
  static int32_t faces[3 * n_faces], bottom[2 * n], right[2 * n], top[2 * n];
  int32_t i, j, *f = faces;
  kinemesh_status status;
  for (j = 0; j <= n; ++j)
    for (i = 0; i <= n; ++i) {
      const int32_t a = j * (n + 1) + i;
      xy[2 * a] = (double)i / n, xy[2 * a + 1] = (double)j / n;
      if (i == n || j == n) continue;
      *f++ = a, *f++ = a + 1, *f++ = a + n + 2;
      *f++ = a, *f++ = a + n + 2, *f++ = a + n + 1;
    }
  for (i = 0; i < 2 * n; ++i) {
    const int32_t k = (i + 1) / 2;
    bottom[i] = k, right[i] = k * (n + 1) + n, top[i] = n * (n + 1) + k;
  }
  status = kinemesh_mesh_create(n_vertices, xy, n_faces, faces, NULL, mesh);
  if (!status) status = kinemesh_mesh_add_marker(*mesh, "bottom", n, bottom);
  if (!status) status = kinemesh_mesh_add_marker(*mesh, "right", n, right);
  if (!status) status = kinemesh_mesh_add_marker(*mesh, "top", n, top);
  return status;
}

/* What each face holds; in place, as nothing else can refuse the step afterwards. */
static int carry(const kinemesh_changes* changes, void* mass) {
  return kinemesh_remap_amounts(changes, mass, mass);
}

/* The bottom swings like a membrane. */
static kinemesh_status swing(kinemesh_stepper* stepper, kinemesh_step* step) {
  const double pi = acos(-1.0), dt = 0.05;
  int32_t wall[n + 1], i;
  double to[2 * (n + 1)];
  kinemesh_status status = KINEMESH_OK;
  while (!status && kinemesh_stepper_time(stepper) < 2.0) {
    const double t = kinemesh_stepper_time(stepper) + dt;
    for (i = 0; i <= n; ++i) {
      wall[i] = i; /* the vertex's number */
      to[2 * i] = (double)i / n;
      to[2 * i + 1] = 0.4 * sin(pi * t) * sin(pi * i / n);
    }
    status = kinemesh_stepper_step_border(stepper, n + 1, wall, to, dt, step);
  }
  return status;
}

static const char piston[] =
    "[[body]]\n"
    "on = 'marker:right'\n"
    "motion = [{ field = 'rigid', x = '-0.8 * sin(t)' }]\n"
    "[border]\n"
    "bottom = 'slide'\n"
    "top = 'slide'\n";

static kinemesh_status push(kinemesh_stepper* stepper, kinemesh_step* step) {
  kinemesh_status status = KINEMESH_OK;
  while (!status && kinemesh_stepper_time(stepper) < 2.0)
    status = kinemesh_stepper_advance(stepper, 0.05, step);
  return status;
}

int main(void) {
  kinemesh_mesh* mesh = NULL;
  kinemesh_stepper *swinging = NULL, *pushed = NULL;
  kinemesh_step step;
  kinemesh_options options = kinemesh_default_options();
  kinemesh_status status = make_square(&mesh);
  double mass[n_faces], sum = 0.0;
  int32_t f;
  for (f = 0; f < n_faces; ++f) mass[f] = 1.0 / n_faces;
  options.quality = "angles";
  options.max_region_share = 0.5;
  if (!status) status = kinemesh_stepper_create(mesh, &options, &swinging);
  if (!status) status = kinemesh_stepper_observe(swinging, carry, mass);
  if (!status) status = swing(swinging, &step);
  for (f = 0; f < n_faces; ++f) sum += mass[f];
  if (!status) printf("%d steps, smallest angle %.1f, mass %.6f\n", step.step, step.min_angle_deg, sum);
  if (!status) status = kinemesh_stepper_create_scenario(mesh, piston, 0.25, &pushed);
  if (!status) status = push(pushed, &step);
  if (!status) printf("%d steps, smallest angle %.1f\n", step.step, step.min_angle_deg);
  if (status) printf("%s\n", kinemesh_error()); /* and the mesh is as it was before the step */
  kinemesh_stepper_destroy(swinging);
  kinemesh_stepper_destroy(pushed);
  kinemesh_mesh_destroy(mesh);
  return status;
}
