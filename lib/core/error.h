#pragma once
#include <fmt/format.h>

#include <stdexcept>
#include <string>

/// The one exception type of the suite. Thrown anywhere, caught once per process in tools/cli/run_tool.h, which
/// prints the message and exits with exit_code(). A message names the object, the fact and the remedy
/// (docs/exit-codes.md).
namespace bp {

enum class ErrorCode {
  failed,           ///< the work could not be done, for a reason that is none of the below
  bad_argument,     ///< the caller asked for something impossible: a usage error
  bad_input,        ///< an input is missing, broken, truncated or of the wrong kind
  out_of_resource,  ///< memory, disk or device exhausted or absent
  closed_pipe,      ///< the reader of our output went away: end quietly
};

/// Process exit status: 1 failed, 2 usage, 3 bad input, 4 out of memory, disk or device; 141 for a closed pipe (128 +
/// SIGPIPE).
[[nodiscard]] constexpr int exit_code(ErrorCode code) {
  switch (code) {
    case ErrorCode::failed:
      return 1;
    case ErrorCode::bad_argument:
      return 2;
    case ErrorCode::bad_input:
      return 3;
    case ErrorCode::out_of_resource:
      return 4;
    case ErrorCode::closed_pipe:
      return 141;
  }
  return 1;
}

class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  [[nodiscard]] ErrorCode code() const { return code_; }

 private:
  ErrorCode code_;
};

/// fail(ErrorCode::bad_input, "{}: no triangles", name) throws an Error with the formatted message.
template <class... Args>
[[noreturn]] void fail(ErrorCode code, fmt::format_string<Args...> format, Args&&... args) {
  throw Error(code, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace bp
