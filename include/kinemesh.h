/* kinemesh from C, and from whatever can call C: planar triangle meshes whose vertices move and that stay
 * valid. docs/embedding.md shows a working loop; this is C99.
 *
 * Numbers of vertices and faces are the caller's: the order of the arrays a mesh was made from, from 0.
 * Coordinates are x0 y0 x1 y1 ..., triangles three vertices each, counter-clockwise.
 *
 * Functions that can fail return a kinemesh_status and leave everything as it was unless it is KINEMESH_OK;
 * kinemesh_error() then tells what, where, and what was expected. Others say what they return instead. No
 * exception crosses this interface. Pointers must not be NULL unless it says so, but an array of no elements
 * may be. A NULL, a number out of range, a size that cannot be: all are KINEMESH_BAD_INPUT. What C cannot see
 * is not seen: arrays that are shorter than said, handles after they are destroyed.
 *
 * A handle may be used by one thread at a time, or by several that only read it (the handle is const);
 * different handles by different threads. Who comes in between gets KINEMESH_BUSY.
 *
 * Options, and structs that the caller is shown, begin with their size, so that members can be added. In
 * options it is sizeof the struct, as the caller was compiled; only so many bytes are read or written. In a
 * struct that is shown it is how many there are; members beyond it are not there. Structs that the caller
 * provides to be filled have no size: they stay as they are as long as the library keeps its version in its
 * name (libkinemesh.so.0.1). */
#ifndef KINEMESH_H
#define KINEMESH_H

#include <stddef.h>
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
  KINEMESH_VETOED = 4,            /* an observer returned something else than 0, or threw */
  KINEMESH_BUG = 5,               /* a mistake of kinemesh; please report it with its message */
  KINEMESH_NO_RESOURCES = 6,      /* a full disk, a limit of files or of their size, a device that fails */
  KINEMESH_STUCK = 7,             /* "flips", "optimize" do not get on: another strategy may find a mesh */
  KINEMESH_REGIONS_TOO_LARGE = 8, /* there is a valid mesh, but max_region_share refuses it */
  KINEMESH_BUSY = 9,              /* the handle is in use: by another thread, or by the step that the caller
                                     observes */
  KINEMESH_NOT_VALID = 10         /* kinemesh_mesh_validate has found a defect */
} kinemesh_status;

/* What went wrong in the last call of this thread that failed, in one line; never NULL. Valid until the next
 * that fails. */
KINEMESH_API const char* kinemesh_error(void);

/* What keeps a mesh from being valid. A vertex or face that is -1 is of the padding around the domain. */
typedef enum kinemesh_defect_kind {
  KINEMESH_NO_DEFECT = 0,
  KINEMESH_NON_FINITE_POSITION = 1,  /* vertices: the one */
  KINEMESH_COINCIDENT_VERTICES = 2,  /* vertices: both */
  KINEMESH_INVERTED_FACE = 3,        /* faces: the one; vertices: its corners */
  KINEMESH_FLAT_FACE = 4,            /* likewise */
  KINEMESH_CROSSING_EDGES = 5,       /* edges: both constrained edges */
  KINEMESH_VERTEX_ON_EDGE = 6,       /* vertices: the one; edges: the constrained edge it lies on */
  KINEMESH_INSIDE_OUT = 7,           /* edges: a border edge with the domain on its wrong side, or twice */
  KINEMESH_LABELS_MEET = 8,          /* edges: two constrained edges between which two labels meet */
  KINEMESH_LEFT_DOMAIN = 9,          /* vertices: one beyond the padding's border, or on it */
  KINEMESH_ESCAPED = 10,             /* vertices: one on the wrong side of its border or interface */
  KINEMESH_HULL_MOVED = 11,          /* vertices: one of the convex hull of a mesh without a frame */
  KINEMESH_NOT_PLANAR = 12,          /* the faces are no part of the plane: a handle, a twist, no border */
  KINEMESH_BROKEN_CONNECTIVITY = 13, /* faces or vertices: where it is inconsistent */
  KINEMESH_MISSING_EDGE = 14,        /* edges: a constrained edge that is not in the mesh */
  KINEMESH_COVERAGE = 15             /* areas do not add up to the area inside the border */
} kinemesh_defect_kind;

typedef struct kinemesh_defect {
  size_t size;
  int32_t kind; /* a kinemesh_defect_kind; KINEMESH_NO_DEFECT: what failed had no culprits */
  int32_t n_vertices;
  const int32_t* vertices;
  int32_t n_faces;
  const int32_t* faces;
  int32_t n_edges;
  const int32_t* edges; /* two vertices each */
  double where[2];      /* a place to look at, rounded; 0 0 where there is none */
} kinemesh_defect;

/* The culprits that kinemesh_error() tells of, as numbers; never NULL. Valid until the next call of this
 * thread that fails. */
KINEMESH_API const kinemesh_defect* kinemesh_culprits(void);

/* As "inverted face"; NULL for what is no kinemesh_defect_kind. */
KINEMESH_API const char* kinemesh_defect_name(int32_t kind);

/* As "0.1.0". */
KINEMESH_API const char* kinemesh_version(void);

/* What options may ask for, by number from 0; NULL where there are no more. Valid until the thread asks for
 * the next. */
KINEMESH_API const char* kinemesh_strategy_name(int32_t number);
KINEMESH_API const char* kinemesh_quality_name(int32_t number);

/* ---- Meshes as plain arrays -------------------------------------------------------------------------- */

typedef struct kinemesh_mesh kinemesh_mesh;

/* Copies the arrays. labels: one per triangle, not INT32_MIN, or NULL for all 0. Winding is made consistent,
 * and parts that are clockwise on the whole are turned over, which swaps the last two corners of their faces.
 * The mesh may be tangled. */
KINEMESH_API kinemesh_status kinemesh_mesh_create(int32_t n_vertices, const double* xy, int32_t n_faces,
                                                  const int32_t* triangles, const int32_t* labels,
                                                  kinemesh_mesh** mesh);

/* By the file's extension: .off .obj .ply .su2 .msh .vtu, and to be written only .svg, a drawing. */
KINEMESH_API kinemesh_status kinemesh_mesh_read(const char* file, kinemesh_mesh** mesh);
KINEMESH_API kinemesh_status kinemesh_mesh_write(const kinemesh_mesh* mesh, const char* file);

/* -1 where they fail. */
KINEMESH_API int32_t kinemesh_mesh_n_vertices(const kinemesh_mesh* mesh);
KINEMESH_API int32_t kinemesh_mesh_n_faces(const kinemesh_mesh* mesh);

/* Copies to the caller's arrays of 2 n_vertices, 3 n_faces and n_faces; each may be NULL. */
KINEMESH_API kinemesh_status kinemesh_mesh_get(const kinemesh_mesh* mesh, double* xy, int32_t* triangles,
                                               int32_t* labels);

/* Edges, two vertices each, that are to stay edges of the mesh whatever happens; on the border or inside.
 * More edges of a name that is there already are added to it. */
KINEMESH_API kinemesh_status kinemesh_mesh_add_marker(kinemesh_mesh* mesh, const char* name, int32_t n_edges,
                                                      const int32_t* edges);

/* Markers by number, from 0, in the order they were added or read. -1 and NULL where they fail; a name is
 * valid until the mesh is changed or destroyed; edges: 2 n_edges numbers. */
KINEMESH_API int32_t kinemesh_mesh_n_markers(const kinemesh_mesh* mesh);
KINEMESH_API const char* kinemesh_mesh_marker_name(const kinemesh_mesh* mesh, int32_t marker);
KINEMESH_API int32_t kinemesh_mesh_marker_n_edges(const kinemesh_mesh* mesh, int32_t marker);
KINEMESH_API kinemesh_status kinemesh_mesh_get_marker(const kinemesh_mesh* mesh, int32_t marker,
                                                      int32_t* edges);

/* A label's name, for formats that have them (.msh). Empty where it has none; NULL where it fails; valid
 * until the mesh is changed or destroyed. */
KINEMESH_API const char* kinemesh_mesh_label_name(const kinemesh_mesh* mesh, int32_t label);
KINEMESH_API kinemesh_status kinemesh_mesh_name_label(kinemesh_mesh* mesh, int32_t label, const char* name);

/* Whether the mesh is an embedded triangulation with all its markers: KINEMESH_NOT_VALID, or
 * KINEMESH_NO_VALID_MESH where no faces on these vertices could be one, with kinemesh_error() and
 * kinemesh_culprits(). */
KINEMESH_API kinemesh_status kinemesh_mesh_validate(const kinemesh_mesh* mesh);

/* Makes the inverted and flat faces upright, vertices staying where they are. strategy: NULL for "global". */
KINEMESH_API kinemesh_status kinemesh_mesh_untangle(kinemesh_mesh* mesh, const char* strategy);

KINEMESH_API kinemesh_status kinemesh_mesh_destroy(kinemesh_mesh* mesh); /* NULL is fine */

/* How much of a move from xy0 to xy1 can be done before the first triangle is flat, all vertices moving
 * linearly: *share, from 0 to 1, rounded down, and *face, the smallest of those that are flat first. 1 and -1
 * if none is; 0 if one is not upright at the start. */
KINEMESH_API kinemesh_status kinemesh_max_safe_step(int32_t n_vertices, const double* xy0, const double* xy1,
                                                    int32_t n_faces, const int32_t* triangles, double* share,
                                                    int32_t* face);

/* ---- The stepper ------------------------------------------------------------------------------------- */

typedef struct kinemesh_stepper kinemesh_stepper;

typedef struct kinemesh_options {
  size_t size;
  const char* strategy; /* how a tangled mesh is repaired; NULL: "global" */
  const char* quality;  /* what is done for the shape of the faces after it: "none", "delaunay", "smooth",
                           "angles"; NULL: "none" */
  double angle;         /* degrees, above 0 and below 60: what "angles" keeps angles above, where it can */
  double frame; /* margin of padding around the domain, in diagonals of its bounding box; 0: its convex hull
                   must not move */
  int32_t allow_escaped;   /* not 0: vertices may end on the wrong side of a border or interface */
  int32_t retain;          /* not 0: keep upright faces of a region that need not be replaced */
  double max_region_share; /* a step whose regions hold more than this share of all faces, padding included,
                              is refused; 0 or infinity: none is. A limit takes memory for the whole mesh, as
                              observers do. */
} kinemesh_options;

/* Fills what options->size says is there: global, none, 25 degrees, frame 0.25, and 0 for all else. */
KINEMESH_API kinemesh_status kinemesh_set_default_options(kinemesh_options* options);

/* The same, with the right size. Compiled by the caller: a struct that may grow cannot be returned by a
 * library. */
static inline kinemesh_options kinemesh_default_options(void) {
  kinemesh_options options;
  options.size = sizeof options;
  (void)kinemesh_set_default_options(&options);
  return options;
}

/* The mesh is copied; it has to be valid (kinemesh_mesh_untangle). options: NULL for the default ones. Of a
 * larger struct than this version knows, the rest has to be 0. */
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

/* KINEMESH_BUSY, and not destroyed, within a step of its own. */
KINEMESH_API kinemesh_status kinemesh_stepper_destroy(kinemesh_stepper* stepper); /* NULL is fine */

/* What a step did; the columns of a run's log. Faces are counted with the padding around the domain, but for
 * `faces`. */
typedef struct kinemesh_step {
  int32_t step;            /* its number, from 1 */
  int32_t vertices, faces; /* of the domain, after it */
  double time, dt;         /* at its end; its length */
  int32_t inverted;        /* faces the move turned over */
  int32_t degenerate;      /* faces it left without area */
  int32_t components;      /* of inverted faces with common edges */
  int32_t regions;         /* replaced */
  int32_t replaced;        /* faces in them that were rewritten */
  int32_t escaped;         /* vertices now on the wrong side of their border or interface */
  int32_t doubled_edges;   /* pairs of edges with the same ends that were made on the way */
  int32_t quality_flips;   /* for quality "delaunay" and "angles" */
  int32_t quality_moves;   /* of vertices, by "smooth" or "angles"; some vertices more than once */
  int32_t region_faces, region_faces_max; /* in all regions, in the largest */
  int32_t explored;                       /* faces read to find the regions */
  int32_t crease_edges;                   /* between an inverted and an upright face of a region */
  int32_t retries;                        /* enlargements the safety net needed; 0 outside freak cases */
  double region_share;                    /* region_faces over all: what max_region_share limits */
  double min_angle_deg;                   /* of the domain, after the step */
  double min_area;
  /* Wall-clock times. total_ms holds all others. */
  double move_ms, interior_ms, detect_ms, explore_ms, triangulate_ms, splice_ms, quality_ms, measure_ms;
  double total_ms;
} kinemesh_step;

/* All vertices to new places in a time dt >= 0. record: may be NULL, here and below. */
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

/* For those who would rather move vertices in place: the stepper's own array of positions, 2 n_vertices
 * numbers, to be written to before kinemesh_stepper_repair, which takes them for a step. After a step that
 * was refused the array holds the mesh's positions again. Any step that is taken may leave the pointer
 * invalid: ask again after it. NULL where it fails. */
KINEMESH_API double* kinemesh_stepper_positions(kinemesh_stepper* stepper);
KINEMESH_API kinemesh_status kinemesh_stepper_repair(kinemesh_stepper* stepper, double dt,
                                                     kinemesh_step* record);

/* As they are now: any step may change them, those of faces where vertices escape. -1 where they fail. */
KINEMESH_API int32_t kinemesh_stepper_n_vertices(const kinemesh_stepper* stepper);
KINEMESH_API int32_t kinemesh_stepper_n_faces(const kinemesh_stepper* stepper);

/* The lengths of the steps taken so far, added up as if without rounding: after n steps of dt, n * dt. Not a
 * number where it fails. */
KINEMESH_API double kinemesh_stepper_time(const kinemesh_stepper* stepper);

/* The mesh as it is now; each array may be NULL. */
KINEMESH_API kinemesh_status kinemesh_stepper_get(const kinemesh_stepper* stepper, double* xy,
                                                  int32_t* triangles, int32_t* labels);

/* The numbers of the faces as they are listed there, n_faces of them: 0, 1, 2, ... unless vertices have
 * escaped and faces have entered or left the domain with them. */
KINEMESH_API kinemesh_status kinemesh_stepper_face_numbers(const kinemesh_stepper* stepper, int32_t* numbers);

/* The mesh with its markers, as one of its own. */
KINEMESH_API kinemesh_status kinemesh_stepper_mesh(const kinemesh_stepper* stepper, kinemesh_mesh** mesh);

/* ---- The regions of a step --------------------------------------------------------------------------- */

/* A region that the last step replaced; see docs/algorithm.md. Counts include padding but for n_faces. */
typedef struct kinemesh_region {
  int32_t seed;    /* the face "local" started from; others: the smallest inverted or flat one, -1: padding */
  int32_t n_faces; /* of the domain, before the step */
  int32_t padding_faces; /* besides */
  int32_t kept;          /* faces that were not replaced; 0 unless retained */
  int32_t inverted, degenerate, components, explored, crease_edges, retries; /* as in kinemesh_step */
  int32_t border_edges;
  int32_t gamma_first_stable, gamma; /* signed cover: when extending first came to rest, and at the end */
  int32_t rounds, grown;             /* of growing shadows; convex pieces these added */
  int32_t self_overlap;              /* not 0: its border overlaps itself in the plane */
  int32_t fallback;                  /* not 0: replaced as a piece of the global walk, by another strategy */
  double centre[2];                  /* of the bounding box of its vertices */
} kinemesh_region;

/* The regions of the last step that was taken, by number from 0 and below kinemesh_step.regions. faces: room
 * for n_faces numbers, ascending; region and faces may be NULL. */
KINEMESH_API kinemesh_status kinemesh_stepper_get_region(const kinemesh_stepper* stepper, int32_t number,
                                                         kinemesh_region* region, int32_t* faces);

/* ---- Who wants to know what a step changes ------------------------------------------------------------ */

/* Some faces of the domain: their numbers, ascending, three corners and a label each. */
typedef struct kinemesh_faces {
  int32_t n;
  const int32_t* faces;
  const int32_t* triangles;
  const int32_t* labels;
} kinemesh_faces;

/* Faces that were rewritten together: those before, which are gone, and those that stand in their place. Both
 * have the same border, and now the same vertices and as many faces with the same numbers, which need not
 * stay so. A number stands for a face of `before` until the step, for one of `after` from then on. Where
 * vertices escape, faces leave or enter the domain, and are in one of the lists only. */
typedef struct kinemesh_patch {
  size_t size;
  kinemesh_faces before, after;
  int32_t n_vertices;
  const int32_t* vertices; /* the corners, ascending */
  int32_t n_regions;
  const int32_t* regions; /* that it comes from, as kinemesh_stepper_get_region numbers them after the step;
                             none: flips for quality alone */
} kinemesh_patch;

/* All that a step changes: faces in no patch keep corners and label. */
typedef struct kinemesh_changes {
  size_t size;
  int32_t step;
  double time, dt;
  int32_t n_vertices_before, n_vertices_after;
  int32_t n_faces_before, n_faces_after; /* of the domain */
  const int32_t* vertex_map; /* number after the step of each vertex before it, -1 where it is gone; NULL,
                                which it is now: all keep their number */
  const int32_t* face_map;   /* likewise, of faces in no patch */
  int32_t n_patches;
  const kinemesh_patch* const* patches; /* one pointer each */
  const double* xy_before;              /* of all vertices before, of all after */
  const double* xy_after;
  int32_t n_moved; /* by quality "smooth" or "angles", after the step had brought them to xy_moved */
  const int32_t* moved;
  const double* xy_moved;
} kinemesh_changes;

/* Called within each step that can be taken, before it is final; what it points to is gone afterwards.
 * Anything but 0 vetoes the step, which then returns KINEMESH_VETOED and has not happened; so does an
 * exception, where the observer is C++. It has to come back: no longjmp. The stepper itself is
 * KINEMESH_BUSY meanwhile, whatever is asked of it; other handles are not. */
typedef int (*kinemesh_observer)(const kinemesh_changes* changes, void* user);
KINEMESH_API kinemesh_status kinemesh_stepper_observe(kinemesh_stepper* stepper, kinemesh_observer observer,
                                                      void* user);

/* What becomes of values of faces, for an observer: from n_faces_before values, one per face, to
 * n_faces_after of them. `after` may be `before`; faces that are not rewritten keep their value, bit for bit,
 * and nothing is written unless all goes well, which it does not where faces have entered or left the domain.
 * `changes` are those that the observer is being shown: others, those of steps gone by among them, are
 * KINEMESH_BAD_INPUT. Any threads may call these until it returns. kinemesh/cell_transfer.h has the formulas.
 *   amounts: what a face holds all together, a mass, say; by label their sum is kept, to rounding.
 *   averages: likewise the integral, inverted faces counting negative; constants stay constant.
 *   nearest: the value of the old face of the label whose centre is nearest; nothing is conserved. */
KINEMESH_API kinemesh_status kinemesh_remap_amounts(const kinemesh_changes* changes, const double* before,
                                                    double* after);
KINEMESH_API kinemesh_status kinemesh_remap_averages(const kinemesh_changes* changes, const double* before,
                                                     double* after);
KINEMESH_API kinemesh_status kinemesh_copy_nearest(const kinemesh_changes* changes, const double* before,
                                                   double* after);

#ifdef __cplusplus
}
#endif

#endif
