#include "lib/core/parallel.h"

#include <pthread.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <array>
#include <mutex>

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

namespace bp {

namespace {

// Only the thread that calls fork() lives on in its child. If oneTBB had threads before, they are lost there: all work
// is then done by the thread that asks for it, in order and without oneTBB.
std::atomic<bool> has_threads{false};
std::atomic<bool> lost_threads{false};

[[maybe_unused]] const int registered = ::pthread_atfork(nullptr, nullptr, [] {
  if (has_threads.load(std::memory_order_relaxed)) lost_threads = true;
});

void note_threads() {
  if (!has_threads.load(std::memory_order_relaxed)) has_threads = true;
}

bool threads_are_lost() {
  return lost_threads.load(std::memory_order_relaxed);
}

// ThreadSanitizer does not see what oneTBB orders, since libtbb is not compiled with it. So it is told: what a thread
// did before hand_on(tag) happens before what another thread does after take_up(tag). BP_UNSEEN is for functions that
// read their object, which oneTBB copies from thread to thread.
#ifdef __SANITIZE_THREAD__
#define BP_UNSEEN __attribute__((no_sanitize("thread"), noinline))
void hand_on(void* tag) {
  __tsan_release(tag);
}
void take_up(void* tag) {
  __tsan_acquire(tag);
}
#else
#define BP_UNSEEN
void hand_on(void*) {}
void take_up(void*) {}
#endif

/// The work of a WorkArena, as its threads see it.
struct Work {
  int threads = 0;
  std::array<const std::atomic<bool>*, 2> stops{};  // each may be null
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

/// A loop or a pipeline, from begin to end. It is not cancelled when other items of a pipeline around it fail: it would
/// return in the middle, and its caller would go on with half of its data.
class Loop {
 public:
  explicit Loop(const Work* work = this_work) : work_(work) {
    note_threads();
    hand_on(&begun_);
  }
  ~Loop() { take_up(&ended_); }
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;
  [[nodiscard]] tbb::task_group_context& context() { return context_; }

 private:
  friend class Item;
  tbb::task_group_context context_{tbb::task_group_context::isolated};
  const Work* work_;
  char begun_ = 0, ended_ = 0;  // tags
};

/// Begins and ends an item of a loop: on any thread, it is part of the work that the loop is.
class Item {
 public:
  explicit Item(Loop& loop) : loop_(&loop), in_(begin(loop)) {
    try {
      stop_if_asked();
    } catch (...) {
      hand_on(&loop.ended_);
      throw;
    }
  }
  ~Item() { hand_on(&loop_->ended_); }
  Item(const Item&) = delete;
  Item& operator=(const Item&) = delete;

 private:
  static const Work* begin(Loop& loop) {
    take_up(&loop.begun_);
    return loop.work_;
  }
  Loop* loop_;
  InWork in_;
};

/// Calls body(arguments...) as an item of a loop.
template <class Body, class... Arguments>
void run_item(Loop& loop, const Body& body, Arguments... arguments) {
  const Item item(loop);
  body(arguments...);
}

/// Calls body(0) ... body(n - 1) as items of a loop.
template <class Body>
void run_loop(std::int64_t n, const Body& body) {
  Loop loop;
  if (threads_are_lost()) {
    for (std::int64_t i = 0; i < n; ++i) run_item(loop, body, i);
    return;
  }
  tbb::parallel_for(
      std::int64_t(0), n, [l = &loop, b = &body](std::int64_t i) BP_UNSEEN { run_item(*l, *b, i); }, loop.context());
}

/// The stages of a pipeline; it may have no last one.
class Stages {
 public:
  using Produce = std::function<void*()>;
  using Use = std::function<void(void*)>;
  Stages(const Produce& produce, const Use& work, const Use* consume)
      : produce_(produce), work_(work), consume_(consume) {}

  [[nodiscard]] void* produce() {
    const Item begun(loop_);
    take_up(&produced_);
    void* const item = produce_();
    hand_on(&produced_);
    if (item != nullptr) hand_on(item);
    return item;
  }
  void work(void* item) {
    const Item begun(loop_);
    take_up(item);
    work_(item);
    if (consume_ != nullptr) hand_on(item);
  }
  void consume(void* item) {
    const Item begun(loop_);
    take_up(item);
    take_up(&consumed_);
    (*consume_)(item);
    hand_on(&consumed_);
  }
  [[nodiscard]] tbb::task_group_context& context() { return loop_.context(); }

 private:
  const Produce& produce_;
  const Use& work_;
  const Use* consume_;
  Loop loop_;
  char produced_ = 0, consumed_ = 0;  // tags: these stages have one item at a time
};

tbb::filter<void, void*> first_of(Stages& stages) {
  return tbb::make_filter<void, void*>(tbb::filter_mode::serial_in_order,
                                       [s = &stages](tbb::flow_control& control) BP_UNSEEN -> void* {
                                         void* const item = s->produce();
                                         if (item == nullptr) control.stop();
                                         return item;
                                       });
}

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

WorkArena::WorkArena(int threads, std::array<const std::atomic<bool>*, 2> stops) : state_(std::make_unique<State>()) {
  const int all = tbb::info::default_concurrency();
  state_->work = {threads > 0 ? std::min(threads, all) : all, stops};
  if (!threads_are_lost()) state_->arena.initialize(state_->work.threads);
}
WorkArena::~WorkArena() = default;

void WorkArena::run(const std::function<void()>& body) {
  Loop loop(&state_->work);
  if (threads_are_lost()) return run_item(loop, body);
  state_->arena.execute([l = &loop, b = &body]() BP_UNSEEN { run_item(*l, *b); });
}

void stop_if_asked() {
  if (this_work == nullptr) return;
  for (const std::atomic<bool>* stop : this_work->stops) {
    if (stop != nullptr && stop->load(std::memory_order_relaxed)) throw Cancelled{};
  }
}

int thread_count() {
  if (threads_are_lost()) return 1;
  if (this_work != nullptr) return this_work->threads;
  if (process_threads == 0) note_process_threads();
  return process_threads;
}

void parallel_for(std::int64_t n, const std::function<void(std::int64_t)>& body) {
  run_loop(n, body);
}

void parallel_ranges(std::int64_t n, std::int64_t grain, const std::function<void(std::int64_t, std::int64_t)>& body) {
  const std::int64_t chunks = (n + grain - 1) / grain;  // fixed boundaries: they do not depend on the thread count
  run_loop(chunks, [&](std::int64_t c) { body(c * grain, std::min(n, (c + 1) * grain)); });
}

void isolated(const std::function<void()>& body) {
  if (threads_are_lost()) return body();
  tbb::this_task_arena::isolate(body);
}

struct SideWork::State {
  explicit State(std::function<void()> what) : body(std::move(what)), group(loop.context()) {}

  const std::function<void()> body;
  Loop loop;
  tbb::task_group group;
  bool begun = false;  // by oneTBB; otherwise wait() calls the body
};

SideWork::SideWork() = default;
SideWork::SideWork(SideWork&&) noexcept = default;

SideWork::~SideWork() {
  try {
    wait();
  } catch (...) {
  }
}

void SideWork::begin(std::function<void()> body) {
  state_ = std::make_unique<State>(std::move(body));
  if (threads_are_lost()) return;
  state_->group.run([s = state_.get()]() BP_UNSEEN { run_item(s->loop, s->body); });
  state_->begun = true;
}

void SideWork::wait() {
  if (!state_) return;
  const std::unique_ptr<State> done = std::move(state_);
  if (!done->begun) return run_item(done->loop, done->body);
  done->group.wait();
}

namespace detail {

void run_jobs(int in_flight, const std::function<void*()>& produce, const std::function<void(void*)>& work) {
  Stages stages(produce, work, nullptr);
  if (threads_are_lost()) {
    while (void* const item = stages.produce()) stages.work(item);
    return;
  }
  const auto second = [s = &stages](void* item) BP_UNSEEN { isolated([&] { s->work(item); }); };
  tbb::parallel_pipeline(std::size_t(in_flight),
                         first_of(stages) & tbb::make_filter<void*, void>(tbb::filter_mode::parallel, second),
                         stages.context());
}

void run_pipeline(int in_flight, const std::function<void*()>& produce, const std::function<void(void*)>& work,
                  const std::function<void(void*)>& consume) {
  Stages stages(produce, work, &consume);
  if (threads_are_lost()) {
    while (void* const item = stages.produce()) {
      stages.work(item);
      stages.consume(item);
    }
    return;
  }
  const auto second = [s = &stages](void* item) BP_UNSEEN -> void* {
    s->work(item);
    return item;
  };
  const auto third = [s = &stages](void* item) BP_UNSEEN { s->consume(item); };
  tbb::parallel_pipeline(std::size_t(in_flight),
                         first_of(stages) & tbb::make_filter<void*, void*>(tbb::filter_mode::parallel, second) &
                             tbb::make_filter<void*, void>(tbb::filter_mode::serial_in_order, third),
                         stages.context());
}

}  // namespace detail

}  // namespace bp
