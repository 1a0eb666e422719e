#pragma once
#include <algorithm>
#include <array>

#include "lib/core/grid_frame.h"
#include "lib/core/vec3.h"
#include "lib/geometry/triangle_bvh.h"
#include "lib/mesh/lattice_geometry.h"

namespace bp {

/// The triangles of a simple scene. They tell at once that all of a large face is near, or that a corner is far.
/// Otherwise pieces of the face are looked up in thousands of voxels.
class NearTriangles {
 public:
  static constexpr std::size_t kMost = 4096;  ///< triangles; of more, each is near a small part of a face

  /// In scene units; one or more. Copied, and kept in the lattice units of the frame.
  NearTriangles(const std::vector<TriangleD>& triangles, const GridFrame& frame)
      : tree_(in_lattice(triangles, frame)) {}

  /// Whether the triangle nearest to the middle of a face is within `distance` of its corners, lattice units, and so of
  /// all of it. `guess`: as for TriangleBvh::near_enough(); 0 at first.
  [[nodiscard]] bool is_near(const std::array<LatticeCoord, 3>& face, double distance, std::uint32_t& guess) const {
    const Vec3d middle = (1.0 / 3) * (to_double(face[0]) + to_double(face[1]) + to_double(face[2]));
    guess = tree_.nearest(middle, guess).item;
    const TriangleD& nearest = tree_.item(guess).corners;
    for (const LatticeCoord& corner : face) {
      if (distance_squared(to_double(corner), nearest) > distance * distance) return false;
    }
    return true;
  }
  /// Whether a corner is that far from all triangles, lattice units.
  [[nodiscard]] bool is_far(const std::array<LatticeCoord, 3>& face, double distance, std::uint32_t& guess) const {
    return std::any_of(face.begin(), face.end(), [&](const LatticeCoord& corner) {
      const TriangleBvh::Nearest nearest = tree_.near_enough(to_double(corner), distance * distance, guess);
      guess = nearest.item;
      return nearest.distance_squared > distance * distance;
    });
  }
  [[nodiscard]] std::uint64_t bytes() const { return tree_.bytes(); }

 private:
  static std::vector<TriangleD> in_lattice(std::vector<TriangleD> triangles, const GridFrame& frame) {
    for (TriangleD& t : triangles) {
      for (Vec3d& p : t) p = double(kLatticePerVoxel) * frame.to_voxels(p);
    }
    return triangles;
  }

  TriangleBvh tree_;
};

}  // namespace bp
