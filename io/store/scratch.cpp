#include "io/store/scratch.h"

#include <zstd.h>

#include <mutex>
#include <unordered_map>

#include "io/files/file.h"
#include "lib/core/error.h"

namespace bp {

namespace {

constexpr int kLevel = 1;                   // scratch is written once and read once: speed counts
constexpr std::uint64_t kIndexBytes = 100;  // for each entry of the map, and its handle, about

struct FreeCompressor {
  void operator()(ZSTD_CCtx* c) const { ZSTD_freeCCtx(c); }
  void operator()(ZSTD_DCtx* d) const { ZSTD_freeDCtx(d); }
};

class ZstdScratch final : public Scratch {
 public:
  ZstdScratch(std::uint64_t memory_bytes, std::string temp_dir)
      : memory_bytes_(memory_bytes), temp_dir_(std::move(temp_dir)) {}

  Handle put(std::span<const std::byte> bytes) override {
    thread_local const std::unique_ptr<ZSTD_CCtx, FreeCompressor> context(ZSTD_createCCtx());
    Chunk chunk;
    chunk.size = bytes.size();
    chunk.data.resize(ZSTD_compressBound(bytes.size()));
    const std::size_t packed =
        ZSTD_compressCCtx(context.get(), chunk.data.data(), chunk.data.size(), bytes.data(), bytes.size(), kLevel);
    if (ZSTD_isError(packed)) fail(ErrorCode::failed, "scratch data: {}", ZSTD_getErrorName(packed));
    chunk.data.resize(packed);
    chunk.packed = packed;
    if (ScratchFile* file = reserve(packed)) {
      chunk.offset = file->append(chunk.data);
      std::vector<std::byte>().swap(chunk.data);
    } else {
      chunk.data.shrink_to_fit();
    }
    const std::lock_guard lock(mutex_);
    const Handle handle = next_++;
    chunks_.emplace(handle, std::move(chunk));
    return handle;
  }

  void get(Handle handle, std::vector<std::byte>& out) const override {
    thread_local const std::unique_ptr<ZSTD_DCtx, FreeCompressor> context(ZSTD_createDCtx());
    const Chunk& chunk = find(handle);
    std::vector<std::byte> read;
    if (chunk.data.empty()) {
      read.resize(chunk.packed);
      file_->read_at(chunk.offset, read);
    }
    const std::vector<std::byte>& packed = chunk.data.empty() ? read : chunk.data;
    out.resize(chunk.size);
    const std::size_t size = ZSTD_decompressDCtx(context.get(), out.data(), out.size(), packed.data(), packed.size());
    if (ZSTD_isError(size) || size != chunk.size)
      fail(ErrorCode::failed, {Remedy::other_scratch_folder},
           "scratch data in {} came back damaged: its disk may be failing", temp_dir_);
  }

  void drop(Handle handle) override {
    const std::lock_guard lock(mutex_);
    const auto at = chunks_.find(handle);
    if (at == chunks_.end()) return;
    used_ -= at->second.data.size();
    chunks_.erase(at);
  }

  [[nodiscard]] std::uint64_t memory_bytes() const override {
    const std::lock_guard lock(mutex_);
    return used_ + chunks_.size() * kIndexBytes;
  }
  [[nodiscard]] std::uint64_t scratch_bytes() const override {
    const std::lock_guard lock(mutex_);
    return file_ ? file_->size() : 0;
  }

 private:
  struct Chunk {
    std::uint64_t size = 0, packed = 0, offset = 0;
    std::vector<std::byte> data;  ///< empty: the bytes are in the scratch file
  };

  /// Returns the scratch file for the bytes, or null if they may stay in memory, where they are counted.
  ScratchFile* reserve(std::uint64_t bytes) {
    const std::lock_guard lock(mutex_);
    if (used_ + bytes + (chunks_.size() + 1) * kIndexBytes <= memory_bytes_) {
      used_ += bytes;
      return nullptr;
    }
    if (!file_) file_ = std::make_unique<ScratchFile>(temp_dir_);
    return file_.get();
  }
  /// Finds a chunk. The map never moves its elements.
  const Chunk& find(Handle handle) const {
    const std::lock_guard lock(mutex_);
    return chunks_.at(handle);
  }

  const std::uint64_t memory_bytes_;
  const std::string temp_dir_;
  mutable std::mutex mutex_;
  std::unordered_map<Handle, Chunk> chunks_;
  std::unique_ptr<ScratchFile> file_;
  Handle next_ = 0;
  std::uint64_t used_ = 0;
};

}  // namespace

std::unique_ptr<Scratch> make_scratch(std::uint64_t memory_bytes, const std::string& temp_dir) {
  return std::make_unique<ZstdScratch>(memory_bytes, temp_dir);
}

}  // namespace bp
