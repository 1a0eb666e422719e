#pragma once
#include <map>
#include <mutex>

#include "lib/store/result_store.h"

namespace bp::test {

/// Results that just stay.
class MemoryResults final : public ResultStore {
 public:
  bool get(const ResultKey& key, std::string& out) override {
    const std::lock_guard lock(mutex_);
    const auto found = results.find(key);
    if (found != results.end()) out = found->second;
    return found != results.end();
  }
  void put(const ResultKey& key, std::string_view bytes) override {
    const std::lock_guard lock(mutex_);
    results[key] = bytes;
  }
  std::map<ResultKey, std::string> results;

 private:
  std::mutex mutex_;
};

}  // namespace bp::test
