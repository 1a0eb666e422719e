// Separable squared-distance and power transforms after Saito & Toriwaki and Felzenszwalb & Huttenlocher, in the
// brute-force form min(best, value + d^2). On a window of some tens of voxels, with two voxels to a register and
// skipping rows without seeds, it beats the lower-envelope form, whose branches diverge. An offset per seed turns
// distance into power at no cost after the first pass.
#include "gpu/kernels/transform_device.h"

namespace bp {

namespace {

__host__ __device__ int padded_reach(int reach) {
  return (reach + kRowGroup - 1) / kRowGroup * kRowGroup;
}
/// Returns the number of groups of inputs in reach of a unit of outputs.
__host__ __device__ int group_count(int reach) {
  return (kUnit + 2 * padded_reach(reach)) / kRowGroup;
}
/// Returns the size of the table of squares: entry i is (i - padded - 16)^2, so a group's squares start at a multiple
/// of 8.
__host__ __device__ int table_size(int reach) {
  return kRowGroup * group_count(reach) + kUnit;
}
template <class P>
__device__ const uint4* squares_table(int reach) {
  std::uint32_t* table = static_cast<std::uint32_t*>(dynamic_shared_memory());
  for (int i = int(threadIdx.x); i < table_size(reach); i += int(blockDim.x)) {
    const int d = i - padded_reach(reach) - kUnit;
    table[i] = P::square(std::uint32_t(d * d));
  }
  __syncthreads();
  return reinterpret_cast<const uint4*>(table);
}

/// The outputs a thread holds: best values of one pair at kUnit places along the axis of the pass.
template <class P>
struct Column {
  P best[kUnit];
  __device__ Column() {
#pragma unroll
    for (int t = 0; t < kUnit; ++t) best[t] = P::far_away();
  }
  /// Takes the inputs of one group: those of `uniform` (the same for the warp). Where `own` lacks the bit, an input
  /// counts as far away.
  ///   from    input j at from[j * stride]
  ///   table   squares for this group, see squares_table
  __device__ void take(const P* from, std::size_t stride, unsigned uniform, unsigned own, const uint4* table) {
    P in[kRowGroup];
#pragma unroll
    for (int j = 0; j < kRowGroup; ++j) {
      in[j] = P::far_away();
      if (own >> j & 1) in[j] = from[std::size_t(j) * stride];
    }
    std::uint32_t square[kRowGroup + kUnit];
#pragma unroll
    for (int i = 0; i < (kRowGroup + kUnit) / 4; ++i) {
      const uint4 four = table[i];
      square[4 * i] = four.x, square[4 * i + 1] = four.y, square[4 * i + 2] = four.z, square[4 * i + 3] = four.w;
    }
#pragma unroll
    for (int j = 0; j < kRowGroup; ++j) {
      if (uniform >> j & 1) {
#pragma unroll
        for (int t = 0; t < kUnit; ++t) best[t].step(in[j], square[j - t + kUnit]);
      }
    }
  }
};

/// One y unit in slices z and z + 1.
template <class P>
__device__ void y_unit(const TransformArgs& a, const uint4* table, const UnitCoord& u, int z) {
  const int lane = lane_id(), half = lane >> 4, pair = lane & 15;
  const int groups = group_count(a.bounds.reach), flag_rows = a.shape.cells_y(),
            first = kUnit * u.y - padded_reach(a.bounds.reach);
  const std::uint8_t* flags =
      a.buffers.row_flags + (std::size_t(u.wl) * std::size_t(a.shape.nz) + std::size_t(z)) * std::size_t(flag_rows);
  Column<P> column;
  unsigned seen_low = 0, seen_high = 0;
  for (int base = 0; base < groups; base += kWarp) {
    const int g = base + lane, at = first / kRowGroup + g;
    const bool inside = g < groups && at >= 0 && at < flag_rows;
    const unsigned mine = inside ? unsigned(flags[at]) | unsigned(flags[flag_rows + at]) << 8 : 0;
    for (unsigned left = __ballot_sync(kAllLanes, mine != 0); left != 0; left &= left - 1) {
      const int i = __ffs(int(left)) - 1;
      const unsigned both = __shfl_sync(kAllLanes, mine, i), low = both & 0xff, high = both >> 8;
      seen_low |= low, seen_high |= high;
      const int y = first + kRowGroup * (base + i);
      column.take(values_at<P>(a.buffers.rows, a, u.wl, z + half, y) + pair, kPairs, low | high, half ? high : low,
                  table + (kRowGroup / 4) * (base + i));
    }
  }
  if ((seen_low | seen_high) == 0) return;
  P* to = values_at<P>(a.buffers.planes, a, u.wl, z + half, kUnit * u.y) + pair;
#pragma unroll
  for (int t = 0; t < kUnit; ++t) to[t * kPairs] = column.best[t];
  if (pair == 0 && (half ? seen_high : seen_low) != 0) {
    const std::size_t line = std::size_t(u.wl) * std::size_t(a.shape.ny / kUnit) + std::size_t(u.y);
    std::uint32_t* slices =
        reinterpret_cast<std::uint32_t*>(a.buffers.slice_flags + line * std::size_t(a.buffers.slice_stride));
    atomicOr(&slices[(z + half) >> 5], 1u << ((z + half) & 31));
  }
}

/// Along y. A warp takes 16 rows of two neighbouring slices at a time: a half of the warp each.
template <class P>
__global__ void __launch_bounds__(kPassThreads, sizeof(P) == 4 ? 3 : 2)
    y_pass_kernel(const __grid_constant__ TransformArgs a) {
  const uint4* table = squares_table<P>(a.bounds.reach);
  const unsigned count = a.lists.counts->ys;
  for (unsigned item = next_item(&a.lists.counts->y_next); item < count; item = next_item(&a.lists.counts->y_next)) {
    const UnitCoord u = unit_at(a.lists.ys[item], a.slab.words, a.shape.ny / kUnit);
    for (int slices = 0; slices < kCell; slices += 2) y_unit<P>(a, table, u, kCell * u.z + slices);
  }
}

/// Runs the z pass of a z unit in rows `row` and `row` + 1, and decides.
template <class P, bool kBoundAtVoxel>
__device__ void z_unit(const TransformArgs& a, const DecideArgs& decide, const uint4* table, const UnitCoord& u,
                       int row) {
  const int lane = lane_id(), half = lane >> 4, pair = lane & 15;
  const int groups = group_count(a.bounds.reach), flag_bytes = a.shape.nz / kRowGroup,
            first = kUnit * u.z - padded_reach(a.bounds.reach);
  const std::size_t slice = std::size_t(a.shape.ny) * kPairs;
  const int y = row + half, w = a.slab.w0 + u.wl;
  // Lane t and lane 16 + t own the words of slice t of the two rows.
  const int own_z = kUnit * u.z + pair;
  const std::uint32_t at = a.shape.word(w, y, own_z);
  std::uint32_t asked = decide.open[a.shape.quad(w, y / kCell, own_z / kCell)] & decide.region.mask(w, y, own_z);
  if (asked != 0) asked &= ~decide.solid[at];
  if (asked != 0 && decide.erosion) asked &= decide.dilated[at];
  if (!__any_sync(kAllLanes, asked != 0)) return;

  Column<P> column;
  const std::size_t line = std::size_t(u.wl) * std::size_t(a.shape.ny / kUnit) + std::size_t(u.y);
  const std::uint8_t* flags = a.buffers.slice_flags + line * std::size_t(a.buffers.slice_stride);
  for (int base = 0; base < groups; base += kWarp) {
    const int g = base + lane, byte = first / kRowGroup + g;
    const unsigned mine = g < groups && byte >= 0 && byte < flag_bytes ? flags[byte] : 0;
    for (unsigned left = __ballot_sync(kAllLanes, mine != 0); left != 0; left &= left - 1) {
      const int i = __ffs(int(left)) - 1;
      const unsigned slices = __shfl_sync(kAllLanes, mine, i);
      column.take(values_at<P>(a.buffers.planes, a, u.wl, first + kRowGroup * (base + i), y) + pair, slice, slices,
                  slices, table + (kRowGroup / 4) * (base + i));
    }
  }

  std::uint32_t within = 0;
#pragma unroll
  for (int t = 0; t < kUnit; ++t) {
    std::uint32_t low_bound = a.bounds.limit, high_bound = a.bounds.limit;
    if (kBoundAtVoxel) {
      low_bound = std::uint32_t(ball_bound(a.scale.at(32 * w + pair, y, kUnit * u.z + t)));
      high_bound = std::uint32_t(ball_bound(a.scale.at(32 * w + pair + 16, y, kUnit * u.z + t)));
    }
    const std::uint32_t low = __ballot_sync(kAllLanes, column.best[t].low() < low_bound),
                        high = __ballot_sync(kAllLanes, column.best[t].high() < high_bound);
    const std::uint32_t word = half ? (low >> 16 | (high & 0xffff0000u)) : ((low & 0xffff) | high << 16);
    if (pair == t) within = word;
  }
  const std::uint32_t set = asked & (decide.erosion ? ~within : within);
  if (set != 0) decide.out[at] |= set;
}

/// The pass along z, which also decides each voxel. A warp computes 16 slices of two neighbouring rows at a time. An
/// item of the queue is 8 of the 16 rows of a z unit.
template <class P, bool kBoundAtVoxel>
__global__ void __launch_bounds__(kPassThreads, sizeof(P) == 4 ? 3 : 2)
    z_pass_kernel(const __grid_constant__ TransformArgs a, const __grid_constant__ DecideArgs decide) {
  const uint4* table = squares_table<P>(a.bounds.reach);
  const unsigned count = a.lists.counts->zs * 2;
  for (unsigned item = next_item(&a.lists.counts->z_next); item < count; item = next_item(&a.lists.counts->z_next)) {
    const UnitCoord u = unit_at(a.lists.zs[item / 2], a.slab.words, a.shape.ny / kUnit);
    for (int i = 0; i < kUnit / 2; i += 2)
      z_unit<P, kBoundAtVoxel>(a, decide, table, u, kUnit * u.y + int(item % 2) * (kUnit / 2) + i);
  }
}

template <class P>
std::size_t table_bytes(const TransformArgs& a) {
  return std::size_t(table_size(a.bounds.reach)) * 4;
}

}  // namespace

TransformBytes transform_bytes(const TransformBounds& bounds, const GridShape& shape, int slab_words) {
  const std::size_t words = std::size_t(slab_words), ny = std::size_t(shape.ny), nz = std::size_t(shape.nz);
  TransformBytes b{};
  b.values = words * ny * nz * kPairs * (fits_16_bits(bounds) ? sizeof(Packed16) : sizeof(Packed32));
  b.row_flags = words * nz * (ny / kCell);
  b.slice_stride = std::int32_t((nz + 31) / 32 * 4);
  b.slice_flags = words * (ny / kUnit) * std::size_t(b.slice_stride);
  return b;
}

void y_pass(const TransformArgs& a, int multiprocessors, cudaStream_t stream) {
  with_packing(a, [&](auto packing) {
    using P = decltype(packing);
    launch("y_pass_kernel", y_pass_kernel<P>, unsigned(multiprocessors) * (sizeof(P) == 4 ? 3 : 2), kPassThreads,
           table_bytes<P>(a), stream, a);
  });
}

void z_pass(const TransformArgs& a, const DecideArgs& decide, int multiprocessors, cudaStream_t stream) {
  with_packing(a, [&](auto packing) {
    using P = decltype(packing);
    const unsigned blocks = unsigned(multiprocessors) * (sizeof(P) == 4 ? 3 : 2);
    const auto kernel = a.bounds.bound_at_voxel ? z_pass_kernel<P, true> : z_pass_kernel<P, false>;
    launch("z_pass_kernel", kernel, blocks, kPassThreads, table_bytes<P>(a), stream, a, decide);
  });
}

}  // namespace bp
