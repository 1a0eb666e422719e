#pragma once
#include <cuda_runtime.h>

#include "gpu/kernels/bit_kernels.h"

/// Dilation by turned cubes, for the voxels that the upright cubes in them and around them leave open.
namespace bp {

/// The cubes of the domain: a rotation for each cell of the orientation field. Beyond the cells the nearest one holds.
struct CubeView {
  const Rotation* rotations = nullptr;
  const std::uint16_t* cells = nullptr;
  std::int32_t nx = 0, ny = 0, nz = 0;  ///< cells held
  std::int32_t edge = 1;                ///< edge of a cell of the field, in cells of kCell voxels
  std::int32_t ox = 0, oy = 0,
               oz = 0;  ///< cell of kCell voxels at voxel (0,0,0) of the domain, from the first one held

  /// Returns the number of the rotation at a cell of kCell voxels of the domain.
  [[nodiscard]] BP_HD std::uint16_t at(std::int32_t cx, std::int32_t cy, std::int32_t cz) const {
    const std::int32_t i = nearest_index(floor_div(cx + ox, edge), nx), j = nearest_index(floor_div(cy + oy, edge), ny),
                       k = nearest_index(floor_div(cz + oz, edge), nz);
    return cells[(std::uint32_t(k) * std::uint32_t(ny) + std::uint32_t(j)) * std::uint32_t(nx) + std::uint32_t(i)];
  }
};

/// Rows of a cube are asked for in blocks of 16 x 16, in blocks of 4 x 4, and one by one: levels 2, 1 and 0.
constexpr int kTurnedLevels = 3;
[[nodiscard]] BP_HD constexpr int rows_across(int level) {
  return 1 << (2 * level);
}
/// table[level][k]: G over [x, x + 2^k) of rows_across(level)^2 rows from (y, z) on; k begins at first_octave(level).
/// Word (w, y, z) is number (z words + w) ny + y.
struct TurnedTables {
  const std::uint32_t* table[kTurnedLevels][kOctaves] = {};
  int last = 0;  ///< largest k
};
[[nodiscard]] BP_HD constexpr int first_octave(int level) {
  return 2 * level;
}
/// Returns how many tables rows of this many voxels need.
[[nodiscard]] int turned_table_count(int longest);
/// Places the tables in `memory`, which has room for turned_table_count(longest) times shape.word_count().
[[nodiscard]] TurnedTables turned_tables(const std::uint32_t* bits, const GridShape& shape, int longest,
                                         std::uint32_t* memory, cudaStream_t stream);

/// Adds to `out` the voxels of `open` whose turned cube meets G. Voxels of `open` that are in `out` already are left.
///   items   scratch, 4 shape.quad_count(); `counts`, two more, must be zero before
struct TurnedArgs {
  TurnedTables tables;
  GridShape shape;
  CubeView cubes;
  ScaleView scale;
  const std::uint32_t* open;
  std::uint32_t* out;
  std::uint32_t *items, *counts;
};
void dilate_turned(const TurnedArgs& args, int multiprocessors, cudaStream_t stream);

}  // namespace bp
