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

class Enclosed {
 public:
  virtual ~Enclosed() = default;
  /// True if the star may shrink: no tetrahedron of `swept` holds any of what must stay inside, given that the old
  /// faces enclosed it. `star` are the faces after the change. Exact; false is always safe.
  [[nodiscard]] virtual bool allows(std::span<const NewFace> star, std::span<const Tetrahedron> swept) const = 0;
};

/// A set of voxels, as closed cubes. Touching is allowed: the proxy may lie on their boundary, as the dense surface
/// does. Exact by separating axes in integers: a tetrahedron is clear if its interior meets no cube's interior. Memory:
/// one bit per voxel of the bricks with a boundary; cost of a query: the voxels and 8^3 blocks near the tetrahedron.
class EnclosedVoxels : public Enclosed {
 public:
  explicit EnclosedVoxels(const BrickShelf& shelf);
  [[nodiscard]] bool allows(std::span<const NewFace> star, std::span<const Tetrahedron> swept) const override;

 private:
  struct BoundaryBrick {
    BrickBits bits;                       ///< occupied voxels with an empty one among their 26 neighbours
    std::array<std::uint64_t, 8> blocks;  ///< 8^3 blocks with any: word bz, bit by * 8 + bx
  };
  [[nodiscard]] bool clear(const Tetrahedron& t) const;
  [[nodiscard]] bool brick_clear(const class Separator& separator, BrickCoord coord, const BoundaryBrick& brick) const;
  struct Hash {
    std::size_t operator()(const BrickCoord& c) const {
      return std::size_t(std::uint32_t(c.x) * 0x9e3779b1u ^ std::uint32_t(c.y) * 0x85ebca77u ^
                         std::uint32_t(c.z) * 0xc2b2ae3du);
    }
  };
  std::unordered_map<BrickCoord, BoundaryBrick, Hash> bricks_;
};

/// The triangles of a scene, in scene units and exactly as read: the proxy must not even touch them. All in memory: 72
/// bytes each and about 80 for the tree. `frame` is the proxy's; its vertices are exact doubles, so the predicates on
/// doubles are exact too.
class EnclosedTriangles : public Enclosed {
 public:
  EnclosedTriangles(std::vector<TriangleD> triangles, const GridFrame& frame);
  [[nodiscard]] bool allows(std::span<const NewFace> star, std::span<const Tetrahedron> swept) const override;

 private:
  std::vector<TriangleD> triangles_;
  GridFrame frame_;
  BoxTree tree_;
};

}  // namespace bp
