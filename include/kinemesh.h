/* kinemesh from C, and from whatever can call C: planar triangle meshes whose vertices move and that stay
 * valid. docs/embedding.md shows a working loop; this is C99.
 *
 * Numbers of vertices and faces are the caller's: the order of the arrays a mesh was made from, from 0.
 * Coordinates are x0 y0 x1 y1 ..., triangles three vertices each, counter-clockwise.
 *
 * Functions that can fail return a kinemesh_status and leave everything as it was unless it is KINEMESH_OK;
 * kinemesh_error() then tells what, where, and what was expected. No exception crosses this interface. A
 * handle may be used by one thread at a time, different handles by different threads. Pointers must not be
 * NULL unless it says so. */
#ifndef KINEMESH_H
#define KINEMESH_H

#include <stdint.h>

#if defined(__GNUC__)
#define KINEMESH_API __attribute__((visibility("default")))
#else
#define KINEMESH_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef enum kinemesh_status {
  KINEMESH_OK = 0,
  KINEMESH_NO_VALID_MESH = 1, /* the domain has none with these positions: borders cross, vertices coincide */
  KINEMESH_BAD_INPUT = 2,     /* the caller's mistake, or a file's; positions that are not finite, too */
  KINEMESH_OUT_OF_MEMORY = 3,
  KINEMESH_VETOED = 4,       /* an observer returned something else than 0 */
  KINEMESH_BUG = 5,          /* a mistake of kinemesh; please report it with its message */
  KINEMESH_NO_RESOURCES = 6, /* a full disk, a limit of files or of their size, a device that fails */
  KINEMESH_STUCK = 7         /* "flips", "optimize" do not get on: another strategy may find a mesh */
} kinemesh_status;

/* What went wrong in the last call of this thread that failed, in one line; never NULL. Valid until the next
 * that fails. */
KINEMESH_API const char* kinemesh_error(void);

/* As "0.1.0". */
KINEMESH_API const char* kinemesh_version(void);

/* ---- Meshes as plain arrays -------------------------------------------------------------------------- */

typedef struct kinemesh_mesh kinemesh_mesh;

/* Copies the arrays. labels: one per triangle, or NULL for all 0. Winding is made consistent, and parts that
 * are clockwise on the whole are turned over, which swaps the last two corners of their faces. The mesh may
 * be tangled. */
KINEMESH_API kinemesh_status kinemesh_mesh_create(int32_t n_vertices, const double* xy, int32_t n_faces,
                                                  const int32_t* triangles, const int32_t* labels,
                                                  kinemesh_mesh** mesh);

/* By the file's extension: .off .obj .ply .su2 .msh .vtu. */
KINEMESH_API kinemesh_status kinemesh_mesh_read(const char* file, kinemesh_mesh** mesh);
KINEMESH_API kinemesh_status kinemesh_mesh_write(const kinemesh_mesh* mesh, const char* file);

/* Edges, two vertices each, that are to stay edges of the mesh whatever happens; on the border or inside.
 * More edges of a name that is there already are added to it. */
KINEMESH_API kinemesh_status kinemesh_mesh_add_marker(kinemesh_mesh* mesh, const char* name, int32_t n_edges,
                                                      const int32_t* edges);

/* Makes the inverted and flat faces upright, vertices staying where they are. strategy: NULL for "global". */
KINEMESH_API kinemesh_status kinemesh_mesh_untangle(kinemesh_mesh* mesh, const char* strategy);

KINEMESH_API int32_t kinemesh_mesh_n_vertices(const kinemesh_mesh* mesh);
KINEMESH_API int32_t kinemesh_mesh_n_faces(const kinemesh_mesh* mesh);

/* Copies to the caller's arrays of 2 n_vertices, 3 n_faces and n_faces; each may be NULL. */
KINEMESH_API void kinemesh_mesh_get(const kinemesh_mesh* mesh, double* xy, int32_t* triangles,
                                    int32_t* labels);

KINEMESH_API void kinemesh_mesh_destroy(kinemesh_mesh* mesh); /* NULL is fine */

/* ---- The stepper ------------------------------------------------------------------------------------- */

typedef struct kinemesh_stepper kinemesh_stepper;

typedef struct kinemesh_options {
  const char* strategy; /* how a tangled mesh is repaired; NULL: "global" */
  const char*
      quality;  /* what is done for the shape of the faces after it: "none", "delaunay", "smooth", "angles" */
  double angle; /* degrees, above 0 and below 60: what "angles" keeps angles above, where it can */
  double frame; /* margin of padding around the domain, in diagonals of its bounding box; 0: its convex hull
                   must not move */
  int32_t allow_escaped; /* not 0: vertices may end on the wrong side of a border or interface */
  int32_t retain;        /* not 0: keep upright faces of a region that need not be replaced */
} kinemesh_options;

/* global, none, 25 degrees, frame 0.25, 0, 0. */
KINEMESH_API kinemesh_options kinemesh_default_options(void);

/* The mesh is copied; it has to be valid (kinemesh_mesh_untangle). options: NULL for the default ones. */
KINEMESH_API kinemesh_status kinemesh_stepper_create(const kinemesh_mesh* mesh,
                                                     const kinemesh_options* options,
                                                     kinemesh_stepper** stepper);

/* For bodies whose motion is known: a stepper, and what moves its mesh. scenario is TOML, the tables
 * [[body]], [[motion]], [interior], [border] and [repair] as docs/scenarios.md has them, with their defaults;
 * files it names are relative to the current folder. Other tables are refused: the mesh is this one, frame as
 * in kinemesh_options, and each step brings its length. The message about a mistake in it begins with its
 * place, "scenario:LINE: ", and names the key. */
KINEMESH_API kinemesh_status kinemesh_stepper_create_scenario(const kinemesh_mesh* mesh, const char* scenario,
                                                              double frame, kinemesh_stepper** stepper);
KINEMESH_API void kinemesh_stepper_destroy(kinemesh_stepper* stepper); /* NULL is fine */

/* What a step did. Faces are counted with the padding around the domain, but for n_faces. */
typedef struct kinemesh_step {
  int32_t step;         /* its number, from 1 */
  double time, dt;      /* at its end; its length */
  int32_t n_faces;      /* of the domain */
  int32_t inverted;     /* faces the move turned over */
  int32_t flat;         /* faces it left without area */
  int32_t regions;      /* replaced */
  int32_t replaced;     /* faces in them that were rewritten */
  int32_t flips;        /* for quality "delaunay" and "angles" */
  int32_t moves;        /* of vertices, by quality "smooth" or "angles"; some vertices more than once */
  double min_angle_deg; /* of the domain, after the step */
  double min_area;
} kinemesh_step;

/* All vertices to new places in a time dt >= 0. record: may be NULL. */
KINEMESH_API kinemesh_status kinemesh_stepper_step(kinemesh_stepper* stepper, const double* xy, double dt,
                                                   kinemesh_step* record);

/* The border, or some of it, to new places: n different vertices, and where each is to be, in a time dt >= 0.
 * The rest of the border stays, and the interior follows: harmonically, or as a scenario says. Vertices of
 * the interior may be named, too. */
KINEMESH_API kinemesh_status kinemesh_stepper_step_border(kinemesh_stepper* stepper, int32_t n,
                                                          const int32_t* vertices, const double* xy,
                                                          double dt, kinemesh_step* record);

/* What the scenario of kinemesh_stepper_create_scenario says is to happen in a time dt >= 0 from now on.
 * Bodies are where it says for the time at the end of the step, to rounding: nothing adds up over the steps,
 * and two of dt / 2 bring a body to the same bits as one of dt. Other steps may come between; bodies then go
 * from there to where they have to be. */
KINEMESH_API kinemesh_status kinemesh_stepper_advance(kinemesh_stepper* stepper, double dt,
                                                      kinemesh_step* record);

/* For those who would rather move vertices in place: the stepper's own array of positions, to be written to
 * before kinemesh_stepper_repair, which takes them for a step. After any step, taken or refused, it holds the
 * mesh's positions. Stays where it is until the stepper is destroyed. NULL without memory. */
KINEMESH_API double* kinemesh_stepper_positions(kinemesh_stepper* stepper);
KINEMESH_API kinemesh_status kinemesh_stepper_repair(kinemesh_stepper* stepper, double dt,
                                                     kinemesh_step* record);

KINEMESH_API int32_t kinemesh_stepper_n_vertices(const kinemesh_stepper* stepper);
KINEMESH_API int32_t kinemesh_stepper_n_faces(const kinemesh_stepper* stepper);

/* The lengths of the steps taken so far, added up as if without rounding: after n steps of dt, n * dt. */
KINEMESH_API double kinemesh_stepper_time(const kinemesh_stepper* stepper);

/* The mesh as it is now; each array may be NULL. */
KINEMESH_API kinemesh_status kinemesh_stepper_get(const kinemesh_stepper* stepper, double* xy,
                                                  int32_t* triangles, int32_t* labels);

/* The same with its markers, as a mesh of its own. */
KINEMESH_API kinemesh_status kinemesh_stepper_mesh(const kinemesh_stepper* stepper, kinemesh_mesh** mesh);

/* ---- Who wants to know what a step changes ------------------------------------------------------------ */

/* Faces that were rewritten together: n_faces numbers, and for each the corners and the label before and
 * after. Before and after they have the same vertices and the same border. A corner of the padding's frame is
 * -1, a face outside the domain has the label INT32_MIN; both only occur where vertices have escaped. */
typedef struct kinemesh_patch {
  int32_t n_faces;
  const int32_t* faces;
  const int32_t* before; /* 3 n_faces */
  const int32_t* after;  /* 3 n_faces */
  const int32_t* labels_before;
  const int32_t* labels_after;
  int32_t n_vertices;
  const int32_t* vertices; /* the corners, ascending */
} kinemesh_patch;

/* All that a step changes: faces in no patch keep corners and label. */
typedef struct kinemesh_changes {
  int32_t step;
  double time, dt;
  int32_t n_patches;
  const kinemesh_patch* patches;
  const double* xy_before; /* of all vertices */
  const double* xy_after;
  int32_t n_moved; /* by quality "smooth" or "angles", after the step had brought them to xy_moved */
  const int32_t* moved;
  const double* xy_moved;
} kinemesh_changes;

/* Called within each step that can be taken, before it is final; what it points to is gone afterwards.
 * Anything but 0 vetoes the step, which then returns KINEMESH_VETOED and has not happened. Must not call the
 * stepper. */
typedef int (*kinemesh_observer)(const kinemesh_changes* changes, void* user);
KINEMESH_API kinemesh_status kinemesh_stepper_observe(kinemesh_stepper* stepper, kinemesh_observer observer,
                                                      void* user);

#ifdef __cplusplus
}
#endif

#endif
