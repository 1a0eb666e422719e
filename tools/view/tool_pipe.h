#pragma once
#include <sys/types.h>

#include <mutex>
#include <string>
#include <vector>

#include "tools/view/memory_file.h"

/// Runs the tools of the suite as a shell would, so that bpview saves the files of its command line.
namespace bp {

/// The name of a tool and its arguments.
using ToolCommand = std::vector<std::string>;

struct ToolResult {
  int status = 0;        ///< of the last tool that failed, else of the last one; 128 + signal
  std::string tool;      ///< the tool that has this status
  std::string said;      ///< stderr of all tools
  bool stopped = false;  ///< stop() ended it
};

/// Runs one pipe of tools at a time. The tools are looked for beside this program.
class ToolPipe {
 public:
  /// Runs the tools; stdout of the last one goes to `out`. `inputs` are open in every tool. With `tells_user`, stderr
  /// of the tools goes to stderr of this process, and not into the result. Throws out_of_resource if a process cannot
  /// be started.
  [[nodiscard]] ToolResult run(const std::vector<ToolCommand>& commands, const std::vector<const MemoryFile*>& inputs,
                               const MemoryFile& out, bool tells_user = false);
  /// Ends the tools at work, and each run() from now on, until allow(). May be called on any thread.
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
