#pragma once
#include "gpu/kernels/cell_kernels.h"

/// The arguments of the passes of the separable transform (distance_kernels.h).
namespace bp {

/// Intermediate values of a slab: after the row pass and after the y pass. Layout [word][z][y][16 pairs], so that what
/// a warp reads is contiguous in y. Only rows and slices flagged as non-empty are written or read.
struct TransformBuffers {
  void* rows;                 ///< Packed16 or Packed32 values, slab words x nz x ny x 16
  void* planes;               ///< the same, after the y pass
  std::uint8_t* row_flags;    ///< [word][z][y/8]: bit y%8: the row has a seed in reach
  std::uint8_t* slice_flags;  ///< [word][y/16][slice_stride]: bit z%8 of byte z/8: the y unit has one in that slice
  std::int32_t slice_stride;  ///< bytes, a multiple of 4
};

/// Bytes of `rows` (and again of `planes`), of the flags of rows and of those of slices, for a slab of this many words.
struct TransformBytes {
  std::size_t values, row_flags, slice_flags;
  std::int32_t slice_stride;
};
[[nodiscard]] TransformBytes transform_bytes(const TransformBounds& bounds, const GridShape& shape, int slab_words);

struct TransformArgs {
  const std::uint32_t* seeds;  ///< bits
  GridShape shape;
  Slab slab;
  TransformBounds bounds;
  ScaleView scale;
  TransformBuffers buffers;  ///< flags zeroed before
  WorkLists lists;
};
/// The task of the last pass. It decides the voxels of `region` in open cells that are in D and not in G (erosion), or
/// not in G (dilation). Erosion sets those that are NOT within their bound, dilation those that are.
struct DecideArgs {
  bool erosion;
  const std::uint32_t* solid;
  const std::uint32_t* dilated;  ///< erosion only
  const std::uint32_t* open;     ///< flags of cells
  VoxelRange region;
  std::uint32_t* out;
};

}  // namespace bp
