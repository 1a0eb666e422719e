#pragma once
#include <cuda_runtime.h>

#include "gpu/kernels/device_error.h"

namespace bp {

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
  /// The calling thread works on this device from now on.
  void select() const { BP_CUDA_CHECK(cudaSetDevice(device_)); }
  [[nodiscard]] cudaStream_t get() const { return stream_; }

 private:
  int device_;
  cudaStream_t stream_{};
};

}  // namespace bp
