#include "tools/cli/run_tool.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <new>
#include <system_error>

#include "io/files/kept_files.h"
#include "io/files/partial_outputs.h"
#include "lib/check/counted.h"
#include "lib/core/error.h"
#include "tools/cli/advice.h"
#include "tools/cli/common_options.h"

namespace bp::detail {

namespace {

/// Opens the null device for each closed one of 0, 1 and 2. Otherwise the next opened file would get its number, and
/// messages would go to that file. The device is opened in the wrong direction, so that using it is still an error.
void occupy_standard_streams() {
  for (int fd = 0; fd < 3; ++fd) {
    if (::fcntl(fd, F_GETFD) < 0) (void)!::open("/dev/null", fd == 0 ? O_WRONLY : O_RDONLY);
  }
}

extern "C" void on_signal(int number) {
  end_making();
  remove_partial_outputs();
  ::signal(number, SIG_DFL);  // the shell then sees a death by signal, 128 + number, and ends its loop
  ::raise(number);
}

void install_handlers() {
  ::signal(SIGPIPE, SIG_IGN);
  ::signal(SIGXFSZ, SIG_IGN);  // a limit on the size of files becomes an error of write(), like a full disk
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction old {};
    ::sigaction(number, nullptr, &old);
    if (old.sa_handler == SIG_IGN) continue;  // ignored before, as by nohup and for background jobs
    struct sigaction action {};
    action.sa_handler = on_signal;
    action.sa_flags = SA_NODEFER;
    ::sigaction(number, &action, nullptr);
  }
}

/// Prints the message as one line, whatever characters a file name or a parser put into it.
int complain(const Args& args, const std::string& message, int status) {
  // Outputs are being removed because of a signal: wait for the thread that dies of it.
  while (making_has_ended()) ::pause();
  const std::string line = fmt::format("{}: {}\n", args.tool(), one_line(message));
  (void)!::write(2, line.data(), line.size());
  return status;
}

int complain(const Args& args, const Error& e) {
  if (e.code() == ErrorCode::closed_pipe) return exit_code(e.code());
  const auto has_option = [tool = args.declaration()](const std::string& name) {
    return std::any_of(tool.options.begin(), tool.options.end(), [&](const Declaration& option) {
      const std::vector<std::string> names = parts_of(option.names, ',');
      return std::find(names.begin(), names.end(), name) != names.end();
    });
  };
  return complain(args, advised(e, has_option), exit_code(e.code()));
}

/// Forgets what was said about outputs, before a run of a tool and after it: this process may do something else then.
struct ForgetsOutputs {
  ForgetsOutputs() { forget_outputs(); }
  ~ForgetsOutputs() { forget_outputs(); }
  ForgetsOutputs(const ForgetsOutputs&) = delete;
  ForgetsOutputs& operator=(const ForgetsOutputs&) = delete;
};

}  // namespace

int guard(const Args& args, const std::function<int()>& body) {
  occupy_standard_streams();
  install_handlers();
  const KeepsInputs inputs;
  const ForgetsOutputs outputs;
  try {
    return body();
  } catch (const Args::Done&) {
    return 0;
  } catch (const Error& e) {
    return complain(args, e);
  } catch (const std::bad_alloc&) {
    return complain(args, "out of memory; use a smaller --memory, fewer --threads or larger voxels", 4);
  } catch (const std::filesystem::filesystem_error& e) {
    return complain(args, e.what(), 1);
  } catch (const std::system_error& e) {  // no thread could be started, for example
    return complain(args, e.what(), 4);
  } catch (const std::exception& e) {
    return complain(args, std::string("unexpected: ") + e.what(), 1);
  } catch (...) {
    return complain(args, "unexpected failure", 1);
  }
}

}  // namespace bp::detail
