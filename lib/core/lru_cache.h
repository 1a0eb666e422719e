#pragma once
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <unordered_map>

namespace bp {

/// Values that are made when they are first wanted; those that were wanted longest ago make room. Thread-safe.
template <class T>
class LruCache {
 public:
  /// Values in the cache take at most `most_bytes`, or are one; those that someone holds come on top.
  explicit LruCache(std::uint64_t most_bytes) : most_bytes_(most_bytes) {}

  /// make(), if the value is not there: a shared_ptr<const T>, maybe null, which is kept, too. Others that want the
  /// same value wait for it: make() must not begin loops in parallel.
  template <class Make>
  [[nodiscard]] std::shared_ptr<const T> get(std::uint32_t key, const Make& make) {
    const std::shared_ptr<Slot> slot = slot_of(key);
    const std::lock_guard lock(slot->mutex);
    if (!slot->is_made) {
      slot->value = make();
      slot->is_made = true;
      if (slot->value != nullptr) make_room(key, *slot);
    }
    return slot->value;
  }

 private:
  struct Slot {
    std::mutex mutex;
    bool is_made = false;
    std::shared_ptr<const T> value;
    std::uint64_t bytes = 0;  // in the cache
    std::list<std::uint32_t>::iterator place;
  };

  std::shared_ptr<Slot> slot_of(std::uint32_t key) {
    const std::lock_guard lock(mutex_);
    std::shared_ptr<Slot>& slot = slots_[key];
    if (slot != nullptr) {
      last_wanted_.splice(last_wanted_.begin(), last_wanted_, slot->place);
      return slot;
    }
    last_wanted_.push_front(key);
    slot = std::make_shared<Slot>();
    slot->place = last_wanted_.begin();
    return slot;
  }

  /// For a value that was made just now. It may have left the cache meanwhile.
  void make_room(std::uint32_t key, Slot& made) {
    const std::lock_guard lock(mutex_);
    const auto found = slots_.find(key);
    if (found == slots_.end() || found->second.get() != &made) return;
    bytes_ += made.bytes = made.value->bytes();
    while (bytes_ > most_bytes_ && last_wanted_.size() > 1) {
      const auto oldest = slots_.find(last_wanted_.back());
      bytes_ -= oldest->second->bytes;
      slots_.erase(oldest);
      last_wanted_.pop_back();
    }
  }

  const std::uint64_t most_bytes_;
  std::mutex mutex_;
  std::unordered_map<std::uint32_t, std::shared_ptr<Slot>> slots_;
  std::list<std::uint32_t> last_wanted_;  // the latest first
  std::uint64_t bytes_ = 0;
};

}  // namespace bp
