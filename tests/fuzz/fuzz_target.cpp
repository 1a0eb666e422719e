// libFuzzer target of BP_FUZZ_ENTRY, one of entries.h.
#include <vector>

#include "tests/fuzz/entries.h"
#include "tests/fuzz/tool_runs.h"

/// While a tool runs, stderr is a file in memory. What the fuzzer and the sanitizers say goes to stderr as it is now.
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

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::BP_FUZZ_ENTRY(data, size);
  return 0;
}
