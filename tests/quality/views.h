#pragma once
#include <cstdint>
#include <vector>

#include "lib/core/box.h"
#include "lib/core/coords.h"

/// Orthographic views of triangle meshes: what is seen of them, and their silhouettes.
namespace bp::quality {

/// A direction to look along, and the axes of the picture.
struct ViewAxes {
  Vec3d right, up, forward;
};
/// 36 views from 12 sides at elevations of 0, 15 and 45 degrees; y is up, for silhouettes.
[[nodiscard]] std::vector<ViewAxes> silhouette_views();
/// Returns the silhouette views, and 12 from below and 2 along y: they show all of a mesh except deep folds.
[[nodiscard]] std::vector<ViewAxes> all_views();

/// The content of one view: for each pixel the triangle that is nearest to the viewer, and its distance.
class Picture {
 public:
  static constexpr int kSide = 300;
  static constexpr std::uint32_t kNothing = ~std::uint32_t(0);

  /// `bounds` decides the frame, so that pictures of two meshes can be compared: 1.15 times the sphere around it.
  Picture(const ViewAxes& axes, const Bounds3d& bounds);
  void draw(const std::vector<TriangleD>& mesh);

  [[nodiscard]] std::uint32_t triangle(int x, int y) const { return triangle_[index(x, y)]; }
  [[nodiscard]] bool covered(int x, int y) const { return triangle(x, y) != kNothing; }
  /// The point that is seen there; the pixel must be covered.
  [[nodiscard]] Vec3d point(int x, int y) const;

 private:
  static std::size_t index(int x, int y) { return std::size_t(y) * kSide + std::size_t(x); }
  [[nodiscard]] Vec3d projected(const Vec3d& p) const;
  void draw(const TriangleD& t, std::uint32_t number);

  ViewAxes axes_;
  Vec3d centre_{};
  double pixels_per_unit_ = 1;
  std::vector<std::uint32_t> triangle_;
  std::vector<double> depth_;
};

}  // namespace bp::quality
