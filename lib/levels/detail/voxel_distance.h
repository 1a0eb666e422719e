#pragma once
#include <span>

#include "lib/geometry/triangle_bvh.h"
#include "lib/volume/boundary_runs.h"

/// Distances between a mesh and a surface of which only the voxels are known: those that it touches, as runs. Upper
/// bounds, up to the rounding of doubles.
namespace bp {

constexpr double kTriangleTolerance = 1.0 / 16;  ///< of distances to triangles of the scene, in voxels

/// Runs as segments through the middles of their voxels, scene units (triangles of no width).
[[nodiscard]] std::vector<TriangleD> segments_of(std::span<const VoxelRun> runs, const GridFrame& frame);

/// No point of `mesh` is farther from the surface, if every voxel of the runs behind `segments`, of edge `voxel`, holds
/// a point of it. Neither may be empty.
[[nodiscard]] double distance_from_mesh(const std::vector<TriangleD>& mesh, const TriangleBvh& segments, double voxel);

/// No point of the surface that lies outside of a closed mesh is farther from it. `mesh` is over it; every point of the
/// surface lies in a voxel of the runs behind `segments`, and is outside if the centre of that voxel has a winding
/// number below 1. Never below `at_least`, which must exceed a voxel: what is nearer costs one look.
[[nodiscard]] double distance_beyond_mesh(const std::vector<TriangleD>& segments, const TriangleBvh& mesh, double voxel,
                                          double at_least);

/// Which of the segments have a point in their voxels that may be farther from the mesh than `limit`, in their order.
[[nodiscard]] std::vector<std::uint32_t> far_segments(const std::vector<TriangleD>& segments, const TriangleBvh& mesh,
                                                      double voxel, double limit);

/// Of a closed mesh around p.
[[nodiscard]] int winding_number(const TriangleBvh& mesh, const Vec3d& p);

}  // namespace bp
