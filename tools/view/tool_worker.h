#pragma once
#include <condition_variable>
#include <deque>
#include <functional>
#include <thread>

#include "tools/view/tool_pipe.h"

namespace bp {

/// Does tasks that run tools, one after the other, on a thread of its own. Thread-safe.
class ToolWorker {
 public:
  /// A task; it must not throw. ToolResult::stopped tells it that it shall end.
  using Task = std::function<void(ToolPipe& pipe)>;

  ToolWorker();
  ~ToolWorker();  ///< as stop(), and waits for the task at work
  ToolWorker(const ToolWorker&) = delete;
  ToolWorker& operator=(const ToolWorker&) = delete;

  void add(Task task);      ///< does it after those that wait
  void replace(Task task);  ///< does it in place of the one at work and those that wait
  void stop();              ///< ends the tools at work, and forgets the tasks that wait

 private:
  void work();
  ToolPipe pipe_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Task> waiting_;
  bool ends_ = false;
  std::thread thread_;  // the last member: the thread begins when all others exist
};

}  // namespace bp
