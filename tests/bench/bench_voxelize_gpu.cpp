// Surface voxelization on the GPU, and the crossings and the fill by winding of one tile of the grid; triangles and
// bits in device memory; every result is compared with the CPU's bits in the same run. usage: bench_voxelize_gpu
// FILE.obj RESOLUTION PIECES [COMMIT]: each triangle is cut into PIECES^2.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "gpu/cuda_backend.h"
#include "gpu/kernels/voxelize_kernels.h"
#include "gpu/kernels/winding_kernels.h"
#include "lib/core/error.h"
#include "lib/voxel/voxelize.h"
#include "tests/bench/bench_scenes.h"
#include "tests/bench/gpu_clock.h"

namespace bp {
namespace {

constexpr std::int32_t kTile = 512;  ///< longest side of a tile in which crossings are found

/// Median of 21 after one.
template <class Run>
double measure(const Run& run) {
  Clock clock(nullptr);
  std::vector<double> ms;
  for (int i = 0; i < 22; ++i) {
    clock.start();
    run();
    clock.mark("total");
    const double t = clock.read()[0].second;
    if (i > 0) ms.push_back(t);
  }
  return median(ms);
}

template <class T>
std::vector<T> download(const DeviceBuffer<T>& from, std::size_t count) {
  std::vector<T> to(count);
  BP_CUDA_CHECK(cudaMemcpyAsync(to.data(), from.data(), count * sizeof(T), cudaMemcpyDeviceToHost, nullptr));
  BP_CUDA_CHECK(cudaDeviceSynchronize());
  return to;
}

std::vector<std::uint32_t> sorted(const std::vector<Crossing>& crossings) {
  std::vector<std::uint32_t> keys(crossings.size());
  if (!keys.empty()) std::memcpy(keys.data(), crossings.data(), keys.size() * sizeof(Crossing));
  std::sort(keys.begin(), keys.end());
  return keys;
}

/// Measures the tile at the middle of the grid.
bool run_winding(const std::string& model, const std::string& commit, const CudaDevice& device, const VoxelBox& grid,
                 const std::vector<FixedTriangle>& triangles, const DeviceBuffer<FixedTriangle>& d_triangles) {
  VoxelBox tile = grid;
  for (int axis = 0; axis < 3; ++axis) {
    if (grid.size()[axis] <= kTile) continue;
    tile.min[axis] = floor_div(grid.min[axis] + (grid.size()[axis] - kTile) / 2, kBrickEdge) * kBrickEdge;
    tile.max[axis] = tile.min[axis] + kTile;
  }
  BitBox want(tile), got(tile);
  tile = want.box();
  std::vector<Crossing> crossings;
  find_crossings(triangles, tile, crossings);
  const std::uint32_t capacity = std::uint32_t(crossings.size()) + 1;
  const std::size_t columns = std::size_t(tile.size().x) * std::size_t(tile.size().y);
  DeviceBuffer<Crossing> d_crossings;
  DeviceBuffer<std::uint32_t> d_found, d_bits;
  DeviceBuffer<std::int32_t> d_numbers;
  d_crossings.grow(capacity), d_found.grow(1), d_bits.grow(std::size_t(want.word_count()) * 2), d_numbers.grow(columns);
  DeviceWinding winding(device.multiprocessors);
  const double find_ms = measure([&] {
    winding.find(d_triangles.data(), std::uint32_t(triangles.size()), tile, d_crossings.data(), capacity,
                 d_found.data(), nullptr);
  });
  const std::uint32_t found = download(d_found, 1)[0];
  bool equal = found == crossings.size() && sorted(download(d_crossings, found)) == sorted(crossings);
  const double fill_ms = measure([&] {
    BP_CUDA_CHECK(cudaMemsetAsync(d_numbers.data(), 0, columns * sizeof(std::int32_t), nullptr));
    winding.fill(d_crossings.data(), found, tile, nullptr, d_numbers.data(), d_bits.data(), nullptr);
  });
  const std::vector<std::uint32_t> bits = download(d_bits, std::size_t(got.word_count()) * 2);
  std::memcpy(got.data(), bits.data(), bits.size() * sizeof(std::uint32_t));
  std::vector<std::int32_t> numbers(columns, 0);
  fill_winding(crossings, tile, {}, numbers, want);
  equal = equal && got == want && download(d_numbers, columns) == numbers;
  const VoxelCoord n = tile.size();
  std::printf(
      "{\"bench\":\"winding\",\"device\":\"%s\",\"commit\":\"%s\",\"model\":\"%s\",\"tile\":[%d,%d,%d],\"triangles\":%"
      "zu,"
      "\"crossings\":%u,\"find_ms\":%.4f,\"fill_ms\":%.4f,\"voxels\":%llu,\"equal\":\"%s\"}\n",
      device.name.c_str(), commit.c_str(), model.c_str(), n.x, n.y, n.z, triangles.size(), found, find_ms, fill_ms,
      (unsigned long long)got.count(), equal ? "cpu" : "NOT CPU");
  return equal;
}

int run(const std::string& path, int resolution, int pieces, const std::string& commit) {
  if (cuda_devices().empty()) fail(ErrorCode::out_of_resource, "no GPU here");
  const CudaDevice device = cuda_devices()[0];
  VoxelBox box;
  const std::vector<FixedTriangle> triangles = load_bench_triangles(path, resolution, pieces, box);
  BitBox got(box), want(box);
  DeviceBuffer<FixedTriangle> d_triangles;
  DeviceBuffer<std::uint32_t> d_bits;
  const std::size_t bytes = std::size_t(got.word_count()) * 8;
  BP_CUDA_CHECK(cudaMemcpyAsync(d_triangles.grow(triangles.size()), triangles.data(),
                                triangles.size() * sizeof(FixedTriangle), cudaMemcpyHostToDevice, nullptr));
  d_bits.grow(bytes / 4);
  DeviceVoxelizer voxelizer(device.multiprocessors);
  const double ms = measure([&] {
    BP_CUDA_CHECK(cudaMemsetAsync(d_bits.data(), 0, bytes, nullptr));
    voxelizer.enqueue(d_triangles.data(), std::uint32_t(triangles.size()), kFixedSlack, got.box(), d_bits.data(),
                      nullptr);
  });
  BP_CUDA_CHECK(cudaMemcpyAsync(got.data(), d_bits.data(), bytes, cudaMemcpyDeviceToHost, nullptr));
  BP_CUDA_CHECK(cudaDeviceSynchronize());
  voxelize_surface(triangles, want);
  const bool equal = got == want;
  const VoxelCoord n = box.size();
  std::printf(
      "{\"bench\":\"voxelize\",\"device\":\"%s\",\"commit\":\"%s\",\"model\":\"%s\",\"grid\":[%d,%d,%d],\"triangles\":%"
      "zu,"
      "\"ms\":%.4f,\"triangles_per_s\":%.4g,\"GB_per_s\":%.4g,\"voxels\":%llu,\"equal\":\"%s\"}\n",
      device.name.c_str(), commit.c_str(), path.substr(path.find_last_of('/') + 1).c_str(), n.x, n.y, n.z,
      triangles.size(), ms, double(triangles.size()) / ms * 1e3,
      double(triangles.size() * sizeof(FixedTriangle) + 2 * bytes) / ms / 1e6, (unsigned long long)got.count(),
      equal ? "cpu" : "NOT CPU");
  const std::string model = path.substr(path.find_last_of('/') + 1);
  const bool wound = run_winding(model, commit, device, box, triangles, d_triangles);
  return equal && wound ? 0 : 1;
}

}  // namespace
}  // namespace bp

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: bench_voxelize_gpu FILE.obj RESOLUTION PIECES [COMMIT]\n");
    return 2;
  }
  try {
    return bp::run(argv[1], std::atoi(argv[2]), std::atoi(argv[3]), argc > 4 ? argv[4] : "unknown");
  } catch (const std::exception& e) {
    std::fprintf(stderr, "bench_voxelize_gpu: %s\n", e.what());
    return 1;
  }
}
