#pragma once
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "io/files/file.h"
#include "lib/core/length.h"
#include "lib/pass/context.h"
#include "tools/api/include/bp/bp.h"
#include "tools/api/structs.h"
#include "tools/cli/common_options.h"
#include "tools/cli/report.h"

struct bp_stop {
  std::atomic<bool> set{false};
};

/// A call of libbp: its resources and callbacks, and the one place where exceptions become a bp_status.
namespace bp::api {

using Clock = std::chrono::steady_clock;

class Call {
 public:
  /// Throws bad_argument if a member of `run` will not do.
  explicit Call(const bp_run* run);

  [[nodiscard]] const CommonOptions& common() const { return common_; }
  [[nodiscard]] Report& report() { return report_; }
  /// Returns a receiver of progress that keeps a reference to this object. It throws Cancelled if the caller says so.
  [[nodiscard]] PassProgress progress();
  /// Says what the call does next. From then on the caller hears of it every tenth of a second.
  void begin(const char* pass);
  /// Returns the caller's own flag that ends calls; may be null.
  [[nodiscard]] const std::atomic<bool>* stop() const;
  /// Fills in defaults that depend on the threads, as CommonOptions::prepare() does.
  void prepare() { common_.prepare(); }
  /// Calls body() in an arena of the call's threads.
  void run(const std::function<void()>& body);
  /// Hands the notes of the report to the caller.
  void tell_notes() const;

 private:
  /// The progress that the caller heard of last.
  struct Told {
    std::string pass, unit;
    std::uint64_t done = 0, total = 0;
    Clock::time_point when{};
  };
  void tell(const char* pass, const char* unit, std::uint64_t done, std::uint64_t total);
  /// Tells the caller the same again if it has heard nothing for a tenth of a second: so it can end any call. Returns
  /// when to call this again.
  [[nodiscard]] Clock::time_point remind();
  bp_run run_;
  CommonOptions common_;
  Report report_{"libbp"};
  std::atomic<bool> ended_{false};  ///< by the caller's progress
  std::mutex mutex_;                ///< one thread at a time tells the caller
  Told told_;
};

/// Returns a caller's budgets of faces. Throws bad_argument unless each is above 0 and below the one before.
[[nodiscard]] std::vector<std::uint64_t> falling_faces(const std::uint64_t* first, std::size_t count);

/// Calls `body`; an exception becomes a status, and a message for bp_error_message().
bp_status with_status(const std::function<void()>& body) noexcept;
/// Does the same, except in a child of a fork() during which another thread was in such a call: what that thread held
/// is held for ever there, so the call fails.
bp_status guarded(const std::function<void()>& body) noexcept;
/// Does the same in an arena of the call's threads, and hands the notes to the caller if `body` succeeds.
bp_status guarded_call(const bp_run* run, const std::function<void(Call&)>& body) noexcept;

/// Fills a caller's options of `size` bytes. They stay as they are if they cannot hold their size.
template <class T>
void put_defaults(T* options, std::size_t size, const T& value) noexcept {
  (void)with_status([&] { put_struct(options, size, value); });
}

/// Calls `make` as guarded_call() does, and gives the caller a new T of what it returns.
template <class T, class Make>
bp_status guarded_result(const bp_run* run, T** out, const Make& make) noexcept {
  std::unique_ptr<T> made;  // handed over once the notes are told, too
  const bp_status status = guarded_call(run, [&](Call& call) {
    (void)needed(out, "the result");  // before anything is made
    made.reset(new T{make(call)});
  });
  if (status == BP_OK) *out = made.release();
  return status;
}

/// Returns the name of a file. Throws bad_argument if it is null, or "-": the library uses neither stdin nor stdout.
[[nodiscard]] std::string file_name(const char* path);

/// Returns an output whose bytes go to a caller's sink. `several`: it is one of several files, and the sink gets its
/// name. Throws bad_argument if there is no sink; the output throws Cancelled if the sink says so.
[[nodiscard]] std::unique_ptr<OutputFile> output_of(bp_sink_fn sink, void* user, const std::string& name,
                                                    bool several = false);

/// Throws bad_argument if the length is negative, not finite or of no unit. `name`: of the member.
[[nodiscard]] Length length_of(const bp_length& length, const char* name);

}  // namespace bp::api
