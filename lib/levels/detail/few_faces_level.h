#pragma once
#include "lib/levels/lod_chain.h"

/// Bounding levels of so few faces that one way to them may lead anywhere: several are tried, and the nearest is taken.
/// A box is tried for all that come out with few faces, or hold more than it; of a flat scene its prism, too,
/// and of a convex one its hull.
namespace bp {

/// Whether the target is nothing but a number of faces below 32.
[[nodiscard]] bool is_of_few_faces(const LodTarget& target);

/// Whether it has fewer than 32.
[[nodiscard]] bool has_few_faces(const LodLevel& level);

/// Whether another way may lead to few enough faces: all parts and handles are kept, and each takes four. Where there
/// are several, none was seen to lead from more than twice as many.
[[nodiscard]] bool may_have_faces(const LodLevel& level, std::uint64_t faces);

/// Of all triangles, in lattice units of the frame. None if there are more than 2^20, which take 72 MiB.
[[nodiscard]] std::vector<Vec3d> scene_corners(const GridFrame& frame, std::span<const TriangleD> scene);

/// A convex mesh around all that is enclosed, of which only vertices and triangles count: a level in the place of
/// `level`, with its frame and scale. Its distances are not measured.
[[nodiscard]] LodLevel convex_level(const LodLevel& level, const LatticeMesh& mesh);

/// The box that lies around `bounds`, scene units, by a lattice unit or two: a level as of convex_level().
[[nodiscard]] LodLevel box_level(const LodLevel& level, const Bounds3d& bounds);

/// Whether a convex level may lie within `near` lattice units of the scene of `corners`: the middle of its largest face
/// does. O(n).
[[nodiscard]] bool may_be_near(const LodLevel& convex, std::span<const Vec3d> corners, double near);

/// By volume.
[[nodiscard]] bool holds_no_more(const LodLevel& level, const LodLevel& other, double share = 0);

/// Which of two measured levels is better for a target of few faces: one that has no more than these, or else the
/// nearer one.
[[nodiscard]] bool is_better(const LodLevel& level, const LodLevel& other, std::uint64_t faces);
/// The same of a box, a prism or a hull, which has to be clearly nearer if it holds more.
[[nodiscard]] bool is_better_box(const LodLevel& box, const LodLevel& other, std::uint64_t faces);

}  // namespace bp
