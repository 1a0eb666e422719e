#pragma once
#include <cerrno>
#include <csignal>
#include <initializer_list>

namespace bp::detail {

/// While it lives, a write of this thread that finds no reader (SIGPIPE) or grows a file beyond the process's limit
/// (SIGXFSZ) fails with an error, and no signal ends the process. The program around the library keeps its handlers.
/// Cost: four system calls.
class NoWriteSignals {
 public:
  NoWriteSignals() {
    ::sigemptyset(&of_writes_);
    ::sigaddset(&of_writes_, SIGPIPE);
    ::sigaddset(&of_writes_, SIGXFSZ);
    (void)::pthread_sigmask(SIG_BLOCK, &of_writes_, &before_);
    (void)::sigpending(&pending_);
  }
  ~NoWriteSignals() {
    for (const int number : {SIGPIPE, SIGXFSZ}) {  // one that was pending before belongs to the caller
      if (::sigismember(&pending_, number) == 1) (void)::sigdelset(&of_writes_, number);
    }
    const int error = errno;
    const timespec at_once{};
    while (::sigtimedwait(&of_writes_, nullptr, &at_once) > 0) {
    }
    (void)::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    errno = error;
  }
  NoWriteSignals(const NoWriteSignals&) = delete;
  NoWriteSignals& operator=(const NoWriteSignals&) = delete;

 private:
  sigset_t of_writes_{}, before_{}, pending_{};
};

}  // namespace bp::detail
