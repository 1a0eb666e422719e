#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "lib/grid/stream.h"

/// Shelves: bricks that wait, in memory while they fit, then compressed, then on disk.
namespace bp {

/// The memory and scratch that the shelves of one pool use now, and used at most.
struct ShelfUse {
  std::uint64_t memory_bytes = 0, peak_memory_bytes = 0;    ///< bricks and their index
  std::uint64_t scratch_bytes = 0, peak_scratch_bytes = 0;  ///< in the scratch file; its size is the peak
};

/// The memory and the scratch file that the shelves of a process share.
///   Mixed bricks stay as they are (32 KiB) while memory in use is below half of `memory_bytes`; then they are
///   compressed (about 20 to 1), first the newcomers, then, near the budget, those of the same shelf that lay raw; what
///   still does not fit goes to a scratch file in `temp_dir`, made when it is first needed. Its free space is reused.
///   Full and empty bricks have no bits to store. The index (about 80 bytes a brick, and 4 for each KiB of it in the
///   file) counts: a grid of N voxels a side has at most (N / 64)^3 bricks, so 160 MiB at 8192, 1.3 GiB at 16384. Where
///   it alone takes more than `memory_bytes` and 4 MiB, put() throws out_of_resource.
/// Thread-safe. put() takes about 15 us raw, 35 us compressed or spilled; get() 3 us and 20 us.
class ShelfPool {
 public:
  ShelfPool(std::uint64_t memory_bytes, std::string temp_dir);
  [[nodiscard]] std::unique_ptr<BrickShelf> make() const;  ///< an empty shelf; it keeps the pool's memory alive
  [[nodiscard]] ShelfFactory factory() const;
  [[nodiscard]] ShelfUse use() const;

  struct State;

 private:
  std::shared_ptr<State> state_;
};

/// Returns one shelf with a budget of its own.
[[nodiscard]] std::unique_ptr<BrickShelf> make_shelf(std::uint64_t memory_bytes, const std::string& temp_dir);

/// Returns a factory of shelves that share one budget.
[[nodiscard]] ShelfFactory make_shelf_factory(std::uint64_t memory_bytes, const std::string& temp_dir);

}  // namespace bp
