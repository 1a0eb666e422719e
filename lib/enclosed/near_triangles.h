#pragma once
#include <array>
#include <span>
#include <vector>

#include "lib/core/grid_frame.h"
#include "lib/enclosed/enclosed.h"
#include "lib/geometry/triangle_bvh.h"

namespace bp {

/// Answers what is near a scene of few triangles. A single triangle may be near all of a large face, whereas masks are
/// looked up for each piece of the face.
class NearTriangles {
 public:
  /// `triangles`: scene units, at least one. Copied, and kept in the lattice units of the frame.
  NearTriangles(const std::vector<TriangleD>& triangles, const GridFrame& frame);

  /// As Enclosed::is_near(), plus half of a voxel's diagonal, since voxels that hold a point of a wall reach as far
  /// beyond it. May return true up to kUpTo times the distance. Cost: a search for each piece that no single triangle
  /// is near.
  [[nodiscard]] bool is_near(std::span<const NewFace> faces, double distance) const;
  static constexpr double kUpTo = 1.35;
  [[nodiscard]] std::uint64_t bytes() const { return tree_.bytes(); }

 private:
  [[nodiscard]] bool is_near(const TriangleD& face, double distance, std::uint32_t& guess) const;

  TriangleBvh tree_;
};

}  // namespace bp
