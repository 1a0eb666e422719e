#pragma once
#include <map>
#include <mutex>

#include "lib/grid/stream.h"

namespace bp::test {

/// A shelf that just keeps everything.
class MemoryShelf : public BrickShelf {
 public:
  void put(BrickCoord coord, BrickFill fill, const BrickBits& bits) override {
    const std::lock_guard lock(mutex_);
    if (fill == BrickFill::empty) {
      bricks_.erase(coord);
    } else {
      bricks_[coord] = bits;
    }
  }
  BrickFill get(BrickCoord coord, BrickBits& out) const override {
    const std::lock_guard lock(mutex_);
    const auto it = bricks_.find(coord);
    out = it == bricks_.end() ? BrickBits{} : it->second;
    return it == bricks_.end() ? BrickFill::empty : classify(out);
  }
  [[nodiscard]] BrickFill fill(BrickCoord coord) const override {
    BrickBits bits;
    return get(coord, bits);
  }
  void drop(BrickCoord coord) override {
    const std::lock_guard lock(mutex_);
    bricks_.erase(coord);
  }
  [[nodiscard]] std::vector<BrickCoord> coords() const override {
    const std::lock_guard lock(mutex_);
    std::vector<BrickCoord> all;
    for (const auto& [coord, bits] : bricks_) all.push_back(coord);
    return all;
  }
  [[nodiscard]] std::uint64_t memory_bytes() const override {
    const std::lock_guard lock(mutex_);
    return bricks_.size() * sizeof(BrickBits);
  }

 private:
  mutable std::mutex mutex_;
  std::map<BrickCoord, BrickBits> bricks_;
};

}  // namespace bp::test
