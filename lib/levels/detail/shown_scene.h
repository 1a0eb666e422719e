#pragma once
#include <span>

#include "lib/geometry/triangle_bvh.h"
#include "lib/volume/boundary_rects.h"
#include "lib/volume/boundary_runs.h"

/// Distances between a mesh that need not enclose and what the triangles of a scene show to the outside, which is empty
/// voxels. Upper bounds, up to the rounding of doubles. Sharper than those of voxel_distance.h.
namespace bp {

constexpr std::uint64_t kMostShownPoints = std::uint64_t(1) << 20;

/// Points that are shown, as triangles of one point: the nearest ones to the faces between the scene's voxels and empty
/// ones. Nothing lies between. They are about a voxel apart; farther if there are more than kMostShownPoints faces, of
/// which so many are asked. Empty if a face has nothing of the scene near: the triangles are not those of the voxels.
/// Parallel; the same for any number of threads.
[[nodiscard]] std::vector<TriangleD> shown_points(std::span<const FaceRect> faces, const TriangleBvh& scene,
                                                  const GridFrame& frame);

/// No point of `mesh` is farther from what is shown, of which `shown` are points.
[[nodiscard]] double distance_from_mesh_to_shown(const std::vector<TriangleD>& mesh,
                                                 const std::vector<TriangleD>& shown, double voxel);

/// No point of the scene in voxels of the runs that lies outside the mesh is farther from it. The mesh is closed. Never
/// below `at_least`; sharp from a voxel on. `segments`: of the runs, as segments_of() has them.
[[nodiscard]] double distance_beyond_mesh(std::span<const VoxelRun> runs, const std::vector<TriangleD>& segments,
                                          const TriangleBvh& scene, const GridFrame& frame, const TriangleBvh& mesh,
                                          double at_least);

}  // namespace bp
