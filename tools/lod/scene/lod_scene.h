#pragma once
#include <functional>
#include <memory>
#include <optional>

#include "io/scene/texture_table.h"
#include "lib/grid/mirror_plane.h"
#include "lib/pass/bake/scene_looks.h"
#include "lib/pass/color/scene_colors.h"
#include "tools/lod/build.h"

/// How the options of bplod become a scene that levels are made from.
namespace bp {

/// The share of the memory for work that is left beside the looks of a scene, where they are held while levels are
/// made.
constexpr double kBesideLooks = 0.5;

/// A scene as it was read: its voxels, and what levels need of it besides.
struct LodScene {
  VoxelizedScene voxels;
  SceneSize size;
  Enclose enclosed = Enclose::input;       ///< what stays inside bounding levels
  std::optional<ScalePlan> field;          ///< of --field
  std::unique_ptr<SceneColors> colors;     ///< null: the scene has none, or none are wanted
  std::shared_ptr<TextureTable> textures;  ///< null: none are wanted
  bool textured = false;  ///< levels get textures: they are wanted, the scene has looks, and it can be read again
  bool colored = false;   ///< the scene has colours besides its images

  /// Images of the levels show more than grey.
  [[nodiscard]] bool has_colors() const { return colored || (textures && textures->has_images()); }
  [[nodiscard]] ToldScene told(double margin_world = 0) const {
    ToldScene told{voxels.counts, voxels.header.frame.voxel, {}, margin_world};
    if (colors) told.color_cells = colors->cells();
    return told;
  }
};

struct ReadOptions {
  std::int32_t cell_vox = 0;       ///< as in VoxelizeOptions
  ResultStore* results = nullptr;  ///< as in PassContext
  bool ground = false;  ///< the scene stands on the ground (tools/run/grounded_source.h); it was read without before
  bool tells_time = false;  ///< says how long the work will take: it is known how much of it is to be done
};
/// Reads and voxelizes the scene of the options. Notes tell of the scene, but for one that is read again for the
/// ground.
[[nodiscard]] LodScene read_scene(Build& build, const ReadOptions& read);

/// The room of a cage around its scene.
struct CageRoom {
  double margin_world = 0, voxel = 0;
  std::optional<MirrorPlane> plane;  ///< the voxels are their own mirror image about it
};
/// Grows the voxels of a scene by the margin of a cage, after they were made symmetric where that is wanted.
[[nodiscard]] CageRoom make_room(Build& build, LodScene& scene);

/// The levels in one mesh as a part of a whole tileset.
struct TilesetSteps {
  double share = 1;     ///< of the memory for work
  std::size_t cut = 0;  ///< levels before them that are cut
  /// Returns a limit on memory at which all steps of the tileset fit, for these options. A refusal asks it.
  std::function<std::uint64_t(const LodOptions&)> limit;
};

/// For LodChain. Reads the scene once more where levels lie around its triangles, or follow them.
[[nodiscard]] LodOptions lod_options(const Build& build, const LodScene& scene, const CageRoom& room = {},
                                     const TilesetSteps& tileset = {});

}  // namespace bp
