#include "lib/core/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

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

}  // namespace

ThreadLimit::ThreadLimit(int threads)
    : control_(new tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                       std::size_t(threads > 0 ? threads : tbb::info::default_concurrency()))) {}
ThreadLimit::~ThreadLimit() {
  delete static_cast<tbb::global_control*>(control_);
}

int thread_count() {
  return int(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

void parallel_for(std::int64_t n, const std::function<void(std::int64_t)>& body) {
  OwnContext own;
  tbb::parallel_for(
      std::int64_t(0), n, [&](std::int64_t i) { body(i); }, own.get());
}

void parallel_ranges(std::int64_t n, std::int64_t grain, const std::function<void(std::int64_t, std::int64_t)>& body) {
  const std::int64_t chunks = (n + grain - 1) / grain;  // fixed boundaries: they do not depend on the thread count
  OwnContext own;
  tbb::parallel_for(
      std::int64_t(0), chunks, [&](std::int64_t c) { body(c * grain, std::min(n, (c + 1) * grain)); }, own.get());
}

namespace {

tbb::filter<void, void*> items_of(const std::function<void*()>& produce) {
  return tbb::make_filter<void, void*>(tbb::filter_mode::serial_in_order,
                                       [&produce](tbb::flow_control& control) -> void* {
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
      items_of(produce) &
          tbb::make_filter<void*, void>(tbb::filter_mode::parallel,
                                        [&](void* item) { tbb::this_task_arena::isolate([&] { work(item); }); }),
      own.get());
}

void run_pipeline(int in_flight, const std::function<void*()>& produce, const std::function<void(void*)>& work,
                  const std::function<void(void*)>& consume) {
  OwnContext own;
  tbb::parallel_pipeline(
      std::size_t(in_flight),
      items_of(produce) &
          tbb::make_filter<void*, void*>(tbb::filter_mode::parallel,
                                         [&](void* item) -> void* {
                                           work(item);
                                           return item;
                                         }) &
          tbb::make_filter<void*, void>(tbb::filter_mode::serial_in_order, [&](void* item) { consume(item); }),
      own.get());
}

}  // namespace detail

}  // namespace bp
