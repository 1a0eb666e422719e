#pragma once
#include <span>
#include <vector>

#include "lib/levels/lod_level.h"

/// Convex meshes that may replace a bounding level: a box around the scene; for a flat scene also the prism around its
/// outline; for a convex one also its hull. They are exact for scenes of that shape, and a good choice for few faces.
namespace bp {

struct ConvexLevel {
  const char* way;  ///< "box", "prism" or "hull"
  LodLevel level;
};

/// Returns the convex meshes that have at most `faces` faces. Their error is not measured. `place`: a level without a
/// mesh; the results take its frame and scale. `bounds`: of everything that is enclosed; scene units. `corners`:
/// scene_corners(); empty if only voxels are known, and then there is a box only.
[[nodiscard]] std::vector<ConvexLevel> convex_levels(const LodLevel& place, const Bounds3d& bounds,
                                                     std::span<const Vec3d> corners, double off, std::uint64_t faces);

/// Returns a prism around a flat scene of `corners` (scene_corners()), which may be off by `off` lattice units, as a
/// level in the place of `level`. Its ends are parallel to the scene's plane, its sides stand on the scene's convex
/// outline, and all lie a few lattice units away. An outline of n corners makes 4 n - 4 triangles; if these are more
/// than `faces`, the outline is grown to fewer corners. Returns nothing in these cases:
///   - the scene is thicker than a voxel;
///   - the outline is a needle, or has more than 4096 corners;
///   - it cannot be grown to so few corners, as a parallelogram cannot to three;
///   - `faces` is below 8.
/// The error is not measured. Takes O(n log n) for the scene's n corners, and O(m^2) for the outline's m.
[[nodiscard]] std::optional<LodLevel> prism_level(const LodLevel& level, std::span<const Vec3d> corners, double off,
                                                  std::uint64_t faces);

/// Returns the convex hull of `corners` (scene_corners()), which may be off by `off` lattice units, grown by these and
/// a few more, as a level in the place of `level`. Returns nothing in these cases:
///   - the hull has more than `faces` or 16,384 faces;
///   - it is flat, or so thin that its corners would move by half a voxel;
///   - the scene has more than 65,536 triangles.
/// The error is not measured. Takes O(n log n) for n corners, and O(f^2) for f faces of the hull.
[[nodiscard]] std::optional<LodLevel> hull_level(const LodLevel& level, std::span<const Vec3d> corners, double off,
                                                 std::uint64_t faces);

/// Returns the corners of all triangles, in lattice units of the frame. Empty if there are more than 2^20 triangles,
/// whose corners take 72 MiB.
[[nodiscard]] std::vector<Vec3d> scene_corners(const GridFrame& frame, std::span<const TriangleD> scene);

/// Makes a level from the vertices and triangles of `mesh`, which must enclose the scene. Frame, provenance and scale
/// are those of `place`.
[[nodiscard]] LodLevel convex_level(const LodLevel& place, const LatticeMesh& mesh);

}  // namespace bp
