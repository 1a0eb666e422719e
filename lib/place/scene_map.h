#pragma once
#include <optional>
#include <vector>

#include "lib/core/triangle_source.h"
#include "lib/core/up_axis.h"

namespace bp {

/// Takes a scene to other coordinates while it is read: nobody else sees the coordinates of its files.
class SceneMap {
 public:
  virtual ~SceneMap() = default;
  /// Moves triangles; those that are not finite stay. The result for a point depends on that point alone. Throws
  /// bad_input if a point has no image. Thread-safe. `told`: the axis that the file says is up.
  virtual void move(std::vector<TriangleD>& triangles, std::optional<UpAxis> told) const = 0;
  /// Turns the normal of a surface, of any length.
  [[nodiscard]] virtual Vec3d normal(const Vec3d& n, std::optional<UpAxis> told) const = 0;
  /// Returns the largest factor by which lengths grow.
  [[nodiscard]] virtual double stretch() const = 0;
  [[nodiscard]] virtual UpAxis up() const = 0;  ///< in the new coordinates
};

}  // namespace bp
