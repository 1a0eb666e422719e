#pragma once
#include <array>
#include <span>
#include <unordered_map>
#include <vector>

#include "lib/grid/stream.h"
#include "lib/meshing/guard.h"

/// What must stay inside the proxy while it shrinks.
namespace bp {

/// Removing `swept` from the solid: the tetrahedron between an old face and the new place of one of its corners.
using Tetrahedron = std::array<LatticeCoord, 4>;

/// What stood in the way of a change: a triangle (3 points) or a cube (8 points, bit i of the index for axis i).
/// Lattice units, rounded: for the search, not for proofs.
struct Blocker {
  std::array<Vec3d, 8> points;
  std::size_t count = 0;
};

class Enclosed {
 public:
  virtual ~Enclosed() = default;
  /// True if the star may shrink: no tetrahedron of `swept` holds any of what must stay inside, given that the old
  /// faces enclosed it. `star` are the faces after the change. Exact; false is always safe.
  /// `blocker`, if not null: what stood in the way.
  [[nodiscard]] virtual bool allows(std::span<const NewFace> star, std::span<const Tetrahedron> swept,
                                    Blocker* blocker = nullptr) const = 0;
  /// Points of it that tell where a proxy must stay outside, relative to `origin`, lattice units; rounded. They guide
  /// the search, allows() decides.
  [[nodiscard]] virtual std::vector<Vec3d> contact_points(const LatticeCoord& origin) const = 0;
};

/// A set of voxels, as closed cubes. Touching is allowed: the proxy may lie on their boundary, as the dense surface
/// does. Exact by separating axes in integers: a tetrahedron is clear if its interior meets no cube's interior. Memory:
/// one bit per voxel of the bricks with a boundary; cost of a query: the voxels and 8^3 blocks near the tetrahedron.
class EnclosedVoxels : public Enclosed {
 public:
  explicit EnclosedVoxels(const BrickShelf& shelf);
  [[nodiscard]] bool allows(std::span<const NewFace> star, std::span<const Tetrahedron> swept,
                            Blocker* blocker) const override;
  [[nodiscard]] std::vector<Vec3d> contact_points(const LatticeCoord& origin) const override;

 private:
  struct BoundaryBrick {
    BrickBits bits;                       ///< occupied voxels with an empty one among their 26 neighbours
    std::array<std::uint64_t, 8> blocks;  ///< 8^3 blocks with any: word bz, bit by * 8 + bx
  };
  [[nodiscard]] bool clear(const Tetrahedron& t, Blocker* blocker) const;
  [[nodiscard]] bool brick_clear(const class Separator& separator, BrickCoord coord, const BoundaryBrick& brick,
                                 Blocker* blocker) const;
  struct Hash {
    std::size_t operator()(const BrickCoord& c) const {
      return std::size_t(std::uint32_t(c.x) * 0x9e3779b1u ^ std::uint32_t(c.y) * 0x85ebca77u ^
                         std::uint32_t(c.z) * 0xc2b2ae3du);
    }
  };
  std::unordered_map<BrickCoord, BoundaryBrick, Hash> bricks_;
  std::vector<VoxelCoord> tips_;  ///< corners with one occupied voxel around them; some on brick borders are left out
};

/// The triangles of a scene, in scene units and exactly as read: the proxy must not even touch them. All in memory: 72
/// bytes each and about 80 for the tree. `frame` is the proxy's; its vertices are exact doubles, so the predicates on
/// doubles are exact too.
class EnclosedTriangles : public Enclosed {
 public:
  EnclosedTriangles(std::vector<TriangleD> triangles, const GridFrame& frame);
  [[nodiscard]] bool allows(std::span<const NewFace> star, std::span<const Tetrahedron> swept,
                            Blocker* blocker) const override;
  [[nodiscard]] std::vector<Vec3d> contact_points(const LatticeCoord& origin) const override;

 private:
  [[nodiscard]] bool blocks(std::uint32_t triangle, Blocker* blocker) const;
  std::vector<TriangleD> triangles_;
  GridFrame frame_;
  BoxTree tree_;
};

}  // namespace bp
