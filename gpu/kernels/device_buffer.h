#pragma once
#include <cuda_runtime.h>

#include <cstddef>
#include <utility>

#include "gpu/kernels/cuda_check.h"

/// Memory that grows when needed and is kept until the end. So nothing is allocated inside a tile once the sizes are
/// known.
namespace bp {

/// Device memory of the current device. Contents are lost when it grows.
template <class T>
class DeviceBuffer {
 public:
  DeviceBuffer() = default;
  ~DeviceBuffer() { release(); }
  DeviceBuffer(const DeviceBuffer&) = delete;
  DeviceBuffer& operator=(const DeviceBuffer&) = delete;

  /// Makes room for at least `count` elements. Throws OutOfDeviceMemory, and is empty, if the device has no room.
  T* grow(std::size_t count) {
    if (count <= capacity_) return data_;
    release();
    BP_CUDA_CHECK(cudaMalloc(reinterpret_cast<void**>(&data_), count * sizeof(T)));
    capacity_ = count;
    return data_;
  }
  void release() {
    if (data_ != nullptr) (void)cudaFree(data_);
    data_ = nullptr;
    capacity_ = 0;
  }
  [[nodiscard]] T* data() const { return data_; }
  [[nodiscard]] std::size_t bytes() const { return capacity_ * sizeof(T); }

 private:
  T* data_ = nullptr;
  std::size_t capacity_ = 0;
};

/// Page-locked host memory, for copies that run beside kernels. A lack of it is not OutOfDeviceMemory, because smaller
/// tiles do not help.
template <class T>
class PinnedBuffer {
 public:
  PinnedBuffer() = default;
  ~PinnedBuffer() {
    if (data_ != nullptr) (void)cudaFreeHost(data_);
  }
  PinnedBuffer(const PinnedBuffer&) = delete;
  PinnedBuffer& operator=(const PinnedBuffer&) = delete;

  T* grow(std::size_t count) {
    if (count <= capacity_) return data_;
    if (data_ != nullptr) (void)cudaFreeHost(std::exchange(data_, nullptr));
    capacity_ = 0;
    check_pinned(cudaMallocHost(reinterpret_cast<void**>(&data_), count * sizeof(T)), count * sizeof(T));
    capacity_ = count;
    return data_;
  }
  [[nodiscard]] T* data() const { return data_; }

 private:
  T* data_ = nullptr;
  std::size_t capacity_ = 0;
};

}  // namespace bp
