#pragma once
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "lib/core/box.h"
#include "lib/core/triangle_source.h"
#include "lib/pass/voxelize/stray_part.h"

namespace bp {

/// Where the area of a scene lies, in bins along each axis that grow with the distance from a point of the scene, and
/// the volume that its triangles go around. Sums of doubles: for notes, not for decisions. 270 KiB.
class SurfaceSums {
 public:
  /// `origin`: a point of the scene, the same for all sums that are merged.
  explicit SurfaceSums(const Vec3d& origin = {}) : origin_(origin) {}
  void add(std::span<const TriangleD> triangles);
  void merge(const SurfaceSums& other);
  /// As constructed; keeps the memory.
  void reset(const Vec3d& origin);

  [[nodiscard]] const Bounds3d& bounds() const { return bounds_; }
  [[nodiscard]] double area() const { return area_; }      ///< of all triangles
  [[nodiscard]] double extent() const { return extent_; }  ///< of all triangles: sides of their boxes
  /// What makes the bounds large, if a small share of the area does.
  [[nodiscard]] std::optional<StrayPart> stray() const;
  /// Signed, seen from the middle of the bounds: of a closed surface its volume.
  [[nodiscard]] double volume() const;

 private:
  static constexpr int kOctaves = 100, kPerOctave = 8, kHalf = kOctaves * kPerOctave, kBins = 2 * kHalf + 1;
  struct Bin {
    double area = 0;
    Bounds3d bounds;  // of its triangles
  };
  struct Axis {
    std::vector<Bin> bins;               // none until the first triangle
    std::size_t begin = kBins, end = 0;  // of those with triangles, and perhaps others between them
    void add(std::size_t i, const Bin& bin);
  };
  struct Lanes;
  [[nodiscard]] static std::size_t bin_of(double distance);
  struct Split {
    Bounds3d part, rest;
    double area = 0;  // of the part
  };
  [[nodiscard]] Split split(std::size_t axis) const;

  Vec3d origin_;
  std::array<Axis, 3> axes_;
  Bounds3d bounds_;
  double area_ = 0, extent_ = 0, volume_ = 0;  // the latter from the origin
  Vec3d normals_{};                            // sum of the normals, as long as twice the areas
};

}  // namespace bp
