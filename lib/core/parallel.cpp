#include "lib/core/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <mutex>

namespace bp {

namespace {

/// Keeps a loop within a pipeline from being cancelled when other items of the pipeline fail. A cancelled loop would
/// return in the middle, and its caller would go on with half of its data.
class OwnContext {
 public:
  [[nodiscard]] tbb::task_group_context& get() { return context_; }

 private:
  tbb::task_group_context context_{tbb::task_group_context::isolated};
};

/// The work of a WorkArena, as its threads see it.
struct Work {
  int threads = 0;
  const std::atomic<bool>* stop = nullptr;
};
thread_local const Work* this_work = nullptr;  // null: of the process

/// Makes this thread part of some work. A thread may wait within one work, and begin an item of another meanwhile.
class InWork {
 public:
  explicit InWork(const Work* work) : before_(this_work) { this_work = work; }
  ~InWork() { this_work = before_; }
  InWork(const InWork&) = delete;
  InWork& operator=(const InWork&) = delete;

 private:
  const Work* before_;
};

/// Begins an item of a loop: on any thread, it is part of the work that the loop is.
class Item {
 public:
  explicit Item(const Work* work) : in_(work) { stop_if_asked(); }

 private:
  InWork in_;
};

/// The threads of the process; 0 until they are first asked for or limited. oneTBB answers the same under a lock, for
/// which the threads of small loops would wait most of their time.
std::atomic<int> process_threads{0};
std::mutex noting;  // so that of limits that begin or end at the same time the last one counts

void note_process_threads() {
  const std::lock_guard lock(noting);
  process_threads = int(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

}  // namespace

ThreadLimit::ThreadLimit(int threads)
    : control_(new tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                       std::size_t(threads > 0 ? threads : tbb::info::default_concurrency()))) {
  note_process_threads();
}
ThreadLimit::~ThreadLimit() {
  delete static_cast<tbb::global_control*>(control_);
  note_process_threads();
}

struct WorkArena::State {
  tbb::task_arena arena;
  Work work;
};

WorkArena::WorkArena(int threads, const std::atomic<bool>* stop) : state_(std::make_unique<State>()) {
  const int all = tbb::info::default_concurrency();
  state_->work = {threads > 0 ? std::min(threads, all) : all, stop};
  state_->arena.initialize(state_->work.threads);
}
WorkArena::~WorkArena() = default;

void WorkArena::run(const std::function<void()>& body) {
  state_->arena.execute([&] {
    const Item item(&state_->work);
    body();
  });
}

void stop_if_asked() {
  if (this_work != nullptr && this_work->stop != nullptr && this_work->stop->load(std::memory_order_relaxed))
    throw Cancelled{};
}

int thread_count() {
  if (this_work != nullptr) return this_work->threads;
  if (process_threads == 0) note_process_threads();
  return process_threads;
}

void parallel_for(std::int64_t n, const std::function<void(std::int64_t)>& body) {
  OwnContext own;
  tbb::parallel_for(
      std::int64_t(0), n,
      [&body, work = this_work](std::int64_t i) {
        const Item item(work);
        body(i);
      },
      own.get());
}

void parallel_ranges(std::int64_t n, std::int64_t grain, const std::function<void(std::int64_t, std::int64_t)>& body) {
  const std::int64_t chunks = (n + grain - 1) / grain;  // fixed boundaries: they do not depend on the thread count
  OwnContext own;
  tbb::parallel_for(
      std::int64_t(0), chunks,
      [&, work = this_work](std::int64_t c) {
        const Item item(work);
        body(c * grain, std::min(n, (c + 1) * grain));
      },
      own.get());
}

namespace {

tbb::filter<void, void*> items_of(const std::function<void*()>& produce) {
  return tbb::make_filter<void, void*>(tbb::filter_mode::serial_in_order,
                                       [&produce, work = this_work](tbb::flow_control& control) -> void* {
                                         const Item begun(work);
                                         void* item = produce();
                                         if (item == nullptr) control.stop();
                                         return item;
                                       });
}

}  // namespace

void isolated(const std::function<void()>& body) {
  tbb::this_task_arena::isolate(body);
}

namespace detail {

void run_jobs(int in_flight, const std::function<void*()>& produce, const std::function<void(void*)>& work) {
  OwnContext own;
  tbb::parallel_pipeline(
      std::size_t(in_flight),
      items_of(produce) & tbb::make_filter<void*, void>(tbb::filter_mode::parallel,
                                                        [&, mine = this_work](void* item) {
                                                          const Item begun(mine);
                                                          tbb::this_task_arena::isolate([&] { work(item); });
                                                        }),
      own.get());
}

void run_pipeline(int in_flight, const std::function<void*()>& produce, const std::function<void(void*)>& work,
                  const std::function<void(void*)>& consume) {
  OwnContext own;
  tbb::parallel_pipeline(std::size_t(in_flight),
                         items_of(produce) &
                             tbb::make_filter<void*, void*>(tbb::filter_mode::parallel,
                                                            [&, mine = this_work](void* item) -> void* {
                                                              const Item begun(mine);
                                                              work(item);
                                                              return item;
                                                            }) &
                             tbb::make_filter<void*, void>(tbb::filter_mode::serial_in_order,
                                                           [&, mine = this_work](void* item) {
                                                             const Item begun(mine);
                                                             consume(item);
                                                           }),
                         own.get());
}

}  // namespace detail

}  // namespace bp
