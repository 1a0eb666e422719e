#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <utility>

/// The only door to oneTBB. Results never depend on the number of threads: work items are independent and are combined
/// in order.
namespace bp {

/// Limits this process to `threads` computing threads (0: all cores). Keep it alive while work runs.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  void* control_;
};

/// Returns the number of computing threads that the caller's work has: that of its WorkArena, else of the process.
/// Takes no lock, so small loops may ask.
[[nodiscard]] int thread_count();

/// Thrown by work that was told to stop. Its output is incomplete then.
struct Cancelled {};

/// One caller's work among that of others in this process, as calls of libbp are. It has threads of its own number, and
/// can be told to stop.
class WorkArena {
 public:
  /// `threads`: at most so many, and at most all cores (0: all cores). `stops`: once one of them is true, the parallel
  /// loops and pipelines of this work throw Cancelled before their next item; null: never.
  explicit WorkArena(int threads, std::array<const std::atomic<bool>*, 2> stops = {});
  WorkArena(int threads, const std::atomic<bool>* stop) : WorkArena(threads, std::array{stop, stop}) {}
  ~WorkArena();
  WorkArena(const WorkArena&) = delete;
  WorkArena& operator=(const WorkArena&) = delete;
  /// Calls body() on this thread. Its parallel loops share the threads of this arena only. Rethrows what body() throws.
  void run(const std::function<void()>& body);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Throws Cancelled if the caller's work is to stop. Parallel loops do this before each item; long loops on one thread
/// call it now and then. Cost: a few loads.
void stop_if_asked();

/// Calls body(i) for i in [0, n), in any order, in parallel. Rethrows the first exception.
void parallel_for(std::int64_t n, const std::function<void(std::int64_t)>& body);

/// The usual grain of parallel_ranges(), for faces, points and the like that take microseconds each.
constexpr std::int64_t kItemsAtOnce = 256;
/// Calls body(begin, end) for consecutive chunks of `grain` items. The last chunk may have fewer.
void parallel_ranges(std::int64_t n, std::int64_t grain, const std::function<void(std::int64_t, std::int64_t)>& body);

/// Calls body(). While its parallel loops wait, this thread begins no other work, so body() may hold a lock.
void isolated(const std::function<void()>& body);

/// Work that another thread does while the caller goes on. It is begun and waited for in the same WorkArena::run(),
/// isolated() or job of run_jobs(), and in the same process: elsewhere it may never be done.
class SideWork {
 public:
  SideWork();
  ~SideWork();  ///< waits, and drops what the body threw
  SideWork(SideWork&&) noexcept;
  SideWork& operator=(SideWork&&) = delete;
  /// Begins body(). The caller has waited for what it began before.
  void begin(std::function<void()> body);
  /// Returns once the body has returned, at once if there is none. Rethrows what it threw. Where no other thread is
  /// free, this one calls the body.
  void wait();

 private:
  struct State;
  std::unique_ptr<State> state_;  ///< null: nothing was begun
};

/// Runs a pipeline with at most `in_flight` items: produce() in order on one thread at a time until it returns false,
/// work() in parallel, consume() in the order of production. `Item` is default-constructible and movable.
///   produce: bool(Item&)   work: void(Item&)   consume: void(Item&)
template <class Item>
void pipeline(int in_flight, const std::function<bool(Item&)>& produce, const std::function<void(Item&)>& work,
              const std::function<void(Item&)>& consume);

/// Runs a pipeline without consume(): work() on at most `in_flight` items at once, begun in the order of production. No
/// item waits for another. While a loop within an item waits for its other threads, its own thread begins no further
/// item.
template <class Item>
void run_jobs(int in_flight, const std::function<bool(Item&)>& produce, const std::function<void(Item&)>& work);

namespace detail {
void run_jobs(int in_flight, const std::function<void*()>& produce, const std::function<void(void*)>& work);
void run_pipeline(int in_flight, const std::function<void*()>& produce, const std::function<void(void*)>& work,
                  const std::function<void(void*)>& consume);

/// Owns the items in a pipeline, so that items which an exception leaves there are destroyed with it.
template <class Item>
class Items {
 public:
  /// Returns null at the end.
  void* add(const std::function<bool(Item&)>& produce) {
    auto item = std::make_unique<Item>();
    if (!produce(*item)) return nullptr;
    const std::lock_guard lock(mutex_);
    void* const p = item.get();
    items_.emplace(p, std::move(item));
    return p;
  }
  std::unique_ptr<Item> take(void* p) {
    const std::lock_guard lock(mutex_);
    return std::move(items_.extract(p).mapped());
  }

 private:
  std::mutex mutex_;
  std::unordered_map<void*, std::unique_ptr<Item>> items_;
};
}  // namespace detail

template <class Item>
void pipeline(int in_flight, const std::function<bool(Item&)>& produce, const std::function<void(Item&)>& work,
              const std::function<void(Item&)>& consume) {
  detail::Items<Item> items;
  detail::run_pipeline(
      in_flight, [&] { return items.add(produce); }, [&](void* p) { work(*static_cast<Item*>(p)); },
      [&](void* p) { consume(*items.take(p)); });
}

template <class Item>
void run_jobs(int in_flight, const std::function<bool(Item&)>& produce, const std::function<void(Item&)>& work) {
  detail::Items<Item> items;
  detail::run_jobs(
      in_flight, [&] { return items.add(produce); }, [&](void* p) { work(*items.take(p)); });
}

}  // namespace bp
