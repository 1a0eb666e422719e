#pragma once
#include "io/scene/detail/block_cache.h"
#include "lib/core/coords.h"

/// Vertices by index, in doubles: in memory up to a budget, then in a scratch file behind a block cache.
namespace bp {

class VertexPool {
 public:
  VertexPool(std::uint64_t budget_bytes, std::string temp_dir);

  void push(const Vec3d& p) {
    if (size_ % kChunk == 0) open_chunk();
    chunks_.back()[size_++ % kChunk] = p;
  }
  /// Returns a vertex; i < size().
  [[nodiscard]] Vec3d operator[](std::uint64_t i) {
    return i >= spilled_ ? chunks_[std::size_t((i - spilled_) / kChunk)][i % kChunk] : read_spilled(i);
  }
  /// Returns a vertex while none is spilled. Thread-safe.
  [[nodiscard]] const Vec3d& in_memory(std::uint64_t i) const { return chunks_[std::size_t(i / kChunk)][i % kChunk]; }
  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] bool spilled() const { return spilled_ > 0; }

 private:
  static constexpr std::uint64_t kChunk = 4096;  // 96 KiB: a whole number of cache blocks
  static_assert(kChunk * sizeof(Vec3d) % BlockCache::kBlockBytes == 0);

  void open_chunk();
  void spill();
  Vec3d read_spilled(std::uint64_t i);

  std::uint64_t budget_bytes_;
  std::string temp_dir_;
  std::uint64_t size_ = 0, spilled_ = 0;          // vertices; the first spilled_ ones lie in the scratch file
  std::vector<std::unique_ptr<Vec3d[]>> chunks_;  // the rest
  std::shared_ptr<ScratchFile> scratch_;
  std::unique_ptr<BlockCache> cache_;
};

}  // namespace bp
