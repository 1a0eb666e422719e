#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "lib/enclosed/enclosed.h"
#include "lib/mesh/constrained_minimum.h"

/// Where to put the apex of a fan of faces so that it encloses least and still lies over given points. With the rim
/// fixed, the volume under the fan is linear in the apex x, and so is "point p lies under face (x, a, b)":
/// ((a - p) x (b - p)) . (x - p) >= 0. A point is held against the one face that it lies under, seen along the area
/// vector of the rim, which does not depend on the apex. All in doubles: a proposal, which the caller checks exactly.
/// Coordinates are relative to a point of the caller's choice near the fan, lattice units.
namespace bp {

class FanFit {
 public:
  void clear();                                        ///< starts a new fan
  void add_rim(const Vec3d& p) { rim_.push_back(p); }  ///< counter-clockwise seen from outside
  /// A point that must stay under the fan; `sector`: index of the rim corner that begins the face it is likely under.
  void add_point(const Vec3d& p, std::uint32_t sector) { points_.push_back({p, sector}); }
  /// Call when the rim is complete. False if the rim has no area vector, so that there is no way in.
  [[nodiscard]] bool close();

  /// Volume under the fan with apex x, up to a constant of the fan. Lattice units cubed.
  [[nodiscard]] double volume(const Vec3d& x) const;
  [[nodiscard]] const std::vector<Vec3d>& rim() const { return rim_; }
  [[nodiscard]] const Vec3d& outward() const { return outward_; }  ///< unit area vector of the rim

  /// Keeps the fan over something that a fan with its apex at `apex` cuts into: the faces over its corners, the spokes
  /// over its edges, the apex over its faces. `shift`: the fan's origin in the blocker's coordinates. False if neither
  /// is in the way.
  bool avoid(const Vec3d& apex, const Blocker& blocker, const Vec3d& shift);
  /// Points of the blocker that the last avoid() lifted the fan over: contact points to come.
  [[nodiscard]] const std::vector<Vec3d>& obstacles() const { return obstacles_; }

  /// The apex of least volume, about `reach` from `start` at most. Cutting planes: the deepest violation of each face
  /// is added to a small quadratic program until none is left. Nothing if the cuts contradict each other.
  [[nodiscard]] std::optional<Vec3d> least_volume(const Vec3d& start, double reach);

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t(0);
  /// A point under face (apex, rim[sector], rim[sector + 1]), and the plane through it and that edge of the rim.
  struct Point {
    Vec3d at;
    std::uint32_t sector;
    std::uint32_t plane_of = kNone;  // the sector that the plane is of
    Vec3d normal{};                  // the apex must be above
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
  Vec3d gradient_{}, outward_{};            // of the volume
  std::vector<PlaneConstraint> avoided_;    // from avoid()
  std::vector<Vec3d> obstacles_;            // from the last avoid()
  std::vector<PlaneConstraint> cuts_;       // of least_volume()
  std::vector<Vec3d> spokes_;               // scratch
  std::vector<double> deepest_;             // scratch, per face
  std::vector<std::size_t> deepest_point_;  // scratch, per face
};

}  // namespace bp
