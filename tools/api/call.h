#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>

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

class Call {
 public:
  /// Throws bad_argument if a member of `run` will not do.
  explicit Call(const bp_run* run);

  [[nodiscard]] const CommonOptions& common() const { return common_; }
  [[nodiscard]] Report& report() { return report_; }
  /// Returns a receiver of progress that keeps a reference to this object. It throws Cancelled if the caller says so.
  [[nodiscard]] PassProgress progress();
  /// Says what the call does next.
  void begin(const char* pass) const;
  [[nodiscard]] int threads() const { return common_.threads; }
  [[nodiscard]] const std::atomic<bool>* stop() const;
  /// Fills in defaults that depend on the threads, as CommonOptions::prepare() does.
  void prepare() { common_.prepare(); }
  /// Hands the notes of the report to the caller.
  void tell_notes() const;

 private:
  void tell(const char* pass, const char* unit, std::uint64_t done, std::uint64_t total) const;
  bp_run run_;
  CommonOptions common_;
  Report report_{"libbp"};
  mutable std::mutex mutex_;  ///< one thread at a time tells the caller
};

/// Returns a caller's budgets of faces. Throws bad_argument unless each is above 0 and below the one before.
[[nodiscard]] std::vector<std::uint64_t> falling_faces(const std::uint64_t* first, std::size_t count);

/// Calls `body`; an exception becomes a status, and a message for bp_error_message().
bp_status guarded(const std::function<void()>& body) noexcept;
/// Does the same in an arena of the call's threads, and hands the notes to the caller if `body` succeeds.
bp_status guarded_call(const bp_run* run, const std::function<void(Call&)>& body) noexcept;

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

/// Returns the text as users of the library know it. Members are named as options are: --keep-cavities, and bpclose
/// --keep-cavities, is keep_cavities.
[[nodiscard]] std::string in_words_of_library(const std::string& text);

/// Throws bad_argument if the length is negative, not finite or of no unit. `name`: of the member.
[[nodiscard]] Length length_of(const bp_length& length, const char* name);

}  // namespace bp::api
