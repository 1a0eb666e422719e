#include "gpu/kernels/cell_kernels.h"
#include "gpu/kernels/launch.h"
#include "gpu/kernels/packed_min.h"

namespace bp {

namespace {

/// Cells: x fastest, four per quad.
struct CellCoord {
  std::int32_t cx, cy, cz;
};
__device__ CellCoord cell_at(const GridShape& s, std::uint32_t i) {
  const std::uint32_t row = 4 * std::uint32_t(s.words), rest = i / row;
  return {std::int32_t(i - rest * row), std::int32_t(rest % std::uint32_t(s.cells_y())),
          std::int32_t(rest / std::uint32_t(s.cells_y()))};
}

/// Returns the least and the largest squared difference of two coordinates of voxels whose cells are `i` apart.
__device__ std::uint32_t least_square(int i) {
  const int d = i == 0 ? 0 : kCell * i - (kCell - 1);
  return std::uint32_t(d * d);
}
__device__ std::uint32_t largest_square(int i) {
  const int d = kCell * i + (kCell - 1);
  return std::uint32_t(d * d);
}
/// Returns the distance in cells along one axis beyond which cells cannot matter.
__host__ __device__ int cell_reach(int reach) {
  return (reach + kCell - 1) / kCell;
}

__global__ void __launch_bounds__(kPassThreads)
    bound_cells_kernel(ScaleView scale, GridShape shape, uint2* __restrict__ w) {
  const unsigned i = thread_in_grid();
  if (i >= 4 * shape.quad_count()) return;
  const CellCoord c = cell_at(shape, i);
  std::uint32_t least = 0xffff, most = 0;
#pragma unroll
  for (int k = 0; k < 8; ++k) {
    const std::uint32_t s = scale.sample(c.cx + (k & 1), c.cy + (k >> 1 & 1), c.cz + (k >> 2));
    least = min(least, s);
    most = max(most, s);
  }
  w[i] = make_uint2(std::uint32_t(ball_bound(Scale(least))), std::uint32_t(ball_bound(Scale(most))));
}

/// Bounds of the transform in the four cells of a quad. P holds two numbers: the lower bound in the low half, the upper
/// in the high half.
template <class P>
struct alignas(16) Quad {
  P cell[4];
  __device__ static Quad far_away() { return {{P::far_away(), P::far_away(), P::far_away(), P::far_away()}}; }
};

/// Runs the pass along the first axis, from the seeds' flags.
template <class P>
__global__ void __launch_bounds__(kPassThreads)
    cells_x_kernel(const std::uint8_t* __restrict__ seeds, const uint2* __restrict__ w_of_cells,
                   const __grid_constant__ TransformBounds bounds, GridShape shape, Quad<P>* __restrict__ out) {
  const unsigned i = thread_in_grid();
  if (i >= shape.quad_count()) return;
  const int first = 4 * quad_at(shape, i).w, m = cell_reach(bounds.reach), nx = 4 * shape.words;
  Quad<P> v = Quad<P>::far_away();
  for (int k = max(-m, -first); k <= min(m + 3, nx - 1 - first); ++k) {
    const int from = int(4 * i) + k;
    if (seeds[from] == 0) continue;
    P own = P::of(0, 0);
    if (bounds.offset_at_seed) {
      const uint2 w = w_of_cells[from];
      own = P::of(bounds.limit - w.y, bounds.limit - w.x);
    }
#pragma unroll
    for (int t = 0; t < 4; ++t) {
      const int d = abs(k - t);
      if (d <= m) v.cell[t].step_each(own, least_square(d), largest_square(d));
    }
  }
  out[i] = v;
}

/// Runs the pass along one more axis: `at` of `n` cells, `stride` quads apart.
template <class P>
__device__ Quad<P> cells_along(const Quad<P>* __restrict__ in, unsigned i, int at, int n, int stride, int m) {
  Quad<P> v = Quad<P>::far_away();
#pragma unroll 4
  for (int k = max(-m, -at); k <= min(m, n - 1 - at); ++k) {
    const Quad<P> from = in[int(i) + k * stride];
    const std::uint32_t least = least_square(abs(k)), largest = largest_square(abs(k));
#pragma unroll
    for (int t = 0; t < 4; ++t) v.cell[t].step_each(from.cell[t], least, largest);
  }
  return v;
}

template <class P>
__global__ void __launch_bounds__(kPassThreads)
    cells_y_kernel(const Quad<P>* __restrict__ in, const __grid_constant__ TransformBounds bounds, GridShape shape,
                   Quad<P>* __restrict__ out) {
  const unsigned i = thread_in_grid();
  if (i >= shape.quad_count()) return;
  out[i] = cells_along(in, i, quad_at(shape, i).cy, shape.cells_y(), shape.words, cell_reach(bounds.reach));
}

template <class P>
__global__ void __launch_bounds__(kPassThreads)
    cells_z_kernel(const Quad<P>* __restrict__ in, const uint2* __restrict__ w_of_cells,
                   const __grid_constant__ TransformBounds bounds, GridShape shape, std::uint32_t* __restrict__ near,
                   std::uint32_t* __restrict__ open) {
  const unsigned i = thread_in_grid();
  if (i >= shape.quad_count()) return;
  const Quad<P> v = cells_along(in, i, quad_at(shape, i).cz, shape.cells_z(), shape.words * shape.cells_y(),
                                cell_reach(bounds.reach));
  std::uint32_t is_near = 0, is_open = 0;
#pragma unroll
  for (int t = 0; t < 4; ++t) {
    const uint2 w = bounds.bound_at_voxel ? w_of_cells[4 * i + unsigned(t)] : make_uint2(bounds.limit, bounds.limit);
    const bool all_within = v.cell[t].high() < w.x, none_within = v.cell[t].low() >= w.y;
    is_near |= all_within ? 0xffu << (8 * t) : 0;
    is_open |= !all_within && !none_within ? 0xffu << (8 * t) : 0;
  }
  near[i] = is_near;
  open[i] = is_open;
}

__global__ void __launch_bounds__(kPassThreads)
    apply_kernel(bool erosion, const std::uint32_t* __restrict__ solid, const std::uint32_t* __restrict__ dilated,
                 const std::uint32_t* __restrict__ near, const std::uint32_t* __restrict__ open, VoxelRange region,
                 GridShape shape, std::uint32_t* __restrict__ out, std::uint8_t* __restrict__ wanted) {
  const unsigned i = thread_in_grid();
  if (i >= shape.word_count() / kCell) return;
  const unsigned rest = i / unsigned(shape.words);
  const int w = int(i - rest * unsigned(shape.words)), cy = int(rest % unsigned(shape.cells_y())),
            z = int(rest / unsigned(shape.cells_y()));
  const std::uint32_t quad = shape.quad(w, cy, z / kCell), is_near = near[quad], is_open = open[quad];
  std::uint32_t undecided = 0;
#pragma unroll
  for (int j = 0; j < kCell; ++j) {
    const int y = cy * kCell + j;
    const std::uint32_t at = shape.word(w, y, z), in = region.mask(w, y, z), g = solid[at];
    if (erosion) {
      const std::uint32_t d = dilated[at];
      out[at] = g | (d & ~is_near & ~is_open);
      undecided |= d & ~g & is_open & in;
    } else {
      out[at] = (g | is_near) & in;
      undecided |= ~g & is_open & in;
    }
  }
  if (undecided) wanted[quad] = 1;
}

/// One thread per y unit: is a wanted voxel within reach along z? A z unit is listed if it holds one.
__global__ void __launch_bounds__(kPassThreads)
    plan_columns_kernel(const std::uint8_t* __restrict__ wanted, TransformBounds bounds, GridShape shape, Slab slab,
                        WorkLists lists, unsigned threads) {
  const unsigned i = thread_in_grid(), units_y = unsigned(shape.ny / kUnit);
  const bool live = i < threads;
  const unsigned rest = i / unsigned(slab.words);
  const int wl = int(i - rest * unsigned(slab.words)), yu = int(rest % units_y), cz = int(rest / units_y);
  bool need = false, own = false;
  if (live) {
    const int m = cell_reach(bounds.reach);
    for (int k = max(cz - m, 0); k <= min(cz + m, shape.cells_z() - 1) && !need; ++k) {
      const std::uint32_t q = shape.quad(slab.w0 + wl, 2 * yu, k);
      need = wanted[q] | wanted[q + unsigned(shape.words)];
    }
    if (cz % 2 == 0 && need) {
      const std::uint32_t q = shape.quad(slab.w0 + wl, 2 * yu, cz), up = shape.quad(slab.w0 + wl, 2 * yu, cz + 1);
      own = wanted[q] | wanted[q + unsigned(shape.words)] | wanted[up] | wanted[up + unsigned(shape.words)];
    }
    lists.columns[i] = need;
  }
  append(need, i, lists.ys, &lists.counts->ys);
  append(own, unsigned(wl) + unsigned(slab.words) * (unsigned(yu) + units_y * unsigned(cz / 2)), lists.zs,
         &lists.counts->zs);
}

/// One thread per cell row of 8 x 8 rows: does a listed y unit read it, and is a seed in its reach along x?
__global__ void __launch_bounds__(kPassThreads)
    plan_rows_kernel(const std::uint8_t* __restrict__ seeds, TransformBounds bounds, GridShape shape, Slab slab,
                     WorkLists lists, unsigned threads) {
  const unsigned i = thread_in_grid(), units_y = unsigned(shape.ny / kUnit);
  const unsigned rest = i / unsigned(slab.words);
  const int wl = int(i - rest * unsigned(slab.words)), cy = int(rest % unsigned(shape.cells_y())),
            cz = int(rest / unsigned(shape.cells_y()));
  bool need = false;
  if (i < threads) {
    const int first = max(0, (kCell * cy - (kUnit - 1) - bounds.reach + kUnit - 1) / kUnit);
    const int last = min(int(units_y) - 1, (kCell * cy + kCell - 1 + bounds.reach) / kUnit);
    for (int yu = first; yu <= last && !need; ++yu) {
      need = lists.columns[unsigned(wl) + unsigned(slab.words) * (unsigned(yu) + units_y * unsigned(cz))];
    }
    if (need) {
      const int m = cell_reach(bounds.reach), row = int(4 * shape.quad(0, cy, cz)), cx = 4 * (slab.w0 + wl);
      need = false;
      for (int k = max(0, cx - m); k <= min(4 * shape.words - 1, cx + 3 + m) && !need; ++k) need = seeds[row + k] != 0;
    }
  }
  append(need, i, lists.rows, &lists.counts->rows);
}

}  // namespace

bool fits_16_bits(const TransformBounds& bounds) {
  return !bounds.wide && bounds.limit <= Packed16::kLimit;
}

void bound_cells(const ScaleView& scale, const GridShape& shape, uint2* w_of_cells, cudaStream_t stream) {
  launch("bound_cells_kernel", bound_cells_kernel, blocks_for(4 * shape.quad_count()), kPassThreads, 0, stream, scale,
         shape, w_of_cells);
}

namespace {

template <class P>
void answer_cells_as(const std::uint32_t* seeds, const uint2* w_of_cells, const TransformBounds& bounds,
                     const GridShape& shape, void* scratch, const CellAnswers& answers, cudaStream_t stream) {
  const unsigned blocks = blocks_for(shape.quad_count());
  Quad<P>*a = static_cast<Quad<P>*>(scratch), *b = a + shape.quad_count();
  launch("cells_x_kernel", cells_x_kernel<P>, blocks, kPassThreads, 0, stream,
         reinterpret_cast<const std::uint8_t*>(seeds), w_of_cells, bounds, shape, a);
  launch("cells_y_kernel", cells_y_kernel<P>, blocks, kPassThreads, 0, stream, a, bounds, shape, b);
  launch("cells_z_kernel", cells_z_kernel<P>, blocks, kPassThreads, 0, stream, b, w_of_cells, bounds, shape,
         answers.near, answers.open);
}

}  // namespace

std::size_t answer_bytes(const TransformBounds& bounds, const GridShape& shape) {
  return 2 * shape.quad_count() * (fits_16_bits(bounds) ? sizeof(Quad<Packed16>) : sizeof(Quad<Packed32>));
}

void answer_cells(const std::uint32_t* seeds, const uint2* w_of_cells, const TransformBounds& bounds,
                  const GridShape& shape, void* scratch, const CellAnswers& answers, cudaStream_t stream) {
  if (fits_16_bits(bounds))
    return answer_cells_as<Packed16>(seeds, w_of_cells, bounds, shape, scratch, answers, stream);
  answer_cells_as<Packed32>(seeds, w_of_cells, bounds, shape, scratch, answers, stream);
}

void apply_answers(bool erosion, const std::uint32_t* solid, const std::uint32_t* dilated, const CellAnswers& answers,
                   const VoxelRange& region, const GridShape& shape, std::uint32_t* out, std::uint8_t* wanted,
                   cudaStream_t stream) {
  launch("apply_kernel", apply_kernel, blocks_for(shape.word_count() / kCell), kPassThreads, 0, stream, erosion, solid,
         dilated, answers.near, answers.open, region, shape, out, wanted);
}

WorkSizes work_sizes(const GridShape& shape, int slab_words) {
  const std::size_t words = std::size_t(slab_words), uy = std::size_t(shape.ny / kUnit);
  return {words * std::size_t(shape.cells_y()) * std::size_t(shape.cells_z()),
          words * uy * std::size_t(shape.cells_z()), words * uy * std::size_t(shape.nz / kUnit)};
}

void plan_work(const std::uint8_t* wanted, const std::uint32_t* seeds, const TransformBounds& bounds,
               const GridShape& shape, const Slab& slab, const WorkLists& lists, cudaStream_t stream) {
  const WorkSizes n = work_sizes(shape, slab.words);
  launch("plan_columns_kernel", plan_columns_kernel, blocks_for(n.ys), kPassThreads, 0, stream, wanted, bounds, shape,
         slab, lists, unsigned(n.ys));
  launch("plan_rows_kernel", plan_rows_kernel, blocks_for(n.rows), kPassThreads, 0, stream,
         reinterpret_cast<const std::uint8_t*>(seeds), bounds, shape, slab, lists, unsigned(n.rows));
}

}  // namespace bp
