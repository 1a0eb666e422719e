#pragma once
#include <chrono>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/cli/common_options.h"

/// The JSON of --report: what ran, with which options, counts, the time of each pass, peak memory, bytes in and out.
/// Keys keep their order. Times and memory differ from run to run; everything else does not.
namespace bp {

using Json = nlohmann::ordered_json;

class Report {
 public:
  explicit Report(std::string tool);

  Json options = Json::object();  ///< the given ones and defaults; the tool fills it
  Json counts = Json::object();   ///< triangles, bricks, voxels, ...
  Json notes = Json::array();     ///< sentences for the user: what was skipped, why a target was not reached
  std::uint64_t bytes_in = 0, bytes_out = 0;

  /// Adds a note, and prints it to stderr as one line, unless the tool is quiet.
  void note(const std::string& text, const CommonOptions& common);

  /// Counts the seconds until the next begin() or write() under this name. Seconds of the same name add up.
  void begin(const std::string& name);

  [[nodiscard]] std::string text();
  /// Writes the file of --report, completely or not at all; does nothing without --report.
  void write(const CommonOptions& common);

 private:
  using Clock = std::chrono::steady_clock;
  void close_pass();
  std::string tool_, pass_;
  Clock::time_point begin_ = Clock::now(), pass_begin_ = begin_;
  Json seconds_ = Json::object();
};

/// Returns the sum of the files' sizes. Missing files and stdin count as 0.
[[nodiscard]] std::uint64_t size_of_files(const std::vector<std::string>& paths);

/// Returns the largest resident set of this process so far, bytes.
[[nodiscard]] std::uint64_t peak_memory();

}  // namespace bp
