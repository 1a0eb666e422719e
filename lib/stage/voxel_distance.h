#pragma once
#include <span>

#include "lib/geometry/triangle_bvh.h"
#include "lib/grid/boundary_runs.h"

/// Distances between a mesh and a surface of which only the voxels are known: those that it touches, as runs. Upper
/// bounds, up to the rounding of doubles.
namespace bp {

/// Runs as segments through the middles of their voxels, scene units (triangles of no width).
[[nodiscard]] std::vector<TriangleD> segments_of(std::span<const VoxelRun> runs, const GridFrame& frame);

/// No point of `mesh` is farther from the surface, if every voxel of the runs behind `segments`, of edge `voxel`, holds
/// a point of it. Neither may be empty.
[[nodiscard]] double distance_from_mesh(const std::vector<TriangleD>& mesh, const TriangleBvh& segments, double voxel);

/// No point of the surface is farther from `mesh`, if every one lies in a voxel of the runs behind `segments`. 0
/// without segments.
[[nodiscard]] double distance_to_mesh(const std::vector<TriangleD>& segments, const std::vector<TriangleD>& mesh,
                                      double voxel);

}  // namespace bp
