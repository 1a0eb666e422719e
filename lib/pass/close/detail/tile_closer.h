#pragma once
#include <atomic>
#include <chrono>
#include <mutex>

#include "lib/core/pool.h"
#include "lib/device/backend.h"
#include "lib/grid/stream.h"
#include "lib/volume/outside.h"

namespace bp {

/// Adds the time of its scope to a sum, in seconds.
class Stopwatch {
 public:
  explicit Stopwatch(std::atomic<double>& sum) : sum_(sum), start_(Clock::now()) {}
  ~Stopwatch() { sum_.fetch_add(std::chrono::duration<double>(Clock::now() - start_).count()); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  std::atomic<double>& sum_;
  Clock::time_point start_;
};

/// Returns the halo of a tile where `s` is the largest scale.
[[nodiscard]] Halo widest_halo(Scale s, const ClosingParams& params);

/// Closes the tiles of a grid one by one, and then fills the enclosed cavities over all tiles. close_stream() and
/// close_cells() bring the tiles. Thread-safe, except for the constructor and resolve().
class TileCloser {
 public:
  /// The voxels to close. `solid` holds the bricks of `header`.
  struct Input {
    const StreamHeader& header;
    const BrickShelf& solid;
    const ScaleField& scale;
    ClosingParams params;
  };
  /// Keeps references. The closing goes to `shelf`. At most `at_work` of the backends are used. Throws bad_argument if
  /// there is none.
  TileCloser(const Input& input, BrickShelf& shelf, Backends& backends, std::size_t at_work);
  /// From now on, tiles that are kept are labelled, so that fill() can be called.
  void flood(const VoxelBox& grid, std::int32_t tile_vox);

  [[nodiscard]] const Halo& widest() const { return widest_; }
  [[nodiscard]] Halo halo(const VoxelBox& tile) const;
  /// Returns true if solid bricks lie in the tile or its halo.
  [[nodiscard]] bool in_reach(const VoxelBox& tile, const Halo& halo) const;
  void close(const VoxelBox& tile, const Halo& halo, BitBox& closed);
  void keep(const VoxelBox& tile, const BitBox& closed);   ///< puts the tile onto the shelf, and labels it
  void label(const VoxelBox& tile, const BitBox& closed);  ///< labels a tile that is on the shelf already

  [[nodiscard]] bool floods() const { return flood_ != nullptr; }
  void resolve() { flood_->resolve(); }  ///< to be called when all tiles are kept
  [[nodiscard]] bool has_enclosed(const VoxelBox& tile) const { return flood_->has_enclosed(tile); }
  /// Fills the cavities of a tile on the shelf, and returns the number of filled voxels. `bits`: scratch. They go to
  /// `filled_too`, too, unless it is null.
  std::uint64_t fill(const VoxelBox& tile, BitBox& bits, BrickShelf* filled_too = nullptr);

  std::atomic<double> waiting{0}, closing{0}, labelling{0}, shelving{0}, filling{0};  ///< seconds, as CloseTimes

 private:
  [[nodiscard]] BrickFill fill_of(const VoxelBox& voxels) const;
  [[nodiscard]] ScaleLattice scales(const VoxelBox& tile, const Halo& halo) const;

  const Input input_;
  const Halo widest_;
  BrickShelf& shelf_;
  Pool<Backend*> backends_;
  std::unique_ptr<OutsideFlood> flood_;  // null: cavities stay
  std::mutex flood_mutex_;
};

}  // namespace bp
