#pragma once
#include <array>
#include <functional>
#include <span>
#include <vector>

#include "lib/mesh/half_edge_mesh.h"
#include "lib/mesh/lattice_geometry.h"

/// The enclosed set: what must stay inside the proxy while it shrinks.
namespace bp {

/// The solid that moving a corner removes: the tetrahedron between an old face and the new place of one of its corners.
using Tetrahedron = std::array<LatticeCoord, 4>;

/// An obstacle that refused a change: a triangle (3 points) or a cube (8 points, bit i of the index for axis i).
/// Lattice units, rounded: for the search, not for proofs.
struct Blocker {
  std::array<Vec3d, 8> points;
  std::size_t count = 0;  ///< number of points; 0: no obstacle
};

class Enclosed {
 public:
  virtual ~Enclosed() = default;
  /// Returns true if no tetrahedron of `swept` holds a part of the enclosed set, given that the old faces enclosed it.
  /// `star`: the faces after the change. Exact; returning false is always safe. `blocker` (may be null) gets what
  /// refused the change. On entry it may hold the obstacle of an earlier, similar change of this set, which is tested
  /// first; count 0: none.
  [[nodiscard]] virtual bool allows(std::span<const NewFace> star, std::span<const Tetrahedron> swept,
                                    Blocker* blocker = nullptr) const = 0;
  /// Returns points of the set in the closed box `within` that tell where a proxy must stay outside, relative to
  /// `origin`, lattice units; rounded. They guide the search; allows() decides.
  [[nodiscard]] virtual std::vector<Vec3d> contact_points(const LatticeCoord& origin,
                                                          const LatticeBox& within) const = 0;
  /// Returns whether every point of the faces is within `distance`, lattice units, of the enclosed set. A guide only,
  /// with an error that depends on the class. Returns true if it is unknown.
  [[nodiscard]] virtual bool is_near(std::span<const NewFace> faces, double distance) const {
    static_cast<void>(faces), static_cast<void>(distance);
    return true;
  }
  /// Makes what is_near() needs for this distance, on all threads. Without this call the first question makes it, on
  /// one thread, while all others that ask wait.
  virtual void expect_near(double distance) const { static_cast<void>(distance); }
  /// Returns true if the set is the scene itself, false if it lies around the scene, as voxels do: then the last
  /// percent of a volume means nothing.
  [[nodiscard]] virtual bool is_exact() const { return false; }
  /// Passes boxes whose convex hull holds the set, some at a time, neighbours after each other, until `use` returns
  /// false. The first 512 or so come from all over the set. Passes none if they are unknown, as for a part of a scene.
  using UseBoxes = std::function<bool(std::span<const LatticeBox>)>;
  virtual void outer_boxes(const UseBoxes& use) const { static_cast<void>(use); }
  static constexpr std::size_t kFirstBoxes = 512;
  /// Returns the memory of the set and of its contact points while a proxy is tightened, bytes; about.
  [[nodiscard]] virtual std::uint64_t bytes() const = 0;
  static constexpr std::uint64_t kBytesPerContactPoint =
      136;  ///< the point, its place in the list of a face, its row in joint_fit.h
};

}  // namespace bp
