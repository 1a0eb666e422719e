/* bp_experimental.h: parts of the C library that may change with any version. bp.h has the rest, and the conventions.
 */
#ifndef BP_BP_EXPERIMENTAL_H
#define BP_BP_EXPERIMENTAL_H
#pragma once

#include <bp/bp.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Convex hulls ---------------------------------------------------------------------------------*/

typedef struct bp_hulls_options {
  size_t size;
  uint32_t hulls;   /* at most so many; 0: 32, or 64 where these hold clearly less */
  uint64_t faces;   /* of all hulls together; 0: no limit */
  uint32_t corners; /* of a hull, 8 at least; 0: 64, which physics engines take */
} bp_hulls_options;
BP_API void bp_hulls_defaults(bp_hulls_options* options, size_t size);

/* Covers a proxy with convex hulls that together enclose, exactly, what it encloses: an approximate convex
 * decomposition, after [WLLS22] and [MG09]. `mesh` is of bp_mesh_make() or bp_proxy(). Cost: seconds for 20,000 faces.
 */
BP_API bp_status bp_hulls(const bp_mesh* mesh, size_t index, const bp_hulls_options* options, const bp_run* run,
                          bp_mesh** out);

/* ---- Levels of detail, and occluders --------------------------------------------------------------*/

typedef struct bp_levels_options {
  size_t size;
  const uint64_t* faces;   /* triangles of each level, falling. One number: of the finest level; each other level gets a
                              quarter of those before. Neither faces nor errors: the scene decides */
  size_t face_count;       /* numbers in `faces` */
  const bp_length* errors; /* largest distance of each level, rising, in place of `faces`. One number: of the finest
                              level; it doubles from level to level */
  size_t error_count;
  uint32_t levels; /* at most so many, 32 at most; 0: as many as are listed, else 4, or fewer */
  bp_length scale; /* closing radius of the finest level, which doubles from level to level; 0: chosen */
  int32_t mode;    /* bp_mode: bounding (auto), or fit */
  int32_t enclose; /* bp_enclose */
} bp_levels_options;
BP_API void bp_levels_defaults(bp_levels_options* options, size_t size);

/* Makes levels of detail of a scene as bplod does, without colours and textures. `out` holds the levels, finest first:
 * each has fewer triangles than the level before, and a larger error (bp_mesh_info.error_bound: the largest distance
 * that a viewer can see). A level that is not worth having is left out, and a note tells why. Each bounding level
 * strictly encloses the scene, but not the level before. `voxelize`: NULL, or without voxel and resolution: the voxels
 * follow from faces or errors; BP_FILL_INSIDE is refused. Cost: seconds to a minute. */
BP_API bp_status bp_levels(const bp_scene* scene, const bp_voxelize_options* voxelize, const bp_levels_options* options,
                           const bp_run* run, bp_mesh** out);

typedef struct bp_occluder_options {
  size_t size;
  uint64_t faces;   /* most triangles; 0: chosen, some hundred */
  bp_length scale;  /* openings narrower than twice this count as closed; 0: the least that hides nearly the most */
  int32_t no_scale; /* not 0: a scale of exactly 0, which keeps free what one can enter */
} bp_occluder_options;
BP_API void bp_occluder_defaults(bp_occluder_options* options, size_t size);

/* Makes a mesh strictly inside what the scene hides, for occlusion culling, as bplod --profile occluder does. `fill` of
 * `voxelize` is refused. Prove it with bp_check_options.inside. BP_BAD_INPUT if the scene hides nothing. Cost: some
 * seconds at the default of 512 voxels. */
BP_API bp_status bp_occluder(const bp_scene* scene, const bp_voxelize_options* voxelize,
                             const bp_occluder_options* options, const bp_run* run, bp_mesh** out);

/* Writes all meshes of bp_levels(), bp_occluder() or bp_scene_cage() into a folder, with the names and bytes of bplod:
 * NAME_LOD0.glb and so on and NAME.glb with all levels, NAME_occluder.glb, or NAME_cage.obj and NAME_cage.glb. All
 * files appear, or none. The folder is made if it is missing. */
BP_API bp_status bp_levels_save(const bp_mesh* meshes, const char* folder, const char* name, int overwrite);
/* Hands the bytes of these files to `sink`, with their names. */
BP_API bp_status bp_levels_write(const bp_mesh* meshes, const char* name, bp_sink_fn sink, void* user);

/* ---- Cages that deform points ---------------------------------------------------------------------*/

typedef enum bp_symmetry {
  BP_SYMMETRY_AUTO = 0, /* across the axis across which the scene is symmetric, if there is one */
  BP_SYMMETRY_OFF = 1,
  BP_SYMMETRY_X = 2,
  BP_SYMMETRY_Y = 3,
  BP_SYMMETRY_Z = 4
} bp_symmetry;

typedef struct bp_cage_options {
  size_t size;
  uint64_t faces;    /* most triangles, 12 at least, and 20 of a symmetric cage; 0: chosen, 1000 at most */
  bp_length margin;  /* least distance from the scene; 0: 0.5 % of the scene's diagonal */
  int32_t no_margin; /* not 0: a margin of exactly 0 */
  int32_t symmetry;  /* bp_symmetry: the cage is its own mirror image */
} bp_cage_options;
BP_API void bp_cage_defaults(bp_cage_options* options, size_t size);

/* Makes a cage of quads and triangles around a scene as bplod --profile cage does: with a margin, since coordinates
 * bend sharply near a cage, and symmetric. Prove the margin with bp_check_options.margin. Cost: some seconds. */
BP_API bp_status bp_scene_cage(const bp_scene* scene, const bp_voxelize_options* voxelize,
                               const bp_cage_options* options, const bp_run* run, bp_mesh** out);

/* Makes a cage of quads around the scene of a closed grid: at most `faces` triangles, 12 at least. The quads are pairs
 * of triangles, bp_mesh_view.quads; where a pair's other diagonal would cut the scene or the cage, the two triangles
 * stay without a quad. The cage is closed and strictly around the scene, as other proxies are. Cost: a second for 1000
 * faces. */
BP_API bp_status bp_cage(const bp_grid* grid, uint64_t faces, const bp_run* run, bp_mesh** out);

/* Coordinates of points in a cage, rounded to whole numbers as files of bpdeform hold them. */
typedef struct bp_weights bp_weights;

typedef enum bp_coordinates {
  BP_MEAN_VALUE = 0,        /* [JSW05] */
  BP_GREEN = 1,             /* [LLC08]; keeps angles better */
  BP_MAXIMUM_LIKELIHOOD = 2 /* after [CDH23]; none is negative inside */
} bp_coordinates;

typedef struct bp_bind_options {
  size_t size;
  int32_t kind;          /* bp_coordinates */
  int32_t carry_outside; /* not 0: points outside the cage follow its nearest point; else they are an error */
} bp_bind_options;
BP_API void bp_bind_defaults(bp_bind_options* options, size_t size);

/* Computes the coordinates of points (x, y, z each, doubles) in a closed cage, such as a proxy. BP_BAD_INPUT if the
 * mesh is no cage, a point is not finite, or a point lies outside. Memory: 4 bytes for each point and column; the
 * columns are the cage's vertices, with BP_GREEN its faces, too. Cost: microseconds for each 300 faces and point. */
BP_API bp_status bp_bind(const bp_arrays* cage, const double* points, size_t count, const bp_bind_options* options,
                         const bp_run* run, bp_weights** out);
/* Moves the points: `moved` has the cage's vertices in their new places, bp_weights_cage_count() of them, in the same
 * order. `out` gets x, y, z of each point; it may be the array of points that was bound. */
BP_API bp_status bp_weights_apply(const bp_weights* weights, const double* moved, const bp_run* run, double* out);
BP_API size_t bp_weights_count(const bp_weights* weights);      /* of points */
BP_API size_t bp_weights_cage_count(const bp_weights* weights); /* of vertices of the cage */
BP_API void bp_weights_free(bp_weights* weights);

#ifdef __cplusplus
}
#endif
#endif
