#pragma once
#include <map>
#include <memory>
#include <vector>

#include "lib/closing/detail/cube_dilation.h"
#include "lib/closing/detail/oriented_cube.h"
#include "lib/closing/detail/row_tables.h"
#include "lib/closing/detail/scale_row.h"

/// Dilation by cubes that are turned, each voxel's by the rotation of its cell.
namespace bp::detail {

class OrientedDilation {
 public:
  /// Looks up the cubes over `region`, for run(). False if no cube is turned there: then this is a cube's dilation.
  bool turns(const OrientationField& field, const VoxelBox& region);
  /// Sets `out` (its box is kept, within the region) to the voxels whose turned cube holds a voxel of `solid`.
  /// From large voxels to small ones: at each level the cubes of some that are in for sure and of some that may be are
  /// asked for, and what they leave open is asked for at the next one. At first the largest cube along the axes that
  /// lies in all turned ones decides, and the smallest around them. Rows of a turned cube are asked for by 16 x 16
  /// voxels at once, and blocks of 4 x 4 rows before them: some 5 cycles for each row and block that is asked. Where
  /// the scale varies in a cell, the least and the largest are asked for, and each voxel for the rows on which they
  /// disagree. The solid is swept once for as many cubes as most_bytes hold, or turned_cubes_bytes(); they are kept for
  /// the next call.
  void run(const BitBox& solid, const ScaleLattice& scale, BitBox& out, std::size_t most_bytes = 0);

 private:
  static constexpr std::int32_t kCell = kScaleStep, kAcross = RowTables::kAcross;
  static constexpr std::int32_t kSlices = kCell;  ///< of a block
  using Word = RowTables::Word;

  /// Voxels of 2^level voxels a side.
  struct Level {
    BitBox solid;    ///< of the finest, that is another's
    BitBox in, may;  ///< for sure; perhaps
  };
  /// Voxels of a block whose cubes are alike, by the least and the largest that any of them has.
  struct Part {
    Word mask[kAcross];
    std::uint16_t rotation;
    std::int32_t min, max;  ///< scales, in 1/16 of the level's voxels; min < 0: none is in for sure
    const CubeRows *least = nullptr, *most = nullptr;  ///< while it is asked for
    std::uint64_t near[kSlices] = {};                  ///< for each slice: what of the cubes' next slices is asked for
    std::uint32_t asks = 0;                            ///< slices of which something is
  };
  /// kAcross x kAcross x kSlices voxels: four cells.
  struct Block {
    VoxelCoord first;
    std::size_t part, parts;
    std::size_t open;          ///< of its words in open_ and maybe_: y fastest
    std::uint32_t slices = 0;  ///< that have open voxels
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
  /// Of the smallest voxels, one slice across a kept axis is enough.
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

  CubesOver cubes_;                     ///< of the region
  std::vector<std::int64_t> row_sums_;  ///< of its rotations
  std::vector<Level> levels_;
  std::int32_t edge_ = 1, reach_ = 0;  ///< of the level: its voxels; the farthest cube in them
  const BitBox* solid_ = nullptr;      ///< while it is swept
  const ScaleLattice* scale_ = nullptr;
  int flat_ = -1;  ///< an axis about which all cubes are turned: y, z, or none
  BitBox along_;   ///< solid, dilated along it
  RowTables tables_;
  std::map<std::pair<Rotation, std::int32_t>, std::unique_ptr<CubeRows>> kept_;
  std::size_t kept_bytes_ = 0, most_bytes_ = 0;
  std::vector<Part> parts_;
  std::vector<Block> blocks_;  ///< by z, then y, then x
  std::vector<Block> group_;   ///< some of them, of some of their parts: those whose cubes are there
  std::vector<Word> open_, maybe_;
  CubeDilation cube_;
};

}  // namespace bp::detail
