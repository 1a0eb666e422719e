#pragma once
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "lib/core/box.h"
#include "lib/core/triangle_source.h"
#include "lib/pass/voxelize/stray_part.h"

namespace bp {

/// The area of a scene in bins along each axis, whose width grows with the distance from a point of the scene, and the
/// volume that the triangles go around. Sums of doubles: for notes, not for decisions. 270 KiB.
class SurfaceSums {
 public:
  /// `origin`: a point of the scene, the same for all sums that are merged.
  explicit SurfaceSums(const Vec3d& origin = {}) : origin_(origin) {}
  void add(std::span<const TriangleD> triangles);
  void merge(const SurfaceSums& other);
  /// Starts anew, as constructed; keeps the memory.
  void reset(const Vec3d& origin);

  [[nodiscard]] const Bounds3d& bounds() const { return bounds_; }
  [[nodiscard]] double area() const { return area_; }      ///< area of all triangles
  [[nodiscard]] double extent() const { return extent_; }  ///< sides of all triangles' boxes
  /// Returns the part of the scene that makes its bounds large, if that part has a small share of the area.
  [[nodiscard]] std::optional<StrayPart> stray() const;
  /// Returns the signed volume, seen from the middle of the bounds; for a closed surface it is the volume inside.
  [[nodiscard]] double volume() const;

 private:
  static constexpr int kOctaves = 100, kPerOctave = 8, kHalf = kOctaves * kPerOctave, kBins = 2 * kHalf + 1;
  struct Bin {
    double area = 0;
    Bounds3d bounds;  // bounds of the bin's triangles
  };
  struct Axis {
    std::vector<Bin> bins;               // none until the first triangle
    std::size_t begin = kBins, end = 0;  // range of bins with triangles; others may lie between them
    void add(std::size_t i, const Bin& bin);
  };
  struct Lanes;
  [[nodiscard]] static std::size_t bin_of(double distance);
  struct Split {
    Bounds3d part, rest;
    double area = 0;  // area of the part
  };
  [[nodiscard]] Split split(std::size_t axis) const;

  Vec3d origin_;
  std::array<Axis, 3> axes_;
  Bounds3d bounds_;
  double area_ = 0, extent_ = 0, volume_ = 0;  // volume_: seen from the origin
  Vec3d normals_{};                            // sum of the normals, with lengths of twice the areas
};

}  // namespace bp
