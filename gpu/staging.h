#pragma once
#include <array>

#include "gpu/device_buffer.h"

/// Copies between ordinary host memory and the device through two page-locked blocks, so that the copy of one block on
/// the bus runs beside the copy of the next in memory. Page-locked memory stays bounded whatever the tile.
namespace bp {

class Staging {
 public:
  explicit Staging(cudaStream_t stream);
  ~Staging();
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;

  /// Returns when `from` may be reused; the device has the data once the stream has passed.
  void upload(void* to, const void* from, std::size_t bytes);
  /// Returns when `to` holds the data: everything enqueued before has run.
  void download(void* to, const void* from, std::size_t bytes);

 private:
  struct Block {
    PinnedBuffer<std::byte> memory;
    cudaEvent_t free{};  ///< the device is done with it
  };
  cudaStream_t stream_;
  std::array<Block, 2> blocks_;
};

}  // namespace bp
