#pragma once
#include <array>
#include <functional>
#include <span>
#include <vector>

#include "lib/mesh/guard.h"

/// What must stay inside the proxy while it shrinks.
namespace bp {

/// Removing `swept` from the solid: the tetrahedron between an old face and the new place of one of its corners.
using Tetrahedron = std::array<LatticeCoord, 4>;

/// What stood in the way of a change: a triangle (3 points) or a cube (8 points, bit i of the index for axis i).
/// Lattice units, rounded: for the search, not for proofs.
struct Blocker {
  std::array<Vec3d, 8> points;
  std::size_t count = 0;  ///< 0: none
};

class Enclosed {
 public:
  virtual ~Enclosed() = default;
  /// True if the star may shrink: no tetrahedron of `swept` holds any of what must stay inside, given that the old
  /// faces enclosed it. `star` are the faces after the change. Exact; false is always safe.
  /// `blocker`, if not null: what stood in the way. What it holds before, from this set and a change like this
  /// one, may be asked first; count 0: nothing.
  [[nodiscard]] virtual bool allows(std::span<const NewFace> star, std::span<const Tetrahedron> swept,
                                    Blocker* blocker = nullptr) const = 0;
  /// Points of it in the closed box `within` that tell where a proxy must stay outside, relative to `origin`, lattice
  /// units; rounded. They guide the search, allows() decides.
  [[nodiscard]] virtual std::vector<Vec3d> contact_points(const LatticeCoord& origin,
                                                          const LatticeBox& within) const = 0;
  /// Whether every point of the faces is within `distance`, lattice units, of the enclosed set; as a guide, with the
  /// error of the class that answers; true if that is unknown.
  [[nodiscard]] virtual bool is_near(std::span<const NewFace> faces, double distance) const {
    static_cast<void>(faces), static_cast<void>(distance);
    return true;
  }
  /// True if it is the thing itself, false if it stands around it, as voxels do: then the last shares of a volume say
  /// nothing.
  [[nodiscard]] virtual bool is_exact() const { return false; }
  /// Boxes whose convex hull holds all of it, as a proxy must: some at a time, neighbours after each other, until `use`
  /// returns false. The first are about 512 from everywhere. None if they are not known, as of a part of a scene.
  using UseBoxes = std::function<bool(std::span<const LatticeBox>)>;
  virtual void outer_boxes(const UseBoxes& use) const { static_cast<void>(use); }
  static constexpr std::size_t kFirstBoxes = 512;
  /// Memory of this, and of its contact points while a proxy is tightened; about.
  [[nodiscard]] virtual std::uint64_t bytes() const = 0;
  static constexpr std::uint64_t kBytesPerContactPoint =
      136;  ///< the point, its place in the list of a face, its row in joint_fit.h
};

}  // namespace bp
