#pragma once
#include <cstring>

#include "io/scene/scene_file.h"

/// Cache for small random reads from a file: a bounded number of blocks, in 8-way sets; the least recently used block
/// is replaced.
namespace bp {

class BlockCache {
 public:
  static constexpr std::size_t kBlockBytes = std::size_t(1) << 14;

  /// Keeps at most `budget_bytes` of blocks (at least 8 blocks), allocated when first used.
  BlockCache(SceneFilePtr file, std::uint64_t budget_bytes);

  /// Copies the n <= kBlockBytes bytes at `offset`. Throws bad_input if the file ends before them.
  void read(std::uint64_t offset, void* out, std::size_t n) {
    const std::uint64_t block = offset / kBlockBytes;
    const std::size_t within = std::size_t(offset % kBlockBytes), here = std::min(n, kBlockBytes - within);
    copy(block, within, static_cast<std::byte*>(out), here);
    if (here < n) copy(block + 1, 0, static_cast<std::byte*>(out) + here, n - here);
  }

  [[nodiscard]] std::uint64_t misses() const { return misses_; }

 private:
  static constexpr std::size_t kWays = 8;
  struct Slot {
    std::uint64_t block = ~std::uint64_t(0), used = 0;
    std::size_t bytes = 0;  // less than a block at the end of the file
    std::unique_ptr<std::byte[]> data;
  };
  void copy(std::uint64_t block, std::size_t within, std::byte* out, std::size_t n) {
    const Slot& slot = last_->block == block ? *last_ : find(block);
    if (within + n > slot.bytes) fail_short(block * kBlockBytes + within + n);
    std::memcpy(out, slot.data.get() + within, n);
  }
  const Slot& find(std::uint64_t block);
  void load(Slot& slot, std::uint64_t block);
  [[noreturn]] void fail_short(std::uint64_t end) const;

  SceneFilePtr file_;
  std::size_t sets_;
  std::vector<Slot> slots_;
  Slot* last_;
  std::uint64_t clock_ = 0, misses_ = 0;
};

}  // namespace bp
