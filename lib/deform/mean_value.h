#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "lib/deform/cage.h"
#include "lib/geometry/triangle_bvh.h"

namespace bp {

namespace detail {
struct RawScratch;
}

/// Coordinates of points: a row for each point, in it a number for each vertex of the cage.
struct CoordinateRows {
  enum class Place : std::uint8_t { inside, outside, nowhere };  ///< nowhere: the point is not finite

  std::size_t columns = 0;      ///< vertices of the cage
  std::vector<double> weights;  ///< of point i and vertex v: [i * columns + v]; all 0 for a point that is nowhere
  std::vector<Place> places;    ///< by point; a point on the cage is inside

  [[nodiscard]] std::size_t points() const { return places.size(); }
  [[nodiscard]] std::span<double> row(std::size_t i) { return std::span(weights).subspan(i * columns, columns); }
  [[nodiscard]] std::span<const double> row(std::size_t i) const {
    return std::span(weights).subspan(i * columns, columns);
  }
};

/// Mean value coordinates of a cage ([JSW05]). The coordinates of a point sum to 1, and reproduce the point: an affine
/// map of the cage is that map of the points, to rounding. Thread-safe.
class MeanValueCoordinates {
 public:
  explicit MeanValueCoordinates(Cage cage);

  [[nodiscard]] const Cage& cage() const { return cage_; }
  /// Replaces `out`. `points` are in scene units. A point outside follows the nearest point of the cage; its offset
  /// from there turns and grows as the cage does as a whole. This continues the coordinates inside. On the caller's
  /// thread; the coordinates of a point do not depend on the points beside it. Cost: some microseconds for each 300
  /// faces.
  void evaluate(std::span<const Vec3d> points, CoordinateRows& out) const;

 private:
  void take_group(std::span<const Vec3d> points, std::size_t first, detail::RawScratch& raw, CoordinateRows& out) const;
  void finish(const Vec3d& point, std::span<double> weights, CoordinateRows::Place& place, bool trusted) const;
  [[nodiscard]] double nearest(const Vec3d& point, std::span<double> weights) const;
  void reproduce(const Vec3d& point, std::span<double> weights) const;

  Cage cage_;
  TriangleBvh faces_;  ///< in the unit of the cage
};

}  // namespace bp
