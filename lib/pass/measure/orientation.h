#pragma once
#include <array>
#include <memory>
#include <vector>

#include "lib/grid/stream.h"

/// Makes orientation fields: from a scene's surface, or from frames at a few places.
namespace bp {

class OrientationMaker {
 public:
  /// For a closing of the grid of `header` by cubes of about this scale: cells are as large as the scale, or larger,
  /// and at most 32 along each axis. Throws bad_input if the header has no scene.
  OrientationMaker(const StreamHeader& header, double scale_world);
  ~OrientationMaker();
  OrientationMaker(const OrientationMaker&) = delete;
  OrientationMaker& operator=(const OrientationMaker&) = delete;

  /// A triangle of the scene: cubes stand on it, by its area.
  void add(const TriangleD& triangle);
  /// A frame at a place, at right angles, of unit length: what is there is turned so.
  void add(const Vec3d& at, const std::array<Vec3d, 3>& axes);

  /// Smooth between what was added, and nearly constant where it can be: rotations within 2 degrees of each other are
  /// one. The same field for any number of threads.
  [[nodiscard]] OrientationField make() const;

 private:
  struct Sums;
  std::unique_ptr<Sums> sums_;
};

}  // namespace bp
