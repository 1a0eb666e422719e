#pragma once
#include <algorithm>
#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "gpu/kernels/cuda_check.h"
#include "tests/bench/median.h"

/// Time on a GPU, by events.
namespace bp {

/// Events on a stream, by name.
class Clock {
 public:
  explicit Clock(cudaStream_t stream) : stream_(stream) {}
  ~Clock() {
    for (auto& e : events_) (void)cudaEventDestroy(e);
  }
  void start() {
    used_ = 0;
    names_.clear();
    mark("");
  }
  void mark(const char* name) {
    if (used_ == events_.size()) {
      events_.push_back(nullptr);
      BP_CUDA_CHECK(cudaEventCreateWithFlags(&events_.back(), cudaEventDefault));
    }
    names_.emplace_back(name);
    BP_CUDA_CHECK(cudaEventRecord(events_[used_++], stream_));
  }
  /// Milliseconds between consecutive marks; stages that occur several times add up.
  std::vector<std::pair<std::string, double>> read() {
    BP_CUDA_CHECK(cudaEventSynchronize(events_[used_ - 1]));
    std::vector<std::pair<std::string, double>> out;
    for (std::size_t i = 1; i < used_; ++i) {
      float ms = 0;
      BP_CUDA_CHECK(cudaEventElapsedTime(&ms, events_[i - 1], events_[i]));
      const auto at = std::find_if(out.begin(), out.end(), [&](const auto& p) { return p.first == names_[i]; });
      if (at == out.end()) {
        out.emplace_back(names_[i], ms);
      } else {
        at->second += double(ms);
      }
    }
    return out;
  }

 private:
  cudaStream_t stream_;
  std::deque<cudaEvent_t> events_;
  std::vector<std::string> names_;
  std::size_t used_ = 0;
};

}  // namespace bp
