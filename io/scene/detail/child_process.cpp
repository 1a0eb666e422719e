#include "io/scene/detail/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <utility>

#include "lib/core/error.h"
#include "lib/core/parallel.h"

namespace bp {

namespace {

// Tags of the child's answer: then comes the result, or an error as packed().
constexpr char kResult = 'R', kError = 'E', kFailure = 'F', kMemory = 'M';

struct ErrorHead {
  std::uint64_t memory_bytes = 0;
  std::uint8_t code = 0, remedies = 0;  // remedies: their number; they follow, a byte each, and then the text
};

std::string packed(const Error& e) {
  const ErrorHead head{e.memory_bytes(), std::uint8_t(e.code()), std::uint8_t(e.remedies().size())};
  std::string text(sizeof head, '\0');
  std::memcpy(text.data(), &head, sizeof head);
  for (const Remedy remedy : e.remedies()) text += char(remedy);
  return text + e.what();
}

[[noreturn]] void throw_packed(const std::string& text) {
  ErrorHead head;
  std::memcpy(&head, text.data(), sizeof head);
  Remedies remedies;
  for (std::size_t i = 0; i < head.remedies; ++i) remedies.push_back(Remedy(text[sizeof head + i]));
  throw Error(ErrorCode(head.code), text.substr(sizeof head + head.remedies), remedies, head.memory_bytes);
}

std::uint64_t address_space() {
  unsigned long pages = 0;
  if (std::FILE* const f = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(f, "%lu", &pages) != 1) pages = 0;
    std::fclose(f);
  }
  return std::uint64_t(pages) * std::uint64_t(::sysconf(_SC_PAGESIZE));
}

/// `kill`: the hard limit, which ends the process after it was warned.
void limit(int resource, std::uint64_t value, std::uint64_t kill = 0) {
  struct rlimit r {};
  if (::getrlimit(__rlimit_resource_t(resource), &r) != 0) return;
  kill = std::max(kill, value);
  if (r.rlim_max != RLIM_INFINITY) kill = std::min<std::uint64_t>(kill, r.rlim_max);
  r.rlim_max = rlim_t(kill);
  r.rlim_cur = rlim_t(std::min(value, kill));
  ::setrlimit(__rlimit_resource_t(resource), &r);
}

void confine(const ChildLimits& limits) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // the child must not outlive a parent that was killed
  for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGXCPU, SIGTERM, SIGINT, SIGHUP, SIGPIPE})
    std::signal(signal, SIG_DFL);
  const int nowhere = ::open("/dev/null", O_RDWR);
  if (nowhere >= 0) {
    ::dup2(nowhere, 1);
    ::dup2(nowhere, 2);
  }
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, limits.cpu_seconds, limits.cpu_seconds + 1);
  const std::uint64_t now = address_space();
  if (now > 0) limit(RLIMIT_AS, now + limits.memory_bytes);
}

std::string message_of(const std::function<std::string()>& work) {
  try {
    return kResult + work();
  } catch (const Error& e) {
    return kError + packed(e);
  } catch (const std::bad_alloc&) {
    return std::string(1, kMemory);
  } catch (const std::exception& e) {
    return std::string(1, kFailure) + "failed: " + e.what();
  } catch (...) {
    return std::string(1, kFailure) + "failed";
  }
}

[[noreturn]] void run_child(int out, const ChildLimits& limits, const std::function<std::string()>& work) {
  confine(limits);
  const std::string message = message_of(work);
  std::size_t done = 0;
  while (done < message.size()) {
    const ssize_t n = ::write(out, message.data() + done, message.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) ::_exit(1);
    done += std::size_t(n);
  }
  ::_exit(0);  // no destructors: they belong to the parent
}

enum class Reception { complete, late, large };

/// Receives all bytes until the child closes its end, the time is over, more has come than it may send, or the caller's
/// work is to stop: then it throws Cancelled.
Reception receive(int in, const ChildLimits& limits, std::string& message) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::seconds(limits.wall_seconds);
  constexpr long long kGlanceMs = 50;
  char block[65536];
  for (;;) {
    stop_if_asked();
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    if (left <= 0) return Reception::late;
    struct pollfd waiting {
      in, POLLIN, 0
    };
    const int ready = ::poll(&waiting, 1, int(std::min<long long>(left, kGlanceMs)));
    if (ready <= 0) continue;  // interrupted or too early: look at the clock again
    const ssize_t n = ::read(in, block, sizeof block);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return Reception::complete;
    if (message.size() + std::size_t(n) > limits.answer_bytes) return Reception::large;
    message.append(block, std::size_t(n));
  }
}

int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

/// A child of this process, and the end of the pipe that it writes to. It ends with this object at the latest.
class Child {
 public:
  /// `pid`: of fork(), which may have failed.
  Child(pid_t pid, int in) : pid_(pid), in_(in) {}
  ~Child() {
    ::close(in_);
    if (pid_ > 0) (void)end(true);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  [[nodiscard]] int in() const { return in_; }
  /// Waits for its end, and returns its status.
  [[nodiscard]] int end(bool kill) {
    if (kill) ::kill(pid_, SIGKILL);
    return wait_for(std::exchange(pid_, 0));
  }

 private:
  pid_t pid_;
  int in_;
};

std::string why_killed(int signal, const ChildLimits& limits) {
  if (signal == SIGXCPU)
    return fmt::format("was still busy after {} seconds, longer than files of this size take, and was stopped",
                       limits.cpu_seconds);
  if (signal == SIGKILL) return "took too long or too much memory and was stopped";
  return fmt::format("crashed (signal {})", signal);
}

}  // namespace

std::string run_in_child(const std::string& name, const std::string& what, const std::string& remedy,
                         const ChildLimits& limits, const std::function<std::string()>& work) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    fail(ErrorCode::out_of_resource, "{}: cannot make a pipe: {}", name, std::strerror(errno));
  const pid_t pid = ::fork();
  if (pid == 0) {
    ::close(ends[0]);
    run_child(ends[1], limits, work);
  }
  const int error = errno;
  ::close(ends[1]);
  Child child(pid, ends[0]);
  if (pid < 0) fail(ErrorCode::out_of_resource, "{}: cannot start a process: {}", name, std::strerror(error));
  std::string message;
  const Reception reception = receive(child.in(), limits, message);
  const int status = child.end(reception != Reception::complete);
  if (reception == Reception::large || (message.size() == 1 && message[0] == kMemory)) throw ChildOutOfMemory();
  if (WIFSIGNALED(status))
    fail(ErrorCode::bad_input, "{}: {} {}; {}", name, what, why_killed(WTERMSIG(status), limits), remedy);
  if (message.size() > sizeof(ErrorHead) && message[0] == kError) throw_packed(message.substr(1));
  if (message.empty() || message[0] != kResult) {
    fail(ErrorCode::bad_input, "{}: {} {}; {}", name, what, message.empty() ? "ended early" : message.substr(1),
         remedy);
  }
  return message.substr(1);
}

}  // namespace bp
