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
#include "tools/cli/report.h"
#include "tools/place/place.h"

/// The command line of bplod.
namespace bp {

/// What the levels are for.
enum class LodProfile { gltf, tiles, collision, occluder, cage };
[[nodiscard]] const char* name_of(LodProfile profile);

/// What levels carry of the scene's looks, if it has any: nothing; colours on vertices; a texture of their own; a
/// texture, and how the scene answers to light; a texture if the scene has images, else colours.
enum class Appearance { off, color, texture, full, automatic };
[[nodiscard]] const char* name_of(Appearance appearance);

/// Across which axis a cage is its own mirror image: one of the three, none, or that of the scene if it has one.
enum class Symmetry { x, y, z, off, automatic };
[[nodiscard]] const char* name_of(Symmetry symmetry);

/// A file for each convex hull, in addition to those of the profile.
enum class HullFiles { none, obj, stl };
[[nodiscard]] const char* name_of(HullFiles files);

/// Least distance of a cage from the scene, percent of the scene's diagonal: coordinates bend sharply near a cage.
constexpr double kCageMargin = 0.5;

/// "A..B". Throws bad_argument.
[[nodiscard]] JobRange parse_job_range(const std::string& text);

struct BuildOptions {
  CommonOptions common;
  VoxelOptions voxels;
  ClosingOptions closing;
  std::string field;  ///< file of rules; empty: none
  LevelOptions levels;
  ProxyOptions proxy;
  std::string out, name;
  bool obj = false;  ///< levels as OBJ with materials; then they have the name that -o gave
  LodProfile profile = LodProfile::gltf;
  std::int32_t tile_vox = 512;                             ///< edge of a cell of a tileset
  Symmetry symmetry = Symmetry::automatic;                 ///< of a cage
  Length margin{kCageMargin, Length::Unit::percent};       ///< of a cage
  std::int64_t hulls = 0;                                  ///< of a collision mesh, at most; 0: as HullLimits::hulls
  std::int64_t hull_corners = std::int64_t(kMostCorners);  ///< of a hull, at most
  HullFiles hull_files = HullFiles::none;
  std::string cache;                                       ///< folder of results of earlier builds; empty: none
  TileCompression compression = TileCompression::meshopt;  ///< of a tileset's contents
  bool leaves = false;                                     ///< below the finest level are the scene's own triangles
  PlaceOptions place;                                      ///< of a tileset, on the globe
  std::optional<JobRange> tiles;  ///< the jobs to do, without a tileset; empty: all, and the tileset
  bool explain = false;           ///< print the plan; do nothing
  Appearance appearance = Appearance::automatic;

  [[nodiscard]] bool colors() const { return appearance != Appearance::off; }
  [[nodiscard]] bool full() const { return appearance == Appearance::full; }
  [[nodiscard]] bool may_have_textures() const { return appearance >= Appearance::texture; }
  [[nodiscard]] bool is_cage() const { return profile == LodProfile::cage; }
  [[nodiscard]] bool is_tileset() const { return profile == LodProfile::tiles; }
};

/// Throws bad_argument if options contradict each other.
[[nodiscard]] BuildOptions parse_build_options(Args& args);

/// All of them but folders and files, for the report: as they were given, null where nothing was.
[[nodiscard]] Json options_json(const BuildOptions& options);

}  // namespace bp
