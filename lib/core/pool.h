#pragma once
#include <condition_variable>
#include <mutex>
#include <utility>
#include <vector>

namespace bp {

/// Lends objects to tasks by pointers of some kind. A task waits until an object is idle.
template <class Pointer>
class Pool {
 public:
  explicit Pool(std::vector<Pointer> things) : count_(int(things.size())), idle_(std::move(things)) {}
  [[nodiscard]] int count() const { return count_; }

  /// Borrows one object for the length of a scope.
  class Lease {
   public:
    explicit Lease(Pool& pool) : pool_(pool), thing_(pool.take()) {}
    ~Lease() { pool_.give(std::move(thing_)); }
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;
    auto* operator->() const { return &*thing_; }
    auto& operator*() const { return *thing_; }

   private:
    Pool& pool_;
    Pointer thing_;
  };

 private:
  Pointer take() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !idle_.empty(); });
    Pointer thing = std::move(idle_.back());
    idle_.pop_back();
    return thing;
  }
  void give(Pointer thing) {
    {
      const std::lock_guard lock(mutex_);
      idle_.push_back(std::move(thing));
    }
    changed_.notify_one();
  }
  const int count_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Pointer> idle_;
};

/// Memory that is used again instead of being given to the system and taken from it anew. Thread-safe.
template <class T>
class Spares {
 public:
  /// One that was given back, as it was then; else a new one.
  [[nodiscard]] T take() {
    const std::lock_guard lock(mutex_);
    if (spares_.empty()) return T();
    T spare = std::move(spares_.back());
    spares_.pop_back();
    return spare;
  }
  void give(T&& thing) {
    const std::lock_guard lock(mutex_);
    spares_.push_back(std::move(thing));
  }
  void clear() {
    const std::lock_guard lock(mutex_);
    std::vector<T>().swap(spares_);
  }

 private:
  std::mutex mutex_;
  std::vector<T> spares_;
};

}  // namespace bp
