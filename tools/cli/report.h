#pragma once
#include <chrono>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/cli/common_options.h"

/// The JSON of --report: what ran, with which options, what it counted, how long each pass took, peak memory, bytes in
/// and out. Keys keep their order. Times and memory differ from run to run; everything else does not.
namespace bp {

using Json = nlohmann::ordered_json;

class Report {
 public:
  explicit Report(std::string tool);

  Json options = Json::object();  ///< those given and defaults; the tool fills it
  Json counts = Json::object();   ///< triangles, bricks, voxels, ...
  Json notes = Json::array();     ///< sentences worth a look: what was skipped, why a target was not reached
  std::uint64_t bytes_in = 0, bytes_out = 0;

  /// Adds a note, and says it on stderr unless the tool is to be quiet: one line, as an error would be.
  void note(const std::string& text, const CommonOptions& common);

  /// Seconds from here to the next begin() or to write(), under this name; a name met again adds up.
  void begin(const std::string& name);

  [[nodiscard]] std::string text();
  /// Writes the file of --report, complete or not at all; nothing without --report.
  void write(const CommonOptions& common);

 private:
  using Clock = std::chrono::steady_clock;
  void close_pass();
  std::string tool_, pass_;
  Clock::time_point begin_ = Clock::now(), pass_begin_ = begin_;
  Json seconds_ = Json::object();
};

/// Of those that are there; stdin counts nothing.
[[nodiscard]] std::uint64_t size_of_files(const std::vector<std::string>& paths);

/// Largest resident set of this process so far, bytes.
[[nodiscard]] std::uint64_t peak_memory();

}  // namespace bp
