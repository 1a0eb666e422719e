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

/* ---- Cages that deform points ---------------------------------------------------------------------*/

/* Makes a cage of nothing but quads around the scene of a closed grid: at most `faces` triangles, 12 at least. The
 * quads are pairs of triangles, bp_mesh_view.quads. The cage is closed and strictly around the scene, as other proxies
 * are. Cost: a second for 1000 faces. */
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
/* Moves the points: `moved` has the cage's vertices in their new places, as many and in the same order. `out` gets x,
 * y, z of each point; it may be the array of points that was bound. */
BP_API bp_status bp_weights_apply(const bp_weights* weights, const double* moved, const bp_run* run, double* out);
BP_API size_t bp_weights_count(const bp_weights* weights); /* of points */
BP_API void bp_weights_free(bp_weights* weights);

#ifdef __cplusplus
}
#endif
#endif
