#include "tools/view/tool_pipe.h"

#include <fcntl.h>
#include <linux/close_range.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>

#include "lib/core/error.h"

namespace bp {

namespace {

/// Returns the folder of the tools: they are installed and built together.
std::string tool_folder() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path().string();
}

/// Everything that a new process needs: between fork() and exec() no memory may be allocated.
struct Start {
  std::string path;
  std::vector<char*> arguments;
  int in, out, err;
};

[[noreturn]] void become(const Start& start, const std::vector<int>& inputs) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // no tool outlives the page that it works for
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ}) ::signal(number, SIG_DFL);
  ::dup2(start.in, 0);
  ::dup2(start.out, 1);
  ::dup2(start.err, 2);
  ::close_range(3, ~0U, CLOSE_RANGE_CLOEXEC);
  for (const int fd : inputs) ::fcntl(fd, F_SETFD, 0);
  ::execv(start.path.c_str(), start.arguments.data());
  ::_exit(127);
}

/// A pipe between two tools. Its ends are closed here once both have begun.
struct Ends {
  int read = -1, write = -1;
};

int status_of(int wait_status) {
  return WIFSIGNALED(wait_status) ? 128 + WTERMSIG(wait_status) : WEXITSTATUS(wait_status);
}

}  // namespace

bool ToolPipe::start(const std::vector<ToolCommand>& commands, const std::vector<int>& inputs, int out, int err) {
  const std::lock_guard lock(mutex_);
  if (stopped_) return false;
  const std::string folder = tool_folder();
  const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  int in = nothing;
  for (std::size_t i = 0; i < commands.size(); ++i) {
    int ends[2] = {-1, -1};
    const bool last = i + 1 == commands.size();
    const bool piped = last || ::pipe2(ends, O_CLOEXEC) == 0;
    Start start{folder + "/" + commands[i].front(), {}, in, last ? out : ends[1], err};
    for (const std::string& word : commands[i]) start.arguments.push_back(const_cast<char*>(word.c_str()));
    start.arguments.push_back(nullptr);
    const pid_t child = piped ? ::fork() : -1;
    const int error = errno;
    if (child == 0) become(start, inputs);
    ::close(in);
    if (!last) ::close(ends[1]);
    in = ends[0];
    if (child < 0) {
      if (in >= 0) ::close(in);
      end_all();
      fail(ErrorCode::out_of_resource, "cannot start {}: {}", commands[i].front(), std::strerror(error));
    }
    at_work_.push_back(child);
  }
  return true;
}

ToolResult ToolPipe::run(const std::vector<ToolCommand>& commands, const std::vector<const MemoryFile*>& inputs,
                         const MemoryFile& out, bool tells_user) {
  std::vector<int> descriptors;
  descriptors.reserve(inputs.size());
  for (const MemoryFile* file : inputs) descriptors.push_back(file->descriptor());
  const MemoryFile said;
  ToolResult result;
  result.stopped = !start(commands, descriptors, out.descriptor(), tells_user ? 2 : said.descriptor());
  for (std::size_t i = 0; !result.stopped && i < commands.size(); ++i) {
    const int status = wait_for(i);
    if (i == 0 || status != 0 || result.status == 0) {
      // A tool that fails ends those before it by a closed pipe, so their status tells nothing.
      result.status = status;
      result.tool = commands[i].front();
    }
  }
  const std::lock_guard lock(mutex_);
  at_work_.clear();
  result.stopped = result.stopped || stopped_;
  result.said = said.bytes();
  return result;
}

/// Returns the exit status of process i. Its number stays on the list until it has ended, so that stop() ends no other
/// process.
int ToolPipe::wait_for(std::size_t i) {
  siginfo_t info{};
  while (::waitid(P_PID, id_t(at_work_[i]), &info, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
  }
  const std::lock_guard lock(mutex_);
  int status = 0;
  (void)::waitpid(at_work_[i], &status, 0);
  at_work_[i] = kEnded;
  return status_of(status);
}

void ToolPipe::end_all() {
  for (const pid_t pid : at_work_) {
    if (pid != kEnded) ::kill(pid, SIGKILL);
  }
}

void ToolPipe::stop() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  end_all();
}

void ToolPipe::allow() {
  const std::lock_guard lock(mutex_);
  stopped_ = false;
}

}  // namespace bp
