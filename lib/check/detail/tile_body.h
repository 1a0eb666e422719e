#pragma once
#include <optional>
#include <span>

#include "lib/check/detail/known_inside.h"
#include "lib/check/detail/surface.h"

namespace bp {

/// The content of a tile that encloses what of the scene lies in its cell.
class TileBody {
 public:
  enum class Side { inside, touching, outside, undecided };

  /// `number`: of the tile, for what is known of it.
  TileBody(const IndexedMesh& content, std::size_t number);

  /// A closed, oriented, embedded 2-manifold.
  [[nodiscard]] bool sound() const { return sound_; }
  /// Where t lies, of which only what is in the cell counts; in no cell: all of t. `bounds`: of t.
  [[nodiscard]] Side side_of(const TriangleD& t, const Bounds3d& bounds, const std::optional<Bounds3d>& cell,
                             KnownInside& known) const;

 private:
  [[nodiscard]] Side side_of_part(const TriangleD& t, const Bounds3d& cell, double growth, KnownInside& known) const;
  [[nodiscard]] Side side_of_corners(std::span<const Vec3d> corners, KnownInside& known) const;
  [[nodiscard]] Side side_near(const Vec3d& p, double radius) const;
  [[nodiscard]] Side side_of_point(const Vec3d& p) const;

  std::size_t number_;
  WeldedMesh mesh_;
  std::optional<Surface> surface_;
  bool closed_ = false, sound_ = false;
};

}  // namespace bp
