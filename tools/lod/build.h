#pragma once
#include <optional>
#include <string>
#include <vector>

#include "io/scene/scene_reader.h"
#include "lib/levels/level_chain.h"
#include "tools/lod/level_list.h"
#include "tools/lod/level_notes.h"
#include "tools/run/make_backend.h"
#include "tools/run/memory_shares.h"

/// What all steps of a run of bplod work with, and how its end is told.
namespace bp {

struct Build {
  const BuildOptions& options;
  Report report{"bplod"};
  Progress progress;
  Backends backends;
  const BuildBudget budget;
  const ShelfFactory make_shelf;
  const PassProgress show;  ///< progress of passes
  PlacedScene placed;       ///< on the globe: set before the scene is read

  explicit Build(const BuildOptions& options);
  Build(const Build&) = delete;
  Build& operator=(const Build&) = delete;

  void note(const std::string& text);  ///< on stderr and in the report; nothing of an empty text
  /// Finds the place that the options ask for, and notes it. Reads the scene once if it has a system.
  void place();
  /// How scenes are read. `beside`: something else of them is in memory meanwhile.
  [[nodiscard]] SceneOptions scene_options(bool beside = false) const;
  /// Makes the context of all passes after reading: budget.work, or a share of it, and where the rest spills to.
  [[nodiscard]] PassContext context(ResultStore* results = nullptr, double share = 1) const;
};

/// Levels that lack nothing but to be written.
struct CompleteLevels {
  std::vector<LodLevel> levels;   ///< finest first
  std::vector<LevelFacts> facts;  ///< of each
  std::vector<LeftOut> left_out;
};

/// Notes of levels in one mesh, of which `first` is the number of the first.
void note_levels(Build& build, const std::vector<LevelFacts>& levels, std::size_t first,
                 const std::vector<LeftOut>& left_out, const SceneSize& scene);

/// What the end of a run tells of the scene.
struct ToldScene {
  const VoxelizeCounts& counts;
  double voxel = 0;
  std::optional<std::uint64_t> color_cells{};  ///< none: the scene's colours were not gathered
  double margin_world = 0;                     ///< that levels keep from the scene
};

/// Writes the report and prints the list; then, on stderr, where the files are, and what proves them.
void finish(Build& build, const ToldScene& scene, const std::vector<LevelRow>& rows, std::uint64_t bytes_out);
/// Ends a run of --tiles in the same way: `range` of `all` numbers.
void finish_jobs(Build& build, const ToldScene& scene, const JobRange& range, std::uint64_t all,
                 const std::vector<FoundJobs>& found);

}  // namespace bp
