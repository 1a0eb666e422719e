// Separable squared-distance and power transforms after Saito & Toriwaki and Felzenszwalb & Huttenlocher, in the brute
// form min(best, value + d^2): on a window of some tens of voxels, two voxels to a register and skipping rows without
// seeds, it beats the lower-envelope form, whose branches diverge. An offset per seed turns distance into power at no
// cost after the first pass.
#include "gpu/distance_kernels.h"
#include "gpu/launch.h"
#include "gpu/packed_min.h"

namespace bp {

namespace {

constexpr int kPairs = 16;  ///< pairs of voxels in a word

/// Values of Packed16 or Packed32 at a place of the slab.
template <class P>
__device__ P* values_at(void* buffer, const TransformArgs& a, int wl, int z, int y) {
  return static_cast<P*>(buffer) +
         ((std::size_t(wl) * std::size_t(a.shape.nz) + std::size_t(z)) * std::size_t(a.shape.ny) + std::size_t(y)) *
             kPairs;
}

// ---------------------------------------------------------------- rows

/// Where a row's seeds lie around one word: its own bits, and the distance from its first and last voxel to the nearest
/// seed in the words before and after.
struct RowSeeds {
  std::uint32_t here;
  int before, after;
};
constexpr int kNone = 1 << 20;

__device__ RowSeeds row_seeds(const TransformArgs& a, int w, int y, int z) {
  const std::uint32_t* row = a.seeds + a.shape.word(0, y, z);
  RowSeeds s{row[w], kNone, kNone};
  for (int k = 1; 32 * (k - 1) < a.bounds.reach; ++k) {
    const std::uint32_t left = w - k >= 0 ? row[w - k] : 0, right = w + k < a.shape.words ? row[w + k] : 0;
    if (left != 0 && s.before == kNone) s.before = 32 * (k - 1) + __clz(int(left)) + 1;
    if (right != 0 && s.after == kNone) s.after = 32 * (k - 1) + __ffs(int(right));
  }
  return s;
}

/// Squared distance of voxel x of the word to the nearest seed of the row.
__device__ std::uint32_t row_value(std::uint32_t here, int before, int after, int x, int reach, std::uint32_t far) {
  const std::uint32_t left = here << (31 - x), right = here >> x;
  const int to_left = left ? __clz(int(left)) : x + before, to_right = right ? __ffs(int(right)) - 1 : 31 - x + after;
  const int d = min(to_left, to_right);
  return d <= reach ? std::uint32_t(d * d) : far;
}

/// Reads the seeds of the 64 rows of a cell row, two per lane, and stores which rows have any in reach.
struct CellRows {
  RowSeeds low, high;  ///< rows `lane` and `lane + 32`; row i is (y = i & 7, z = i >> 3)
  std::uint64_t mask;
};
__device__ CellRows load_rows(const TransformArgs& a, int wl, int cy, int cz) {
  const int lane = lane_id(), w = a.slab.w0 + wl, y = kCell * cy + (lane & 7), z = kCell * cz + (lane >> 3);
  CellRows r{row_seeds(a, w, y, z), row_seeds(a, w, y, z + 4), 0};
  const auto any = [&](const RowSeeds& s) {
    return s.here != 0 || s.before <= a.bounds.reach || s.after <= a.bounds.reach;
  };
  const std::uint32_t low = __ballot_sync(kAllLanes, any(r.low)), high = __ballot_sync(kAllLanes, any(r.high));
  r.mask = std::uint64_t(high) << 32 | low;
  if (lane < kCell) {
    const std::size_t at =
        (std::size_t(wl) * std::size_t(a.shape.nz) + std::size_t(kCell * cz + lane)) * std::size_t(a.shape.cells_y());
    a.buffers.row_flags[at + std::size_t(cy)] = std::uint8_t(r.mask >> (8 * lane));
  }
  return r;
}

struct UnitCoord {
  int wl, y, z;
};
__device__ UnitCoord unit_at(std::uint32_t id, int words, int ny) {
  const std::uint32_t rest = id / std::uint32_t(words);
  return {int(id - rest * std::uint32_t(words)), int(rest % std::uint32_t(ny)), int(rest / std::uint32_t(ny))};
}

/// Distance transform along x. A warp takes 8 x 8 rows; each half of it computes a row, each lane voxels x and x + 16.
template <class P>
__global__ void __launch_bounds__(kPassThreads) row_pass_kernel(const __grid_constant__ TransformArgs a) {
  const int lane = lane_id(), half = lane >> 4, x = lane & 15;
  const unsigned count = a.lists.counts->rows;
  for (unsigned item = next_item(&a.lists.counts->row_next); item < count;
       item = next_item(&a.lists.counts->row_next)) {
    const UnitCoord u = unit_at(a.lists.rows[item], a.slab.words, a.shape.cells_y());
    const CellRows r = load_rows(a, u.wl, u.y, u.z);
    for (std::uint64_t left = r.mask; left != 0;) {
      const int first = __ffsll((long long)left) - 1;
      left &= left - 1;
      const int second = left != 0 ? __ffsll((long long)left) - 1 : first;  // an odd one out is computed twice
      left &= left - 1;
      const int row = half ? second : first;
      const std::uint32_t here_low = __shfl_sync(kAllLanes, r.low.here, row),
                          here_high = __shfl_sync(kAllLanes, r.high.here, row);
      // both distances of a row in one register: reach is below 2^15
      const auto both = [](const RowSeeds& s) {
        return std::uint32_t(min(s.before, 0x7fff)) | std::uint32_t(min(s.after, 0x7fff)) << 16;
      };
      const std::uint32_t sides_low = __shfl_sync(kAllLanes, both(r.low), row),
                          sides_high = __shfl_sync(kAllLanes, both(r.high), row);
      const std::uint32_t here = row < 32 ? here_low : here_high, sides = row < 32 ? sides_low : sides_high;
      const int before = int(sides & 0xffff), after = int(sides >> 16);
      const P v = P::of(row_value(here, before, after, x, a.bounds.reach, P::kFar),
                        row_value(here, before, after, x + 16, a.bounds.reach, P::kFar));
      values_at<P>(a.buffers.rows, a, u.wl, kCell * u.z + (row >> 3), kCell * u.y + (row & 7))[x] = v;
    }
  }
}

/// The offsets of the seeds around one word of a row, in shared memory: kFar where there is none.
struct Offsets {
  std::uint32_t* at;  ///< [(2 side + 1) * 32]; voxel x of the word is at[32 side + x]
  int side;           ///< words on each side
  int seeds;          ///< in all
  std::uint32_t least;
};
template <class P>
__device__ Offsets load_offsets(const TransformArgs& a, std::uint32_t* memory, int side, int w, int y, int z) {
  Offsets o{memory, side, 0, P::kFar};
  const int lane = lane_id();
  const std::uint32_t* row = a.seeds + a.shape.word(0, y, z);
  __syncwarp();  // the row before has been read
  for (int k = -side; k <= side; ++k) {
    const std::uint32_t bits = w + k >= 0 && w + k < a.shape.words ? row[w + k] : 0;
    std::uint32_t offset = P::kFar;
    if (bits >> lane & 1) offset = a.bounds.limit - std::uint32_t(ball_bound(a.scale.at(32 * (w + k) + lane, y, z)));
    o.at[32 * (k + side) + lane] = offset;
    o.least = min(o.least, offset);
    o.seeds += __popc(bits);
  }
  o.least = warp_min(o.least);
  __syncwarp();
  return o;
}

/// min over the seeds in reach of d^2 + offset, at voxel `lane` of the word; at least kFar (or exact) if beyond the
/// limit.
template <class P>
__device__ std::uint32_t offset_value(const TransformArgs& a, const Offsets& o, int w, int y, int z) {
  const int lane = lane_id(), here = 32 * o.side + lane;
  std::uint32_t best = P::kFar;
  if (o.seeds <= kFewSeeds) {
    const std::uint32_t* row = a.seeds + a.shape.word(0, y, z);
    for (int k = -o.side; k <= o.side; ++k) {
      std::uint32_t bits = w + k >= 0 && w + k < a.shape.words ? row[w + k] : 0;
      for (; bits != 0; bits &= bits - 1) {
        const int q = 32 * (k + o.side) + __ffs(int(bits)) - 1, d = here - q;
        best = min(best, std::uint32_t(d * d) + o.at[q]);
      }
    }
  } else {
    for (int d = 0; d <= a.bounds.reach; ++d) {
      const std::uint32_t d2 = std::uint32_t(d * d);
      best = min(best, d2 + min(o.at[here - d], o.at[here + d]));
      if ((d & 3) == 3 && d2 + o.least >= warp_max(best)) break;  // farther seeds cannot do better
    }
  }
  return best < a.bounds.limit ? best : P::kFar;
}

/// Power transform along x (scale varies at the seed). A warp takes 8 x 8 rows, one row at a time, a voxel per lane.
template <class P>
__global__ void __launch_bounds__(kPassThreads)
    row_pass_offset_kernel(const __grid_constant__ TransformArgs a, int side) {
  const int lane = lane_id();
  std::uint32_t* memory =
      static_cast<std::uint32_t*>(dynamic_shared_memory()) + warp_in_block() * unsigned(2 * side + 1) * 32;
  const unsigned count = a.lists.counts->rows;
  for (unsigned item = next_item(&a.lists.counts->row_next); item < count;
       item = next_item(&a.lists.counts->row_next)) {
    const UnitCoord u = unit_at(a.lists.rows[item], a.slab.words, a.shape.cells_y());
    for (std::uint64_t left = load_rows(a, u.wl, u.y, u.z).mask; left != 0; left &= left - 1) {
      const int row = __ffsll((long long)left) - 1, y = kCell * u.y + (row & 7), z = kCell * u.z + (row >> 3),
                w = a.slab.w0 + u.wl;
      const Offsets o = load_offsets<P>(a, memory, side, w, y, z);
      const std::uint32_t v = offset_value<P>(a, o, w, y, z), other = __shfl_xor_sync(kAllLanes, v, 16);
      if (lane < kPairs) values_at<P>(a.buffers.rows, a, u.wl, z, y)[lane] = P::of(v, other);
    }
  }
}

// ---------------------------------------------------------------- y and z

__host__ __device__ int padded_reach(int reach) {
  return (reach + kRowGroup - 1) / kRowGroup * kRowGroup;
}
/// Groups of inputs in reach of a unit of outputs.
__host__ __device__ int group_count(int reach) {
  return (kUnit + 2 * padded_reach(reach)) / kRowGroup;
}
/// Squares of -(padded + 16) ... : entry i is (i - padded - 16)^2, so that a group's squares start at a multiple of 8.
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
  /// Takes the inputs of one group: those of `uniform` (the same for the warp), far away where `own` lacks the bit.
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

/// Slices of a z unit in rows `row` and `row` + 1, and the decision.
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

/// Along z, and the decision. A warp takes 16 slices of two neighbouring rows at a time; half a z unit from the queue.
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

template <class F>
void with_packing(const TransformArgs& a, F f) {
  if (fits_16_bits(a.bounds)) {
    f(Packed16{});
  } else {
    f(Packed32{});
  }
}

constexpr std::size_t kSharedLimit = 48 * 1024;  ///< what every device gives without asking

}  // namespace

bool fits_16_bits(const TransformBounds& bounds) {
  return !bounds.wide && bounds.limit <= Packed16::kLimit;
}

TransformBytes transform_bytes(const TransformBounds& bounds, const GridShape& shape, int slab_words) {
  const std::size_t words = std::size_t(slab_words), ny = std::size_t(shape.ny), nz = std::size_t(shape.nz);
  TransformBytes b{};
  b.values = words * ny * nz * kPairs * (fits_16_bits(bounds) ? sizeof(Packed16) : sizeof(Packed32));
  b.row_flags = words * nz * (ny / kCell);
  b.slice_stride = std::int32_t((nz + 31) / 32 * 4);
  b.slice_flags = words * (ny / kUnit) * std::size_t(b.slice_stride);
  return b;
}

void row_pass(const TransformArgs& a, int multiprocessors, cudaStream_t stream) {
  const unsigned blocks = unsigned(multiprocessors) * 4;
  with_packing(a, [&](auto packing) {
    using P = decltype(packing);
    if (!a.bounds.offset_at_seed) {
      launch("row_pass_kernel", row_pass_kernel<P>, blocks, kPassThreads, 0, stream, a);
      return;
    }
    const int side = (a.bounds.reach + 31) / 32;
    const std::size_t per_warp = std::size_t(2 * side + 1) * 32 * 4;
    unsigned warps = kPassThreads / kWarp;
    while (warps > 1 && warps * per_warp > kSharedLimit) warps /= 2;
    launch("row_pass_offset_kernel", row_pass_offset_kernel<P>, blocks * (kPassThreads / kWarp / warps), warps * kWarp,
           warps * per_warp, stream, a, side);
  });
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
