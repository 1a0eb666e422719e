#pragma once
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace bp {

/// Tells listeners that something has changed. They ask for the new state themselves, so a slow listener misses steps
/// between and never falls behind.
class Events {
 public:
  void tell() {
    {
      const std::lock_guard lock(mutex_);
      ++number_;
    }
    wake_.notify_all();
  }
  /// Makes listeners return at once from now on.
  void end() {
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
    }
    wake_.notify_all();
  }
  /// Waits for a change after number `seen`, at most this long. Returns the present number.
  std::uint64_t wait(std::uint64_t seen, std::chrono::milliseconds most) {
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, most, [&] { return ended_ || number_ != seen; });
    return number_;
  }
  [[nodiscard]] bool ended() const {
    const std::lock_guard lock(mutex_);
    return ended_;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::uint64_t number_ = 1;
  bool ended_ = false;
};

}  // namespace bp
