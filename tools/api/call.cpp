#include "tools/api/call.h"

#include <cctype>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <new>
#include <optional>
#include <system_error>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "tools/api/structs.h"
#include "tools/cli/advice.h"

namespace bp::api {

namespace {

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

void Call::tell(const char* pass, const char* unit, std::uint64_t done, std::uint64_t total) const {
  const std::lock_guard lock(mutex_);
  if (run_.progress(run_.user, pass, unit, done, total) != 0) throw Cancelled{};
}

PassProgress Call::progress() {
  if (run_.progress == nullptr) return {};
  return [this](const char* pass, const char* unit, std::uint64_t done, std::uint64_t total) {
    tell(pass, unit, done, total);
  };
}

void Call::begin(const char* pass) const {
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

bp_status guarded(const std::function<void()>& body) noexcept {
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

bp_status guarded_call(const bp_run* run, const std::function<void(Call&)>& body) noexcept {
  return guarded([&] {
    Call call(run);
    WorkArena(call.threads(), call.stop()).run([&] {
      call.prepare();
      body(call);
    });
    call.tell_notes();
  });
}

std::string in_words_of_library(const std::string& text) {
  const auto is_word = [](char c) { return std::islower(static_cast<unsigned char>(c)) != 0; };
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const bool begins = i == 0 || std::isalnum(static_cast<unsigned char>(text[i - 1])) == 0;
    for (const char* tool : {"bpvox --", "bpclose --", "bpmesh --", "bplod --"}) {
      if (begins && text.compare(i, std::strlen(tool), tool) == 0) i += std::strlen(tool) - 2;
    }
    if (!begins || text.compare(i, 2, "--") != 0 || i + 2 == text.size() || !is_word(text[i + 2])) {
      out += text[i++];
      continue;
    }
    for (i += 2; i < text.size() && (is_word(text[i]) || text[i] == '-'); ++i) out += text[i] == '-' ? '_' : text[i];
  }
  return out;
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
  (void)guarded([&] { put_struct(run, size, bp_run{}); });
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
