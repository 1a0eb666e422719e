#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "lib/deform/cage.h"
#include "lib/geometry/triangle_bvh.h"

namespace bp {

namespace detail {
struct CageView;
struct CoordinateScratch;
struct GreenCage;
}  // namespace detail

enum class CoordinateKind : std::uint8_t {
  mean_value = 0,         ///< [JSW05]: a number for each vertex; some may be negative in a concave cage
  green = 1,              ///< [LLC08]: a number for each vertex, then one for each face, which carries its normal
  maximum_likelihood = 2  ///< after [CDH23]: a number for each vertex, none negative inside
};

/// Coordinates of points. Each point has a row with a number for each vertex of the cage, and perhaps for each face.
struct CoordinateRows {
  enum class Place : std::uint8_t { inside, outside, nowhere };  ///< nowhere: the point is not finite

  std::size_t columns = 0;
  std::vector<double> weights;  ///< of point i and column c: [i * columns + c]; all 0 if the point is nowhere
  std::vector<Place> places;    ///< by point; a point on the cage is inside
  std::unique_ptr<detail::CoordinateScratch> scratch;  ///< kept from call to call

  CoordinateRows();
  ~CoordinateRows();
  [[nodiscard]] std::size_t points() const { return places.size(); }
  [[nodiscard]] std::span<double> row(std::size_t i) { return std::span(weights).subspan(i * columns, columns); }
  [[nodiscard]] std::span<const double> row(std::size_t i) const {
    return std::span(weights).subspan(i * columns, columns);
  }
};

/// Returns the number of columns: the vertices of the cage, and for Green coordinates also its faces that name no
/// vertex twice.
[[nodiscard]] std::size_t columns_of(CoordinateKind kind, const IndexedMesh& cage);

/// Computes coordinates of a cage. The coordinates of the vertices sum to 1, and all columns together reproduce the
/// point. So a similarity of the cage moves the points alike, up to rounding. So does an affine map, except with Green
/// coordinates. Thread-safe.
class CageCoordinates {
 public:
  explicit CageCoordinates(Cage cage, CoordinateKind kind = CoordinateKind::mean_value);
  ~CageCoordinates();

  [[nodiscard]] const Cage& cage() const { return cage_; }
  [[nodiscard]] CoordinateKind kind() const { return kind_; }
  /// Returns the cage as the formulas take it. The view points into this object.
  [[nodiscard]] detail::CageView view() const;
  [[nodiscard]] std::size_t columns() const;
  /// Returns a number of points whose rows stay in the processor's cache.
  [[nodiscard]] std::size_t points_at_once() const;
  /// Returns the bytes of CoordinateRows with points_at_once().
  [[nodiscard]] std::uint64_t bytes_at_once() const;
  /// Replaces `out`. `points` are in scene units. A point outside follows the nearest point of the cage; its offset
  /// from there turns and grows as the cage does as a whole. This continues the coordinates inside. It works on the
  /// caller's thread. The coordinates of a point do not depend on the other points. Cost: some microseconds for each
  /// 300 faces; a hundred for a point outside with Green coordinates.
  void evaluate(std::span<const Vec3d> points, CoordinateRows& out) const;
  /// Returns the move of each column in scene units: a point moves by the sum of coordinate times move. The column of a
  /// vertex has the vertex's move. The column of a face has its normal times its stretch factor, less its normal at
  /// rest, and 0 if no vertex of the face moves.
  [[nodiscard]] std::vector<Vec3d> moves_of_columns(std::span<const Vec3d> vertex_moves) const;

 private:
  struct Nearest {
    double distance = 0;
    std::uint32_t face = 0;
    Vec3d place{};
    std::array<double, 3> share{};  ///< shares of the face's corners
  };
  void take_group(std::span<const Vec3d> points, std::size_t first, CoordinateRows& out) const;
  [[nodiscard]] CoordinateRows::Place finish(const Vec3d& point, std::span<double> weights, double total,
                                             bool trusted) const;
  [[nodiscard]] double slowly(const Vec3d& point, std::span<double> weights) const;
  [[nodiscard]] Nearest nearest(const Vec3d& point) const;
  void take_surface(const Vec3d& point, const Nearest& near, std::span<double> weights) const;

  Cage cage_;
  CoordinateKind kind_;
  TriangleBvh faces_;                         ///< in the unit of the cage
  std::unique_ptr<detail::GreenCage> green_;  ///< null if the coordinates are of another kind
};

}  // namespace bp
