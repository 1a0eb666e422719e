#include "lib/levels/tiles/level_tiles.h"

#include <algorithm>

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

/// Returns the bytes of four copies of a tile's voxels, as leave_out_fringes() needs them.
std::uint64_t voxel_bytes(const Cells& cells) {
  const auto edge = std::uint64_t(cells.edge_vox);
  return 4 * (edge + 2 * kBrickEdge) * (edge + 2) * (edge + 2) / 8 + kBytesPerTile;
}

void check_cells(const Cells& cells, const MemoryShare& memory) {
  if (cells.edge_vox < kBrickEdge || cells.edge_vox % kBrickEdge != 0)
    fail(ErrorCode::bad_argument, "a cell of {} voxels a side: must be a multiple of 64", cells.edge_vox);
  const std::uint64_t bytes = voxel_bytes(cells);
  if (bytes > memory.bytes)
    throw NeedsMemory(fmt::format("a tile of {} voxels", cells.edge_vox), bytes, memory.bytes,
                      memory.limit_with(bytes - memory.bytes), {Remedy::smaller_tiles});
}

/// Returns the wanted cells that hold bricks of the closing, each with the closing's faces in it.
std::vector<std::pair<CellCoord, std::uint64_t>> cells_of(const TileLevel& level, const TileParams& params) {
  std::vector<BrickCoord> bricks = level.closing.coords();
  if (params.wanted)
    std::erase_if(bricks, [&](BrickCoord c) { return !params.wanted->holds(level.cells.of(first_voxel(c))); });
  std::vector<std::pair<CellCoord, std::uint64_t>> parts(bricks.size());
  parallel_for(std::int64_t(bricks.size()), [&](std::int64_t i) {
    const BrickCoord brick = bricks[std::size_t(i)];
    parts[std::size_t(i)] = {level.cells.of(first_voxel(brick)), 2 * boundary_faces(level.closing, brick)};
  });
  std::sort(parts.begin(), parts.end());
  std::vector<std::pair<CellCoord, std::uint64_t>> cells;
  for (const auto& [cell, faces] : parts) {
    if (cells.empty() || cells.back().first != cell) cells.emplace_back(cell, 0);
    cells.back().second += faces;
  }
  return cells;
}

}  // namespace

TileJobs::TileJobs(std::span<const TileTask> tasks, const PassContext& context) : context_(context) {
  for (const TileTask& task : tasks) {
    check_cells(task.level.cells, context.memory);
    for (const auto& [cell, faces] : cells_of(task.level, task.params)) jobs_.push_back({&task, cell, faces});
  }
  std::stable_sort(jobs_.begin(), jobs_.end(),
                   [](const Job& a, const Job& b) { return a.dense_faces > b.dense_faces; });
}

bool TileJobs::get(std::size_t number, const ResultKey& inputs, std::optional<KeptTile>& tile) {
  tile.reset();
  if (context_.results == nullptr) return false;
  Job& job = jobs_[number];
  job.key = TileMaker(*job.task, job.cell, context_).key(inputs);
  std::string bytes;
  if (!context_.results->get(job.key, bytes)) return false;
  if (!bytes.empty()) {  // else the job has no tile
    std::string_view left = bytes;
    if (!unpack(left, tile.emplace().measures)) return false;
    tile->content = left;
  }
  job.is_kept = true;
  return true;
}

void TileJobs::put(std::size_t job, const std::optional<KeptTile>& tile) const {
  if (context_.results == nullptr) return;
  std::string bytes;
  if (tile) {
    pack(bytes, tile->measures);
    bytes += tile->content;
  }
  context_.results->put(jobs_[job].key, bytes);
}

std::vector<std::size_t> TileJobs::left() const {
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < jobs_.size(); ++i) {
    if (!jobs_[i].is_kept) left.push_back(i);
  }
  return left;
}

double TileJobs::surface(bool with_kept) const {
  double sum = 0;
  for (const Job& job : jobs_) sum += with_kept || !job.is_kept ? double(job.dense_faces) : 0;
  return sum;
}

double TileJobs::share_left() const {
  return surface(false) / std::max(surface(true), 1.0);
}

int TileJobs::at_once() const {
  std::uint64_t largest = 0, triangles = 0;
  for (const std::size_t i : left()) {
    const TileTask& task = *jobs_[i].task;
    largest =
        std::max({largest, jobs_[i].dense_faces * kBytesPerDenseFace + kBytesPerTile, voxel_bytes(task.level.cells)});
    if (task.params.scene != nullptr) triangles = std::max(triangles, std::uint64_t(task.params.scene->size()));
  }
  largest += std::min(triangles, std::uint64_t(TileParams::kMostTriangles)) * kBytesPerTriangle;
  return int(std::clamp<std::uint64_t>(context_.memory.bytes / std::max<std::uint64_t>(largest, 1), 1,
                                       std::uint64_t(thread_count())));
}

std::optional<LatticeMesh> TileJobs::make(std::size_t job, const PassContext& context, TileMeasures& measures) const {
  TileMaker maker(*jobs_[job].task, jobs_[job].cell, context);
  if (!maker.begin()) return std::nullopt;
  return maker.make(measures);
}

std::uint64_t tiles_limit(const TileLevel& level, const TileParams& params, PassContext context, std::uint64_t held,
                          const CellCounts& triangles) {
  std::uint64_t most = context.memory.limit_for(voxel_bytes(level.cells) + held);
  context.pieces = context.pieces.without(held);
  const TileTask task{0, level, params};
  const std::uint64_t most_near = params.mode == MeshMode::fit ? UINT64_MAX : TileParams::kMostTriangles;
  for (const auto& [cell, faces] : cells_of(level, params)) {
    TileMaker maker(task, cell, context);
    if (maker.begin()) most = std::max(most, maker.limit(std::min(triangles.near(cell), most_near)));
  }
  return most;
}

}  // namespace bp
