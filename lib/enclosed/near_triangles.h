#pragma once
#include <array>
#include <span>
#include <vector>

#include "lib/core/grid_frame.h"
#include "lib/enclosed/enclosed.h"
#include "lib/geometry/triangle_bvh.h"

namespace bp {

/// Tells what is near a scene of few triangles. One of them may be near all of a large face, where voxels would be
/// looked up for each piece of it.
class NearTriangles {
 public:
  /// In scene units; one or more. Copied, and kept in the lattice units of the frame.
  NearTriangles(const std::vector<TriangleD>& triangles, const GridFrame& frame);

  /// As Enclosed::is_near(), with half of a voxel's diagonal more: voxels that hold a point of a wall reach as far
  /// beyond it. May be true up to kUpTo times the distance. Cost: a search for each piece that no single triangle is
  /// near.
  [[nodiscard]] bool is_near(std::span<const NewFace> faces, double distance) const;
  static constexpr double kUpTo = 1.35;
  [[nodiscard]] std::uint64_t bytes() const { return tree_.bytes(); }

 private:
  [[nodiscard]] bool is_near(const TriangleD& face, double distance, std::uint32_t& guess) const;

  TriangleBvh tree_;
};

}  // namespace bp
