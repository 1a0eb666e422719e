#include "tools/view/tool_worker.h"

namespace bp {

ToolWorker::ToolWorker() : thread_([this] { work(); }) {}

ToolWorker::~ToolWorker() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
    pipe_.stop();
  }
  wake_.notify_all();
  thread_.join();
}

void ToolWorker::add(Task task) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(task));
  }
  wake_.notify_all();
}

void ToolWorker::replace(Task task) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.clear();
    waiting_.push_back(std::move(task));
    pipe_.stop();
  }
  wake_.notify_all();
}

void ToolWorker::stop() {
  const std::lock_guard lock(mutex_);
  waiting_.clear();
  pipe_.stop();
}

void ToolWorker::work() {
  for (;;) {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [&] { return ends_ || !waiting_.empty(); });
    if (ends_) return;
    const Task task = std::move(waiting_.front());
    waiting_.pop_front();
    pipe_.allow();
    lock.unlock();
    task(pipe_);
  }
}

}  // namespace bp
