#pragma once
#include <atomic>

#include "lib/store/memory_scratch.h"

namespace bp::test {

/// Counts the bytes that it was given and those that it holds.
class MemoryStore final : public MemoryScratch {
 public:
  MemoryStore(std::uint64_t& put, std::uint64_t& held) : put_(put), held_(held) {}
  Handle put(std::span<const std::byte> bytes) override {
    std::atomic_ref(put_) += bytes.size();
    const Handle handle = MemoryScratch::put(bytes);
    held_of_now();
    return handle;
  }
  void drop(Handle handle) override {
    MemoryScratch::drop(handle);
    held_of_now();
  }

 private:
  void held_of_now() { std::atomic_ref(held_).store(memory_bytes()); }
  std::uint64_t &put_, &held_;
};

}  // namespace bp::test
