#pragma once
#include <span>
#include <vector>

#include "lib/levels/lod_level.h"

/// Helpers that all convex levels (box, prism, hull) share.
namespace bp {

/// Returns the corners of all triangles, in lattice units of the frame. Empty if there are more than 2^20 triangles,
/// whose corners take 72 MiB.
[[nodiscard]] std::vector<Vec3d> scene_corners(const GridFrame& frame, std::span<const TriangleD> scene);

/// Makes a level from the vertices and triangles of `mesh`, which must enclose the scene. Frame, provenance and scale
/// are those of `place`.
[[nodiscard]] LodLevel convex_level(const LodLevel& place, const LatticeMesh& mesh);

}  // namespace bp
