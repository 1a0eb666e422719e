#pragma once
#include <cstdint>

#include "lib/core/parallel.h"

namespace bp {

/// How --memory is shared out while a scene is voxelized, bytes. The rest is for the program, and for what the threads
/// and the writer have in hand.
struct VoxelizeBudget {
  std::uint64_t reader;   ///< vertices of an indexed file: neighbours in the file are neighbours in space
  std::uint64_t waiting;  ///< triangles and bricks, what store and shelf hold included
  std::uint64_t store, shelf;
  std::uint64_t tiles;  ///< at work
  explicit VoxelizeBudget(std::uint64_t memory) {
    const std::uint64_t fixed = (std::uint64_t(96) << 20) + std::uint64_t(thread_count()) * (8 << 20);
    const std::uint64_t usable = memory > 2 * fixed ? memory - fixed : memory / 2;
    reader = usable / 10;
    waiting = usable / 10 * 7;
    store = waiting / 14;
    shelf = waiting / 14 * 6;
    tiles = usable / 10;
  }
};

/// How bpmesh shares out --memory, bytes.
struct MeshBudget {
  std::uint64_t shelves;        ///< voxels
  std::uint64_t waiting, work;  ///< pieces of the surface, those in hand
  std::uint64_t store;          ///< further ones that wait, compressed
  explicit MeshBudget(std::uint64_t memory) {
    const std::uint64_t fixed = (std::uint64_t(48) << 20) + std::uint64_t(thread_count()) * (8 << 20);
    const std::uint64_t usable = memory > 2 * fixed ? memory - fixed : memory / 2;
    shelves = usable / 20 * 5;
    waiting = usable / 20 * 5;
    work = usable / 20 * 6;
    store = usable / 20;
  }
};

}  // namespace bp
