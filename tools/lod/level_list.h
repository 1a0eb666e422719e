#pragma once
#include <string>
#include <vector>

#include "lib/levels/level_chain.h"
#include "tools/cli/report.h"

/// Makes the list that bplod prints, and the same for its report.
namespace bp {

/// A line of the list, and an object of the report.
struct LevelRow {
  std::string file;
  std::uint64_t tiles = 0, faces = 0, bytes = 0;
  double error_world = 0;  ///< NaN: not measured
  double scale_world = 0, voxel = 0;
  Json more = Json::object();  ///< for the report only
};
/// Returns the row of a level that is one mesh.
[[nodiscard]] LevelRow row_of(const LevelFacts& level, const std::string& file, std::uint64_t bytes);

/// Counts the jobs of a tileset, and those whose results were found in the store.
struct FoundJobs {
  std::string what;
  std::uint64_t jobs = 0, kept = 0;
};

[[nodiscard]] Json json_of(const LevelRow& row);
[[nodiscard]] Json json_of(const FoundJobs& found);
/// Return the list as lines of text for stdout.
[[nodiscard]] std::string listing(const std::vector<LevelRow>& rows);
[[nodiscard]] std::string listing(const std::vector<FoundJobs>& found);

}  // namespace bp
