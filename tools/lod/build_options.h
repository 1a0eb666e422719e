#pragma once
#include <optional>
#include <string>

#include "io/mesh/lod_writer.h"
#include "lib/hulls/convex_parts.h"
#include "lib/levels/tiles/tile_plan.h"
#include "tools/cli/common_options.h"
#include "tools/cli/options/closing.h"
#include "tools/cli/options/levels.h"
#include "tools/cli/options/mesh.h"
#include "tools/cli/options/voxel.h"
#include "tools/place/place.h"

/// The options of bplod.
namespace bp {

/// The purpose of the levels.
enum class LodProfile { gltf, tiles, collision, occluder, cage };
[[nodiscard]] const char* name_of(LodProfile profile);

/// The looks of the scene that levels carry, if it has any: nothing; colours on vertices; a texture of their own; a
/// texture and the material's answer to light; a texture if the scene has images, else colours.
enum class Appearance { off, color, texture, full, automatic };
[[nodiscard]] const char* name_of(Appearance appearance);

/// The axis across which a cage is its own mirror image: one of the three, none, or the scene's if it has one.
enum class Symmetry { x, y, z, off, automatic };
[[nodiscard]] const char* name_of(Symmetry symmetry);

/// The format of a file for each convex hull, in addition to the profile's files.
enum class HullFiles { none, obj, stl };
[[nodiscard]] const char* name_of(HullFiles files);

/// Least distance of a cage from the scene, percent of the scene's diagonal: coordinates bend sharply near a cage.
constexpr double kCageMargin = 0.5;

struct BuildOptions {
  CommonOptions common;
  VoxelOptions voxels;
  ClosingOptions closing;
  std::string field;  ///< file of rules; empty: none
  LevelOptions levels;
  ProxyOptions proxy;
  std::string out, name;
  bool obj = false;  ///< levels are OBJ files with materials; `name` is then the name given by -o
  LodProfile profile = LodProfile::gltf;
  std::int32_t tile_vox = 512;              ///< edge of a tileset's cell, in voxels
  Symmetry symmetry = Symmetry::automatic;  ///< of a cage
  /// Height of a body to which an occluder leaves rooms open; 0: it follows from the rooms; empty: rooms are filled.
  std::optional<Length> rooms;
  double min_hidden = 0;  ///< share of the scene's bounds that an occluder holds, or it fails
  Length margin{kCageMargin, Length::Unit::percent};       ///< of a cage
  std::int64_t hulls = 0;                                  ///< most hulls of a collision mesh; 0: as HullLimits::hulls
  std::int64_t hull_corners = std::int64_t(kMostCorners);  ///< most corners of a hull
  HullFiles hull_files = HullFiles::none;
  std::string cache;  ///< folder with the results of earlier runs; empty: none
  std::optional<Compression> asked_compression;
  /// Below the finest level are tiles with the scene's own triangles.
  bool leaves = false;
  PlaceOptions place;             ///< where on the globe a tileset stands
  std::optional<JobRange> tiles;  ///< the jobs to do without writing a tileset; empty: all jobs, and the tileset
  bool explain = false;           ///< print the plan only
  std::string inputs;             ///< file for the names of what was read; empty: none
  Appearance appearance = Appearance::automatic;

  /// Returns how GLB files are stored: if nothing was asked for, tiles are small, and every program reads levels.
  [[nodiscard]] Compression compression() const {
    return asked_compression.value_or(is_tileset() ? Compression::meshopt : Compression::none);
  }
  [[nodiscard]] bool colors() const { return appearance != Appearance::off; }
  [[nodiscard]] bool full() const { return appearance == Appearance::full; }
  [[nodiscard]] bool may_have_textures() const { return appearance >= Appearance::texture; }
  [[nodiscard]] const char* mode_name() const;  ///< the word of --mode
  [[nodiscard]] bool is_cage() const { return profile == LodProfile::cage; }
  [[nodiscard]] bool is_tileset() const { return profile == LodProfile::tiles; }
  /// Returns whether the tiles are the scene's own triangles: nothing is voxelized, closed or enclosed.
  [[nodiscard]] bool shows_scene() const { return is_tileset() && proxy.visual; }
};

}  // namespace bp
