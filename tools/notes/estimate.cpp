#include "tools/notes/estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/parallel.h"
#include "lib/levels/voxel_choice.h"
#include "tools/cli/length.h"

namespace bp {

namespace {

// Measured as user seconds and peak memory, at 256 to 2048 voxels: docs/performance.md, "The estimate of a long run".
constexpr double kNoteSeconds = 10;      ///< shorter runs say nothing: they were not measured
constexpr double kSurfacePerArea = 0.6;  ///< voxels that triangles touch, for each voxel face of the bounds' surface
constexpr double kFacesPerArea = 1;      ///< triangles of the dense surface, for each voxel face of the bounds' surface
constexpr double kMostFacesPerVoxel = 4;          ///< two triangles on either side of a sheet
constexpr double kSecondsPerSurfaceVoxel = 1e-7;  ///< bpvox: 0.6 to 1.1e-7
/// Bpclose, for each voxel of the grid and voxel of scale: 2 to 9e-11.
constexpr double kSecondsPerScaledVoxel = 4e-11;
constexpr double kSecondsPerFace = 1.3e-6;  ///< bpmesh, for each triangle of the dense surface: 1.1 to 3.7e-6
constexpr double kLodEffort = 2.5;          ///< time of a level of bplod, over bpmesh
constexpr double kTilesEffort = 6.5;        ///< time of a level of a tileset, over bpmesh: 2.5 to 17
constexpr double kTilesBytes = 150e6;       ///< tiles at work: 130e6 to 260e6
/// Cores that a GPU equals; bpclose as a whole is 2 to 5 times as fast as on 16 cores.
constexpr double kCoresPerGpu = 64;
constexpr double kSerialShare = 0.5;  ///< share of bpmesh's time in which one core works
/// The last three: bytes for each surface voxel, and for each triangle of the dense surface.
constexpr double kProgramBytes = 25e6, kVoxBytes = 10, kCloseBytes = 100, kMeshBytes = 32;

double area_in_voxels(const Bounds3d& b, double voxel) {
  return b.empty() ? 0 : area_of(b) / (voxel * voxel);
}

Estimate of_grid(const Bounds3d& scene, double voxel) {
  Estimate e;
  for (std::size_t i = 0; !scene.empty() && i < 3; ++i)
    e.grid[i] = std::int64_t(std::min(std::ceil((scene.max[i] - scene.min[i]) / voxel) + 1, 9e15));
  return e;
}

/// Returns "40 s", "7 min", "3 h", "12 days".
std::string duration_text(double seconds) {
  constexpr double kMinute = 60, kHour = 3600, kDay = 86400;
  if (seconds < 2 * kMinute) return fmt::format("{:.0f} s", seconds);
  if (seconds < 2 * kHour) return fmt::format("{:.0f} min", seconds / kMinute);
  if (seconds < 2 * kDay) return fmt::format("{:.0f} h", seconds / kHour);
  return fmt::format("{:.0f} days", seconds / kDay);
}

}  // namespace

void Estimate::then(const Estimate& next) {
  core_seconds += next.core_seconds;
  serial_seconds += next.serial_seconds;
  bytes = std::max(bytes, next.bytes);
}

// A plane touches up to 1.7 voxels for each voxel face of its area, a line up to one for each step along an axis.
double most_touched_voxels(const VoxelizeCounts& counts, double voxel) {
  return 2 * counts.area / voxel / voxel + 2 * counts.extent / voxel + 8 * double(counts.scene.triangles);
}

Estimate estimate_voxelize(const Bounds3d& scene, double voxel, double touched) {
  Estimate e = of_grid(scene, voxel);
  const double surface = std::min(kSurfacePerArea * area_in_voxels(scene, voxel), touched);
  e.core_seconds = kSecondsPerSurfaceVoxel * surface;
  e.bytes = kProgramBytes + kVoxBytes * surface;
  return e;
}

Estimate estimate_close(const StreamHeader& header, const ScaleField& field) {
  const GridFrame& frame = header.frame;
  Estimate e = of_grid(header.bounds, frame.voxel);
  const VoxelCoord size = voxels_of(header.bricks).size();
  e.core_seconds =
      kSecondsPerScaledVoxel * double(size.x) * size.y * size.z * field.upper_bound(frame) / double(kScaleOne);
  e.bytes = kProgramBytes + kCloseBytes * kSurfacePerArea * area_in_voxels(header.bounds, frame.voxel);
  return e;
}

Estimate estimate_mesh(const Bounds3d& scene, double voxel, double effort, double touched) {
  Estimate e = of_grid(scene, voxel);
  const double faces = std::min(kFacesPerArea * area_in_voxels(scene, voxel), kMostFacesPerVoxel * touched);
  e.core_seconds = effort * kSecondsPerFace * faces;
  e.serial_seconds = kSerialShare * e.core_seconds;
  e.bytes = kProgramBytes + kMeshBytes * faces;
  return e;
}

Estimate estimate_levels(const Bounds3d& scene, const VoxelizeCounts& counts, double voxel, std::size_t levels,
                         bool tiles, double effort) {
  Estimate all = estimate_voxelize(scene, voxel, most_touched_voxels(counts, voxel));
  for (std::size_t i = 0; i < levels; ++i) {
    const double edge = voxel * (tiles ? std::pow(2.0, i) : 1);
    all.then(
        estimate_mesh(scene, edge, effort * (tiles ? kTilesEffort : kLodEffort), most_touched_voxels(counts, edge)));
  }
  if (tiles) all.bytes += kTilesBytes;
  return all;
}

double wall_seconds(const Estimate& e, const std::vector<std::string>& backends) {
  const int threads = thread_count();
  const bool gpu = std::any_of(backends.begin(), backends.end(), [](const std::string& b) { return b != "cpu"; });
  const double cores = gpu ? std::max<double>(threads, kCoresPerGpu) : threads;
  return e.serial_seconds + (e.core_seconds - e.serial_seconds) / cores;
}

std::string work_text(const Estimate& e, std::uint64_t memory, const std::vector<std::string>& backends) {
  const int threads = thread_count();
  const double seconds = wall_seconds(e, backends), limit = double(memory);
  return fmt::format(
      "{} on {} thread{}, with {} of memory{}",
      seconds > kNoteSeconds ? "about " + duration_text(seconds) : fmt::format("{:.0f} s or less", kNoteSeconds),
      threads, threads == 1 ? "" : "s", size_text(std::uint64_t(std::min(e.bytes, limit))),
      e.bytes > limit ? "; what does not fit goes to files in --temp" : "");
}

std::string estimate_note(const Estimate& e, std::uint64_t memory, const std::vector<std::string>& backends) {
  if (!(wall_seconds(e, backends) > kNoteSeconds)) return "";
  return fmt::format("a grid of {} x {} x {} voxels: {}", e.grid[0], e.grid[1], e.grid[2],
                     work_text(e, memory, backends));
}

void note_estimate(const Estimate& estimate, const CommonOptions& common, Progress& progress, Report& report,
                   const std::vector<std::string>& backends) {
  const std::string text = estimate_note(estimate, common.memory_bytes, backends);
  if (text.empty()) return;
  progress.end();
  report.note(text, common);
}

}  // namespace bp
