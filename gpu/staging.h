#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "gpu/kernels/device_buffer.h"

/// Copies between ordinary host memory and the device through two page-locked blocks, so that one block is copied on
/// the bus while the next is copied in memory. Page-locked memory stays bounded, whatever the tile is.
namespace bp {

class Staging {
 public:
  explicit Staging(cudaStream_t stream);
  ~Staging();
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;

  /// Returns when `from` may be reused. The device has the data once the stream has passed.
  void upload(void* to, const void* from, std::size_t bytes);
  /// Uploads pieces of `piece_bytes` (at most kStagingBytes) one after the other. fill(piece) writes one straight into
  /// page-locked memory, and returns false if there is none left. At most `most` pieces. Returns their number.
  std::size_t upload_pieces(void* to, std::size_t piece_bytes, std::size_t most,
                            const std::function<bool(std::byte* piece)>& fill);
  /// Calls take(first byte, block, bytes) for consecutive blocks of `from`, in order.
  void download_blocks(const void* from, std::size_t bytes,
                       const std::function<void(std::size_t at, const std::byte* block, std::size_t n)>& take);
  /// Returns when `to` holds the data. Everything enqueued before has run then.
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
