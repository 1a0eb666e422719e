#include "gpu/staging.h"

#include <algorithm>
#include <cstring>

#include "gpu/kernels/tuning.h"

namespace bp {

Staging::Staging(cudaStream_t stream) : stream_(stream) {
  for (Block& b : blocks_) BP_CUDA_CHECK(cudaEventCreateWithFlags(&b.free, cudaEventDisableTiming));
}

Staging::~Staging() {
  for (Block& b : blocks_) (void)cudaEventDestroy(b.free);
}

void Staging::upload(void* to, const void* from, std::size_t bytes) {
  for (std::size_t at = 0, i = 0; at < bytes; at += kStagingBytes, ++i) {
    Block& b = blocks_[i % 2];
    const std::size_t n = std::min(kStagingBytes, bytes - at);
    BP_CUDA_CHECK(cudaEventSynchronize(b.free));
    std::memcpy(b.memory.grow(kStagingBytes), static_cast<const std::byte*>(from) + at, n);
    BP_CUDA_CHECK(
        cudaMemcpyAsync(static_cast<std::byte*>(to) + at, b.memory.data(), n, cudaMemcpyHostToDevice, stream_));
    BP_CUDA_CHECK(cudaEventRecord(b.free, stream_));
  }
}

std::size_t Staging::upload_pieces(void* to, std::size_t piece_bytes, std::size_t most,
                                   const std::function<bool(std::byte*)>& fill) {
  const std::size_t per_block = kStagingBytes / piece_bytes;
  std::size_t done = 0;
  for (std::size_t i = 0, n = per_block; n == per_block; ++i) {
    Block& b = blocks_[i % 2];
    BP_CUDA_CHECK(cudaEventSynchronize(b.free));
    std::byte* piece = b.memory.grow(kStagingBytes);
    for (n = 0; n < per_block && done + n < most && fill(piece); ++n) piece += piece_bytes;
    if (n == 0) break;
    BP_CUDA_CHECK(cudaMemcpyAsync(static_cast<std::byte*>(to) + done * piece_bytes, b.memory.data(), n * piece_bytes,
                                  cudaMemcpyHostToDevice, stream_));
    BP_CUDA_CHECK(cudaEventRecord(b.free, stream_));
    done += n;
  }
  return done;
}

void Staging::download_blocks(const void* from, std::size_t bytes,
                              const std::function<void(std::size_t, const std::byte*, std::size_t)>& take) {
  const std::size_t count = (bytes + kStagingBytes - 1) / kStagingBytes;
  const auto size = [&](std::size_t i) { return std::min(kStagingBytes, bytes - i * kStagingBytes); };
  for (std::size_t i = 0; i <= count; ++i) {
    if (i < count) {
      Block& b = blocks_[i % 2];
      BP_CUDA_CHECK(cudaMemcpyAsync(b.memory.grow(kStagingBytes),
                                    static_cast<const std::byte*>(from) + i * kStagingBytes, size(i),
                                    cudaMemcpyDeviceToHost, stream_));
      BP_CUDA_CHECK(cudaEventRecord(b.free, stream_));
    }
    if (i == 0) continue;
    Block& b = blocks_[(i - 1) % 2];
    BP_CUDA_CHECK(cudaEventSynchronize(b.free));
    take((i - 1) * kStagingBytes, b.memory.data(), size(i - 1));
  }
}

void Staging::download(void* to, const void* from, std::size_t bytes) {
  download_blocks(from, bytes, [&](std::size_t at, const std::byte* block, std::size_t n) {
    std::memcpy(static_cast<std::byte*>(to) + at, block, n);
  });
}

}  // namespace bp
