#pragma once
#include <array>
#include <memory>
#include <vector>

#include "lib/grid/stream.h"

/// Makes orientation fields: from a scene's surface, or from frames at a few places.
namespace bp {

/// Returns the edge of the cells for a closing by cubes of about this scale, in voxels. Scales of one edge have one
/// field.
[[nodiscard]] std::int32_t orientation_cell_vox(const StreamHeader& header, double scale_world);

class OrientationMaker {
 public:
  /// Prepares a field for a closing of the grid of `header` by cubes of about this scale. Cells are as large as the
  /// scale, or larger, and at most 32 along each axis. Throws bad_input if the header has no scene.
  OrientationMaker(const StreamHeader& header, double scale_world);
  ~OrientationMaker();
  OrientationMaker(const OrientationMaker&) = delete;
  OrientationMaker& operator=(const OrientationMaker&) = delete;

  /// Adds a triangle of the scene. Cubes stand on it, with a weight by its area.
  void add(const TriangleD& triangle);
  /// Adds a frame at a place: three unit axes at right angles. Cubes near the place are turned as the frame is.
  void add(const Vec3d& at, const std::array<Vec3d, 3>& axes);

  /// Returns a field that is smooth between what was added, and nearly constant where possible: rotations within 2
  /// degrees of each other become one. The same field for any number of threads.
  [[nodiscard]] OrientationField make() const;

 private:
  struct Sums;
  std::unique_ptr<Sums> sums_;
};

}  // namespace bp
