#include "tools/api/call.h"

#include <pthread.h>
#include <signal.h>

#include <cmath>
#include <condition_variable>
#include <filesystem>
#include <new>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <system_error>
#include <thread>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "tools/api/structs.h"
#include "tools/api/words.h"
#include "tools/cli/advice.h"

namespace bp::api {

namespace {

constexpr std::chrono::milliseconds kSilence{100};

thread_local std::string last_message;

void remember(const std::string& text) noexcept {
  try {
    last_message = text;
  } catch (...) {  // a part of the message before must not stay
    last_message.clear();
  }
}

bp_status status_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::bad_argument:
      return BP_BAD_ARGUMENT;
    case ErrorCode::bad_input:
      return BP_BAD_INPUT;
    case ErrorCode::out_of_resource:
      return BP_OUT_OF_RESOURCE;
    case ErrorCode::failed:
    case ErrorCode::closed_pipe:
      break;
  }
  return BP_FAILED;
}

std::atomic<int> calls_running{0};
std::atomic<bool> forked_in_a_call{false};

/// Counts a call while it runs.
class Running {
 public:
  Running() { ++calls_running; }
  ~Running() { --calls_running; }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
};

[[maybe_unused]] const int registered = ::pthread_atfork(nullptr, nullptr, [] {
  if (calls_running > 0) forked_in_a_call = true;
});

/// Starts a thread that takes none of the process's signals.
template <class Body>
std::jthread without_signals(const Body& body) {
  sigset_t all, before;
  ::sigfillset(&all);
  (void)::pthread_sigmask(SIG_SETMASK, &all, &before);
  std::jthread thread;
  try {
    thread = std::jthread(body);
  } catch (const std::system_error&) {  // the call goes on without reminders
  }
  (void)::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return thread;
}

CommonOptions common_of(const bp_run& run) {
  CommonOptions common;
  constexpr std::int32_t kMostThreads = 4096;
  if (run.threads < 0 || run.threads > kMostThreads)
    fail(ErrorCode::bad_argument, "threads: {} is not between 0 and {}", run.threads, kMostThreads);
  common.threads = run.threads;
  common.memory_bytes = run.memory;
  if (run.temp != nullptr) common.temp = run.temp;
  if (run.device != nullptr) common.device = parse_device(run.device);
  common.progress = ProgressMode::quiet;
  return common;
}

}  // namespace

Call::Call(const bp_run* run) : run_(take_struct(run, bp_run{}, "bp_run")), common_(common_of(run_)) {}

const std::atomic<bool>* Call::stop() const {
  return run_.stop == nullptr ? nullptr : &run_.stop->set;
}

void Call::tell(const char* pass, const char* unit, std::uint64_t done, std::uint64_t total) {
  const std::lock_guard lock(mutex_);
  if (ended_) throw Cancelled{};
  told_ = {pass, unit, done, total, Clock::now()};
  if (run_.progress(run_.user, pass, unit, done, total) == 0) return;
  ended_ = true;
  throw Cancelled{};
}

Clock::time_point Call::remind() {
  const std::lock_guard lock(mutex_);
  const Clock::time_point due = told_.when + kSilence, now = Clock::now();
  if (ended_ || told_.pass.empty()) return now + kSilence;
  if (due > now) return due;
  told_.when = now;
  try {
    ended_ = run_.progress(run_.user, told_.pass.c_str(), told_.unit.c_str(), told_.done, told_.total) != 0;
  } catch (...) {  // of a caller in C++
    ended_ = true;
  }
  return now + kSilence;
}

void Call::run(const std::function<void()>& body) {
  const auto work = [&] { WorkArena(common_.threads, {stop(), &ended_}).run(body); };
  if (run_.progress == nullptr) return work();
  {
    std::mutex mutex;
    std::condition_variable_any woken;
    const std::jthread reminder = without_signals([&](const std::stop_token& over) {
      std::unique_lock lock(mutex);
      for (Clock::time_point next = Clock::now() + kSilence; !over.stop_requested();) {
        woken.wait_until(lock, over, next, [] { return false; });
        if (!over.stop_requested()) next = remind();
      }
    });
    work();
  }
  if (ended_) throw Cancelled{};  // the last answer may have come after the last piece of work
}

PassProgress Call::progress() {
  if (run_.progress == nullptr) return {};
  return [this](const char* pass, const char* unit, std::uint64_t done, std::uint64_t total) {
    tell(pass, unit, done, total);
  };
}

void Call::begin(const char* pass) {
  stop_if_asked();
  if (run_.progress != nullptr) tell(pass, "steps", 0, 0);
}

void Call::tell_notes() const {
  if (run_.note == nullptr) return;
  for (const Json& text : report_.notes) run_.note(run_.user, in_words_of_library(text.get<std::string>()).c_str());
}

std::vector<std::uint64_t> falling_faces(const std::uint64_t* first, std::size_t count) {
  std::vector<std::uint64_t> faces(first, first + count);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (faces[i] == 0) fail(ErrorCode::bad_argument, "faces: 0 is no number of triangles");
    if (i > 0 && faces[i] >= faces[i - 1])
      fail(ErrorCode::bad_argument, "faces: {} after {}: each level has fewer than the one before", faces[i],
           faces[i - 1]);
  }
  return faces;
}

bp_status with_status(const std::function<void()>& body) noexcept {
  try {
    body();
    return BP_OK;
  } catch (const Cancelled&) {
    remember("the call was cancelled");
    return BP_CANCELLED;
  } catch (const Error& e) {
    try {
      remember(in_words_of_library(advised(e)));
    } catch (...) {
      remember("out of memory");
    }
    return status_of(e.code());
  } catch (const std::length_error&) {
    remember("a number of elements is larger than any memory");
    return BP_BAD_ARGUMENT;
  } catch (const std::bad_alloc&) {
    remember("out of memory; use a smaller memory, fewer threads or larger voxels");
    return BP_OUT_OF_RESOURCE;
  } catch (const std::filesystem::filesystem_error& e) {
    remember(e.what());
    return BP_FAILED;
  } catch (const std::system_error& e) {  // no thread could be started
    remember(e.what());
    return BP_OUT_OF_RESOURCE;
  } catch (const std::exception& e) {
    remember(e.what());
    return BP_FAILED;
  } catch (...) {
    remember("unexpected failure");
    return BP_FAILED;
  }
}

bp_status guarded(const std::function<void()>& body) noexcept {
  const Running running;
  return with_status([&] {
    if (forked_in_a_call)
      fail(ErrorCode::failed,
           "this process was forked while another thread was in a call of libbp; fork when no call runs, or start "
           "processes anew (in Python: multiprocessing's method spawn)");
    body();
  });
}

bp_status guarded_call(const bp_run* run, const std::function<void(Call&)>& body) noexcept {
  return guarded([&] {
    Call call(run);
    call.run([&] {
      call.prepare();
      body(call);
    });
    call.tell_notes();
  });
}

std::string file_name(const char* path) {
  std::string name = &needed(path, "the name of the file");
  if (name == "-") fail(ErrorCode::bad_argument, "'-' is no name of a file; the library uses neither stdin nor stdout");
  return name;
}

std::unique_ptr<OutputFile> output_of(bp_sink_fn sink, void* user, const std::string& name, bool several) {
  (void)needed(sink, "the sink");
  return std::make_unique<OutputFile>(
      name, OutputFile::Sink([=](std::span<const std::byte> bytes) {
        if (sink(user, several ? name.c_str() : nullptr, bytes.data(), bytes.size()) != 0) throw Cancelled{};
      }));
}

Length length_of(const bp_length& length, const char* name) {
  if (!std::isfinite(length.value) || length.value < 0)
    fail(ErrorCode::bad_argument, "{}: {} is no length", name, length.value);
  return {length.value + 0.0, choice<Length::Unit>(length.unit, 3, "the unit of a bp_length")};
}

}  // namespace bp::api

using namespace bp::api;

extern "C" {

const char* bp_version(void) {
  return BP_VERSION;
}

const char* bp_error_message(void) {
  return last_message.c_str();
}

bp_stop* bp_stop_new(void) {
  return new (std::nothrow) bp_stop;
}

void bp_stop_set(bp_stop* stop) {
  if (stop != nullptr) stop->set = true;
}

void bp_stop_clear(bp_stop* stop) {
  if (stop != nullptr) stop->set = false;
}

void bp_stop_free(bp_stop* stop) {
  delete stop;
}

void bp_run_defaults(bp_run* run, size_t size) {
  put_defaults(run, size, bp_run{});
}

bp_status bp_length_parse(const char* text, bp_length* out) {
  return guarded([&] {
    const bp::Length length = bp::parse_length(&needed(text, "the text"));
    if (length.unit == bp::Length::Unit::pixels)
      bp::fail(bp::ErrorCode::bad_argument, "'{}': pixels measure pictures", text);
    needed(out, "the result") = {length.value, std::int32_t(length.unit)};
  });
}

}  // extern "C"
