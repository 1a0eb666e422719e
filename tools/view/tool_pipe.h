#pragma once
#include <sys/types.h>

#include <mutex>
#include <string>
#include <vector>

#include "tools/view/memory_file.h"

/// Runs the tools of the suite, as a shell would: so what bpview saves is what its command line makes.
namespace bp {

/// A tool's name and its arguments.
using ToolCommand = std::vector<std::string>;

struct ToolResult {
  int status = 0;        ///< exit status of the last tool that failed, else of the last one; 128 + signal
  std::string tool;      ///< whose status it is
  std::string said;      ///< by all tools on stderr
  bool stopped = false;  ///< by stop()
};

/// One pipe of tools at a time. They are looked for beside this program.
class ToolPipe {
 public:
  /// What the last tool prints goes to `out`. `inputs` are open in every tool. tells_user: what the tools say goes to
  /// stderr of this process, and not into the result. Throws out_of_resource if a process cannot be started.
  [[nodiscard]] ToolResult run(const std::vector<ToolCommand>& commands, const std::vector<const MemoryFile*>& inputs,
                               const MemoryFile& out, bool tells_user = false);
  /// Ends the tools at work, and each run() from now on, until allow(). Any thread.
  void stop();
  void allow();

 private:
  [[nodiscard]] bool start(const std::vector<ToolCommand>& commands, const std::vector<int>& inputs, int out, int err);
  [[nodiscard]] int wait_for(std::size_t i);
  void end_all();
  static constexpr pid_t kEnded = -1;
  std::mutex mutex_;
  std::vector<pid_t> at_work_;
  bool stopped_ = false;
};

}  // namespace bp
