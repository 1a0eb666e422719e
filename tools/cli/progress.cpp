#include "tools/cli/progress.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "io/files/file.h"

namespace bp {

namespace {

constexpr std::int64_t kLongWorkMs = 1000;  ///< runs shorter than this show nothing
constexpr std::int64_t kBarMs = 100, kJsonMs = 1000;
constexpr int kBarWidth = 24;
constexpr double kFewSteps = 100;  ///< passes with fewer steps show a count and no rate

/// Returns whether this tool shows progress. In a pipe only the last tool does, as two lines on one terminal would
/// overwrite each other.
bool may_draw() {
  return ::isatty(2) != 0 && !stdout_is_pipe();
}

void put(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);  // progress that cannot be shown is no error
  std::fflush(stderr);
}

std::string short_count(double n) {
  constexpr const char* kUnits[] = {"", "k", "M", "G", "T"};
  int unit = 0;
  while (n >= 1000 && unit < 4) n /= 1000, ++unit;
  return unit == 0 ? fmt::format("{:.0f}", n) : fmt::format("{:.3g}{}", n, kUnits[unit]);
}

std::string clock_text(double seconds) {
  const auto s = std::int64_t(std::min(seconds, 3.6e7));
  return s < 3600 ? fmt::format("{}:{:02}", s / 60, s % 60)
                  : fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

}  // namespace

bool stdout_is_pipe() {
  struct stat out {};
  return ::fstat(1, &out) == 0 && (S_ISFIFO(out.st_mode) || S_ISSOCK(out.st_mode));
}

Progress::Progress(std::string tool, ProgressMode mode) : tool_(std::move(tool)), mode_(mode) {
  if (mode_ == ProgressMode::automatic) mode_ = may_draw() ? ProgressMode::automatic : ProgressMode::quiet;
}

Progress::~Progress() {
  end();
}

void Progress::begin(const std::string& pass, std::uint64_t total, const std::string& unit) {
  end();
  const std::scoped_lock lock(mutex_);
  pass_ = pass;
  unit_ = unit;
  done_ = 0;
  total_ = total;
  begin_ = Clock::now();
  // In a long run each pass is shown from its first step on, as it may take long.
  const auto before = std::chrono::duration_cast<std::chrono::milliseconds>(begin_ - start_).count();
  const std::int64_t least = mode_ == ProgressMode::automatic ? kLongWorkMs : kBarMs;
  next_ms_ = mode_ == ProgressMode::json ? kBarMs : std::max<std::int64_t>(0, least - before);
}

void Progress::add(std::uint64_t steps) {
  done_.fetch_add(steps, std::memory_order_relaxed);
  maybe_show();
}

void Progress::set(std::uint64_t done, std::uint64_t total) {
  done_ = done;
  total_ = total;
  maybe_show();
}

void Progress::maybe_show() {
  if (mode_ == ProgressMode::quiet) return;
  const auto now = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - begin_).count();
  std::int64_t due = next_ms_.load(std::memory_order_relaxed);
  const std::int64_t step = mode_ == ProgressMode::json ? kJsonMs : kBarMs;
  if (now < due || !next_ms_.compare_exchange_strong(due, now + step)) return;  // another thread shows it
  const std::scoped_lock lock(mutex_);
  show(false);
}

void Progress::end() {
  const std::scoped_lock lock(mutex_);
  if (pass_.empty()) return;
  show(true);
  pass_.clear();
}

void Progress::show(bool last) {
  if (mode_ == ProgressMode::quiet || pass_.empty()) return;
  const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
  if (mode_ == ProgressMode::json) return put(json_line(seconds));
  if (!last) {
    put(fmt::format("\r{}\x1b[K", bar_line(seconds)));
    drawn_ = true;
  } else if (drawn_) {
    put("\r\x1b[K");
    drawn_ = false;
  }
}

std::string Progress::bar_line(double seconds) const {
  const auto done = double(done_), total = double(total_);
  const double rate = seconds * 1000 > kBarMs ? done / seconds : 0;  // 0: not known yet
  const std::string speed = rate > 0 ? fmt::format(" {} {}/s", short_count(rate), unit_) : "";
  if (total <= 0) return fmt::format("{}: {} {} {}{}", tool_, pass_, short_count(done), unit_, speed);
  const double share = std::min(done / total, 1.0);
  const auto full = std::size_t(share * kBarWidth);
  const std::string left = rate > 0 && total >= kFewSteps ? " " + clock_text((total - done) / rate) + " left" : "";
  return fmt::format("{}: {} [{}{}] {:3.0f}%{}{}", tool_, pass_, std::string(full, '#'),
                     std::string(kBarWidth - full, '.'), 100 * share,
                     total < kFewSteps ? fmt::format(" {:.0f} of {:.0f} {}", done, total, unit_) : speed, left);
}

std::string Progress::json_line(double seconds) const {
  return fmt::format(
      "{{\"tool\":\"{}\",\"pass\":\"{}\",\"done\":{},\"total\":{},\"unit\":\"{}\",\"seconds\":{:.3f}}}\n", tool_, pass_,
      done_.load(), total_.load(), unit_, seconds);
}

PassProgress Progress::for_pass(const std::string& before) {
  return [this, before, last = std::string()](const char* pass, const char* unit, std::uint64_t done,
                                              std::uint64_t total) mutable {
    if (last != pass) begin(before + (last = pass), total, unit);
    set(done, total);
  };
}

PassProgress refused_with_outputs(PassProgress show) {
  return [show = std::move(show)](const char* pass, const char* unit, std::uint64_t done, std::uint64_t total) {
    check_outputs();
    if (show) show(pass, unit, done, total);
  };
}

}  // namespace bp
