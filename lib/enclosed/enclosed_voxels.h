#pragma once
#include <array>
#include <optional>
#include <unordered_map>
#include <vector>

#include "lib/enclosed/enclosed.h"
#include "lib/enclosed/near_masks.h"
#include "lib/grid/coord_hash.h"
#include "lib/grid/stream.h"

namespace bp {

/// A set of voxels, as closed cubes. Touching is allowed: the proxy may lie on their boundary, as the dense surface
/// does. Exact by separating axes in integers: a tetrahedron is clear if its interior meets no cube's interior. Memory:
/// 64 bytes per block of 8^3 voxels with a boundary in it; cost of a query: the blocks, and the voxels of some, that
/// the box around the tetrahedron meets; of contact_points(), the points of all bricks that `within` meets.
class EnclosedVoxels : public Enclosed {
 public:
  explicit EnclosedVoxels(const BrickShelf& shelf);  ///< the shelf must outlive this
  [[nodiscard]] bool allows(std::span<const NewFace> star, std::span<const Tetrahedron> swept,
                            Blocker* blocker) const override;
  [[nodiscard]] std::vector<Vec3d> contact_points(const LatticeCoord& origin, const LatticeBox& within) const override;
  [[nodiscard]] bool is_near(std::span<const NewFace> faces, double distance) const override;
  void expect_near(double distance) const override { near_.prepare(distance); }
  void outer_boxes(const UseBoxes& use) const override;
  [[nodiscard]] std::uint64_t bytes() const override;

 private:
  /// The boundary voxels of a block: occupied, with an empty one across one of their 6 faces. Word z, bit 8 y + x.
  using Block = std::array<std::uint64_t, 8>;
  struct BoundaryBrick {
    std::array<std::uint64_t, 8> blocks;  ///< the blocks with any such voxel: word z, bit 8 y + x
    std::array<std::uint32_t, 8> first;   ///< per word: its first block in blocks_
  };
  /// Calls use(first voxel, block) for each block of a brick.
  template <class Use>
  void for_each_block(BrickCoord coord, const Use& use) const;
  [[nodiscard]] bool clear(const Tetrahedron& t, Blocker* blocker) const;
  [[nodiscard]] bool brick_clear(class Separator& separator, BrickCoord coord, const BoundaryBrick& brick,
                                 Blocker* blocker) const;
  [[nodiscard]] bool block_clear(Separator& separator, VoxelCoord first, const Block& block, Blocker* blocker) const;
  NearMasks near_;
  std::unordered_map<BrickCoord, BoundaryBrick, CoordHash> bricks_;
  std::vector<Block> blocks_;
  /// Corners with one occupied voxel around them, and corners 8 voxels apart on straight edges and flat sides; some on
  /// brick borders are left out.
  std::vector<VoxelCoord> points_;
  struct PointsOf {
    BrickCoord coord;
    std::size_t first;  // in points_
  };
  std::vector<PointsOf> points_of_;  // the bricks that have any
};

}  // namespace bp
