#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "lib/core/box.h"

namespace bp {

/// Orthographic views of triangles from 14 directions: along the axes, and from the corners of a cube. They tell how
/// much of what an eye sees of one surface differs on another one.
class SurfaceViews {
 public:
  using Color = std::array<std::uint8_t, 3>;  ///< sRGB
  /// Returns the colour of a triangle at these shares of its corners, as a mean over a square of this side. Is called
  /// from several threads.
  using ColorAt = std::function<Color(std::uint32_t triangle, const std::array<double, 3>& shares, double side)>;

  /// Draws the triangles so that `bounds` fill each view; what lies beyond them by more than an eighth is cut off.
  /// Without colours, colours have no say.
  SurfaceViews(std::span<const TriangleD> triangles, const Bounds3d& bounds, const ColorAt& color = {});

  /// Returns the share of the pixels, of those that show one of both, that both show otherwise, as a mean over all
  /// views. A pixel that only one of them covers counts fully, and one where the surfaces stand across each other, or
  /// an eighth of the bounds' diagonal apart, or are black and white, too; less of an angle, a distance or a colour
  /// counts in part. Without colours, the others are taken to have those of the surface.
  [[nodiscard]] double difference(std::span<const TriangleD> others, const ColorAt& color = {}) const;

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
  using Colors = std::vector<Color>;  // of pixels; empty: colours have no say
  [[nodiscard]] double pixels_per_unit() const;
  [[nodiscard]] Pixels drawn(std::span<const TriangleD> triangles, std::size_t view) const;
  [[nodiscard]] Colors colors_of(std::span<const TriangleD> triangles, std::size_t view, const Pixels& pixels,
                                 const ColorAt& color) const;

  Bounds3d bounds_;
  std::vector<std::array<float, 3>> normals_;  // by triangle, of length 1
  std::vector<Pixels> views_;
  std::vector<Colors> colors_;  // by view
};

}  // namespace bp
