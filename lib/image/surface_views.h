#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lib/core/box.h"

namespace bp {

/// Orthographic views of triangles from 14 directions: along the axes, and from the corners of a cube. They tell how
/// much of what an eye sees of one surface differs on another one.
class SurfaceViews {
 public:
  /// Draws the triangles so that `bounds` fill each view; what lies beyond them by more than an eighth is cut off.
  SurfaceViews(std::span<const TriangleD> triangles, const Bounds3d& bounds);

  /// Returns the share of the pixels, of those that show one of both, that both show otherwise, as a mean over all
  /// views. A pixel that only one of them covers counts fully, and one where the surfaces stand across each other, or
  /// an eighth of the bounds' diagonal apart, too; less of an angle or a distance counts in part.
  [[nodiscard]] double difference(std::span<const TriangleD> others) const;

  /// Returns the numbers of the triangles that a pixel shows, in order.
  [[nodiscard]] std::vector<std::uint32_t> shown() const;

  static constexpr std::size_t kViews = 14;
  static constexpr int kSide = 256;  ///< pixels

 private:
  struct Pixel {
    float depth;             // infinite: nothing is there
    std::uint32_t triangle;  // that is seen
  };
  using Pixels = std::vector<Pixel>;
  [[nodiscard]] Pixels drawn(std::span<const TriangleD> triangles, std::size_t view) const;

  Bounds3d bounds_;
  std::vector<std::array<float, 3>> normals_;  // by triangle, of length 1
  std::vector<Pixels> views_;
};

}  // namespace bp
