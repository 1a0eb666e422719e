#pragma once
#include <string>
#include <vector>

#include "lib/levels/level_chain.h"
#include "tools/cli/report.h"

/// The list that bplod prints, and the same in its report.
namespace bp {

/// A line of the list, and of the report.
struct LevelRow {
  std::string file;
  std::uint64_t tiles = 0, faces = 0, bytes = 0;
  double error_world = 0;  ///< NaN: not measured
  double scale_world = 0, voxel = 0;
  Json more = Json::object();  ///< for the report only
};
/// Of a level in one mesh.
[[nodiscard]] LevelRow row_of(const LevelFacts& level, const std::string& file, std::uint64_t bytes);

/// Jobs of a tileset, and how many of them were found in the store.
struct FoundJobs {
  std::string what;
  std::uint64_t jobs = 0, kept = 0;
};

[[nodiscard]] Json json_of(const LevelRow& row);
[[nodiscard]] Json json_of(const FoundJobs& found);
/// Lines of text on stdout.
[[nodiscard]] std::string listing(const std::vector<LevelRow>& rows);
[[nodiscard]] std::string listing(const std::vector<FoundJobs>& found);

}  // namespace bp
