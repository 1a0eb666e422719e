// The pass along x of the separable transforms (gpu/kernels/distance_kernels.cu), from bits to small integers. With one
// scale a row's values are squared distances to the nearest seed, and counting zeros gives them. With a scale per seed
// a nearer seed may have the smaller ball, so all seeds in reach count.
#include "gpu/kernels/transform_device.h"

namespace bp {

namespace {

/// The seeds of a row around one word: the word's own bits, and the distances from its first and last voxel to the
/// nearest seed in the words before and after.
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

/// Returns the squared distance of voxel x of the word to the nearest seed of the row.
__device__ std::uint32_t row_value(std::uint32_t here, int before, int after, int x, int reach, std::uint32_t far) {
  const std::uint32_t left = here << (31 - x), right = here >> x;
  const int to_left = left ? __clz(int(left)) : x + before, to_right = right ? __ffs(int(right)) - 1 : 31 - x + after;
  const int d = min(to_left, to_right);
  return d <= reach ? std::uint32_t(d * d) : far;
}

/// Reads the seeds of the 64 rows of a cell row, two per lane, and stores which rows have any in `reach`.
struct CellRows {
  RowSeeds low, high;  ///< rows `lane` and `lane + 32`; row i is (y = i & 7, z = i >> 3)
  std::uint64_t mask;
};
__device__ CellRows load_rows(const TransformArgs& a, int wl, int cy, int cz, const int& reach) {
  const int lane = lane_id(), w = a.slab.w0 + wl, y = kCell * cy + (lane & 7), z = kCell * cz + (lane >> 3);
  CellRows r{row_seeds(a, w, y, z), row_seeds(a, w, y, z + 4), 0};
  const auto any = [&](const RowSeeds& s) { return s.here != 0 || s.before <= reach || s.after <= reach; };
  const std::uint32_t low = __ballot_sync(kAllLanes, any(r.low)), high = __ballot_sync(kAllLanes, any(r.high));
  r.mask = std::uint64_t(high) << 32 | low;
  if (lane < kCell) {
    const std::size_t at =
        (std::size_t(wl) * std::size_t(a.shape.nz) + std::size_t(kCell * cz + lane)) * std::size_t(a.shape.cells_y());
    a.buffers.row_flags[at + std::size_t(cy)] = std::uint8_t(r.mask >> (8 * lane));
  }
  return r;
}

/// Distance transform along x. A warp takes 8 x 8 rows. Each half of it computes a row; each lane computes voxels x and
/// x + 16.
template <class P>
__global__ void __launch_bounds__(kPassThreads) row_pass_kernel(const __grid_constant__ TransformArgs a) {
  const int lane = lane_id(), half = lane >> 4, x = lane & 15;
  const unsigned count = a.lists.counts->rows;
  for (unsigned item = next_item(&a.lists.counts->row_next); item < count;
       item = next_item(&a.lists.counts->row_next)) {
    const UnitCoord u = unit_at(a.lists.rows[item], a.slab.words, a.shape.cells_y());
    const CellRows r = load_rows(a, u.wl, u.y, u.z, a.bounds.reach);
    for (std::uint64_t left = r.mask; left != 0;) {
      const int first = __ffsll((long long)left) - 1;
      left &= left - 1;
      const int second = left != 0 ? __ffsll((long long)left) - 1 : first;  // an odd row at the end is computed twice
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

/// The shared memory of a warp in the power transform along x. Eight rows go together, two to a register: four pairs of
/// rows, and in each an entry per voxel within `side` words of the word.
constexpr int kRowPairs = 4, kRun = 4;  ///< a lane computes kRun neighbouring voxels of one pair of rows
struct RowMemory {
  uint4* corners;          ///< the four samples around the unit's rows at x = 8 i, from the first word on
  std::uint32_t* columns;  ///< [row of the eight][corner]: 64 S there
  std::uint32_t*
      entries;  ///< [pair][voxel]: offsets of the seeds of both rows as Packed16 holds them; far where there is no seed
};
__host__ __device__ int row_corners(int side) {
  return 4 * (2 * side + 1) + 1;
}
__host__ __device__ int row_entries(int side) {
  return 32 * (2 * side + 1);
}
__host__ __device__ std::size_t row_memory_bytes(int side) {
  return std::size_t(row_corners(side)) * (16 + 2 * kRowPairs * 4) + std::size_t(kRowPairs * row_entries(side)) * 4;
}
/// Blocks on a multiprocessor: the pass waits for memory more than it computes.
constexpr int kPowerBlocks = 5;
#if defined(__CUDA_ARCH__) && __CUDA_ARCH__ < 800
[[maybe_unused]] constexpr int kPowerResident =
    4;  ///< no more threads fit on a multiprocessor of compute capability 7.5
#else
[[maybe_unused]] constexpr int kPowerResident = kPowerBlocks;
#endif
/// Returns how many groups of kRun inputs are in reach of kRun outputs, and how far they reach.
__host__ __device__ int run_reach(int reach) {
  return (reach + kRun - 1) / kRun * kRun;
}
__host__ __device__ int run_groups(int reach) {
  return 1 + 2 * run_reach(reach) / kRun;
}

/// Loads the samples around a unit. Returns a bound of the reach of the balls of all seeds in question.
__device__ int load_corners(const TransformArgs& a, const RowMemory& memory, int side, const UnitCoord& u) {
  std::uint32_t most = 0;
  for (int i = lane_id(); i < row_corners(side); i += kWarp) {
    const int cx = 4 * (a.slab.w0 + u.wl - side) + i;
    const uint4 s = make_uint4(a.scale.sample(cx, u.y, u.z), a.scale.sample(cx, u.y + 1, u.z),
                               a.scale.sample(cx, u.y, u.z + 1), a.scale.sample(cx, u.y + 1, u.z + 1));
    memory.corners[i] = s;
    most = max(most, max(max(s.x, s.y), max(s.z, s.w)));
  }
  return min(a.bounds.reach, int(warp_max(most) + kScaleOne - 1) / kScaleOne);
}

/// Writes 64 S at the corners of one pair of rows of a unit: half a warp per row.
__device__ void load_columns(const RowMemory& memory, int side, int pair, int first, int second) {
  const int half = lane_id() >> 4, row = half ? second : first, corners = row_corners(side);
  const std::uint32_t fy = std::uint32_t(row & 7), fz = std::uint32_t(row >> 3);
  if (row < 0) return;
  for (int i = lane_id() & 15; i < corners; i += 16) {
    const uint4 c = memory.corners[i];  // ScaleView::column
    memory.columns[(2 * pair + half) * corners + i] =
        (8 - fz) * ((8 - fy) * c.x + fy * c.y) + fz * ((8 - fy) * c.z + fy * c.w);
  }
}

/// Returns the offset of a seed `fx` voxels behind a corner.
__device__ std::uint32_t seed_offset(const std::uint32_t* column, std::uint32_t fx, std::uint32_t limit) {
  return limit - std::uint32_t(ball_bound(Scale(((8 - fx) * column[0] + fx * column[1]) >> 9)));
}

/// Writes the entries of one pair of rows of a unit. `second` < 0: there is no second row.
__device__ void load_pair(const TransformArgs& a, const RowMemory& memory, int side, const UnitCoord& u, int pair,
                          int first, int second) {
  const int lane = lane_id(), w = a.slab.w0 + u.wl, corners = row_corners(side);
  const std::uint32_t* row_a = a.seeds + a.shape.word(0, kCell * u.y + (first & 7), kCell * u.z + (first >> 3));
  const std::uint32_t* row_b =
      second < 0 ? nullptr : a.seeds + a.shape.word(0, kCell * u.y + (second & 7), kCell * u.z + (second >> 3));
  for (int k = -side; k <= side; ++k) {
    const bool inside = w + k >= 0 && w + k < a.shape.words;
    const std::uint32_t bits_a = inside ? row_a[w + k] : 0, bits_b = inside && row_b != nullptr ? row_b[w + k] : 0;
    const std::uint32_t *column_a = memory.columns + 2 * pair * corners + 4 * (k + side) + (lane >> 3),
                        *column_b = column_a + corners, fx = std::uint32_t(lane & 7);
    std::uint32_t low = Packed16::kFar, high = Packed16::kFar;
    if (bits_a != 0) {
      const std::uint32_t offset = seed_offset(column_a, fx, a.bounds.limit);
      if (bits_a >> lane & 1) low = offset;
    }
    if (bits_b != 0) {
      const std::uint32_t offset = seed_offset(column_b, fx, a.bounds.limit);
      if (bits_b >> lane & 1) high = offset;
    }
    memory.entries[pair * row_entries(side) + 32 * (k + side) + lane] = Packed16::of(low, high).v;
  }
}

/// Computes the values of kRun voxels of two rows. `inputs` is the first voxel in reach.
__device__ void take_window(Packed16 (&best)[kRun], const std::uint32_t* inputs, int groups, const uint4* squares) {
  uint4 below = squares[0];
#pragma unroll 2
  for (int g = 0; g < groups; ++g) {
    const uint4 above = squares[g + 1], in = reinterpret_cast<const uint4*>(inputs)[g];
    const std::uint32_t square[2 * kRun] = {below.x, below.y, below.z, below.w, above.x, above.y, above.z, above.w};
    const std::uint32_t from[kRun] = {in.x, in.y, in.z, in.w};
#pragma unroll
    for (int j = 0; j < kRun; ++j) {
#pragma unroll
      for (int t = 0; t < kRun; ++t) best[t].step(Packed16{from[j]}, square[j - t + kRun]);
    }
    below = above;
  }
}

/// Returns the rows of a unit with at most kFewSeeds seeds in the words in question.
__device__ std::uint64_t rows_with_few(const TransformArgs& a, int side, const UnitCoord& u) {
  const auto few = [&](int row) {
    const std::uint32_t* seeds = a.seeds + a.shape.word(0, kCell * u.y + (row & 7), kCell * u.z + (row >> 3));
    const int w = a.slab.w0 + u.wl;
    int count = 0;
    for (int k = max(w - side, 0); k <= min(w + side, a.shape.words - 1); ++k) count += __popc(seeds[k]);
    return count <= kFewSeeds;
  };
  const std::uint32_t low = __ballot_sync(kAllLanes, few(lane_id())),
                      high = __ballot_sync(kAllLanes, few(lane_id() + 32));
  return std::uint64_t(high) << 32 | low;
}

/// Transforms up to eight rows with few seeds, seed by seed: four lanes share a row, and each computes eight voxels of
/// it.
__device__ void transform_few(const TransformArgs& a, const RowMemory& memory, int side, const UnitCoord& u,
                              const int (&rows)[2 * kRowPairs]) {
  const int own = lane_id() >> 2, x = 4 * (lane_id() & 3), w = a.slab.w0 + u.wl;
  __syncwarp();  // the corners are there; the previous columns have been read
  int row = -1;
#pragma unroll
  for (int pair = 0; pair < kRowPairs; ++pair) {
    load_columns(memory, side, pair, rows[2 * pair], rows[2 * pair + 1]);
    if (own == 2 * pair) row = rows[2 * pair];
    if (own == 2 * pair + 1) row = rows[2 * pair + 1];
  }
  __syncwarp();
  if (row < 0) return;
  const int y = kCell * u.y + (row & 7), z = kCell * u.z + (row >> 3);
  const std::uint32_t* seeds = a.seeds + a.shape.word(0, y, z);
  const std::uint32_t* columns = memory.columns + own * row_corners(side);
  Packed16 best[4];
#pragma unroll
  for (Packed16& v : best) v = Packed16::far_away();
  for (int k = max(-side, -w); k <= min(side, a.shape.words - 1 - w); ++k) {
    for (std::uint32_t bits = seeds[w + k]; bits != 0; bits &= bits - 1) {
      const int q = __ffs(int(bits)) - 1, d = 32 * k + q - x;
      const std::uint32_t offset =
          seed_offset(columns + 4 * (k + side) + (q >> 3), std::uint32_t(q & 7), a.bounds.limit);
      const Packed16 both = Packed16::of(offset, offset);
#pragma unroll
      for (int t = 0; t < 4; ++t)
        best[t].step_each(both, std::uint32_t((d - t) * (d - t)), std::uint32_t((d - t - 16) * (d - t - 16)));
    }
  }
  reinterpret_cast<uint4*>(values_at<Packed16>(a.buffers.rows, a, u.wl, z, y) + x)[0] =
      make_uint4(best[0].v, best[1].v, best[2].v, best[3].v);
}

/// Transforms up to eight rows, two to a register. Eight lanes share a pair of rows, and each looks at all voxels in
/// `reach`.
__device__ void transform_many(const TransformArgs& a, const RowMemory& memory, int side, const UnitCoord& u,
                               const int (&rows)[2 * kRowPairs], int reach, const uint4* squares) {
  const int group = lane_id() >> 3, run = lane_id() & 7;
  __syncwarp();  // the corners are there; the previous columns and entries have been read
#pragma unroll
  for (int pair = 0; pair < kRowPairs; ++pair) load_columns(memory, side, pair, rows[2 * pair], rows[2 * pair + 1]);
  __syncwarp();
  int first = -1, second = -1;  // rows of this lane's pair
#pragma unroll
  for (int pair = 0; pair < kRowPairs; ++pair) {
    if (rows[2 * pair] >= 0) load_pair(a, memory, side, u, pair, rows[2 * pair], rows[2 * pair + 1]);
    if (pair == group) first = rows[2 * pair], second = rows[2 * pair + 1];
  }
  __syncwarp();
  Packed16 best[kRun];
#pragma unroll
  for (int t = 0; t < kRun; ++t) best[t] = Packed16::far_away();
  if (first >= 0)
    take_window(best, memory.entries + group * row_entries(side) + 32 * side + kRun * run - reach, run_groups(reach),
                squares);
  // Lanes 0..3 of a group hold voxels x of both rows, lanes 4..7 voxels x + 16: each keeps one row.
  std::uint32_t out[kRun];
#pragma unroll
  for (int t = 0; t < kRun; ++t) {
    const std::uint32_t other = __shfl_xor_sync(kAllLanes, best[t].v, 4);
    out[t] = run < 4 ? __byte_perm(best[t].v, other, 0x5410) : __byte_perm(other, best[t].v, 0x7632);
  }
  const int row = run < 4 ? first : second;
  if (row >= 0) {
    Packed16* to = values_at<Packed16>(a.buffers.rows, a, u.wl, kCell * u.z + (row >> 3), kCell * u.y + (row & 7));
    reinterpret_cast<uint4*>(to)[run & 3] = make_uint4(out[0], out[1], out[2], out[3]);
  }
}

/// Takes the next eight rows; -1 where none is left.
__device__ void take_rows(std::uint64_t& left, int (&rows)[2 * kRowPairs]) {
#pragma unroll
  for (int& row : rows) {
    row = __ffsll((long long)left) - 1;
    left &= left - 1;
  }
}

/// The power transform along x in 16 bits: the ball belongs to the seed, and its size varies. A warp takes 8 x 8 rows.
__global__ void __launch_bounds__(kPassThreads, kPowerResident)
    row_pass_power_kernel(const __grid_constant__ TransformArgs a, int side) {
  std::uint32_t* squares = static_cast<std::uint32_t*>(dynamic_shared_memory());
  const int groups = run_groups(a.bounds.reach), reach = run_reach(a.bounds.reach);
  for (int i = int(threadIdx.x); i < kRun * (groups + 1); i += int(blockDim.x)) {
    const int d = i - reach - kRun;
    squares[i] = Packed16::square(std::uint32_t(d * d));
  }
  __syncthreads();
  std::uint8_t* own =
      reinterpret_cast<std::uint8_t*>(squares + kRun * (groups + 1)) + warp_in_block() * row_memory_bytes(side);
  std::uint32_t* entries = reinterpret_cast<std::uint32_t*>(own + row_corners(side) * 16);
  const RowMemory memory{reinterpret_cast<uint4*>(own), entries + kRowPairs * row_entries(side), entries};

  const unsigned count = a.lists.counts->rows;
  for (unsigned item = next_item(&a.lists.counts->row_next); item < count;
       item = next_item(&a.lists.counts->row_next)) {
    const UnitCoord u = unit_at(a.lists.rows[item], a.slab.words, a.shape.cells_y());
    __syncwarp();  // the previous corners have been read
    const int local_reach = load_corners(a, memory, side, u), padded = run_reach(local_reach);
    const std::uint64_t rows = load_rows(a, u.wl, u.y, u.z, local_reach).mask, few = rows & rows_with_few(a, side, u);
    for (std::uint64_t left = few; left != 0;) {
      int next[2 * kRowPairs];
      take_rows(left, next);
      transform_few(a, memory, side, u, next);
    }
    for (std::uint64_t left = rows & ~few; left != 0;) {
      int next[2 * kRowPairs];
      take_rows(left, next);
      transform_many(a, memory, side, u, next, padded, reinterpret_cast<const uint4*>(squares + reach - padded));
    }
  }
}

/// The offsets of the seeds around one word of a row, in shared memory; kFar where there is no seed.
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
  __syncwarp();  // the previous row has been read
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

/// Returns the minimum of d^2 + offset over the seeds in reach, at voxel `lane` of the word. A minimum beyond the limit
/// may come back as kFar.
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

/// The power transform along x in 32 bits, for large scales. A warp takes 8 x 8 rows, one row at a time, a voxel per
/// lane.
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
    for (std::uint64_t left = load_rows(a, u.wl, u.y, u.z, a.bounds.reach).mask; left != 0; left &= left - 1) {
      const int row = __ffsll((long long)left) - 1, y = kCell * u.y + (row & 7), z = kCell * u.z + (row >> 3),
                w = a.slab.w0 + u.wl;
      const Offsets o = load_offsets<P>(a, memory, side, w, y, z);
      const std::uint32_t v = offset_value<P>(a, o, w, y, z), other = __shfl_xor_sync(kAllLanes, v, 16);
      if (lane < kPairs) values_at<P>(a.buffers.rows, a, u.wl, z, y)[lane] = P::of(v, other);
    }
  }
}

constexpr std::size_t kSharedLimit = 48 * 1024;  ///< bytes of shared memory that every device gives without a request

}  // namespace

void row_pass(const TransformArgs& a, int multiprocessors, cudaStream_t stream) {
  const unsigned blocks = unsigned(multiprocessors) * 4;
  with_packing(a, [&](auto packing) {
    using P = decltype(packing);
    if (!a.bounds.offset_at_seed) {
      launch("row_pass_kernel", row_pass_kernel<P>, blocks, kPassThreads, 0, stream, a);
      return;
    }
    const int side = (a.bounds.reach + 31) / 32;
    unsigned warps = kPassThreads / kWarp;
    if constexpr (sizeof(P) == sizeof(Packed16)) {
      const std::size_t squares = std::size_t(kRun * (run_groups(a.bounds.reach) + 1)) * 4;
      while (warps > 1 && squares + warps * row_memory_bytes(side) > kSharedLimit) warps /= 2;
      launch("row_pass_power_kernel", row_pass_power_kernel,
             unsigned(multiprocessors) * kPowerBlocks * (kPassThreads / kWarp / warps), warps * kWarp,
             squares + warps * row_memory_bytes(side), stream, a, side);
    } else {
      const std::size_t per_warp = std::size_t(2 * side + 1) * 32 * 4;
      while (warps > 1 && warps * per_warp > kSharedLimit) warps /= 2;
      launch("row_pass_offset_kernel", row_pass_offset_kernel<P>, blocks * (kPassThreads / kWarp / warps),
             warps * kWarp, warps * per_warp, stream, a, side);
    }
  });
}

}  // namespace bp
