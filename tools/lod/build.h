#pragma once
#include <memory>
#include <string>
#include <vector>

#include "io/scene/scene_reader.h"
#include "io/scene/texture_table.h"
#include "lib/levels/level_chain.h"
#include "lib/pass/bake/scene_looks.h"
#include "lib/pass/color/scene_colors.h"
#include "tools/lod/level_list.h"
#include "tools/lod/level_notes.h"
#include "tools/run/make_backend.h"
#include "tools/run/memory_shares.h"

/// What all profiles of bplod have in common: how the options become voxels and levels, the list and the report.
namespace bp {

/// Levels that lack nothing but to be written.
struct CompleteLevels {
  std::vector<LodLevel> levels;   ///< finest first
  std::vector<LevelFacts> facts;  ///< of each
  std::vector<LeftOut> left_out;
};

class Build {
 public:
  const BuildOptions& options;
  Report report{"bplod"};
  Progress progress;
  Backends backends;
  const BuildBudget budget;
  const ShelfFactory make_shelf;
  PassProgress show;       ///< progress of passes
  SceneParts scene_parts;  ///< of levels in one mesh, when they are made
  bool tells_time = true;  ///< before the work; false: it is not known how much of it was done before

  explicit Build(const BuildOptions& options);
  Build(const Build&) = delete;
  Build& operator=(const Build&) = delete;

  /// cell_vox, results: as in VoxelizeOptions.
  /// ground: as if it stood on the ground (tools/run/grounded_source.h); the scene was voxelized without before.
  [[nodiscard]] VoxelizedScene voxelize(std::int32_t cell_vox, ResultStore* results = nullptr, bool ground = false);
  /// Of a cage, after voxelize(): the voxels are their own mirror image where that is wanted, and hold the margin.
  void make_room(VoxelizedScene& scene);
  /// How scenes are read. `beside`: something else of them is in memory meanwhile.
  [[nodiscard]] SceneOptions scene_options(bool beside = false) const;
  /// For LodChain; after voxelize(), as all that follow.
  [[nodiscard]] LodOptions lod_options();
  /// Of all that follows voxelize(): budget.work, and what spills.
  [[nodiscard]] PassContext context(ResultStore* results = nullptr) const;
  /// What stays inside bounding levels; after voxelize().
  [[nodiscard]] Enclose enclosed() const { return enclosed_; }
  [[nodiscard]] double margin() const { return margin_; }  ///< scene units; after voxelize()
  /// Null if the scene has no colours, or if none are wanted.
  [[nodiscard]] SceneColors* colors() const { return colors_.get(); }
  /// Levels get textures: they are wanted, and the scene has looks for them and can be read again. After voxelize().
  [[nodiscard]] bool textured() const { return textured_; }
  /// Images of the levels show more than grey.
  [[nodiscard]] bool has_colors() const { return colored_ || (textures_ && textures_->has_images()); }
  [[nodiscard]] const std::shared_ptr<TextureTable>& textures() const { return textures_; }  ///< null: not wanted
  [[nodiscard]] const SceneSize& scene_size() const { return size_; }                        ///< after voxelize()
  /// From now on levels get their textures as they are made, and half of the memory for work is for the scene's looks.
  /// Does nothing if neither levels nor leaves need them.
  void hold_looks();
  [[nodiscard]] const SceneLooks* looks() const { return textured_ ? looks_.get() : nullptr; }  ///< null: not held
  [[nodiscard]] const SceneLooks* scene_looks() const { return looks_.get(); }  ///< also where only leaves need them
  [[nodiscard]] MemoryShare texture_memory() const;  ///< for each image that is baked meanwhile
  /// Makes the levels of a range; each is a stage of the report. They get colours, textures where looks are held, and
  /// provenance with the hash of the scene, `input_hash`.
  [[nodiscard]] CompleteLevels make_levels(LodChain& chain, const ChainRange& range, const std::string& input_hash);

  void note(const std::string& text);
  void note_levels(const std::vector<LevelFacts>& levels, std::size_t first, const std::vector<LeftOut>& left_out);

  /// Writes the report and prints the list; then, on stderr, where the files are, and what proves them.
  void finish(const VoxelizedScene& scene, const std::vector<LevelRow>& rows, std::uint64_t bytes_out);
  /// The same of a run of --tiles: `range` of `all` numbers.
  void finish_jobs(const VoxelizedScene& scene, const JobRange& range, std::uint64_t all,
                   const std::vector<FoundJobs>& found);

 private:
  void note_scene(const VoxelizedScene& scene, std::optional<UpAxis> up_told);
  [[nodiscard]] ScalePlan read_field(const VoxelizedScene& voxels, bool tell);
  void gather(TriangleSource& source, const VoxelizedScene& scene);
  /// After the scene has been read. `tell`: notes why there will be no textures.
  void choose_textures(const TriangleSource& source, bool tell);
  void complete(LodLevel& level, std::size_t number, const LodTarget& target, const std::string& input_hash);
  /// The scene, read again; nothing of a fit's if it has too many triangles or comes from a pipe.
  [[nodiscard]] std::vector<TriangleD> scene_triangles() const;
  /// The report, then the list; a failure says that what was `made` is there.
  void tell(const VoxelizedScene& scene, const std::string& list, const std::string& made);
  void write_report(const VoxelizedScene& scene);
  /// Says how long the work will take, unless the scene is voxelized `again`.
  void tell_time(const StreamHeader& header, const VoxelizeCounts& counts, bool again);
  SceneSize size_;
  bool scene_met_ = false;            // by voxelize(), which tells of it once
  std::optional<MirrorPlane> plane_;  // of a cage
  double voxel_ = 0, margin_ = 0;     // of the scene, scene units
  Enclose enclosed_ = Enclose::input;
  std::optional<ScalePlan> field_;  // of --field
  std::unique_ptr<SceneColors> colors_;
  std::shared_ptr<TextureTable> textures_;
  bool textured_ = false, colored_ = false;
  std::unique_ptr<SceneLooks> looks_;
};

struct MadeChain {
  VoxelizedScene scene;  ///< without its voxels
  CompleteLevels made;
};
/// All levels of a scene, in one mesh each.
[[nodiscard]] MadeChain make_chain(Build& build);

}  // namespace bp
