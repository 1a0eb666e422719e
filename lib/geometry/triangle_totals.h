#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "lib/core/box.h"
#include "lib/core/coords.h"
#include "lib/core/triangle_source.h"
#include "lib/geometry/signed_volume.h"

/// Sums over a triangle soup: what a summary of a mesh tells.
namespace bp {

struct TriangleTotals {
  std::uint64_t triangles = 0;
  Bounds3d bounds;                     ///< of the finite corners
  double area = 0;                     ///< scene units squared
  std::optional<double> volume = 0.0;  ///< enclosed; none if it is open (SignedVolume)
  std::uint64_t checksum_low = 0, checksum_high = 0;

  void add(std::span<const TriangleD> batch);
  /// 32 hexadecimal digits: of the triangles as a set with multiplicity. Independent of their order, of the corner that
  /// each begins with, of shared vertices; not of orientation. The sum modulo 2^128 of the XXH3-128 of the nine
  /// doubles of each triangle, turned to begin with its smallest corner, -0 taken as 0.
  [[nodiscard]] std::string checksum() const;

 private:
  SignedVolume sum_;  ///< from the first corner
};

/// Of all corners. Reads the scene once, from its start.
[[nodiscard]] Bounds3d bounds_of(TriangleSource& scene);

}  // namespace bp
