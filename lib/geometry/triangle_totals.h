#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "lib/core/box.h"
#include "lib/core/coords.h"
#include "lib/core/triangle_source.h"
#include "lib/geometry/signed_volume.h"

/// Sums over a triangle soup, for summaries of meshes.
namespace bp {

struct TriangleTotals {
  std::uint64_t triangles = 0;
  Bounds3d bounds;                     ///< of all finite corners
  double area = 0;                     ///< scene units squared
  std::optional<double> volume = 0.0;  ///< enclosed volume; none if the soup is open (SignedVolume)
  std::uint64_t checksum_low = 0, checksum_high = 0;

  void add(std::span<const TriangleD> batch);
  /// Returns 32 hexadecimal digits for the triangles as a set with multiplicity. They do not depend on the order of
  /// triangles, on the corner that each begins with, or on shared vertices, but on orientation. They are the sum modulo
  /// 2^128 of the XXH3-128 of the nine doubles of each triangle, turned to begin with its smallest corner, with -0
  /// taken as 0.
  [[nodiscard]] std::string checksum() const;

 private:
  SignedVolume sum_;  ///< its origin is the first corner
};

/// Returns the bounds of all corners. Reads the scene once, from its start.
[[nodiscard]] Bounds3d bounds_of(TriangleSource& scene);

}  // namespace bp
