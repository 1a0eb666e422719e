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
    : options_(options), stream_(stream), changed_(std::move(changed)), thread_([this] { work(); }) {}

ProxyJob::~ProxyJob() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
    pipe_.stop();
  }
  wake_.notify_all();
  thread_.join();
}

void ProxyJob::request(std::string rules, std::uint64_t revision, std::uint64_t faces) {
  {
    const std::lock_guard lock(mutex_);
    next_ = std::make_unique<Request>(Request{std::move(rules), revision, faces});
    pipe_.stop();
  }
  wake_.notify_all();
}

void ProxyJob::stop() {
  const std::lock_guard lock(mutex_);
  next_.reset();
  pipe_.stop();
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

void ProxyJob::work() {
  for (;;) {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [&] { return ends_ || next_ != nullptr; });
    if (ends_) return;
    const std::unique_ptr<Request> request = std::move(next_);
    pipe_.allow();
    lock.unlock();
    try {
      make(*request);
    } catch (const std::exception& e) {
      set([&](Status& s) { s.step = Step::failed, s.notes = e.what(); });
    }
  }
}

bool ProxyJob::run(const std::vector<ToolCommand>& commands, const std::vector<const MemoryFile*>& inputs,
                   const MemoryFile& out, bool is_check) {
  constexpr int kRefuted = 1, kUndecided = 5;
  const ToolResult result = pipe_.run(commands, inputs, out);
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

void ProxyJob::make(const Request& request) {
  set([&](Status& s) {
    const std::uint64_t number = s.number;
    s = {};
    s.step = Step::meshing, s.revision = request.revision, s.faces = request.faces, s.number = number;
  });
  const MemoryFile rules(request.rules), proxy, verdict;
  auto begin = std::chrono::steady_clock::now();
  if (!run(mesh_commands(options_, request.faces, {rules.path(), stream_.path(), "-"}), {&rules, &stream_}, proxy,
           false))
    return;
  set([&](Status& s) {
    s.step = Step::checking, s.mesh_seconds = seconds_since(begin);
    s.file = std::make_shared<const std::string>(proxy.bytes()), ++s.number;
  });
  begin = std::chrono::steady_clock::now();
  if (!run({check_command(options_, proxy.path())}, {&proxy}, verdict, true)) return;
  set([&](Status& s) {
    s.step = Step::ready, s.check_seconds = seconds_since(begin);
    s.verdict = brief_verdict(verdict.bytes());
  });
}

}  // namespace bp
