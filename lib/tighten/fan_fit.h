#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "lib/enclosed/enclosed.h"
#include "lib/mesh/constrained_minimum.h"

/// Lattice units by which fits keep faces over points: rounding a vertex moves it by up to 0.87, but rarely straight
/// down.
constexpr double kFitMargin = 0.6;
/// The largest step of a vertex that a fan fit proposes, in mean spokes, and the most rounds in which it avoids
/// obstacles.
constexpr double kFanReach = 0.5;
constexpr int kFanRounds = 4;

/// Finds the apex of a fan of faces that encloses the least volume and still lies over given points. With a fixed rim,
/// the volume under the fan is linear in the apex x, and so is "point p lies under face (x, a, b)": ((a - p) x (b - p))
/// . (x - p) >= 0. A point constrains only the face that it lies under, seen along the area vector of the rim, which
/// does not depend on the apex. The result is in doubles: a proposal that the caller checks exactly. Coordinates are
/// relative to a point of the caller's choice near the fan, lattice units.
namespace bp {

class FanFit {
 public:
  void clear();                                        ///< starts a new fan
  void add_rim(const Vec3d& p) { rim_.push_back(p); }  ///< counterclockwise seen from outside
  /// Adds a point that must stay under the fan. `sector`: number of the rim corner that begins the face it probably
  /// lies under.
  void add_point(const Vec3d& p, std::uint32_t sector) { points_.push_back({p, sector}); }
  /// Completes the rim. Returns false if it has no area vector, so that no direction leads inwards.
  [[nodiscard]] bool close();

  /// Returns the volume under the fan with apex x, up to a constant of the fan, lattice units cubed.
  [[nodiscard]] double volume(const Vec3d& x) const;
  [[nodiscard]] const std::vector<Vec3d>& rim() const { return rim_; }
  [[nodiscard]] const Vec3d& outward() const { return outward_; }  ///< unit area vector of the rim

  /// Keeps the fan over an obstacle that a fan with its apex at `apex` cuts into: the faces stay over its corners, the
  /// spokes over its edges, the apex over its faces. `shift`: the fan's origin in the blocker's coordinates. Returns
  /// false if no part of the obstacle is in the way.
  bool avoid(const Vec3d& apex, const Blocker& blocker, const Vec3d& shift);
  /// Returns the points of the obstacle over which the last avoid() lifted the fan. They become contact points.
  [[nodiscard]] const std::vector<Vec3d>& obstacles() const { return obstacles_; }

  /// Returns the apex of least volume, at most about `reach` from `start`. It uses cutting planes: the deepest
  /// violation of each face is added to a small quadratic program until none is left. Returns nothing if the cuts
  /// contradict each other.
  [[nodiscard]] std::optional<Vec3d> least_volume(const Vec3d& start, double reach);

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t(0);
  /// A point under the face (apex, rim[sector], rim[sector + 1]), and the plane through the point and that edge of the
  /// rim.
  struct Point {
    Vec3d at;
    std::uint32_t sector;
    std::uint32_t plane_of = kNone;  // the sector for which the plane was computed
    Vec3d normal{};                  // the apex must lie above the plane
    double margin = 0;               // times the normal's length
  };
  void set_plane(Point& point) const;
  void bind(const Vec3d& apex);
  [[nodiscard]] bool cut(const Vec3d& apex);
  void add_plane(const Vec3d& normal, const Vec3d& through, const Vec3d& obstacle);
  void avoid_corner(const Vec3d& apex, const Vec3d& p);
  void avoid_edge(const Vec3d& apex, const Vec3d& p, const Vec3d& q);
  void avoid_face(const Vec3d& apex, const Vec3d& p, const Vec3d& q, const Vec3d& r);

  std::vector<Vec3d> rim_;
  std::vector<Point> points_;
  Vec3d gradient_{}, outward_{};            // of the volume; and its direction
  std::vector<PlaneConstraint> avoided_;    // from avoid()
  std::vector<Vec3d> obstacles_;            // from the last avoid()
  std::vector<PlaneConstraint> cuts_;       // within least_volume()
  std::vector<Vec3d> spokes_;               // scratch
  std::vector<double> deepest_;             // scratch, for each face
  std::vector<std::size_t> deepest_point_;  // scratch, for each face
};

}  // namespace bp
