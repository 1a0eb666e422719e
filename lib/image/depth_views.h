#pragma once
#include <span>
#include <vector>

#include "lib/core/box.h"

namespace bp {

/// Orthographic views of triangles from 14 directions: along the axes, and from the corners of a cube. They tell how
/// much of what an eye sees of one surface differs on another one.
class DepthViews {
 public:
  /// Draws the triangles so that `bounds` fill each view; what lies beyond them by more than an eighth is cut off.
  DepthViews(std::span<const TriangleD> triangles, const Bounds3d& bounds);

  /// Returns the share of the pixels, of those that show one of both, that both show otherwise, as a mean over all
  /// views. A pixel that only one of them covers counts fully, and one where the nearest points are an eighth of the
  /// bounds' diagonal apart, too; less of a distance counts in proportion.
  [[nodiscard]] double difference(std::span<const TriangleD> others) const;

  static constexpr std::size_t kViews = 14;
  static constexpr int kSide = 256;  ///< pixels

 private:
  using Depths = std::vector<float>;  ///< by pixel; infinite: nothing is there
  [[nodiscard]] Depths drawn(std::span<const TriangleD> triangles, std::size_t view) const;

  Bounds3d bounds_;
  std::vector<Depths> views_;
};

}  // namespace bp
