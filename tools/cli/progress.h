#pragma once
#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

#include "lib/pass/pass_progress.h"

/// One line on stderr: bar, share, rate and time left. Silent unless stderr is a terminal and the run is long; in a
/// pipe of tools only the last one shows it. stdout is never touched.
namespace bp {

enum class ProgressMode { automatic, bar, json, quiet };

/// Returns whether the stdout of this process goes to another tool.
[[nodiscard]] bool stdout_is_pipe();

class Progress {
 public:
  Progress(std::string tool, ProgressMode mode);
  ~Progress();  ///< clears the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Ends the current pass, and begins one of `total` steps (0: not known). unit: "bricks", "triangles".
  void begin(const std::string& pass, std::uint64_t total, const std::string& unit);
  /// Adds steps. Thread-safe and cheap: an atomic add, and a look at the clock.
  void add(std::uint64_t steps = 1);
  /// Sets the steps done and the total; thread-safe.
  void set(std::uint64_t done, std::uint64_t total);
  void end();

  /// Returns a progress for library code, which knows nothing of terminals: it begins a pass whenever the name changes.
  /// `before`: text before each name. Keeps a reference to this object.
  [[nodiscard]] PassProgress for_pass(const std::string& before = "");

 private:
  using Clock = std::chrono::steady_clock;
  void maybe_show();
  void show(bool last);
  [[nodiscard]] std::string bar_line(double seconds) const;
  [[nodiscard]] std::string json_line(double seconds) const;

  const std::string tool_;
  ProgressMode mode_;
  std::mutex mutex_;  ///< guards the output and the strings
  std::string pass_, unit_;
  std::atomic<std::uint64_t> done_{0}, total_{0};
  const Clock::time_point start_ = Clock::now();  ///< start of the run
  Clock::time_point begin_;                       ///< start of the pass
  std::atomic<std::int64_t> next_ms_{0};          ///< when the line must be shown again, counted from begin_
  bool drawn_ = false;
};

/// Returns a progress that first throws the refusal of outputs, if one waits (check_outputs()): for passes that report
/// when their memory has been counted, and before the work.
[[nodiscard]] PassProgress refused_with_outputs(PassProgress show);

}  // namespace bp
