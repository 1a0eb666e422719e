#pragma once
#include <span>
#include <vector>

#include "lib/levels/lod_level.h"

/// What convex levels of all kinds are made of.
namespace bp {

/// Corners of all triangles, in lattice units of the frame. None if there are more than 2^20 triangles, whose corners
/// take 72 MiB.
[[nodiscard]] std::vector<Vec3d> scene_corners(const GridFrame& frame, std::span<const TriangleD> scene);

/// `mesh`, which lies around all that is enclosed, and of which only vertices and triangles count, as a level.
[[nodiscard]] LodLevel convex_level(const LodLevel& place, const LatticeMesh& mesh);

}  // namespace bp
