// bpview: a page in which the scale of a closing is brushed. Manual: docs/bpview.1.md
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <future>
#include <memory>
#include <thread>

#include "io/files/file.h"
#include "lib/core/error.h"
#include "tools/cli/run_tool.h"
#include "tools/run/make_backend.h"
#include "tools/view/page_files.h"
#include "tools/view/server.h"
#include "tools/view/view_options.h"

namespace {

/// The signals that end the server in good order. They are blocked before any thread begins, and waited for.
class EndSignals {
 public:
  EndSignals() {
    ::sigemptyset(&set_);
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) ::sigaddset(&set_, number);
    ::pthread_sigmask(SIG_BLOCK, &set_, nullptr);
  }
  ~EndSignals() { ::pthread_sigmask(SIG_UNBLOCK, &set_, nullptr); }
  EndSignals(const EndSignals&) = delete;
  EndSignals& operator=(const EndSignals&) = delete;
  [[nodiscard]] const sigset_t& set() const { return set_; }
  void wait() const {
    int number = 0;
    ::sigwait(&set_, &number);
  }

 private:
  sigset_t set_{};
};

/// While it lives, the end signals end the process as they end any tool: during the start nobody waits for them.
class EndsAtOnce {
 public:
  explicit EndsAtOnce(const EndSignals& signals)
      : thread_([set = signals.set(), started = started_.get_future()] {
          ::pthread_sigmask(SIG_UNBLOCK, &set, nullptr);  // in this thread only
          started.wait();
        }) {}
  ~EndsAtOnce() {
    started_.set_value();
    thread_.join();
  }
  EndsAtOnce(const EndsAtOnce&) = delete;
  EndsAtOnce& operator=(const EndsAtOnce&) = delete;

 private:
  std::promise<void> started_;
  std::thread thread_;
};

/// Opens a browser, if there is a screen and a program that knows the browser.
void open_browser(const std::string& link) {
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return;
  const pid_t child = ::fork();
  if (child != 0) {
    if (child > 0) (void)::waitpid(child, nullptr, 0);
    return;
  }
  if (::fork() != 0) ::_exit(0);  // the browser is nobody's child
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::dup2(2, 1);  // stdout has the link, and nothing else
  ::close_range(3, ~0U, 0);
  ::execlp("xdg-open", "xdg-open", link.c_str(), nullptr);
  ::_exit(1);
}

void run(const bp::ViewOptions& o) {
  const EndSignals signals;
  bp::Report report("bpview");
  constexpr double kLongWork = 1e3;  // a page waits for each closing, so a GPU is worth its start
  bp::Backends backends = bp::make_backends(o.common, kLongWork, &report);
  auto starting = std::make_unique<EndsAtOnce>(signals);
  bp::Session session(o, backends);
  bp::Server server(session, o.port);
  starting.reset();
  bp::print(fmt::format("{}\n", server.link()));
  if (bp::page_files().empty())
    report.note("this build has no page: it was made without npm; install npm and build again", o.common);
  if (std::error_code error; o.rules_given && !std::filesystem::exists(o.rules, error))
    report.note(o.rules + " is not there: the design begins without rules", o.common);
  if (o.common.progress != bp::ProgressMode::quiet) report.note("ends with Ctrl-C", o.common);
  std::thread answers([&] { server.run(); });
  if (o.opens_browser) open_browser(server.link_for_once());
  signals.wait();
  server.stop();
  answers.join();
}

}  // namespace

int main(int argc, char** argv) {
  return bp::run_tool("bpview", argc, argv, bp::parse_view_options, run);
}
