// After [SS10], with the half-spaces of lib/voxel/overlap.h: the same integers as the CPU, so the same voxels.
#include "gpu/kernels/launch.h"
#include "gpu/kernels/tuning.h"
#include "gpu/kernels/voxelize_kernels.h"
#include "lib/voxel/overlap.h"

namespace bp {

namespace {

constexpr std::int64_t kFew = 64;          ///< a range of at most so many voxels is tested by one thread, a bit each
constexpr std::int64_t kManyRows = 16384;  ///< on a range of so many rows or more, the whole grid works together

/// The bits of a BitBox on the device.
struct BitsView {
  std::uint32_t* bits;
  std::int32_t min[3], max[3];  ///< voxels; x in whole words
  std::int32_t words;           ///< per row, 32 bits each
  std::int64_t slack;           ///< that voxels are grown by

  __device__ CellRange inside(CellRange r) const {
#pragma unroll
    for (int i = 0; i < 3; ++i) {
      r.min[i] = larger<std::int64_t>(r.min[i], min[i]);
      r.max[i] = smaller<std::int64_t>(r.max[i], max[i]);
    }
    return r;
  }
  __device__ std::uint32_t* row(std::int64_t y, std::int64_t z) const {
    return bits + ((z - min[2]) * (max[1] - min[1]) + (y - min[1])) * words;
  }
  /// Sets bits. Where triangles are dense most are set already, and reading is cheaper than an atomic.
  __device__ static void set(std::uint32_t* word, std::uint32_t mask) {
    if ((mask & ~*word) != 0) atomicOr(word, mask);
  }
  /// Sets voxels first..last of a row, counted from min[0].
  __device__ void set_run(std::uint32_t* row, std::int32_t first, std::int32_t last) const {
    const std::uint32_t head = ~0u << (first & 31), tail = ~0u >> (31 - (last & 31));
    const std::int32_t a = first >> 5, b = last >> 5;
    if (a == b) return set(row + a, head & tail);
    set(row + a, head);
    for (std::int32_t i = a + 1; i < b; ++i) set(row + i, ~0u);
    set(row + b, tail);
  }
};

/// Lists of triangles that need a warp, or the grid, and the queue of the triangles for warps.
struct Lists {
  std::uint32_t *warp, *grid;
  std::uint32_t* counts;  ///< [0] warp, [1] grid, [2] next of warp
};

// ---------------------------------------------------------------- a thread per triangle

/// Clears the bits of the cells of a range of at most 64 that lie outside of a half-space. x fastest.
__device__ void cut(std::uint64_t& mask, const HalfSpace<std::int64_t>& h, int nx, int ny, int nz) {
  std::uint64_t bit = 1;
  std::int64_t at_z = h.at;
  for (int z = 0; z < nz; ++z, at_z += h.step[2]) {
    std::int64_t at_y = at_z;
    for (int y = 0; y < ny; ++y, at_y += h.step[1]) {
      std::int64_t at = at_y;
      for (int x = 0; x < nx; ++x, at += h.step[0], bit <<= 1) {
        if (at < 0) mask &= ~bit;
      }
    }
  }
}

/// Returns the cells of a range of at most 64 that a small triangle meets. `whole`: the range before it was cut to the
/// box.
__device__ std::uint64_t cells_met(const Corners& corners, const CellRange& whole, const CellRange& range) {
  const int nx = int(range.size(0)), ny = int(range.size(1)), nz = int(range.size(2));
  std::uint64_t mask = ~std::uint64_t(0) >> (64 - nx * ny * nz);
  const bool flat[3] = {whole.size(0) == 1, whole.size(1) == 1, whole.size(2) == 1};
  const int thin = int(flat[0]) + int(flat[1]) + int(flat[2]);
  // The triangle is connected, and inside the cubes along two axes, so it meets each along the third.
  if (thin >= 2) return mask;
  std::int64_t normal[3];
#pragma unroll
  for (int w = 0; w < 3; ++w) {
    normal[w] = normal_component<std::int64_t>(corners, w);
    if (thin == 1 && !flat[w])
      continue;  // it lies between the cubes' faces along one axis, so only the projection along that axis decides
#pragma unroll
    for (int e = 0; e < 3; ++e)
      cut(mask, edge_space<std::int64_t>(corners, e, w, normal[w] < 0, range, kFixedOne), nx, ny, nz);
  }
  if (thin == 1) return mask;
  cut(mask, plane_space(corners, normal, range, kFixedOne), nx, ny, nz);
  const std::int64_t opposite[3] = {-normal[0], -normal[1], -normal[2]};
  cut(mask, plane_space(corners, opposite, range, kFixedOne), nx, ny, nz);
  return mask;
}

__device__ void set_cells(const BitsView& out, const CellRange& range, std::uint64_t mask) {
  const int nx = int(range.size(0));
  const std::uint64_t row_mask = ~std::uint64_t(0) >> (64 - nx);
  const std::int32_t x = std::int32_t(range.min[0] - out.min[0]);
  for (std::int64_t z = range.min[2]; z < range.max[2]; ++z) {
    for (std::int64_t y = range.min[1]; y < range.max[1]; ++y) {
      const std::uint64_t bits = mask & row_mask;
      mask = nx < 64 ? mask >> nx : 0;
      if (bits == 0) continue;
      std::uint32_t* word = out.row(y, z) + (x >> 5);
      const std::uint64_t low = bits << (x & 31);
      const std::uint32_t high = (x & 31) != 0 ? std::uint32_t(bits >> (64 - (x & 31))) : 0;
      if (std::uint32_t(low) != 0) BitsView::set(word, std::uint32_t(low));
      if (std::uint32_t(low >> 32) != 0) BitsView::set(word + 1, std::uint32_t(low >> 32));
      if (high != 0) BitsView::set(word + 2, high);
    }
  }
}

__global__ void __launch_bounds__(kPassThreads)
    voxelize_few_kernel(const FixedTriangle* __restrict__ triangles, std::uint32_t count, BitsView out, Lists lists) {
  const unsigned i = thread_in_grid();
  bool warp = false, grid = false;
  if (i < count) {
    const Corners corners(triangles[i], out.slack);
    const CellRange whole = voxel_range(corners), range = out.inside(whole);
    if (!range.empty()) {
      const bool few = range.size(0) <= kFew && range.size(1) <= kFew && range.size(2) <= kFew &&
                       range.size(0) * range.size(1) * range.size(2) <= kFew && corners.extent() <= kSmallExtent;
      if (few) {
        const std::uint64_t mask = cells_met(corners, whole, range);
        if (mask != 0) set_cells(out, range, mask);
      } else {
        grid = range.size(1) * range.size(2) > kManyRows || corners.extent() > kMediumExtent;
        warp = !grid;
      }
    }
  }
  append(warp, i, lists.warp, &lists.counts[0]);
  append(grid, i, lists.grid, &lists.counts[1]);
}

// ---------------------------------------------------------------- many threads per triangle

/// The rows of cells of a triangle, dealt out to `workers`: slices first, then rows within a slice.
template <class Triangle>
__device__ void set_rows(const Triangle& t, const BitsView& out, unsigned worker, unsigned workers) {
  const std::int32_t nx = std::int32_t(t.range.size(0)), ny = std::int32_t(t.range.size(1)),
                     nz = std::int32_t(t.range.size(2));
  const unsigned parts = workers > unsigned(nz) ? workers / unsigned(nz) : 1, part = worker % parts;
  const std::int32_t offset = std::int32_t(t.range.min[0] - out.min[0]);
  for (unsigned z = worker / parts; z < unsigned(nz); z += workers / parts) {
    std::int32_t y0 = 0, y1 = ny - 1;
    bool any = true;
    // In a slice, a half-space can hold only in rows where it holds at the better end. That bounds y.
    const auto bound = [&](const auto& h) {
      any = any && clip(h.value(h.step[0] > 0 ? nx - 1 : 0, 0, std::int32_t(z)), h.step[1], y0, y1);
    };
#pragma unroll 1
    for (int i = 0; i < 9; ++i) bound(t.edges[i]);
#pragma unroll 1
    for (int i = 0; i < 2; ++i) bound(t.plane[i]);
    if (!any) continue;
    for (std::int32_t y = y0 + std::int32_t(part); y <= y1; y += std::int32_t(parts)) {
      std::int32_t x0 = 0, x1 = nx - 1;
      bool row = true;
      const auto narrow = [&](const auto& h) { row = row && clip(h.value(0, y, std::int32_t(z)), h.step[0], x0, x1); };
#pragma unroll 1
      for (int i = 0; i < 2; ++i) narrow(t.plane[i]);
#pragma unroll 1
      for (int i = 3; i < 9; ++i) narrow(t.edges[i]);
      if (row && x0 <= x1)
        out.set_run(out.row(t.range.min[1] + y, t.range.min[2] + std::int32_t(z)), offset + x0, offset + x1);
    }
  }
}

/// A triangle in shared memory: loops over its half-spaces and corners index it at run time, which registers cannot.
template <class Triangle>
struct SharedTriangle {
  FixedTriangle triangle;
  alignas(16) Triangle cells;
};
/// The threads that work on one triangle together: a warp, or the grid (a copy of the triangle per block).
struct WarpTeam {
  __device__ static void meet() { __syncwarp(); }
  __device__ static unsigned builder() { return unsigned(lane_id()); }
  __device__ static unsigned worker() { return unsigned(lane_id()); }
  __device__ static unsigned workers() { return kWarp; }
};
struct GridTeam {
  __device__ static void meet() { __syncthreads(); }
  __device__ static unsigned builder() { return threadIdx.x; }
  __device__ static unsigned worker() { return thread_in_grid(); }
  __device__ static unsigned workers() { return gridDim.x * blockDim.x; }
};

template <class EdgeInt, class PlaneInt>
__device__ void build(TriangleCells<EdgeInt, PlaneInt>& t, const Corners& corners, const CellRange& range,
                      unsigned builder) {
  if (builder < 9) {
    const int w = int(builder) / 3;
    t.edges[builder] =
        edge_space<EdgeInt>(corners, int(builder) % 3, w, normal_component<PlaneInt>(corners, w) < 0, range, kFixedOne);
  } else if (builder < 11) {
    PlaneInt normal[3];
#pragma unroll
    for (int w = 0; w < 3; ++w) {
      normal[w] = normal_component<PlaneInt>(corners, w);
      if (builder == 10) normal[w] = -normal[w];
    }
    t.plane[builder - 9] = plane_space(corners, normal, range, kFixedOne);
  } else if (builder == 11) {
    t.range = range;
  }
}

/// Sets the voxels of `range` that the triangle in `shared` meets.
template <class Team, class Triangle>
__device__ void set_triangle(SharedTriangle<Triangle>& shared, const CellRange& range, const BitsView& out) {
  if (Team::builder() < 12) build(shared.cells, Corners(shared.triangle, out.slack), range, Team::builder());
  Team::meet();
  set_rows(shared.cells, out, Team::worker(), Team::workers());
  Team::meet();
}

template <class Team>
__device__ void load_triangle(FixedTriangle& shared, const FixedTriangle& from) {
  constexpr unsigned kWords = sizeof(FixedTriangle) / sizeof(std::uint64_t);
  const unsigned i = Team::builder();
  if (i < kWords) reinterpret_cast<std::uint64_t*>(&shared)[i] = reinterpret_cast<const std::uint64_t*>(&from)[i];
  Team::meet();
}

using WarpTriangle = SharedTriangle<MediumTriangle>;
using GridTriangle = SharedTriangle<WideTriangle>;

/// Voxelizes triangles up to kMediumExtent.
__global__ void __launch_bounds__(kPassThreads)
    voxelize_warp_kernel(const FixedTriangle* __restrict__ triangles, BitsView out, Lists lists) {
  WarpTriangle& shared = static_cast<WarpTriangle*>(dynamic_shared_memory())[warp_in_block()];
  const unsigned count = lists.counts[0];
  for (unsigned i = next_item(&lists.counts[2]); i < count; i = next_item(&lists.counts[2])) {
    load_triangle<WarpTeam>(shared.triangle, triangles[lists.warp[i]]);
    set_triangle<WarpTeam>(shared, out.inside(voxel_range(Corners(shared.triangle, out.slack))), out);
  }
}

/// Voxelizes any triangle, in blocks, so that the plane's values stay within 128 bits.
__global__ void __launch_bounds__(kPassThreads)
    voxelize_grid_kernel(const FixedTriangle* __restrict__ triangles, BitsView out, Lists lists) {
  GridTriangle& shared = *static_cast<GridTriangle*>(dynamic_shared_memory());
  const unsigned count = lists.counts[1];
  for (unsigned i = 0; i < count; ++i) {
    load_triangle<GridTeam>(shared.triangle, triangles[lists.grid[i]]);
    const CellRange range = out.inside(voxel_range(Corners(shared.triangle, out.slack)));
    const int nx = int((range.size(0) + kWideCells - 1) / kWideCells),
              ny = int((range.size(1) + kWideCells - 1) / kWideCells),
              nz = int((range.size(2) + kWideCells - 1) / kWideCells);
    for (int b = 0; b < nx * ny * nz; ++b) {
      CellRange block = range;
      block.min[0] += kWideCells * (b % nx), block.min[1] += kWideCells * (b / nx % ny),
          block.min[2] += kWideCells * (b / (nx * ny));
#pragma unroll
      for (int k = 0; k < 3; ++k) {
        if (block.min[k] + kWideCells < block.max[k]) block.max[k] = block.min[k] + kWideCells;
      }
      set_triangle<GridTeam>(shared, block, out);
    }
  }
}

}  // namespace

void DeviceVoxelizer::enqueue(const FixedTriangle* triangles, std::uint32_t count, std::int64_t slack,
                              const VoxelBox& box, std::uint32_t* bits, cudaStream_t stream) {
  if (count == 0 || box.empty()) return;
  const BitsView out{
      bits, {box.min.x, box.min.y, box.min.z}, {box.max.x, box.max.y, box.max.z}, (box.max.x - box.min.x) / 32, slack};
  lists_.grow(2 * std::size_t(count));
  BP_CUDA_CHECK(cudaMemsetAsync(counts_.grow(3), 0, 3 * sizeof(std::uint32_t), stream));
  const Lists lists{lists_.data(), lists_.data() + count, counts_.data()};
  launch("voxelize_few_kernel", voxelize_few_kernel, blocks_for(count), kPassThreads, 0, stream, triangles, count, out,
         lists);
  launch("voxelize_warp_kernel", voxelize_warp_kernel, unsigned(multiprocessors_) * 4, kPassThreads,
         sizeof(WarpTriangle) * (kPassThreads / kWarp), stream, triangles, out, lists);
  launch("voxelize_grid_kernel", voxelize_grid_kernel, unsigned(multiprocessors_) * 4, kPassThreads,
         sizeof(GridTriangle), stream, triangles, out, lists);
}

void DeviceVoxelizer::release() {
  lists_.release();
  counts_.release();
}

}  // namespace bp
