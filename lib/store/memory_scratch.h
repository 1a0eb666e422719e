#pragma once
#include <map>
#include <mutex>

#include "lib/store/scratch.h"

namespace bp {

/// Keeps everything in memory, uncompressed, for callers that set no bound.
class MemoryScratch : public Scratch {
 public:
  Handle put(std::span<const std::byte> bytes) override {
    const std::lock_guard lock(mutex_);
    held_ += bytes.size();
    chunks_[next_].assign(bytes.begin(), bytes.end());
    return next_++;
  }
  void get(Handle handle, std::vector<std::byte>& out) const override {
    const std::lock_guard lock(mutex_);
    out = chunks_.at(handle);
  }
  void drop(Handle handle) override {
    const std::lock_guard lock(mutex_);
    held_ -= chunks_.at(handle).size();
    chunks_.erase(handle);
  }
  [[nodiscard]] std::uint64_t memory_bytes() const override {
    const std::lock_guard lock(mutex_);
    return held_;
  }
  [[nodiscard]] std::uint64_t scratch_bytes() const override { return 0; }

 private:
  mutable std::mutex mutex_;
  std::map<Handle, std::vector<std::byte>> chunks_;
  Handle next_ = 0;
  std::uint64_t held_ = 0;
};

}  // namespace bp
