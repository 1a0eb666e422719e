#include "gpu/cuda_backend.h"

#include <cuda_runtime.h>
#include <fmt/format.h>

#include <algorithm>

#include "gpu/device_properties.h"
#include "gpu/device_tiles.h"
#include "gpu/device_weighing.h"
#include "gpu/kernels/device_error.h"
#include "gpu/kernels/tuning.h"
#include "gpu/stream.h"

namespace bp {

namespace {

class CudaBackend final : public Backend {
 public:
  explicit CudaBackend(int device)
      : stream_(device),
        properties_(device_properties(device)),
        name_(fmt::format("cuda:{} {}", device, properties_.name)),
        staging_(stream_.get()),
        work_{name_, stream_.get(), staging_, [this] { make_room(); }},
        tiles_(work_,
               {properties_.multiProcessorCount, std::min(kSlabBytes, properties_.totalGlobalMem / kSlabShare)}) {
    require_code();
  }
  ~CudaBackend() override { (void)cudaStreamSynchronize(stream_.get()); }

  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] std::uint64_t pinned_bytes() const override { return 2 * kStagingBytes; }

  void close(const BitBox& solid, const ScaleLattice& scale, const Halo& halo, const ClosingParams& params,
             const VoxelBox& interior, BitBox& closed) override {
    stream_.select();
    tiles_.close(solid, scale, halo, params, interior, closed);
  }

  void close_from_shelf(const BrickShelf& solid, const BrickBox& bricks, const ScaleLattice& scale, const Halo& halo,
                        const ClosingParams& params, const VoxelBox& interior, BitBox& closed) override {
    stream_.select();
    if (!interior.empty() && voxels_of(bricks_of(interior)) == interior) {
      try {
        return tiles_.close_bricks(solid, bricks, scale, halo, params, interior, closed);
      } catch (const OutOfDeviceMemory&) {
        make_room();
      }
    }
    Backend::close_from_shelf(solid, bricks, scale, halo, params, interior, closed);
  }

  void weigh(const CageCoordinates& coordinates, std::span<const Vec3d> points, bool carry_outside, WeightBlock& out,
             std::span<CoordinateRows::Place> places) override {
    stream_.select();
    weighing_.weigh(coordinates, points, carry_outside, work_, out, places);
  }

 private:
  void require_code() const {
    const cudaError_t error = find_code();
    if (error == cudaErrorMemoryAllocation) check_cuda(error, "loading the kernels");
    if (error == cudaSuccess) return;
    (void)cudaGetLastError();
    throw DeviceError(fmt::format(
        "{} (compute capability {}.{}): this build holds no code that runs there ({}); one with "
        "-DCMAKE_CUDA_ARCHITECTURES={}{} does",
        name_, properties_.major, properties_.minor, cudaGetErrorName(error), properties_.major, properties_.minor));
  }

  /// Frees all device memory.
  void make_room() {
    BP_CUDA_CHECK(cudaStreamSynchronize(stream_.get()));
    tiles_.release();
    weighing_.release();
  }

  Stream stream_;
  cudaDeviceProp properties_;
  std::string name_;
  Staging staging_;
  const DeviceWork work_;
  DeviceTiles tiles_;
  DeviceWeighing weighing_;
};

}  // namespace

std::unique_ptr<Backend> make_cuda_backend(int device) {
  return std::make_unique<CudaBackend>(device);
}

}  // namespace bp
