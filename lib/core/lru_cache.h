#pragma once
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace bp {

/// Holds values that are made when they are first wanted. The least recently wanted ones make room. Thread-safe. A
/// thread that wants a present value waits only for a few instructions of others that want the same.
template <class T>
class LruCache {
 public:
  /// The cache holds at most `most_bytes`, or one value. Values that left the cache and are still held by someone come
  /// on top. `keys`: there are keys from 0 to keys - 1, and each takes about 80 bytes, whatever is in the cache.
  LruCache(std::uint64_t most_bytes, std::size_t keys) : most_bytes_(most_bytes), slots_(keys) {}

  /// Returns the value of the key. If it is not there, it calls make(), which returns a shared_ptr<const T>; null is
  /// kept, too. Other threads that want the same value wait for it, so make() must not begin parallel loops.
  template <class Make>
  [[nodiscard]] std::shared_ptr<const T> get(std::uint32_t key, const Make& make) {
    Slot& slot = slots_.at(key);
    const std::uint32_t now = makes_.load(std::memory_order_relaxed);
    if (slot.last_wanted.load(std::memory_order_relaxed) != now) slot.last_wanted.store(now, std::memory_order_relaxed);
    if (auto made = slot.get()) return value_of(std::move(made));
    const std::lock_guard lock(slot.mutex);
    if (auto made = slot.get()) return value_of(std::move(made));
    const auto made = std::make_shared<const Made>(make());
    slot.set(made);
    if (made->value != nullptr) make_room(key, made->value->bytes());
    return made->value;
  }

 private:
  struct Made {
    explicit Made(std::shared_ptr<const T> v) : value(std::move(v)) {}
    std::shared_ptr<const T> value;
  };
  /// Replaces std::atomic<std::shared_ptr>, whose memory order is too weak in GCC 12.
  class Slot {
   public:
    std::atomic<std::uint32_t> last_wanted{0};  // a time: the number of values that had been made
    std::mutex mutex;                           // held by the thread that makes the value

    [[nodiscard]] std::shared_ptr<const Made> get() {
      lock();
      std::shared_ptr<const Made> made = made_;
      unlock();
      return made;
    }
    void set(std::shared_ptr<const Made> made) {
      lock();
      made_.swap(made);
      unlock();
    }

   private:
    void lock() {
      while (taken_.test_and_set(std::memory_order_acquire)) std::this_thread::yield();
    }
    void unlock() { taken_.clear(std::memory_order_release); }

    std::atomic_flag taken_;
    std::shared_ptr<const Made> made_;
  };
  struct Kept {
    std::uint32_t key;
    std::uint64_t bytes;
  };

  [[nodiscard]] static std::shared_ptr<const T> value_of(std::shared_ptr<const Made> made) {
    const T* const value = made->value.get();
    return value == nullptr ? nullptr : std::shared_ptr<const T>(std::move(made), value);
  }

  /// Drops values until the one that was just made fits.
  void make_room(std::uint32_t key, std::uint64_t bytes) {
    const std::lock_guard lock(mutex_);
    makes_.fetch_add(1, std::memory_order_relaxed);
    bytes_ += bytes;
    while (bytes_ > most_bytes_ && !kept_.empty()) {
      const auto oldest = std::min_element(kept_.begin(), kept_.end(), [&](const Kept& a, const Kept& b) {
        return slots_[a.key].last_wanted < slots_[b.key].last_wanted;
      });
      slots_[oldest->key].set(nullptr);
      bytes_ -= oldest->bytes;
      kept_.erase(oldest);
    }
    kept_.push_back({key, bytes});
  }

  const std::uint64_t most_bytes_;
  std::vector<Slot> slots_;
  std::atomic<std::uint32_t> makes_{0};
  std::mutex mutex_;  // guards all that follows
  std::vector<Kept> kept_;
  std::uint64_t bytes_ = 0;
};

}  // namespace bp
