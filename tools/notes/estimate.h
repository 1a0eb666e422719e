#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "lib/grid/scale_field.h"
#include "lib/grid/stream.h"
#include "lib/pass/voxelize/voxelize_pass.h"
#include "tools/cli/progress.h"
#include "tools/cli/report.h"

/// What a run will take, before the work: a number with a zero too many is noticed at once, not after an hour. The
/// figures are rough, within a factor of 3 for most scenes: they follow from the bounds of the scene, and are less
/// where its triangles cannot touch so many voxels.
namespace bp {

constexpr double kAnyNumber = 1e300;

struct Estimate {
  std::int64_t grid[3] = {};  ///< voxels along each side
  double core_seconds = 0;    ///< of all cores together
  double serial_seconds = 0;  ///< the part that one core does alone
  double bytes = 0;           ///< of memory, without a limit

  /// One after the other: times add up, memory does not.
  void then(const Estimate& next);
};

/// Voxels that the triangles of a scene touch, at most about: many triangles may share one.
[[nodiscard]] double most_touched_voxels(const VoxelizeCounts& counts, double voxel);
/// touched: at most so many voxels.
[[nodiscard]] Estimate estimate_voxelize(const Bounds3d& scene, double voxel, double touched = kAnyNumber);
[[nodiscard]] Estimate estimate_close(const StreamHeader& header, const ScaleField& field);
/// effort: of what is beside --faces: 1 for it alone. touched: as above.
[[nodiscard]] Estimate estimate_mesh(const Bounds3d& scene, double voxel, double effort = 1,
                                     double touched = kAnyNumber);
/// All of bplod: `levels` on the same voxels, or `tiles`, where each next level has voxels twice as large. effort: as
/// of estimate_mesh().
[[nodiscard]] Estimate estimate_levels(const Bounds3d& scene, const VoxelizeCounts& counts, double voxel,
                                       std::size_t levels, bool tiles, double effort = 1);
constexpr double kErrorEffort = 5;         ///< --error: each new face is measured
constexpr double kSceneEffort = 4;         ///< --enclose SCENE: the scene's own triangles stay inside
constexpr double kTilesOfSceneEffort = 2;  ///< tilesets, the same

/// Of a run with these devices (names_of(backends)): a GPU takes over work.
[[nodiscard]] double wall_seconds(const Estimate& estimate, const std::vector<std::string>& backends);
/// "about 4 min on 2 threads, with 550 MiB of memory", or "10 s or less ...". memory: --memory: what does not fit is
/// spilled.
[[nodiscard]] std::string work_text(const Estimate& estimate, std::uint64_t memory,
                                    const std::vector<std::string>& backends);
/// The note for the user, if it takes more than ten seconds; else empty: "a grid of 2048 x 900 x 700 voxels: about 4
/// min on 2 threads, with 550 MiB of memory".
[[nodiscard]] std::string estimate_note(const Estimate& estimate, std::uint64_t memory,
                                        const std::vector<std::string>& backends = {});
/// Says it, on a line of its own.
void note_estimate(const Estimate& estimate, const CommonOptions& common, Progress& progress, Report& report,
                   const std::vector<std::string>& backends = {});

}  // namespace bp
