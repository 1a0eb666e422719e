// libFuzzer target of BP_FUZZ_ENTRY, one of entries.h.
#include <signal.h>
#include <sys/time.h>

#include <vector>

#include "tests/fuzz/entries.h"
#include "tests/fuzz/tool_runs.h"

/// While a tool runs, stderr is a file in memory. Messages of the fuzzer and the sanitizers go to the stderr of this
/// moment.
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  static char quiet[] = "-close_fd_mask=3";
  static std::vector<char*> words(*argv, *argv + *argc);
  fuzz::keep_stderr();
  words.push_back(quiet);
  *argc = int(words.size());
  words.push_back(nullptr);
  *argv = words.data();
  return 0;
}

namespace {

/// Seconds of processor time: a busy machine causes no hang, as the clock of -timeout would. Sanitizers take ten times
/// as long as a release build: this is six seconds there.
constexpr int kHangSeconds = 60;

void set_alarm(int seconds) {
  struct itimerval timer {};
  timer.it_value.tv_sec = seconds;
  ::setitimer(ITIMER_PROF, &timer, nullptr);
}

void on_alarm(int) {
  fuzz::fail_fuzz("hang", "an input takes more than 60 s of computing");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ::signal(SIGPROF, on_alarm);
  set_alarm(kHangSeconds);
  fuzz::BP_FUZZ_ENTRY(data, size);
  set_alarm(0);
  return 0;
}
