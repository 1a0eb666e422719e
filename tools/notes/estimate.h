#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "lib/grid/scale_field.h"
#include "lib/grid/stream.h"
#include "lib/pass/voxelize/voxelize_pass.h"
#include "tools/cli/progress.h"
#include "tools/cli/report.h"

/// Estimates of a run, told before the work: a number with a zero too many is noticed at once, not after an hour. They
/// are rough, within a factor of 3 for most scenes, as they follow from the bounds of the scene. They are lower where
/// its triangles cannot touch so many voxels.
namespace bp {

constexpr double kAnyNumber = 1e300;

struct Estimate {
  std::int64_t grid[3] = {};  ///< voxels along each side
  double core_seconds = 0;    ///< sum over all cores
  double serial_seconds = 0;  ///< the part of the work that one core does alone
  double bytes = 0;           ///< memory without a limit

  /// Adds a run that follows this one: times add up, memory does not.
  void then(const Estimate& next);
};

/// Returns about how many voxels the triangles of a scene touch at most; several triangles may share a voxel.
[[nodiscard]] double most_touched_voxels(const VoxelizeCounts& counts, double voxel);
/// touched: upper bound on the touched voxels.
[[nodiscard]] Estimate estimate_voxelize(const Bounds3d& scene, double voxel, double touched = kAnyNumber);
[[nodiscard]] Estimate estimate_close(const StreamHeader& header, const ScaleField& field);
/// effort: factor for options in addition to --faces; 1 for --faces alone. touched: upper bound on the
/// touched voxels.
[[nodiscard]] Estimate estimate_mesh(const Bounds3d& scene, double voxel, double effort = 1,
                                     double touched = kAnyNumber);
/// Estimates all of bplod: `levels` on the same voxels, or `tiles`, where each next level has voxels twice as large.
/// effort: as in estimate_mesh().
[[nodiscard]] Estimate estimate_levels(const Bounds3d& scene, const VoxelizeCounts& counts, double voxel,
                                       std::size_t levels, bool tiles, double effort = 1);
constexpr double kErrorEffort = 5;         ///< --error: each new face is measured
constexpr double kSceneEffort = 4;         ///< --enclose SCENE: the scene's own triangles stay inside
constexpr double kTilesOfSceneEffort = 2;  ///< the same for tilesets
/// Bytes of each triangle of the scene that a level encloses (530 of a motorbike, 770 of a plant), or follows (900 to
/// 1,700).
constexpr double kBytesOfEnclosed = 600, kBytesOfFollowed = 1200;

/// Returns the time of a run with these devices (names_of(backends)): a GPU takes over work.
[[nodiscard]] double wall_seconds(const Estimate& estimate, const std::vector<std::string>& backends);
/// Returns "about 4 min on 2 threads, with 550 MiB of memory", or "10 s or less ...". memory: the limit of --memory,
/// beyond which data goes to disk.
[[nodiscard]] std::string work_text(const Estimate& estimate, std::uint64_t memory,
                                    const std::vector<std::string>& backends);
/// Returns the note for the user if the run takes more than ten seconds, else nothing: "a grid of 2048 x 900 x 700
/// voxels: about 4 min on 2 threads, with 550 MiB of memory".
[[nodiscard]] std::string estimate_note(const Estimate& estimate, std::uint64_t memory,
                                        const std::vector<std::string>& backends = {});
/// Prints the note on a line of its own, and adds it to the report.
void note_estimate(const Estimate& estimate, const CommonOptions& common, Progress& progress, Report& report,
                   const std::vector<std::string>& backends = {});

}  // namespace bp
