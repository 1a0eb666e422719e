#pragma once
#include <span>

#include "lib/geometry/triangle_bvh.h"
#include "lib/volume/boundary_runs.h"

/// Distances between a mesh and a surface of which only the voxels that it touches are known, as runs. The results are
/// upper bounds, up to the rounding of doubles.
namespace bp {

constexpr double kTriangleTolerance = 1.0 / 16;  ///< of distances to the scene's triangles, in voxels

/// Returns the runs as segments through the middles of their voxels, scene units. A segment is a triangle of no width.
[[nodiscard]] std::vector<TriangleD> segments_of(std::span<const VoxelRun> runs, const GridFrame& frame);

/// Returns an upper bound of the distance of any point of `mesh` to the surface. Every voxel (of edge `voxel`) of the
/// runs behind `segments` must hold a point of the surface. Neither may be empty.
[[nodiscard]] double distance_from_mesh(const std::vector<TriangleD>& mesh, const TriangleBvh& segments, double voxel);

/// Returns an upper bound of the distance to a closed mesh of any point of the surface that lies outside it. `mesh` is
/// the tree over that mesh. Every point of the surface lies in a voxel of the runs behind `segments`; it is outside if
/// the winding number at that voxel's centre is below 1. The result is at least `at_least`, which must exceed a voxel:
/// then a voxel nearer than that costs one test.
[[nodiscard]] double distance_beyond_mesh(const std::vector<TriangleD>& segments, const TriangleBvh& mesh, double voxel,
                                          double at_least);

/// Returns the numbers of the segments, in their order, whose voxels may have a point farther from the mesh than
/// `limit`.
[[nodiscard]] std::vector<std::uint32_t> far_segments(const std::vector<TriangleD>& segments, const TriangleBvh& mesh,
                                                      double voxel, double limit);

/// Returns the winding number of a closed mesh around p.
[[nodiscard]] int winding_number(const TriangleBvh& mesh, const Vec3d& p);

}  // namespace bp
