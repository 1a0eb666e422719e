#pragma once
#include <map>
#include <optional>
#include <span>

#include "lib/levels/tiles/tile_task.h"
#include "lib/pass/context.h"

/// Makes a level of detail in pieces: one proxy for each cell of the grid, as an independent job.
///
/// A tile is the proxy of the closing in its cell grown by one voxel, without the voxels that the closing has there for
/// other cells only. Walls close it where the cell ends. By section 2 of docs/bounding.md, the scene's part in the
/// closed cell lies in the open interior of the solid's voxels in the grown cell. So each tile strictly encloses its
/// part by itself. Neighbours overlap by two voxels, and no crack can open between them, even if a viewer draws them
/// from different levels. Tightening keeps inside, exactly, the closing, the solid or that part of the scene's
/// triangles. A job reads only the voxels and triangles around its cell and the parameters: the same input gives the
/// same bytes.
namespace bp {

/// A tile as the store of results keeps it.
struct KeptTile {
  TileMeasures measures;
  std::string content;  ///< its file
};

/// The jobs of several levels, the large ones first: one for each cell that holds voxels of the closing. Different jobs
/// may be worked on at the same time; none waits for another. A cell in a cavity that the closing fills has a job, but
/// no tile.
class TileJobs {
 public:
  /// Keeps references. Throws bad_argument if cells do not consist of bricks, and NeedsMemory if the voxels of a tile
  /// do not fit.
  TileJobs(std::span<const TileTask> tasks, const PassContext& context);
  [[nodiscard]] std::size_t count() const { return jobs_.size(); }
  [[nodiscard]] const TileTask& task(std::size_t job) const { return *jobs_[job].task; }
  [[nodiscard]] CellCoord cell(std::size_t job) const { return jobs_[job].cell; }

  /// Gets the result of a job from the store, if an earlier run kept it. `tile` is empty if the job has no tile.
  /// `inputs`: the hash of everything that decides the tile's file in addition to TileShape::encoding and its mesh.
  [[nodiscard]] bool get(std::size_t job, const ResultKey& inputs, std::optional<KeptTile>& tile);
  /// Puts the result into the store, if there is one. get() was called before.
  void put(std::size_t job, const std::optional<KeptTile>& tile) const;

  /// Returns the jobs that get() has not found.
  [[nodiscard]] std::vector<std::size_t> left() const;
  /// Returns which share of the dense surface of all jobs is that of the jobs left.
  [[nodiscard]] double share_left() const;
  /// Returns how many of the jobs left fit into the memory at the same time; at least 1. A tile at work takes 320 bytes
  /// for each triangle of its dense surface.
  [[nodiscard]] int at_once() const;
  /// Makes the mesh of a tile with the memory of `context`, and measures it. Returns nothing if the job has no tile.
  /// Throws NeedsMemory.
  [[nodiscard]] std::optional<LatticeMesh> make(std::size_t job, const PassContext& context,
                                                TileMeasures& measures) const;

 private:
  struct Job {
    const TileTask* task = nullptr;
    CellCoord cell{};
    std::uint64_t dense_faces = 0;  // an estimate: the closing's faces in the cell, without walls
    ResultKey key{};                // set by get(), if results are kept
    bool is_kept = false;
  };
  [[nodiscard]] double surface(bool with_kept) const;

  const PassContext& context_;
  std::vector<Job> jobs_;
};

/// Counts of triangles near the cells of a level.
struct CellCounts {
  std::map<CellCoord, std::uint64_t> of_cell{};
  std::uint64_t everywhere = 0;  ///< triangles that may be near any cell
  [[nodiscard]] std::uint64_t near(CellCoord cell) const {
    const auto found = of_cell.find(cell);
    return everywhere + (found != of_cell.end() ? found->second : 0);
  }
};
/// Returns the limit on memory at which each tile of a level can be made. 0: not known. The solid stands for the
/// closing of a level that is not closed yet. `held`: bytes that others keep of the memory of `context`. `triangles`:
/// of the scene near each cell, which its tile encloses or follows, while TileParams::scene is not there yet. Asked for
/// after a refusal; meshes the surface of the level, brick by brick.
[[nodiscard]] std::uint64_t tiles_limit(const TileLevel& level, const TileParams& params, PassContext context,
                                        std::uint64_t held, const CellCounts& triangles);

}  // namespace bp
