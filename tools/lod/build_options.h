#pragma once
#include <optional>
#include <string>
#include <vector>

#include "lib/levels/tile_plan.h"
#include "lib/levels/voxel_choice.h"
#include "tools/cli/common_options.h"
#include "tools/cli/length.h"
#include "tools/cli/report.h"
#include "tools/lod/level_options.h"
#include "tools/run/origin.h"
#include "tools/run/provenance.h"

/// The command line of bplod.
namespace bp {

enum class LodProfile { gltf, tiles, collision, occluder };
[[nodiscard]] const char* name_of(LodProfile profile);

/// "A..B". Throws bad_argument.
[[nodiscard]] JobRange parse_job_range(const std::string& text);

struct BuildOptions {
  CommonOptions common;
  std::vector<std::string> scenes;
  std::string out, name, format;
  LodProfile profile = LodProfile::gltf;
  MeshMode mode = MeshMode::bounding;
  LevelOptions request;
  std::optional<Length> voxel;
  std::optional<std::int64_t> resolution;
  std::int32_t tile_vox = 512;  ///< edge of a cell of a tileset
  std::int64_t hulls = 0;       ///< of a collision mesh, at most; 0: kMostHulls, or as many as parts
  std::string cache;            ///< folder of results of earlier builds; empty: none
  bool resume = false;
  std::optional<JobRange> tiles;  ///< the jobs to do, without a tileset; empty: all, and the tileset
  bool explain = false;           ///< print the plan; do nothing
  FillMode fill = FillMode::flood;
  std::optional<UpAxis> up;  ///< empty: what the scene tells, else y
  StructuringElement element = StructuringElement::cube;
  std::optional<Enclose> enclose;  ///< what stays inside bounding levels; empty: enclosed_by() chooses
  bool loose = false;              ///< --no-tighten
  bool colors = true;              ///< carry the scene's, if it has any
  OriginOption origin;
};

/// Throws bad_argument if options contradict each other.
[[nodiscard]] BuildOptions parse_build_options(Args& args);

/// All of them but folders and files, for the report: as they were given, null where nothing was.
[[nodiscard]] Json options_json(const BuildOptions& options);

/// Edge of a voxel, scene units: chosen_voxel() of these options.
[[nodiscard]] double voxel_size(const BuildOptions& options, const SceneSize& scene);
[[nodiscard]] VoxelRequest voxel_request(const BuildOptions& options, double diagonal);

/// Whether the scene alone decides the voxels of a tileset: no voxels, error or faces are given.
[[nodiscard]] bool is_by_scene(const BuildOptions& options);

/// The levels for a scene of so many triangles: with_defaults() of the profile. Levels of a tileset follow from its
/// voxels instead. `voxel`: of the scene; --scale may be in voxels.
[[nodiscard]] LevelRequest request_for(const BuildOptions& options, std::uint64_t triangles, double diagonal,
                                       double voxel = 1);

/// Whether the scene is of files, which can be read any number of times.
[[nodiscard]] bool can_read_again(const BuildOptions& options);
/// Whether smaller voxels may be tried where the finest level does not come to its faces: nobody said which, the
/// scene can be read again, and no cells depend on them.
[[nodiscard]] bool may_refine(const BuildOptions& options);

/// What stays inside the levels of a scene of so many triangles: as asked; else the triangles, where levels are one
/// mesh each, the scene can be read again, and it has no more than kMostEnclosedTriangles; else its voxels. Memory has
/// no say.
[[nodiscard]] Enclose enclosed_by(const BuildOptions& options, std::uint64_t triangles);

/// Whether levels are one mesh each, and something has to stay inside while they are tightened.
[[nodiscard]] bool may_enclose_scene(const BuildOptions& options);

/// Of a level, for its provenance. `enclosed`: of enclosed_by().
[[nodiscard]] OptionText option_text(const BuildOptions& options, Enclose enclosed, const LodTarget& target,
                                     std::size_t level, double scale_world, const GridFrame& frame);

}  // namespace bp
