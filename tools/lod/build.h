#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "io/scene/scene_reader.h"
#include "lib/pass/color/scene_colors.h"
#include "lib/pass/voxelize/voxelize_stage.h"
#include "tools/cli/report.h"
#include "tools/lod/build_options.h"
#include "tools/run/make_backend.h"
#include "tools/run/memory_shares.h"

/// What all profiles of bplod have in common: the scene as voxels, levels in one mesh, the list and the report.
namespace bp {

struct VoxelizedScene {
  StreamHeader header;
  std::unique_ptr<BrickShelf> solid;
  VoxelizeCounts counts;
};

/// A line of the list, and of the report.
struct LevelRow {
  std::string file;
  std::uint64_t tiles = 0, faces = 0, bytes = 0;
  double error_world = 0;  ///< NaN: not measured
  double scale_world = 0, voxel = 0;
  Json more = Json::object();  ///< for the report only
};

/// Jobs of a tileset, and how many of them were found in the store.
struct FoundJobs {
  std::string what;
  std::uint64_t jobs = 0, kept = 0;
};

/// What is said of a level whose error exceeds the one asked for; scene units.
[[nodiscard]] std::string error_note(std::size_t level, double error_world, double asked_world);

/// As of OriginOption, but of tilesets, which hold coordinates in double. Throws bad_argument if --origin would round.
[[nodiscard]] std::string origin_note(const BuildOptions& options, const StreamHeader& header);

/// What is said of a tileset that nobody named voxels for, if the scene has more triangles than those chosen are for;
/// else empty.
[[nodiscard]] std::string voxel_note(const BuildOptions& options, const SceneSize& scene);

class Build {
 public:
  explicit Build(const BuildOptions& options);
  Build(const Build&) = delete;
  Build& operator=(const Build&) = delete;

  /// cell_vox, results: as in VoxelizeOptions. halvings: as in voxel_size().
  /// ground: as if it stood on the ground (tools/run/grounded_source.h); the scene was voxelized without before.
  [[nodiscard]] VoxelizedScene voxelize(std::int32_t cell_vox, ResultStore* results = nullptr, int halvings = 0,
                                        bool ground = false);
  /// How scenes are read. `beside`: something else of them is in memory meanwhile.
  [[nodiscard]] SceneOptions scene_options(bool beside = false) const;
  /// For LodChain; after voxelize(), as all that follow.
  [[nodiscard]] LodOptions lod_options();
  /// Of all that follows voxelize(): budget.work, and what spills.
  [[nodiscard]] PassContext context(ResultStore* results = nullptr) const;
  /// What stays inside bounding levels; after voxelize().
  [[nodiscard]] Enclose enclosed() const { return enclosed_; }

  /// Colours and provenance of a level of a chain, and the notes on what it missed.
  void finish_level(LodLevel& level, std::size_t number, const LodTarget& target, const std::string& input_hash);
  void note_missing_materials();
  void note(const std::string& text);
  /// Null if the scene has no colours, or if none are wanted.
  [[nodiscard]] SceneColors* colors() const { return colors_.get(); }

  /// Writes the report and prints the list.
  void finish(const VoxelizedScene& scene, const std::vector<LevelRow>& rows, std::uint64_t bytes_out);
  /// The same of a run of --tiles: `range` of `all` numbers.
  void finish_jobs(const VoxelizedScene& scene, const JobRange& range, std::uint64_t all,
                   const std::vector<FoundJobs>& found);

 private:
  /// The report, then the list; a failure says that what was `made` is there.
  void tell(const VoxelizedScene& scene, const std::string& list, const std::string& made);
  void write_report(const VoxelizedScene& scene);

 public:
  const BuildOptions& options;
  Report report{"bplod"};
  Progress progress;
  Backends backends;
  const BuildBudget budget;
  const ShelfFactory make_shelf;
  StageProgress show;  ///< progress of stages

 private:
  void gather(TriangleSource& source, const VoxelizedScene& scene);
  /// The scene, read again; nothing of a fit's if it has too many triangles or comes from a pipe.
  [[nodiscard]] std::vector<TriangleD> scene_triangles() const;
  std::uint64_t triangles_ = 0;  // of the scene
  Enclose enclosed_ = Enclose::input;
  std::unique_ptr<SceneColors> colors_;
};

[[nodiscard]] LevelRow row_of(const LodLevel& level, const std::string& file, std::uint64_t bytes);

}  // namespace bp
