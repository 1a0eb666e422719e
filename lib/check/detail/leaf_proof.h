#pragma once
#include <atomic>
#include <vector>

#include "lib/geometry/triangle_bvh.h"

/// Decides whether a leaf is the scene itself, both ways: each of its triangles lies on a triangle of the scene, and
/// each triangle of the scene is covered by triangles of the leaf that lie on it.
namespace bp {

/// Returns the part of a triangle in a closed box: a convex polygon, or nothing. The side of a face on which a point
/// lies is exact, as it is when leaves are cut: a triangle just beyond a face belongs to the neighbour. New points are
/// rounded.
[[nodiscard]] std::vector<Vec3d> part_within(const TriangleD& t, const Bounds3d& box);

class LeafProof {
 public:
  /// Keeps a reference to the leaf's triangles. `flat`: the largest error that counts when a part is excused as flat
  /// (Cover::flat), scene units. A leaf with a larger error cannot have more parts excused.
  LeafProof(const TriangleBvh& shown, const Bounds3d& cell, double flat)
      : shown_(shown), cell_(cell), flat_(flat), on_scene_(shown.size()) {}

  enum class Cover { whole, thin, flat, missing, undecided };
  /// Compares a part of the scene with the leaf. `part`: the part of a triangle of the scene in the leaf's cell, a
  /// convex polygon. Notes the triangles of the leaf that lie within `error` of it and face as it does. Returns whole
  /// if each point of the part lies within 3 errors of one of these, or if the part has no area. A part thinner than
  /// six errors is compared in another way: whole if one triangle of the leaf has all of its corners within 3 errors,
  /// thin if several have, or if one face of the cell has; flat if its corners lie on a line once each moves by the
  /// error, as rounding moves them; else undecided. Thread-safe. O(n log n) for n triangles of the leaf near the part,
  /// in practice.
  Cover add(const std::vector<Vec3d>& part, double error);
  /// Returns the number of the leaf's triangles that lie on no part so far.
  [[nodiscard]] std::uint64_t strays() const;

 private:
  Cover add_thin(const std::vector<Vec3d>& part, double error);
  [[nodiscard]] std::vector<const TriangleBvh::Item*> near(const std::vector<Vec3d>& part, double error) const;

  const TriangleBvh& shown_;
  const Bounds3d cell_;
  const double flat_;
  std::vector<std::atomic<bool>> on_scene_;
};

}  // namespace bp
