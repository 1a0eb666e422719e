#pragma once
#include <span>

#include "lib/geometry/triangle_bvh.h"
#include "lib/volume/boundary_rects.h"
#include "lib/volume/boundary_runs.h"

/// Distances between a fit and the triangles that a scene shows to the outside, which is the empty voxels. The results
/// are upper bounds, up to the rounding of doubles, and sharper than those of voxel_distance.h.
namespace bp {

constexpr std::uint64_t kMostShownPoints = std::uint64_t(1) << 20;

/// Returns points of the scene that are shown, as triangles whose corners are the same. For each face between a voxel
/// and an empty one, it takes the nearest point of the scene: nothing lies in between. Points are about a voxel apart;
/// if there are more than kMostShownPoints faces, only about so many of them are used. Returns nothing if a face has no
/// triangle near it: then the triangles are not those of the voxels. Parallel; the result does not depend on the number
/// of threads.
[[nodiscard]] std::vector<TriangleD> shown_points(std::span<const FaceRect> faces, const TriangleBvh& scene,
                                                  const GridFrame& frame);

/// Returns an upper bound of the distance to the mesh of any point of the scene that lies outside the mesh, in voxels
/// of the runs. The mesh is closed. The result is at least `at_least`, and sharp if it is a voxel or more. `segments`:
/// segments_of() the runs.
[[nodiscard]] double distance_beyond_mesh(std::span<const VoxelRun> runs, const std::vector<TriangleD>& segments,
                                          const TriangleBvh& scene, const GridFrame& frame, const TriangleBvh& mesh,
                                          double at_least);

}  // namespace bp
