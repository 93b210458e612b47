/* A user's program in C: a step that inverts a face, and the count of what replaced it. */
#include <kinemesh.h>
#include <stdio.h>

/* A triangle 4 5 6 inside a square. */
static double xy[] = {0, 0, 3, 0, 3, 3, 0, 3, 1, 1, 2, 1, 1.5, 2};
static const int32_t triangles[] = {4, 5, 6, 0, 1, 5, 0, 5, 4, 1, 2, 5, 2, 6, 5, 2, 3, 6, 3, 0, 4, 3, 4, 6};

int main(void) {
  kinemesh_mesh* mesh = NULL;
  kinemesh_stepper* stepper = NULL;
  kinemesh_step step;
  kinemesh_status status = kinemesh_mesh_create(7, xy, 8, triangles, NULL, &mesh);
  if (!status) status = kinemesh_stepper_create(mesh, NULL, &stepper);
  xy[13] = 0.5; /* vertex 6 through the edge 4 5 */
  if (!status) status = kinemesh_stepper_step(stepper, xy, 0.1, &step);
  if (status)
    printf("%s\n", kinemesh_error());
  else
    printf("kinemesh %s from C: %d inverted face, %d replaced\n", kinemesh_version(), step.inverted,
           step.replaced);
  kinemesh_stepper_destroy(stepper);
  kinemesh_mesh_destroy(mesh);
  return status;
}
