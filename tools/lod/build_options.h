#pragma once
#include <optional>
#include <string>
#include <vector>

#include "lib/levels/lod_stage.h"
#include "tools/cli/common_options.h"
#include "tools/cli/length.h"
#include "tools/cli/report.h"
#include "tools/lod/lod_targets.h"
#include "tools/run/origin.h"
#include "tools/run/provenance.h"

/// The command line of bplod.
namespace bp {

enum class LodProfile { gltf, tiles, collision, occluder };
[[nodiscard]] const char* name_of(LodProfile profile);

/// Jobs of a tileset by their numbers in the plan: [begin, end).
struct JobRange {
  std::uint64_t begin = 0, end = 0;
  /// Whether one of `count` numbers from `first` on lies in it.
  [[nodiscard]] bool meets(std::uint64_t first, std::uint64_t count) const {
    return first < end && begin < first + count && begin < end;
  }
};
/// "A..B". Throws bad_argument.
[[nodiscard]] JobRange parse_job_range(const std::string& text);

struct BuildOptions {
  CommonOptions common;
  std::vector<std::string> scenes;
  std::string out, name, format;
  LodProfile profile = LodProfile::gltf;
  MeshMode mode = MeshMode::bounding;
  LodRequest request;
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

/// What is known of a scene before a voxel is.
struct SceneSize {
  Bounds3d bounds;
  std::uint64_t triangles = 0;
};

/// Edge of a voxel, scene units: as asked; an eighth of the finest error; or so small that a surface as large as that
/// of the bounds has kDensePerFaceAsked triangles for each face of the finest level, and kLeastDenseFaces, halved so
/// often, within kDefaultResolution and kMostResolution. Of a tileset it is kDensePerFace for as many faces as the
/// scene has triangles, or kTilesetFaces if that is fewer, over the cube as large as the bounds, and the most
/// resolution is kMostTilesetResolution; with a budget for each tile it is kDefaultResolution.
[[nodiscard]] double voxel_size(const BuildOptions& options, const SceneSize& scene, int halvings = 0);

/// Whether the scene alone decides the voxels of a tileset: nobody named voxels, an error or faces.
[[nodiscard]] bool is_by_scene(const BuildOptions& options);

/// What is made of a scene of so many triangles: percentages and defaults as numbers, but of tilesets, whose levels
/// follow from their voxels.
[[nodiscard]] LodRequest request_for(const BuildOptions& options, std::uint64_t triangles);

/// Of the six sides of a box.
[[nodiscard]] double area_of(const Bounds3d& bounds);

/// Voxels along the longest side.
constexpr std::int64_t kDefaultResolution = 256, kMostResolution = 1024, kMostTilesetResolution = 4096;
constexpr std::int64_t kOccluderResolution = 512;  ///< a voxel or two of each wall are given away
constexpr std::uint64_t kTilesetFaces = 40000;     ///< that nobody asked for, over the bounds
/// Whether the scene is of files, which can be read any number of times.
[[nodiscard]] bool can_read_again(const BuildOptions& options);
/// Whether smaller voxels may be tried where the finest level does not come to its faces: nobody said which, the
/// scene can be read again, and no cells depend on them.
[[nodiscard]] bool may_refine(const BuildOptions& options);

/// What stays inside the levels of a scene of so many triangles: as asked; else the triangles, where levels are one
/// mesh each, the scene can be read again, and it has no more than kMostEnclosedTriangles; else its voxels. Memory has
/// no say.
[[nodiscard]] Enclose enclosed_by(const BuildOptions& options, std::uint64_t triangles);

/// What is said where nobody asked, and levels do not enclose the triangles of a scene although such levels could; else
/// empty.
[[nodiscard]] std::string enclose_note(const BuildOptions& options, std::uint64_t triangles);

/// Of a level, for its provenance. `enclosed`: of enclosed_by().
[[nodiscard]] OptionText option_text(const BuildOptions& options, Enclose enclosed, const LodTarget& target,
                                     std::size_t level, double scale_world, const GridFrame& frame);

}  // namespace bp
