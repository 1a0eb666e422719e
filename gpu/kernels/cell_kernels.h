#pragma once
#include <cuda_runtime.h>

#include "gpu/kernels/grid_view.h"

/// Answers for whole cells, before any voxel is examined. The cells that hold seeds give, for each cell of 8^3 voxels,
/// bounds of the transform
///   value(p) = min over seeds q of |p-q|^2 + offset(q),   offset(q) = 0, or limit - w(q) where the scale varies at the
///   seed.
/// The rest is listed as units of work.
namespace bp {

/// The test that decides about a voxel: value(p) < bound(p).
struct TransformBounds {
  std::uint32_t limit = 0;      ///< largest w: no seed at this squared distance or beyond matters
  std::int32_t reach = 0;       ///< largest distance along an axis at which a seed matters
  bool offset_at_seed = false;  ///< erosion with varying scale: the ball belongs to the seed; bound(p) = limit
  bool wide = false;            ///< 32-bit values even where 16 bits would do
  bool bound_at_voxel = false;  ///< ball dilation with varying scale: the ball belongs to the voxel; bound(p) = w(p)
};

/// Returns whether 16 bits hold the values of a transform.
[[nodiscard]] bool fits_16_bits(const TransformBounds& bounds);

/// Flags of cells, a byte each, 0xff or 0: every voxel is within its bound; undecided.
struct CellAnswers {
  std::uint32_t* near;
  std::uint32_t* open;
};

/// Least and largest w over each cell, from the lattice (varying scale only).
void bound_cells(const ScaleView& scale, const GridShape& shape, uint2* w_of_cells, cudaStream_t stream);

/// answers := bounds of the transform of the seeds in the cells flagged by `seeds`. `scratch` holds answer_bytes().
void answer_cells(const std::uint32_t* seeds, const uint2* w_of_cells, const TransformBounds& bounds,
                  const GridShape& shape, void* scratch, const CellAnswers& answers, cudaStream_t stream);
[[nodiscard]] std::size_t answer_bytes(const TransformBounds& bounds, const GridShape& shape);

/// Dilation: out := (G or near) in `region`; erosion: out := G or (D and neither near nor open). `wanted`, a byte per
/// quad that must be zero before, is set where an undecided voxel of `region` is in an open cell.
void apply_answers(bool erosion, const std::uint32_t* solid, const std::uint32_t* dilated, const CellAnswers& answers,
                   const VoxelRange& region, const GridShape& shape, std::uint32_t* out, std::uint8_t* wanted,
                   cudaStream_t stream);

/// A range of words along x whose distances are in memory at one time.
struct Slab {
  std::int32_t w0 = 0, words = 0;
};

/// Units of work of the three passes, made on the device and read there: no host in between. Zeroed before a slab.
struct WorkCounts {
  std::uint32_t rows, ys, zs;              ///< lengths of the lists
  std::uint32_t row_next, y_next, z_next;  ///< queues
};
struct WorkLists {
  WorkCounts* counts;
  std::uint32_t* rows;    ///< 8 x 8 rows: (w - w0) + words (cy + cells_y cz)
  std::uint32_t* ys;      ///< 16 rows of 8 slices: (w - w0) + words (y/16 + units_y cz)
  std::uint32_t* zs;      ///< 16 rows of 16 slices: (w - w0) + words (y/16 + units_y z/16)
  std::uint8_t* columns;  ///< scratch: the y units as flags
};
/// Lengths of the lists that always suffice.
struct WorkSizes {
  std::size_t rows, ys, zs;
};
[[nodiscard]] WorkSizes work_sizes(const GridShape& shape, int slab_words);

/// Lists what must be computed for the undecided voxels of a slab.
void plan_work(const std::uint8_t* wanted, const std::uint32_t* seeds, const TransformBounds& bounds,
               const GridShape& shape, const Slab& slab, const WorkLists& lists, cudaStream_t stream);

}  // namespace bp
