#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "io/scene/scene_reader.h"
#include "lib/levels/level_chain.h"
#include "lib/pass/leaf/scene_leaf.h"
#include "tools/lod/level_list.h"
#include "tools/lod/level_notes.h"
#include "tools/run/make_backend.h"
#include "tools/run/memory_shares.h"

/// The state that all steps of a run of bplod share, and the report at its end.
namespace bp {

/// A program that makes levels from its own scene, and is told of their progress: libbp.
struct BuildHost {
  std::function<std::unique_ptr<TriangleSource>(const SceneOptions&)> open;  ///< none: the files of the options
  PassProgress show;                                                         ///< progress of passes
  const std::atomic<bool>* stop = nullptr;                                   ///< as in PassContext
};

struct Build {
  const BuildOptions& options;
  Report report{"bplod"};
  Progress progress;
  Backends backends;
  const BuildBudget budget;
  const ShelfFactory make_shelf;
  const BuildHost host;
  PlacedScene placed;  ///< on the globe: set before the scene is read

  explicit Build(const BuildOptions& options, BuildHost host = {});
  Build(const Build&) = delete;
  Build& operator=(const Build&) = delete;

  /// Opens the scene from its start.
  [[nodiscard]] std::unique_ptr<TriangleSource> open_scene(const SceneOptions& how) const;
  void note(const std::string& text);  ///< tells the user on stderr and in the report; an empty text is ignored
  /// Finds the place that the options ask for, and notes it. Reads the scene once if it has a system.
  void place();
  /// Returns how scenes are read. `beside`: another copy of the scene's data is in memory at that time.
  [[nodiscard]] SceneOptions scene_options(bool beside = false) const;
  /// Returns the context of all passes after reading: budget.work, or a share of it, and the scratch for data that does
  /// not fit.
  [[nodiscard]] PassContext context(ResultStore* results = nullptr, double share = 1) const;
};

/// Levels that are ready to be written.
struct CompleteLevels {
  std::vector<LodLevel> levels;   ///< finest first
  std::vector<LevelFacts> facts;  ///< of each level
  std::vector<LeftOut> left_out;
  std::set<std::uint32_t> broken;                        ///< images that scenes leave out
  std::vector<std::shared_ptr<const SceneLeaf>> scenes;  ///< shown in place of levels; null, or no element: the level

  /// Returns what is shown in place of a level; null: the level itself.
  [[nodiscard]] const SceneLeaf* scene_of(std::size_t level) const {
    return level < scenes.size() ? scenes[level].get() : nullptr;
  }
};

/// Tells the notes of levels that are one mesh each; `first` is the number of the first one.
void note_levels(Build& build, const std::vector<LevelFacts>& levels, std::size_t first,
                 const std::vector<LeftOut>& left_out, const SceneSize& scene);

/// The facts about the scene that the end of a run reports.
struct ToldScene {
  const VoxelizeCounts& counts;
  double voxel = 0;
  std::optional<std::uint64_t> color_cells{};  ///< none: the scene's colours were not read
  double margin_world = 0;                     ///< distance that levels keep from the scene
};

/// Writes the report and prints the list. Then it says on stderr where the files are, and which command proves them.
void finish(Build& build, const ToldScene& scene, const std::vector<LevelRow>& rows, std::uint64_t bytes_out);
/// Ends a run of --tiles in the same way. `range`: the jobs that were done, of `all` jobs.
void finish_jobs(Build& build, const ToldScene& scene, const JobRange& range, std::uint64_t all,
                 const std::vector<FoundJobs>& found);

}  // namespace bp
