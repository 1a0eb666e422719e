#pragma once
#include <map>
#include <memory>
#include <vector>

#include "lib/closing/detail/cube_dilation.h"
#include "lib/closing/detail/oriented_cube.h"
#include "lib/closing/detail/row_tables.h"
#include "lib/closing/detail/scale_row.h"

/// Dilation by turned cubes: each voxel's cube is turned by the rotation of its cell.
namespace bp::detail {

class OrientedDilation {
 public:
  /// Returns the least memory for rows of cubes that reach so far along an axis.
  [[nodiscard]] static std::size_t least_bytes(std::int32_t reach);
  /// Looks up the cubes over `region`, for run(). Returns false if no cube is turned there; then it is a dilation by
  /// upright cubes.
  bool turns(const OrientationField& field, const VoxelBox& region);
  /// Sets `out` (its box is kept, within the region) to the voxels whose turned cube holds a voxel of `solid`.
  /// It goes from large voxels to small ones. At each level one cube decides which voxels are surely in, and a larger
  /// one which may be in; the voxels between are open, and the next level decides them. The largest upright cube in all
  /// turned ones, and the smallest around them, begin. Rows of a turned cube are looked up for 16 x 16 voxels at once,
  /// after blocks of 4 x 4 rows: some 5 cycles for each row and block. If the scale varies in a cell, its least and its
  /// largest cube are looked up; where they disagree, each voxel decides for itself. The solid is swept once for as
  /// many cubes as most_bytes (or least_bytes()) hold. Cubes are kept for the next call.
  void run(const BitBox& solid, const ScaleLattice& scale, BitBox& out, std::size_t most_bytes = 0);

 private:
  static constexpr std::int32_t kCell = kScaleStep, kAcross = RowTables::kAcross;
  static constexpr std::int32_t kSlices = kCell;  ///< slices of a block
  using Word = RowTables::Word;

  /// The voxels of 2^level voxels a side.
  struct Level {
    BitBox solid;    ///< unused at the finest level, which has the caller's solid
    BitBox in, may;  ///< in for sure; may be in
  };
  /// The voxels of a block with the same rotation and the same least and largest scale.
  struct Part {
    Word mask[kAcross];
    std::uint16_t rotation;
    /// Least and largest scale, in 1/16 of the level's voxels; min < 0: no voxel is in for sure.
    std::int32_t min, max;
    const CubeRows *least = nullptr, *most = nullptr;  ///< set while the group is swept
    std::uint64_t near[kSlices] = {};  ///< by slice: blocks of the cubes' next slices that may meet something
    std::uint32_t asks = 0;            ///< slices whose `near` is not 0
  };
  /// A block of kAcross x kAcross x kSlices voxels: four cells.
  struct Block {
    VoxelCoord first;
    std::size_t part, parts;
    std::size_t open;          ///< place of its words in open_ and maybe_, y fastest
    std::uint32_t slices = 0;  ///< slices with open voxels
  };

  void find_kept_axis(const BitBox& solid, const ScaleRange& range, const VoxelBox& region);
  [[nodiscard]] int coarsest(const ScaleRange& range) const;
  void lay_levels(const BitBox& solid, const ScaleRange& range, const VoxelBox& region, int coarsest);
  void decide_level(int level, const BitBox& solid, const ScaleLattice& scale);
  void list_blocks(const Level& level, const ScaleLattice& scale);
  void list_blocks(VoxelCoord first, const Level& level, const ScaleLattice& scale);
  [[nodiscard]] Part part_of(VoxelCoord cell, const ScaleLattice& scale) const;
  void add_parts(Block& block, const ScaleLattice& scale);
  void decide_blocks(const BitBox& solid, const ScaleLattice& scale);
  bool prepare(Part& part);
  /// Returns the kept axis for the smallest voxels, whose cubes need one slice across it; else -1.
  [[nodiscard]] int flat() const { return edge_ == 1 ? flat_ : -1; }
  [[nodiscard]] auto key(const Rotation& rotation, std::int32_t s) const { return std::pair(rotation, 4 * s + flat()); }
  const CubeRows* cube(const Rotation& rotation, std::int32_t s);
  void sweep(const BitBox& solid, const ScaleLattice& scale);
  void ask_slice(Block& block, std::int32_t dz_of_first, bool any);
  void ask_part(const Block& block, Part& part, int slice, std::int32_t dz);
  void look(const Block& block, Part& part, int slice, std::int32_t dz, bool any) const;
  void ask_each(const Block& block, const Part& part, int slice, std::int32_t dz);
  [[nodiscard]] bool holds(const Rotation& rotation, Scale s, VoxelCoord p, CubeRow row, std::int32_t dy,
                           std::int32_t dz) const;
  void finish(Level& level) const;

  CubesOver cubes_;                     ///< the cubes over the region
  std::vector<std::int64_t> row_sums_;  ///< CubeBounds::row_sum of each rotation
  std::vector<Level> levels_;
  std::int32_t edge_ = 1, reach_ = 0;  ///< of the level: edge of its voxels, and the reach of the largest cube in them
  const BitBox* solid_ = nullptr;      ///< set while it is swept
  const ScaleLattice* scale_ = nullptr;
  int flat_ = -1;  ///< an axis about which all cubes are turned, y or z; -1: none
  BitBox along_;   ///< the solid, dilated along that axis
  RowTables tables_;
  std::map<std::pair<Rotation, std::int32_t>, std::unique_ptr<CubeRows>> kept_;
  std::size_t kept_bytes_ = 0, most_bytes_ = 0;
  std::vector<Part> parts_;
  std::vector<Block> blocks_;  ///< by z, then y, then x
  std::vector<Block> group_;   ///< the blocks, each with some of its parts, whose cubes are in memory
  std::vector<Word> open_, maybe_;
  CubeDilation cube_;
};

}  // namespace bp::detail
