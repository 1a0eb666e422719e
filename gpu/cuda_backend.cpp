#include "gpu/cuda_backend.h"

#include <cuda_runtime.h>

#include <algorithm>

#include "gpu/device_closing.h"
#include "gpu/staging.h"
#include "gpu/tuning.h"
#include "lib/core/error.h"
#include "lib/voxel/voxelize.h"

namespace bp {

namespace {

/// A stream of its own on one device.
class Stream {
 public:
  explicit Stream(int device) : device_(device) {
    select();
    BP_CUDA_CHECK(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking));
  }
  ~Stream() {
    (void)cudaSetDevice(device_);
    (void)cudaStreamDestroy(stream_);
  }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  void select() const {
    BP_CUDA_CHECK(cudaSetDevice(device_));
  }  ///< the calling thread works on this device from now on
  [[nodiscard]] cudaStream_t get() const { return stream_; }

 private:
  int device_;
  cudaStream_t stream_{};
};

cudaDeviceProp properties(int device) {
  cudaDeviceProp p{};
  BP_CUDA_CHECK(cudaGetDeviceProperties(&p, device));
  return p;
}

class CudaBackend final : public Backend {
 public:
  explicit CudaBackend(int device)
      : stream_(device),
        properties_(properties(device)),
        name_(fmt::format("cuda:{} {}", device, properties_.name)),
        staging_(stream_.get()),
        closing_({properties_.multiProcessorCount, std::min(kSlabBytes, properties_.totalGlobalMem / 8)}) {}
  ~CudaBackend() override { (void)cudaStreamSynchronize(stream_.get()); }

  [[nodiscard]] std::string name() const override { return name_; }

  /// On the host, by the code of the CPU backend: the same bits.
  void voxelize(std::span<const FixedTriangle> triangles, BitBox& out) override { voxelize_surface(triangles, out); }

  void close(const BitBox& solid, const ScaleLattice& scale, const Halo& halo, const ClosingParams& params,
             const VoxelBox& interior, BitBox& closed) override {
    stream_.select();
    closed.reset(interior);
    if (interior.empty()) return;
    try {
      close_at_once(solid, scale, halo, params, interior, closed);
    } catch (const Error& e) {
      if (e.code() != ErrorCode::out_of_resource) throw;
      close_in_halves(solid, scale, halo, params, interior, closed);
    }
  }

 private:
  void close_at_once(const BitBox& solid, const ScaleLattice& scale, const Halo& halo, const ClosingParams& params,
                     const VoxelBox& interior, BitBox& closed) {
    const TileLayout layout = lay_out(solid.box(), scale, halo, interior);
    const std::size_t words_in = std::size_t(solid.word_count()) * 2, words_out = std::size_t(closed.word_count()) * 2;
    in_.grow(words_in);
    out_.grow(words_out);
    staging_.upload(in_.data(), solid.data(), words_in * 4);
    if (!scale.constant()) {
      samples_.grow(scale.samples.size());
      staging_.upload(samples_.data(), scale.samples.data(), scale.samples.size() * sizeof(Scale));
    }
    closing_.enqueue(layout, in_.data(), scale, samples_.data(), params.element, out_.data(), stream_.get());
    staging_.download(closed.data(), out_.data(), words_out * 4);
  }

  /// A tile too large for the device: each half of the interior with what it needs of the solid.
  void close_in_halves(const BitBox& solid, const ScaleLattice& scale, const Halo& halo, const ClosingParams& params,
                       const VoxelBox& interior, BitBox& closed) {
    BP_CUDA_CHECK(cudaStreamSynchronize(stream_.get()));
    closing_.release();
    in_.release();
    out_.release();
    int axis = 0;
    for (int i = 1; i < 3; ++i) {
      if (interior.size()[i] >= interior.size()[axis]) axis = i;
    }
    if (interior.size()[axis] <= 2 * kBrickEdge) {
      fail(ErrorCode::out_of_resource,
           "{}: not enough device memory for a tile of {} x {} x {} voxels; use --device cpu", name_, interior.size().x,
           interior.size().y, interior.size().z);
    }
    VoxelBox lower = interior, upper = interior;
    lower.max[axis] = upper.min[axis] =
        floor_div(interior.min[axis] + interior.size()[axis] / 2, kBrickEdge) * kBrickEdge;
    for (const VoxelBox& half : {lower, upper}) {
      BitBox part_solid(intersect(half.grown(halo.total_vox()), solid.box())), part_closed;
      copy_voxels(solid, part_solid);
      close(part_solid, scale, halo, params, half, part_closed);
      copy_voxels(part_closed, closed);
    }
  }

  Stream stream_;
  cudaDeviceProp properties_;
  std::string name_;
  Staging staging_;
  DeviceClosing closing_;
  DeviceBuffer<std::uint32_t> in_, out_;
  DeviceBuffer<Scale> samples_;
};

}  // namespace

std::vector<CudaDevice> cuda_devices() {
  int count = 0;
  if (cudaGetDeviceCount(&count) != cudaSuccess) {
    (void)cudaGetLastError();
    return {};
  }
  std::vector<CudaDevice> devices;
  for (int i = 0; i < count; ++i) {
    const cudaDeviceProp p = properties(i);
    devices.push_back({i, p.name, p.totalGlobalMem, p.multiProcessorCount});
  }
  return devices;
}

std::unique_ptr<Backend> make_cuda_backend(int device) {
  return std::make_unique<CudaBackend>(device);
}

}  // namespace bp
