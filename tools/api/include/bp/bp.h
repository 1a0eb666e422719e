/* bp.h: bounding proxies of triangle scenes, as a C library.
 *
 * A bounding proxy is a coarse closed mesh around a scene. The scene may be a soup of triangles with holes and gaps;
 * the proxy is closed, 2-manifold, free of self-intersections, and strictly encloses every triangle. It is made in
 * three steps, as the tools bpvox | bpclose | bpmesh do it:
 *
 *   scene -> bp_voxelize -> grid [-> bp_field] -> bp_close -> grid -> bp_mesh_make -> mesh   (bp_proxy does the three)
 *
 * Source of the method: Stephane Calderon, Tamy Boubekeur, "Bounding Proxies for Shape Approximation", ACM Transactions
 * on Graphics 36(4), 2017. The same scene and options give the same bytes, on any number of threads and with any limit
 * on memory, and the bytes of the tools.
 *
 * Conventions
 *   Handles   bp_scene, bp_grid, bp_mesh, bp_verdict and bp_stop are opaque. Who gets one frees it; bp_X_free(NULL)
 *             does nothing. Except for bp_stop they do not change once they are made, so several threads may use one
 *             at once.
 *   Options   A struct begins with its size. bp_X_defaults(&o, sizeof o) fills it in; NULL in place of options means
 *             the defaults. Programs that were compiled with an earlier header go on working.
 *   Results   Functions write their result through the last pointer, and only if they succeed. Pointers into a handle
 *             are valid until it is freed.
 *   Errors    Every function that can fail returns a bp_status. bp_error_message() tells the facts. No exception and no
 *             signal leaves the library, and it prints nothing.
 *   Threads   Calls may run at once in one process, each with its own number of threads (bp_run).
 *   fork()    In a child of a process that has made calls, each call runs on one thread, and without a GPU that the
 *             process had used; the result is the same. If another thread was in a call during fork(), calls in the
 *             child fail with BP_FAILED.
 *   Units     Lengths are in scene units unless a bp_length says otherwise. Coordinates are x, y, z, double precision.
 *   Marks     This header is stable: it is kept within a MAJOR version. bp_experimental.h has more, which may change
 *             with any version. docs/compatibility.md says what that means before version 1.
 */
#ifndef BP_BP_H
#define BP_BP_H
#pragma once

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32)
#define BP_API
#else
#define BP_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Version and errors ------------------------------------------------------------------------------------------*/

#define BP_API_MAJOR 0
#define BP_API_MINOR 3
/* Returns the version of the library that runs: "0.3.0". */
BP_API const char* bp_version(void);

typedef enum bp_status {
  BP_OK = 0,
  BP_FAILED = 1,          /* the work could not be done, for a reason that is none of the below */
  BP_BAD_ARGUMENT = 2,    /* the call asks for something impossible */
  BP_BAD_INPUT = 3,       /* a scene or a file is missing, broken or of the wrong kind */
  BP_OUT_OF_RESOURCE = 4, /* memory, disk or device is exhausted or absent */
  BP_CANCELLED = 5        /* bp_stop_set() or the progress callback ended the call */
} bp_status;

/* Returns the message of the last call on this thread that failed: "triangle 5 names vertex 99, and the number of
 * vertices is 10". It is valid until the next call of the library on this thread; "" if none has failed. */
BP_API const char* bp_error_message(void);

/* ---- How a call runs ---------------------------------------------------------------------------------------------*/

/* Ends calls early, from any thread. One bp_stop may serve several calls. */
typedef struct bp_stop bp_stop;
BP_API bp_stop* bp_stop_new(void);        /* NULL: out of memory */
BP_API void bp_stop_set(bp_stop* stop);   /* calls that have it return BP_CANCELLED soon: milliseconds, as a rule */
BP_API void bp_stop_clear(bp_stop* stop); /* it may be used for further calls */
BP_API void bp_stop_free(bp_stop* stop);

/* Called every 0.1 s and at steps of the work, on any thread, by one at a time, also while a sink runs. `pass` names
 * the work, `unit` what is counted; `total` is 0: not known. Returns 0 to go on; else the call ends: BP_CANCELLED. */
typedef int (*bp_progress_fn)(void* user, const char* pass, const char* unit, uint64_t done, uint64_t total);

/* Called with a sentence worth a look before the call returns: what was left out, why a target was not reached. */
typedef void (*bp_note_fn)(void* user, const char* text);

typedef struct bp_run {
  size_t size;
  int32_t threads;    /* at most so many; 0: one for each core */
  uint64_t memory;    /* bytes to keep below; what does not fit waits on disk. 0: a quarter of the machine's */
  const char* temp;   /* folder for what waits; NULL: $TMPDIR, else /tmp */
  const char* device; /* "auto", "cpu", "cuda" or "cuda:0,1"; NULL: auto, a GPU where the work is worth its start */
  bp_progress_fn progress; /* may be NULL */
  bp_note_fn note;         /* may be NULL */
  void* user;              /* handed to both */
  bp_stop* stop;           /* may be NULL */
} bp_run;
BP_API void bp_run_defaults(bp_run* run, size_t size);

/* Called with the next bytes of a result in place of a file, on any thread, by one thread at a time. Where a call
 * writes several files, whose bytes may take turns, `file` is the name of one; else NULL. Returns 0 to go on, any other
 * number to end the call with BP_CANCELLED. Bytes of a call that fails are incomplete. */
typedef int (*bp_sink_fn)(void* user, const char* file, const void* bytes, size_t count);

/* ---- Lengths -----------------------------------------------------------------------------------------------------*/

typedef enum bp_unit {
  BP_SCENE_UNITS = 0,
  BP_PERCENT = 1, /* of the diagonal of the scene's bounding box */
  BP_VOXELS = 2   /* edges of a voxel of the grid */
} bp_unit;

typedef struct bp_length {
  double value; /* 0 or more */
  int32_t unit; /* bp_unit */
} bp_length;

/* Reads "0.5" (scene units), "2%" or "20vx". BP_BAD_ARGUMENT if the text is no length. */
BP_API bp_status bp_length_parse(const char* text, bp_length* out);

/* ---- Scenes ------------------------------------------------------------------------------------------------------*/

typedef struct bp_scene bp_scene;

typedef enum bp_type {
  BP_FLOAT64 = 0,
  BP_FLOAT32 = 1,
  BP_UINT32 = 2,
  BP_INT32 = 3,
  BP_UINT64 = 4,
  BP_INT64 = 5
} bp_type;

typedef enum bp_up {
  BP_UP_UNKNOWN = 0, /* as y, and nobody has said so */
  BP_UP_Y = 1,
  BP_UP_Z = 2,
  BP_UP_X = 3,
  BP_UP_MINUS_X = 4,
  BP_UP_MINUS_Y = 5,
  BP_UP_MINUS_Z = 6
} bp_up;

/* Triangles in the caller's memory. */
typedef struct bp_arrays {
  size_t size;
  const void* vertices;   /* x, y, z of each vertex, next to each other */
  size_t vertex_count;    /* at most 2^32 - 1 */
  size_t vertex_stride;   /* bytes from one vertex to the next; 0: next to each other */
  int32_t vertex_type;    /* BP_FLOAT64 or BP_FLOAT32 */
  const void* triangles;  /* three numbers of vertices each, from 0; counter-clockwise seen from outside */
  size_t triangle_count;  /* at most 2^40 */
  size_t triangle_stride; /* bytes from one triangle to the next; 0: next to each other */
  int32_t triangle_type;  /* BP_UINT32, BP_INT32, BP_UINT64 or BP_INT64 */
  int32_t borrow;         /* not 0: the arrays are not copied. They must stay unchanged while the scene, or a grid that
                             was made of it, lives. A change after bp_voxelize() is reported, by a sum */
  int32_t up;             /* bp_up: the axis that points up; glTF that is written is turned by it */
} bp_arrays;
BP_API void bp_arrays_defaults(bp_arrays* arrays, size_t size);

/* Makes a scene of triangles in memory. `name` is for messages; NULL: "the scene". Cost: a copy, and a look at each
 * number, on all cores. BP_BAD_INPUT, with the first fault, if a vertex that is used is not finite, if a triangle names
 * a vertex that does not exist, or if there is no triangle. Coordinates below 1e-90 in magnitude count as 0. */
BP_API bp_status bp_scene_from_arrays(const bp_arrays* arrays, const char* name, bp_scene** out);

/* Makes a scene of files, voxelized together: PLY, STL, OBJ, OFF, glTF, GLB, tilesets, and what Assimp reads. They are
 * opened when they are needed, and streamed: a scene may be larger than memory. A relative name counts from the folder
 * that is current then. `format`: of files whose names do not tell it; NULL: all names do. */
BP_API bp_status bp_scene_from_files(const char* const* paths, size_t count, const char* format, bp_scene** out);

typedef struct bp_scene_info {
  size_t size;
  uint64_t triangles;    /* with and without area */
  uint64_t degenerate;   /* of them, those of exactly zero area */
  uint64_t non_finite;   /* left out: a coordinate is no finite number (files only) */
  uint64_t bad_faces;    /* left out: faces that name missing vertices (files only) */
  double min[3], max[3]; /* bounding box, scene units */
} bp_scene_info;
/* Reads the whole scene. */
BP_API bp_status bp_scene_read_info(const bp_scene* scene, const bp_run* run, bp_scene_info* info, size_t size);
BP_API void bp_scene_free(bp_scene* scene);

/* ---- Voxels ------------------------------------------------------------------------------------------------------*/

/* Voxels of a scene: the solid layer and, after bp_close, the closing. Kept in bricks of 64 x 64 x 64 bits, compressed
 * where many, on disk beyond bp_run.memory. */
typedef struct bp_grid bp_grid;

typedef enum bp_fill {
  BP_FILL_FLOOD = 0,   /* all that the outside cannot reach is solid */
  BP_FILL_WINDING = 1, /* where the winding number is not 0; cavities stay empty */
  BP_FILL_NONE = 2,    /* only the voxels that a triangle touches */
  BP_FILL_INSIDE = 3   /* as flood, without the voxels that a triangle touches: for a proxy inside the scene */
} bp_fill;

typedef struct bp_voxelize_options {
  size_t size;
  bp_length voxel;    /* edge of a voxel; 0: by the resolution. Rounded up by a 128th at most, so that the vertices of
                         proxies are exact doubles */
  int64_t resolution; /* voxels along the longest side of the scene; 0: 256 */
  int32_t fill;       /* bp_fill */
  int32_t up;         /* bp_up; BP_UP_UNKNOWN: what the scene tells */
} bp_voxelize_options;
BP_API void bp_voxelize_defaults(bp_voxelize_options* options, size_t size);

/* Sets every voxel that a triangle touches, and fills the inside. Exact in integers, after [SS10].
 * Cost: linear in the triangles and in the voxels that they touch; a second for a million triangles on two cores.
 * BP_BAD_ARGUMENT if the grid cannot be had (more than 2^31 voxels along a side, or out of proportion to the scene). */
BP_API bp_status bp_voxelize(const bp_scene* scene, const bp_voxelize_options* options, const bp_run* run,
                             bp_grid** out);

/* Adds a scale field to a grid without a closing, as bpscale does: `rules`, as JSON (docs/bpscale.1.md), tell for each
 * place how large the gaps are that bp_close() closes there, and how cubes are turned. A field that the grid has is
 * replaced. Names of parts need a scene of files. BP_BAD_INPUT, with the key at fault, if the rules are none.
 * Cost: none; rules by shape read all voxels. */
BP_API bp_status bp_field(const bp_grid* grid, const char* rules, const bp_run* run, bp_grid** out);

typedef enum bp_element {
  BP_CUBE = 0, /* of the dilation; large flat areas stay flat */
  BP_BALL = 1
} bp_element;

typedef struct bp_close_options {
  size_t size;
  bp_length scale;       /* gaps, holes and grooves narrower than twice this radius are filled. 0: `rules`, else the
                            field of the grid (bp_field), else 2 % */
  const char* rules;     /* scales that differ from place to place, as JSON (docs/bpscale.1.md), in place of `scale`;
                            NULL: none */
  int32_t element;       /* bp_element */
  int32_t keep_cavities; /* not 0: hollows that the closing cuts off from the outside stay empty */
  int32_t no_scale;      /* not 0: a scale of exactly 0, which changes no voxel */
} bp_close_options;
BP_API void bp_close_defaults(bp_close_options* options, size_t size);

/* Closes the solid layer: the asymmetric closing of [CB17], section 3.3. It holds all solid voxels. A grid of
 * BP_FILL_INSIDE is opened instead: parts narrower than the scale are removed. `grid` stays as it is.
 * Cost: some tens of nanoseconds for each voxel near the surface; it grows with the scale. */
BP_API bp_status bp_close(const bp_grid* grid, const bp_close_options* options, const bp_run* run, bp_grid** out);

/* Reads or writes the stream of voxels that the tools read and write (docs/brick-stream.md). A file that exists is
 * replaced only if `overwrite` is not 0; a file appears complete or not at all. A sink gets the bytes of the file. */
BP_API bp_status bp_grid_load(const char* path, const bp_run* run, bp_grid** out);
BP_API bp_status bp_grid_save(const bp_grid* grid, const char* path, int overwrite, const bp_run* run);
BP_API bp_status bp_grid_write(const bp_grid* grid, bp_sink_fn sink, void* user, const bp_run* run);

typedef enum bp_layer { BP_SOLID = 0, BP_CLOSING = 1 } bp_layer;

typedef struct bp_grid_info {
  size_t size;
  double voxel;     /* edge, scene units */
  double origin[3]; /* corner of voxel (0, 0, 0), scene units. Voxel (i, j, k) covers origin + voxel * (i .. i+1) */
  int32_t min[3], max[3]; /* all voxels that are set lie in min <= v < max; multiples of 64, may be negative */
  double bounds_min[3], bounds_max[3]; /* of the scene, scene units */
  int32_t has_closing;                 /* not 0: there is a closing layer */
  int32_t fill;                        /* bp_fill */
  int32_t up;                          /* bp_up */
  double scale;                        /* of the closing where it is the same everywhere, scene units; else 0 */
  uint64_t bricks[2];                  /* bricks that are not empty, by bp_layer */
  uint64_t voxels[2];                  /* voxels that are set, by bp_layer */
  const char* rules;                   /* scale field of the closing, or of the closing to come, as JSON; "": none */
} bp_grid_info;
/* Cost: reads every brick once, to count. */
BP_API bp_status bp_grid_read_info(const bp_grid* grid, bp_grid_info* info, size_t size);

/* Computes the closing radius at points (x, y, z each) by the field of the grid, scene units; bp_close() samples it
 * every 8 voxels. BP_BAD_ARGUMENT without field and closing. Cost: microseconds for each point and 100 rules. */
BP_API bp_status bp_grid_scales(const bp_grid* grid, const double* points, size_t count, const bp_run* run,
                                double* scales);

/* Copies voxels out: one byte each, 0 or 1, for the box of extent[0] x extent[1] x extent[2] voxels from `min` on.
 * Voxel min + (i, j, k) is out[(k * extent[1] + j) * extent[0] + i], so as an array of NumPy the shape is (z, y, x).
 * What lies outside the grid is 0. The layer of a grid that does not have it is empty. */
BP_API bp_status bp_grid_read(const bp_grid* grid, bp_layer layer, const int32_t min[3], const int32_t extent[3],
                              uint8_t* out);

/* Copies the coordinates of the bricks that are not empty, three numbers each, sorted by x, y, z: brick b holds voxels
 * 64 b .. 64 b + 63. Writes at most `capacity` bricks; `count` gets the number of all. */
BP_API bp_status bp_grid_bricks(const bp_grid* grid, bp_layer layer, int32_t* coords, size_t capacity, size_t* count);
/* Copies the bits of one brick: 4096 words, x fastest. Bit i of word (k * 64 + j) is voxel (i, j, k) of the brick. */
BP_API bp_status bp_grid_brick(const bp_grid* grid, bp_layer layer, const int32_t coord[3], uint64_t bits[4096]);
BP_API void bp_grid_free(bp_grid* grid);

/* ---- Meshes ------------------------------------------------------------------------------------------------------*/

/* One mesh or several: the levels of a proxy, finest first, or the hulls of a body. */
typedef struct bp_mesh bp_mesh;

typedef enum bp_mode {
  BP_MODE_AUTO = 0,     /* bounding; inside for grids of BP_FILL_INSIDE */
  BP_MODE_BOUNDING = 1, /* strictly around what is enclosed */
  BP_MODE_FIT = 2,      /* near the surface, neither around nor within */
  BP_MODE_INSIDE = 3    /* strictly inside the scene, for occluders */
} bp_mode;

typedef enum bp_enclose {
  BP_ENCLOSE_AUTO = 0,   /* the scene's triangles if they are no more than 2^20 and can be had, else its voxels */
  BP_ENCLOSE_SCENE = 1,  /* the scene's triangles */
  BP_ENCLOSE_INPUT = 2,  /* the solid voxels */
  BP_ENCLOSE_CLOSING = 3 /* the voxels that are meshed */
} bp_enclose;

typedef struct bp_mesh_options {
  size_t size;
  const uint64_t* faces; /* triangles of each level, falling; each level strictly encloses the one before. NULL: one
                            level, whose faces the other targets decide */
  size_t levels;         /* numbers in `faces` */
  bp_length error;       /* largest distance to what is enclosed; 0: none */
  double volume;         /* largest volume, as a multiple of the voxels' volume; 0: no limit */
  int32_t mode;          /* bp_mode */
  int32_t enclose;       /* bp_enclose */
  int32_t quads;         /* not 0: triangles are joined to quads, safe for either diagonal */
} bp_mesh_options;
BP_API void bp_mesh_defaults(bp_mesh_options* options, size_t size);

/* Meshes the closing layer, or the solid layer of a grid without one, and simplifies: [GH97] with the constraints of
 * [CB17], section 3.4, every step decided exactly. Proxies are closed, 2-manifold and free of self-intersections, and
 * enclose strictly (docs/bounding.md). A number of faces that cannot be had leads to the best there is, and to a note.
 * Cost: seconds for grids of 256 voxels; more with `error`. BP_BAD_INPUT if the layer is empty. */
BP_API bp_status bp_mesh_make(const bp_grid* grid, const bp_mesh_options* options, const bp_run* run, bp_mesh** out);

/* Voxelizes, closes and meshes. */
BP_API bp_status bp_proxy(const bp_scene* scene, const bp_voxelize_options* voxelize, const bp_close_options* close,
                          const bp_mesh_options* mesh, const bp_run* run, bp_mesh** out);

/* Reads a file of a mesh, all of its levels. Vertices of equal coordinates become one. */
BP_API bp_status bp_mesh_load(const char* path, const bp_run* run, bp_mesh** out);
BP_API size_t bp_mesh_count(const bp_mesh* mesh);

typedef struct bp_mesh_view {
  size_t size;
  const double* vertices; /* x, y, z of each vertex, scene units, exact */
  size_t vertex_count;
  const uint32_t* triangles; /* three numbers of vertices each, counter-clockwise seen from outside */
  size_t triangle_count;
  const uint32_t* quads; /* two numbers of triangles each that make a quad together */
  size_t quad_count;
} bp_mesh_view;
/* Gives the arrays of a mesh; they belong to the handle. Cost: none. */
BP_API bp_status bp_mesh_look(const bp_mesh* mesh, size_t index, bp_mesh_view* view, size_t size);

typedef struct bp_mesh_info {
  size_t size;
  double volume;          /* scene units cubed; 0 of a mesh that was loaded and is not closed */
  double area;            /* scene units squared */
  uint64_t faces_asked;   /* 0: none */
  double error_bound;     /* no point of the mesh is farther from what is enclosed, scene units; 0: not bounded */
  const char* stopped_by; /* the target that was reached first: "faces", "error", "volume"; "least-volume": further
                             faces would save next to no volume; else the reason in words. "" for other meshes */
  const char* enclosed;   /* what lies strictly inside: "scene", "input", "closing"; "" if nothing is known to */
} bp_mesh_info;
BP_API bp_status bp_mesh_read_info(const bp_mesh* mesh, size_t index, bp_mesh_info* info, size_t size);

/* Writes one mesh, without loss: .glb .gltf .ply .obj .stl, with the bytes that bpmesh writes. A mesh that was loaded
 * cannot be saved. BP_BAD_ARGUMENT if the format cannot hold the coordinates. For a sink, `format` is "glb", ... */
BP_API bp_status bp_mesh_save(const bp_mesh* mesh, size_t index, const char* path, int overwrite);
BP_API bp_status bp_mesh_write(const bp_mesh* mesh, size_t index, const char* format, bp_sink_fn sink, void* user);
BP_API void bp_mesh_free(bp_mesh* mesh);

/* ---- Proofs ------------------------------------------------------------------------------------------------------*/

typedef struct bp_verdict bp_verdict;
typedef enum bp_answer { BP_PROVEN = 0, BP_REFUTED = 1, BP_UNDECIDED = 2 } bp_answer;

typedef struct bp_check_options {
  size_t size;
  int32_t inside;       /* not 0: the proxy is to lie inside the scene, not around it; without convex and margin */
  int32_t convex;       /* not 0: the proxy is a union of convex parts that may overlap */
  bp_length margin;     /* the proxy is to keep this distance from the scene; 0: not asked */
  int32_t no_distances; /* not 0: distances are not measured, which takes most of the time */
} bp_check_options;
BP_API void bp_check_defaults(bp_check_options* options, size_t size);

/* Proves or refutes that a proxy is a closed, oriented, embedded 2-manifold and, if `scene` is not NULL, that it
 * strictly encloses every triangle of it. Exact for the doubles as given. The code shares nothing with the code that
 * makes proxies but the predicates. Cost: linear in the scene, times log of the proxy; 300 bytes a proxy triangle. */
BP_API bp_status bp_check(const bp_arrays* proxy, const bp_scene* scene, const bp_check_options* options,
                          const bp_run* run, bp_verdict** out);
/* The same of a mesh of a handle. With `inside`, the mesh also tells how it was made, so an occluder of an open
 * building is proven to be hidden once openings are closed, as bpcheck proves its file. */
BP_API bp_status bp_check_mesh(const bp_mesh* proxy, size_t index, const bp_scene* scene,
                               const bp_check_options* options, const bp_run* run, bp_verdict** out);

typedef struct bp_verdict_info {
  size_t size;
  int32_t answer;              /* bp_answer, of all that was asked */
  int32_t sound;               /* bp_answer: closed, oriented, embedded, 2-manifold */
  int32_t placed;              /* bp_answer: encloses the scene, or lies inside it; BP_UNDECIDED without a scene */
  uint64_t touching;           /* triangles of the scene that touch the proxy's surface */
  uint64_t outside;            /* triangles of the scene that lie outside */
  double volume, scene_volume; /* scene units cubed; NaN: not closed, or not known */
  double scene_to_proxy, proxy_to_scene; /* the largest distance seen, scene units; NaN: not measured */
} bp_verdict_info;
BP_API bp_status bp_verdict_read_info(const bp_verdict* verdict, bp_verdict_info* info, size_t size);
/* What does not hold, in a few words: "not closed, 3 scene triangles outside"; "" if all holds. */
BP_API const char* bp_verdict_reasons(const bp_verdict* verdict);
BP_API const char* bp_verdict_text(const bp_verdict* verdict); /* the lines that bpcheck prints */
BP_API const char* bp_verdict_json(const bp_verdict* verdict); /* what bpcheck --json prints */
BP_API void bp_verdict_free(bp_verdict* verdict);

#ifdef __cplusplus
}
#endif
#endif
