// Crossings: a thread per small triangle, a block per larger one. Fill: crossings are sorted into buckets of 32 columns
// by 32 slices. A warp then climbs 32 columns, a lane each, and turns their numbers into a word per slice by a ballot.
#include "gpu/kernels/launch.h"
#include "gpu/kernels/winding_kernels.h"
#include "lib/voxel/column_crossings.h"

namespace bp {

namespace {

constexpr int kSlices = 32;  ///< slices of a bucket

// ---------------------------------------------------------------- crossings

/// The list of crossings. Crossings beyond the capacity are only counted.
struct CrossingList {
  Crossing* out;
  std::uint32_t capacity;
  std::uint32_t* found;
};

/// Appends the remaining crossings of each lane's triangle, or of its share of one. All lanes of the warp must call it.
template <class Crossings>
__device__ void append_all(Crossings& crossings, bool wanted, const CrossingList& list) {
  Crossing c{};
  bool more = wanted && crossings.next(c);
  while (__any_sync(kAllLanes, more)) {
    const unsigned at = place_in_list(more, list.found);
    if (more && at < list.capacity) list.out[at] = c;
    more = more && crossings.next(c);
  }
}

/// Finds the crossings of triangles up to kSmallExtent, and lists the others.
__global__ void __launch_bounds__(kPassThreads)
    cross_small_kernel(const FixedTriangle* __restrict__ triangles, std::uint32_t count, VoxelBox tile,
                       CrossingList list, std::uint32_t* __restrict__ large, std::uint32_t* large_count) {
  const unsigned i = thread_in_grid();
  const Corners corners(triangles[i < count ? i : 0]);
  const bool small = corners.extent() <= kSmallExtent;
  append(i < count && !small, i, large, large_count);
  ColumnCrossings<std::int64_t, std::int64_t> crossings(corners, tile);
  append_all(crossings, i < count && small, list);
}

/// Finds the crossings of any triangle: a warp of the block per row of columns, a lane per column.
__global__ void __launch_bounds__(kPassThreads)
    cross_large_kernel(const FixedTriangle* __restrict__ triangles, VoxelBox tile, CrossingList list,
                       const std::uint32_t* __restrict__ large, const std::uint32_t* __restrict__ large_count) {
  const Share rows{std::int32_t(warp_in_block()), kPassThreads / kWarp}, columns{lane_id(), kWarp};
  for (unsigned i = blockIdx.x; i < *large_count; i += gridDim.x) {
    ColumnCrossings<Int128, Int128> crossings(Corners(triangles[large[i]]), tile, rows, columns);
    append_all(crossings, true, list);
  }
}

// ---------------------------------------------------------------- fill

/// Buckets of crossings in a tile: x fastest, then y, then z. A crossing above the last slice has a bucket, too.
struct Buckets {
  std::uint32_t words, ny, nz;
  std::uint32_t *counts, *ends;  ///< number of crossings of each bucket; where its part of the sorted crossings ends
  __host__ __device__ std::uint32_t layers() const { return nz / kSlices + 1; }
  __host__ __device__ std::uint32_t size() const { return words * ny * layers(); }
  __device__ std::uint32_t of(const Crossing& c) const { return (c.z / kSlices * ny + c.y) * words + c.x / 32; }
};

__global__ void __launch_bounds__(kPassThreads)
    count_crossings_kernel(const Crossing* __restrict__ crossings, std::uint32_t count, Buckets buckets) {
  const unsigned i = thread_in_grid();
  if (i < count) atomicAdd(&buckets.counts[buckets.of(crossings[i])], 1u);
}

/// Gives each bucket its part of the sorted crossings; the order of buckets does not matter. `ends` becomes where it
/// begins.
__global__ void __launch_bounds__(kPassThreads) place_buckets_kernel(Buckets buckets, std::uint32_t* total) {
  const unsigned i = thread_in_grid();
  if (i >= buckets.size()) return;
  const std::uint32_t n = buckets.counts[i];
  if (n != 0) buckets.ends[i] = atomicAdd(total, n);
}

__global__ void __launch_bounds__(kPassThreads)
    sort_crossings_kernel(const Crossing* __restrict__ crossings, std::uint32_t count, Buckets buckets,
                          Crossing* __restrict__ sorted) {
  const unsigned i = thread_in_grid();
  if (i < count) sorted[atomicAdd(&buckets.ends[buckets.of(crossings[i])], 1u)] = crossings[i];
}

/// Fills 32 columns per warp. Its shared memory holds the change of each column's number at each slice of a bucket.
__global__ void __launch_bounds__(kPassThreads)
    fill_columns_kernel(const Crossing* __restrict__ sorted, Buckets buckets, const std::uint32_t* __restrict__ skip,
                        std::int32_t* __restrict__ numbers, std::uint32_t* __restrict__ bits) {
  const std::uint32_t row = thread_in_grid() / kWarp, lane = std::uint32_t(lane_id());  // a row has 32 columns
  if (row >= buckets.words * buckets.ny) return;
  std::int32_t* change = static_cast<std::int32_t*>(dynamic_shared_memory()) + warp_in_block() * kSlices * kWarp;
  const std::uint32_t kept = skip != nullptr ? ~skip[row] : ~0u;
  std::int32_t number = numbers[row * 32 + lane];
  for (std::uint32_t layer = 0; layer < buckets.layers(); ++layer) {
    const std::uint32_t bucket = layer * buckets.words * buckets.ny + row, count = buckets.counts[bucket];
    for (int z = 0; z < kSlices; ++z) change[z * kWarp + int(lane)] = 0;
    __syncwarp();
    for (std::uint32_t i = lane; i < count; i += kWarp) {
      const Crossing c = sorted[buckets.ends[bucket] - 1 - i];
      atomicAdd(&change[c.z % kSlices * kWarp + c.x % kWarp], c.down != 0 ? 1 : -1);
    }
    __syncwarp();
    std::uint32_t own = 0;
    for (std::uint32_t z = 0; z < kSlices; ++z) {
      number += change[z * kWarp + lane];
      const std::uint32_t inside = __ballot_sync(kAllLanes, number != 0);
      if (lane == z) own = inside & kept;
    }
    const std::uint32_t z = layer * kSlices + lane;
    if (z < buckets.nz) bits[z * buckets.words * buckets.ny + row] = own;
  }
  numbers[row * 32 + lane] = number;
}

}  // namespace

void DeviceWinding::find(const FixedTriangle* triangles, std::uint32_t count, const VoxelBox& tile, Crossing* out,
                         std::uint32_t capacity, std::uint32_t* found, cudaStream_t stream) {
  BP_CUDA_CHECK(cudaMemsetAsync(found, 0, sizeof(std::uint32_t), stream));
  if (count == 0 || tile.empty()) return;
  std::uint32_t *large_count = large_.grow(std::size_t(count) + 1), *large = large_count + 1;
  BP_CUDA_CHECK(cudaMemsetAsync(large_count, 0, sizeof(std::uint32_t), stream));
  const CrossingList list{out, capacity, found};
  launch("cross_small_kernel", cross_small_kernel, blocks_for(count), kPassThreads, 0, stream, triangles, count, tile,
         list, large, large_count);
  launch("cross_large_kernel", cross_large_kernel, unsigned(multiprocessors_) * 4, kPassThreads, 0, stream, triangles,
         tile, list, large, large_count);
}

void DeviceWinding::fill(const Crossing* crossings, std::uint32_t count, const VoxelBox& tile,
                         const std::uint32_t* skip, std::int32_t* numbers, std::uint32_t* bits, cudaStream_t stream) {
  if (tile.empty()) return;
  const VoxelCoord size = tile.size();
  Buckets buckets{std::uint32_t(size.x) / 32, std::uint32_t(size.y), std::uint32_t(size.z), nullptr, nullptr};
  const std::size_t n = buckets.size();
  buckets.counts = buckets_.grow(2 * n + 1);
  buckets.ends = buckets.counts + n;
  std::uint32_t* total = buckets.ends + n;
  BP_CUDA_CHECK(cudaMemsetAsync(buckets.counts, 0, (2 * n + 1) * sizeof(std::uint32_t), stream));
  sorted_.grow(count);
  launch("count_crossings_kernel", count_crossings_kernel, blocks_for(count), kPassThreads, 0, stream, crossings, count,
         buckets);
  launch("place_buckets_kernel", place_buckets_kernel, blocks_for(n), kPassThreads, 0, stream, buckets, total);
  launch("sort_crossings_kernel", sort_crossings_kernel, blocks_for(count), kPassThreads, 0, stream, crossings, count,
         buckets, sorted_.data());
  launch("fill_columns_kernel", fill_columns_kernel, blocks_for(std::uint64_t(buckets.words) * buckets.ny * kWarp),
         kPassThreads, kPassThreads / kWarp * kSlices * kWarp * sizeof(std::int32_t), stream, sorted_.data(), buckets,
         skip, numbers, bits);
}

void DeviceWinding::release() {
  large_.release();
  buckets_.release();
  sorted_.release();
}

}  // namespace bp
