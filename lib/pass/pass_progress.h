#pragma once
#include <cstdint>
#include <functional>
#include <mutex>

namespace bp {

/// Receives how many units are done, and of how many (0: unknown). It may be empty. It is called on any thread, by one
/// at a time.
using PassProgress = std::function<void(const char* pass, const char* unit, std::uint64_t done, std::uint64_t total)>;

/// The steps of one pass. Thread-safe.
class PassSteps {
 public:
  /// Keeps a reference to `progress`.
  PassSteps(const PassProgress& progress, const char* pass, const char* unit, std::uint64_t total)
      : progress_(progress), pass_(pass), unit_(unit), total_(total) {}
  void add(std::uint64_t n) {
    if (!progress_) return;
    const std::lock_guard lock(mutex_);
    done_ += n;
    progress_(pass_, unit_, done_, total_);
  }

 private:
  const PassProgress& progress_;
  const char *pass_, *unit_;
  std::uint64_t total_, done_ = 0;
  std::mutex mutex_;
};

}  // namespace bp
