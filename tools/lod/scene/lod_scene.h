#pragma once
#include <memory>
#include <optional>

#include "io/scene/texture_table.h"
#include "lib/grid/mirror_plane.h"
#include "lib/pass/bake/scene_looks.h"
#include "lib/pass/color/scene_colors.h"
#include "tools/lod/build.h"

/// Turns the options of bplod into a scene that levels are made from.
namespace bp {

/// The share of the memory for work that is left for levels if the looks of the scene are kept while levels are made.
constexpr double kBesideLooks = 0.5;

/// A scene that was read: its voxels, and everything else that levels need of it.
struct LodScene {
  VoxelizedScene voxels;
  SceneSize size;
  Enclose enclosed = Enclose::input;       ///< what bounding levels enclose
  std::optional<ScalePlan> field;          ///< the rules of --field
  std::unique_ptr<SceneColors> colors;     ///< null: the scene has no colours, or they are not wanted
  std::shared_ptr<TextureTable> textures;  ///< null: textures are not wanted
  bool textured = false;  ///< levels get textures: they are wanted, the scene has looks, and it can be read again
  bool colored = false;   ///< the scene has colours in addition to its images

  /// Returns whether the images of levels show more than grey.
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
  bool ground = false;  ///< the scene stands on the ground (tools/run/grounded_source.h); it was read before without
  bool tells_time = false;  ///< tells how long the work will take, since no part of it may have been done before
};
/// Returns how a scene of the options is voxelized, but for the size of its voxels.
[[nodiscard]] VoxelizeOptions voxelize_options(const Build& build, const ReadOptions& read);
/// Reads and voxelizes the scene of the options. Notes tell about the scene, unless it is read again for the ground.
[[nodiscard]] LodScene read_scene(Build& build, const ReadOptions& read);

/// Reads the bounds, the size and the materials of the scene, without voxels. Notes tell about the scene.
[[nodiscard]] LodScene measure_scene(Build& build);

/// The room that a cage leaves around its scene.
struct CageRoom {
  double margin_world = 0, voxel = 0;
  std::optional<MirrorPlane> plane;    ///< the mirror plane of the voxels
  std::shared_ptr<const Limbs> limbs;  ///< of the scene, without the margin
};
/// Makes the voxels symmetric if that is wanted, and grows them by the margin of a cage.
[[nodiscard]] CageRoom make_room(Build& build, LodScene& scene);

/// Returns the options of a LodChain, without the scene's triangles. `share`: part of the memory for work that its
/// levels have. `cut`: number of a tileset's levels before them, which are cut.
[[nodiscard]] LodOptions lod_options(const Build& build, const LodScene& scene, const CageRoom& room, double share = 1,
                                     std::size_t cut = 0);
/// Reads the scene once more, into the options, if levels enclose its triangles or follow them. Throws NeedsMemory.
void take_triangles(const Build& build, const LodScene& scene, LodOptions& options);
/// Returns a limit on memory at which the levels of such options fit. 0: not known.
[[nodiscard]] std::uint64_t levels_limit(const LodScene& scene, const LodOptions& options);
/// Returns the options with the triangles. A refusal names levels_limit().
[[nodiscard]] LodOptions complete_options(const Build& build, const LodScene& scene, const CageRoom& room);

}  // namespace bp
