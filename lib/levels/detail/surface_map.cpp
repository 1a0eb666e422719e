#include <algorithm>
#include <cmath>

#include "lib/core/vec3.h"
#include "lib/levels/tiles/tile_plan.h"

namespace bp {

namespace {

constexpr std::size_t kTriangles = 64, kMostRuns = std::size_t(1) << 16;
constexpr std::uint64_t kMostCells = 4096;  // that one run may meet; a larger run is spread evenly over all cells
// Part of the surface that remains from level to level, since details vanish; measured on a plant.
constexpr double kLeft = 0.8;

void merge(SurfaceRun& run, const SurfaceRun& other) {
  run.bounds.merge(other.bounds);
  run.area += other.area;
  run.extent += other.extent;
}

/// The box of a run, in units of cells, and the cells that it meets.
struct Part {
  Vec3d lo{}, hi{};
  CellSpan span;
};

Part part_of(const SurfaceRun& run, const CutLevel& level, Cells cells) {
  Part part{level.frame.to_voxels(run.bounds.min), level.frame.to_voxels(run.bounds.max), level.cells};
  for (int i = 0; i < 3; ++i) {
    const auto k = std::size_t(i);
    part.lo[k] /= cells.edge_vox, part.hi[k] /= cells.edge_vox;
    const auto cell = [&](double p) {
      return std::clamp(std::int32_t(std::floor(p)), level.cells.first[i], level.cells.last[i]);
    };
    part.span.first[i] = cell(part.lo[k]);
    part.span.last[i] = cell(part.hi[k]);
  }
  return part;
}

/// Returns the part of an interval that lies in a cell; 1 for an interval that is a point.
double share(double lo, double hi, std::int32_t cell) {
  if (hi <= lo) return 1;
  return std::max(0.0, (std::min(hi, cell + 1.0) - std::max(lo, double(cell))) / (hi - lo));
}

/// Returns about how many faces of voxels a run's surface takes. Level 0 is the finest.
double faces_of(const SurfaceRun& run, double voxel, std::size_t level) {
  return run.area / (voxel * voxel) * std::pow(kLeft, level);
}

/// Adds a run's faces to its cells. Returns the faces if the run is too large for that, else 0.
double spread(const SurfaceRun& run, double faces, const CutLevel& level, Cells cells, std::vector<double>& work) {
  const Part part = part_of(run, level, cells);
  if (part.span.count() > kMostCells) return faces;
  CellCoord c;
  for (c.x = part.span.first.x; c.x <= part.span.last.x; ++c.x) {
    for (c.y = part.span.first.y; c.y <= part.span.last.y; ++c.y) {
      for (c.z = part.span.first.z; c.z <= part.span.last.z; ++c.z)
        work[level.number_of(c)] += faces * share(part.lo[0], part.hi[0], c.x) * share(part.lo[1], part.hi[1], c.y) *
                                    share(part.lo[2], part.hi[2], c.z);
    }
  }
  return 0;
}

}  // namespace

std::vector<SurfaceRun> surface_runs(std::span<const TriangleD> triangles) {
  std::vector<SurfaceRun> runs((triangles.size() + kTriangles - 1) / kTriangles);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const TriangleD& t = triangles[i];
    SurfaceRun one;
    for (const Vec3d& p : t) one.bounds.add(p);
    for (std::size_t k = 0; k < 3; ++k) one.extent += one.bounds.max[k] - one.bounds.min[k];
    one.area = length(cross(t[1] - t[0], t[2] - t[0])) / 2;
    merge(runs[i / kTriangles], one);
  }
  return runs;
}

void SurfaceMap::add(std::span<const SurfaceRun> runs) {
  for (const SurfaceRun& run : runs) {
    merge(all_, run);
    if (runs_.empty() || last_ == grain_) {
      if (runs_.size() == kMostRuns) {
        for (std::size_t i = 0; i < kMostRuns / 2; ++i) {
          runs_[i] = runs_[2 * i];
          merge(runs_[i], runs_[2 * i + 1]);
        }
        runs_.resize(kMostRuns / 2);
        grain_ *= 2;
      }
      runs_.emplace_back();
      last_ = 0;
    }
    merge(runs_.back(), run);
    ++last_;
  }
}

std::vector<double> SurfaceMap::work(const TilesetPlan& plan, Cells cells) const {
  std::vector<double> work(plan.jobs());
  for (std::size_t i = 0; i < plan.cut.size(); ++i) {
    const CutLevel& level = plan.cut[i];
    double everywhere = 0;
    for (const SurfaceRun& run : runs_)
      everywhere += spread(run, faces_of(run, level.frame.voxel, i), level, cells, work);
    const std::uint64_t count = level.cells.count();
    for (std::uint64_t n = 0; n < count; ++n) work[level.number + n] += everywhere / double(count);
  }
  if (plan.whole > 0) work.back() += faces_of(all_, plan.uncut.frame.voxel, plan.cut.size());
  return work;
}

}  // namespace bp
