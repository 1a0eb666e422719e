#pragma once
#include <functional>
#include <optional>
#include <type_traits>

#include "lib/core/parallel.h"
#include "tools/cli/args.h"
#include "tools/cli/common_options.h"

/// The main function of every tool: parse, run, and the one catch ladder of the process (docs/exit-codes.md).
namespace bp {

namespace detail {
/// Runs `body`. An exception becomes one line on stderr, `tool: message`, and the exit status of its kind. Advice names
/// only options that are declared in `args` by then. SIGPIPE is
/// ignored, so that a closed pipe is an error of write() and ends quietly with 141. On SIGINT, SIGTERM and SIGHUP
/// partial outputs are removed and the process dies of the signal.
int guard(const Args& args, const std::function<int()>& body);
}  // namespace detail

/// parse: Options(Args&), opens nothing.   run: void(const Options&), or int(const Options&) for the exit status.
/// If Options has a member `common`, its defaults are filled in, its checks made and its thread limit kept during run.
template <class Parse, class Run>
int run_tool(const char* tool, int argc, char** argv, Parse parse, Run run) {
  Args args(tool, argc, argv);
  return detail::guard(args, [&]() -> int {
    auto options = parse(args);
    std::optional<ThreadLimit> limit;
    if constexpr (requires { options.common.prepare(); }) {
      options.common.prepare(SmallMemory::waits);
      limit.emplace(options.common.threads);
    }
    if constexpr (std::is_void_v<decltype(run(options))>) {
      run(options);
      return 0;
    } else {
      return run(options);
    }
  });
}

}  // namespace bp
