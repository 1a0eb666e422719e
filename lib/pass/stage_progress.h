#pragma once
#include <cstdint>
#include <functional>
#include <mutex>

namespace bp {

/// What is done, of how many (0: not known) units. May be empty. Called on any thread, one at a time.
using StageProgress = std::function<void(const char* stage, const char* unit, std::uint64_t done, std::uint64_t total)>;

/// Steps of one stage of the work. Thread-safe.
class StageSteps {
 public:
  /// Keeps a reference to `progress`.
  StageSteps(const StageProgress& progress, const char* stage, const char* unit, std::uint64_t total)
      : progress_(progress), stage_(stage), unit_(unit), total_(total) {}
  void add(std::uint64_t n) {
    if (!progress_) return;
    const std::lock_guard lock(mutex_);
    done_ += n;
    progress_(stage_, unit_, done_, total_);
  }

 private:
  const StageProgress& progress_;
  const char *stage_, *unit_;
  std::uint64_t total_, done_ = 0;
  std::mutex mutex_;
};

}  // namespace bp
