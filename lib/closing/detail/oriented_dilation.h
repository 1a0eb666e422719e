#pragma once
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "lib/closing/detail/chessboard.h"
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
  /// The largest cube along the axes that lies in the turned one decides for most voxels that are in, and the smallest
  /// around it for those that are out. Between, rows of the turned cube are asked for, 64 x 8 voxels at once, and
  /// blocks of 8 x 8 rows before them: some 5 cycles for each row and block that is asked. Where the scale varies in a
  /// cell, the least and the largest are asked for, and voxels on which they disagree one by one. The solid is swept
  /// once for as many cubes as most_bytes hold, or turned_cubes_bytes().
  void run(const BitBox& solid, const ScaleLattice& scale, BitBox& out, std::size_t most_bytes = 0);

 private:
  static constexpr std::int32_t kEdge = RowTables::kRows;  ///< of a block: the cells of the lattice

  /// Voxels of a block by one element: least and largest scale, rounded outwards where they differ.
  struct Part {
    std::uint64_t mask;  ///< of x
    std::uint16_t rotation;
    Scale min, max;
    const RowTables::Element *least = nullptr, *most = nullptr;  ///< while it is asked for
    std::uint64_t near[kEdge] = {};  ///< for each slice: what of the elements' next slices is asked for
    std::uint32_t asks = 0;          ///< slices of which something is
  };
  /// 64 x 8 x 8 voxels, a cell high and wide.
  struct Block {
    VoxelCoord first;
    std::size_t part, parts;
    std::size_t open;          ///< of its kEdge^2 words in open_: y fastest
    std::size_t maybe;         ///< of words in maybe_, if the scale varies
    std::uint32_t slices = 0;  ///< that have open voxels
    bool varies = false;
  };

  void find_kept_axis(const BitBox& solid, const ScaleRange& range, const VoxelBox& region);
  void bound(const BitBox& solid, const ScaleLattice& scale, BitBox& out);
  void list_blocks(const ScaleLattice& scale, const BitBox& out);
  bool take_open(Block& block, const BitBox& out);
  void add_parts(Block& block, const ScaleLattice& scale);
  bool prepare(Part& part);
  const RowTables::Element* element(std::uint16_t rotation, Scale s);
  void decide_blocks(const BitBox& solid, const ScaleLattice& scale, BitBox& out);
  void decide_group(const BitBox& solid, const ScaleLattice& scale, BitBox& out);
  void sweep(const BitBox& solid);
  void ask(Block& block, std::int32_t dz_of_first, bool any);
  void ask(const Block& block, Part& part, int slice, std::int32_t dz);
  [[nodiscard]] bool still_open(const Block& block, const Part& part, int slice, std::uint64_t* open) const;
  void look(const Block& block, Part& part, int slice, std::int32_t dz, bool any) const;
  void finish(const BitBox& solid, const ScaleLattice& scale, BitBox& out);
  void decide(const Block& block, const BitBox& solid, const ScaleLattice& scale);
  [[nodiscard]] bool holds(const Part& part, const BitBox& solid, VoxelCoord p, Scale s) const;

  CubesOver cubes_;  ///< of the region
  BitBox outer_;
  int kept_ = -1;  ///< an axis about which all cubes are turned: y, z, or none
  BitBox along_;   ///< solid, dilated along it
  RowTables tables_;
  std::map<std::pair<std::uint16_t, Scale>, std::unique_ptr<RowTables::Element>> elements_;
  std::size_t element_bytes_ = 0, most_bytes_ = 0;
  std::vector<Part> parts_;
  std::vector<Block> blocks_;  ///< by z, then y, then x
  std::vector<Block> group_;   ///< some of them, of some of their parts: those whose elements are there
  std::vector<std::uint64_t> open_, maybe_;
  std::int32_t reach_ = 0, longest_ = 0;
  CubeDilation cube_;
  VaryingCubeDilation varying_;
};

}  // namespace bp::detail
