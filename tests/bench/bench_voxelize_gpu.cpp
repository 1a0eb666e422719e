// Surface voxelization on the GPU, triangles and bits in device memory; every result is compared with the CPU's bits in
// the same run. usage: bench_voxelize_gpu FILE.obj RESOLUTION PIECES [COMMIT]: each triangle is cut into PIECES^2.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "gpu/cuda_backend.h"
#include "gpu/voxelize_kernels.h"
#include "lib/core/error.h"
#include "lib/voxel/voxelize.h"
#include "tests/bench/bench_scenes.h"
#include "tests/bench/gpu_clock.h"

namespace bp {
namespace {

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
  Clock clock(nullptr);
  std::vector<double> ms;
  for (int i = 0; i < 22; ++i) {
    clock.start();
    BP_CUDA_CHECK(cudaMemsetAsync(d_bits.data(), 0, bytes, nullptr));
    voxelizer.enqueue(d_triangles.data(), std::uint32_t(triangles.size()), got.box(), d_bits.data(), nullptr);
    clock.mark("total");
    const double t = clock.read()[0].second;
    if (i > 0) ms.push_back(t);
  }
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
      triangles.size(), median(ms), double(triangles.size()) / median(ms) * 1e3,
      double(triangles.size() * sizeof(FixedTriangle) + 2 * bytes) / median(ms) / 1e6, (unsigned long long)got.count(),
      equal ? "cpu" : "NOT CPU");
  return equal ? 0 : 1;
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
