#include "tools/view/proxy_job.h"

#include <chrono>

#include "lib/core/error.h"
#include "tools/view/verdict.h"

namespace bp {

namespace {

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

ProxyJob::ProxyJob(const ViewOptions& options, const MemoryFile& stream, std::function<void()> changed)
    : options_(options), stream_(stream), changed_(std::move(changed)) {}

void ProxyJob::request(std::string rules, std::uint64_t revision, std::uint64_t faces) {
  worker_.replace([this, request = Request{std::move(rules), revision, faces}](ToolPipe& pipe) {
    try {
      make(pipe, request);
    } catch (const std::exception& e) {
      set([&](Status& s) { s.step = Step::failed, s.notes = e.what(); });
    }
  });
}

void ProxyJob::stop() {
  worker_.stop();
}

ProxyJob::Status ProxyJob::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

void ProxyJob::set(const std::function<void(Status&)>& change) {
  {
    const std::lock_guard lock(mutex_);
    change(status_);
  }
  changed_();
}

bool ProxyJob::run(ToolPipe& pipe, const std::vector<ToolCommand>& commands,
                   const std::vector<const MemoryFile*>& inputs, const MemoryFile& out, bool is_check) {
  constexpr int kRefuted = 1, kUndecided = 5;
  const ToolResult result = pipe.run(commands, inputs, out);
  const bool answered = is_check && (result.status == kRefuted || result.status == kUndecided);
  const bool failed = result.status != 0 && !answered && !result.stopped;
  set([&](Status& s) {
    s.notes += result.said;
    if (failed && result.said.empty()) s.notes = fmt::format("{} ended with status {}", result.tool, result.status);
    if (result.stopped) s.step = Step::stopped;
    if (failed) s.step = Step::failed;
  });
  return !result.stopped && !failed;
}

void ProxyJob::make(ToolPipe& pipe, const Request& request) {
  set([&](Status& s) {
    const std::uint64_t number = s.number;
    s = {};
    s.step = Step::meshing, s.revision = request.revision, s.faces = request.faces, s.number = number;
  });
  const MemoryFile rules(request.rules), proxy, verdict;
  auto begin = std::chrono::steady_clock::now();
  if (!run(pipe, mesh_commands(options_, request.faces, {rules.path(), stream_.path(), "-"}), {&rules, &stream_}, proxy,
           false))
    return;
  set([&](Status& s) {
    s.step = Step::checking, s.mesh_seconds = seconds_since(begin);
    s.file = std::make_shared<const std::string>(proxy.bytes()), ++s.number;
  });
  begin = std::chrono::steady_clock::now();
  if (!run(pipe, {check_command(options_, proxy.path())}, {&proxy}, verdict, true)) return;
  set([&](Status& s) {
    s.step = Step::ready, s.check_seconds = seconds_since(begin);
    s.verdict = brief_verdict(verdict.bytes());
  });
}

}  // namespace bp
