#include "lib/levels/tiles/level_tiles.h"

#include <algorithm>
#include <mutex>
#include <numeric>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/enclosed/enclosed_triangles.h"
#include "lib/levels/detail/tile_maker.h"
#include "lib/store/packing.h"
#include "lib/volume/boundary_runs.h"

namespace bp {

namespace {

// Memory of a tile at work: the surface while it is simplified, what it encloses, distances.
constexpr std::uint64_t kBytesPerDenseFace = 320, kBytesPerTile = std::uint64_t(4) << 20;
constexpr std::uint64_t kBytesPerTriangle = 2 * sizeof(TriangleD) + EnclosedTriangles::kBytesEach;

/// Returns the bytes that the store keeps of a tile.
std::string packed(const LevelTile& tile) {
  std::string bytes;
  pack(bytes, tile.measures);
  return bytes + tile.content;
}

bool unpack_tile(std::string_view bytes, LevelTile& tile) {
  if (!unpack(bytes, tile.measures)) return false;
  tile.content = bytes;
  return true;
}

/// Returns the bytes of four copies of a tile's voxels, as leave_out_fringes() needs them.
std::uint64_t voxel_bytes(const Cells& cells) {
  const auto edge = std::uint64_t(cells.edge_vox);
  constexpr std::uint64_t brick = kBrickEdge;
  return 4 * (edge + 2 * brick) * (edge + 2) * (edge + 2) / 8 + kBytesPerTile;
}

/// A cell that holds voxels of the closing.
struct Job {
  CellCoord cell{};
  std::uint64_t dense_faces = 0;  // an estimate: the closing's faces in the cell, without walls
};

/// Returns the cells that hold bricks of the closing, with an estimate of the work in each.
std::vector<Job> jobs_of(const TileLevel& level, const std::function<bool(CellCoord)>& wanted) {
  std::vector<BrickCoord> bricks = level.closing.coords();
  if (wanted) std::erase_if(bricks, [&](BrickCoord c) { return !wanted(level.cells.of(first_voxel(c))); });
  std::vector<std::pair<CellCoord, std::uint64_t>> parts(bricks.size());
  parallel_for(std::int64_t(bricks.size()), [&](std::int64_t i) {
    const BrickCoord brick = bricks[std::size_t(i)];
    parts[std::size_t(i)] = {level.cells.of(first_voxel(brick)), 2 * boundary_faces(level.closing, brick)};
  });
  std::sort(parts.begin(), parts.end());
  std::vector<Job> jobs;
  for (const auto& [cell, faces] : parts) {
    if (jobs.empty() || jobs.back().cell != cell) jobs.push_back({cell, 0});
    jobs.back().dense_faces += faces;
  }
  return jobs;
}

/// Makes the tiles of several levels.
class TileMaking {
 public:
  TileMaking(std::span<const TileTask> tasks, const PassContext& context) : tasks_(tasks), context_(context) {
    for (const TileTask& task : tasks_) {
      check_memory(task.level.cells);
      for (const Job& job : jobs_of(task.level, task.params.wanted)) jobs_.push_back({&task, job, {}});
    }
  }

  void operator()(const std::function<void(double)>& left) {
    const double all = surface();
    take_kept();
    if (left && all > 0) left(surface() / all);
    std::stable_sort(jobs_.begin(), jobs_.end(),
                     [](const TileJob& a, const TileJob& b) { return a.job.dense_faces > b.job.dense_faces; });
    const int n = in_flight();
    of_each_.pieces = context_.pieces.split(std::uint64_t(n));
    std::size_t next = 0;
    run_jobs<std::size_t>(
        n,
        [&](std::size_t& i) {
          i = next++;
          return i < jobs_.size();
        },
        [&](const std::size_t& i) { make_beside(jobs_[i], n); });
    for (const TileJob* job : alone_) make(*job, context_);
  }

 private:
  struct TileJob {
    const TileTask* task;
    Job job;
    ResultKey key;  ///< if results are kept
  };

  void check_memory(const Cells& cells) const {
    const std::uint64_t bytes = voxel_bytes(cells);
    const MemoryShare& memory = context_.memory;
    if (bytes > memory.bytes)
      throw NeedsMemory(fmt::format("a tile of {} voxels", cells.edge_vox), bytes, memory.bytes,
                        memory.limit_with(bytes - memory.bytes), {Remedy::smaller_tiles});
  }

  /// Returns the dense faces of all jobs in the list.
  [[nodiscard]] double surface() const {
    return std::accumulate(jobs_.begin(), jobs_.end(), 0.0,
                           [](double sum, const TileJob& job) { return sum + double(job.job.dense_faces); });
  }

  /// Takes the jobs out of the list whose results are kept. The store keeps no bytes for a hidden tile.
  void take_kept() {
    total_ = jobs_.size();
    std::vector<char> kept(jobs_.size());
    parallel_for(std::int64_t(jobs_.size()), [&](std::int64_t i) {
      TileJob& job = jobs_[std::size_t(i)];
      if (context_.results == nullptr) return;
      job.key = TileMaker(*job.task, job.job.cell, context_).key();
      LevelTile tile;
      std::string bytes;
      tile.kept = context_.results->get(job.key, bytes) && (bytes.empty() || unpack_tile(bytes, tile));
      if (!tile.kept) return;
      kept[std::size_t(i)] = 1;
      finish(job, std::move(tile), !bytes.empty());
    });
    std::size_t left = 0;
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      if (kept[i] == 0) jobs_[left++] = jobs_[i];
    }
    jobs_.resize(left);
  }

  /// Returns how many tiles fit into the memory at the same time. The first job must be the largest.
  [[nodiscard]] int in_flight() const {
    if (jobs_.empty()) return 1;
    std::uint64_t largest = jobs_.front().job.dense_faces * kBytesPerDenseFace + kBytesPerTile, triangles = 0;
    for (const TileTask& task : tasks_) {
      largest = std::max(largest, voxel_bytes(task.level.cells));
      if (task.params.scene != nullptr) triangles = std::max(triangles, std::uint64_t(task.params.scene->size()));
    }
    largest += std::min(triangles, std::uint64_t(TileParams::kMostTriangles)) * kBytesPerTriangle;
    return int(std::clamp<std::uint64_t>(context_.memory.bytes / largest, 1, std::uint64_t(thread_count())));
  }

  /// A tile whose share does not suffice beside others is made after them, by itself.
  void make_beside(const TileJob& job, int at_once) {
    try {
      make(job, of_each_);
    } catch (const NeedsMemory&) {
      if (at_once == 1) throw;
      const std::lock_guard lock(mutex_);
      alone_.push_back(&job);
    }
  }

  void make(const TileJob& job, const PassContext& context) {
    const TileTask& task = *job.task;
    TileMaker maker(task, job.job.cell, context);
    LevelTile tile;
    if (!task.params.make) return finish(job, std::move(tile), true);  // it may be in a cavity
    const bool there = maker.begin();
    if (there) tile.content = task.encode(job.job.cell, maker.make(tile.measures));
    if (context_.results != nullptr) context_.results->put(job.key, there ? packed(tile) : "");
    finish(job, std::move(tile), there);
  }

  void finish(const TileJob& job, LevelTile&& tile, bool there) {
    tile.cell = job.job.cell;
    const std::lock_guard lock(mutex_);
    context_.report("meshing", "tiles", ++done_, total_);
    if (there) job.task->consume(std::move(tile));
  }

  const std::span<const TileTask> tasks_;
  const PassContext& context_;
  PassContext of_each_{context_};  // the context of one tile at work: less memory
  std::vector<TileJob> jobs_;
  std::vector<const TileJob*> alone_;  // refused beside others
  std::mutex mutex_;
  std::size_t done_ = 0, total_ = 0;
};

}  // namespace

std::uint64_t tiles_limit(const TileLevel& level, const TileParams& params, PassContext context, std::uint64_t held,
                          const std::function<std::uint64_t(CellCoord)>& triangles) {
  std::uint64_t most = context.memory.limit_for(voxel_bytes(level.cells) + held);
  context.pieces = context.pieces.without(held);
  const TileTask task{level, params, {}, {}};
  const std::uint64_t most_near = params.mode == MeshMode::fit ? UINT64_MAX : TileParams::kMostTriangles;
  for (const Job& job : jobs_of(level, params.wanted)) {
    TileMaker maker(task, job.cell, context);
    const std::uint64_t near = triangles ? triangles(job.cell) : 0;
    if (maker.begin()) most = std::max(most, maker.limit(std::min(near, most_near)));
  }
  return most;
}

void make_tiles(std::span<const TileTask> tasks, const PassContext& context, const std::function<void(double)>& left) {
  for (const TileTask& task : tasks) {
    const std::int32_t edge = task.level.cells.edge_vox;
    if (edge < kBrickEdge || edge % kBrickEdge != 0)
      fail(ErrorCode::bad_argument, "a cell of {} voxels a side: must be a multiple of 64", edge);
  }
  TileMaking(tasks, context)(left);
}

}  // namespace bp
