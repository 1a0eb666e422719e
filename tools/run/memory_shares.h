#pragma once
#include <algorithm>
#include <cstdint>

#include "lib/core/memory_share.h"
#include "lib/core/parallel.h"

namespace bp {

/// The program's own share of --memory in tools that voxelize scenes or close streams, and in tools that make or check
/// meshes.
constexpr std::uint64_t kVoxelProgram = std::uint64_t(96) << 20, kMeshProgram = std::uint64_t(48) << 20;

[[nodiscard]] inline MemoryShare part_of(MemoryShare memory, double part) {
  memory.bytes = std::uint64_t(double(memory.bytes) * part);
  memory.share *= part;
  return memory;
}

/// Returns --memory without the memory that a device pins, which is at most half of it.
[[nodiscard]] inline std::uint64_t unpinned(std::uint64_t memory, std::uint64_t pinned) {
  return memory - std::min(pinned, memory / 2);
}

/// The part of --memory, in bytes, that is left without the program and the buffers of each thread.
struct UsableMemory {
  MemoryLimit limit;
  std::uint64_t bytes;
  /// `pinned`: the part of `memory` that GPUs pin.
  UsableMemory(std::uint64_t memory, std::uint64_t program, std::uint64_t pinned = 0)
      : limit{memory, program + std::uint64_t(thread_count()) * (8 << 20) + pinned},
        bytes(MemoryLimit{memory - pinned, limit.fixed_bytes - pinned}.rest_bytes()) {}
};

/// The shares of --memory while a scene is voxelized, bytes. The rest is for the program, and for the data that threads
/// and the writer have in hand.
struct VoxelizeBudget {
  std::uint64_t reader;   ///< vertices of an indexed file: neighbours in the file are neighbours in space
  std::uint64_t waiting;  ///< triangles and bricks, with those in the store and on the shelf
  std::uint64_t store, shelf;
  std::uint64_t tiles;  ///< tiles at work
  explicit VoxelizeBudget(std::uint64_t memory) : VoxelizeBudget(UsableMemory(memory, kVoxelProgram)) {}

 protected:
  explicit VoxelizeBudget(const UsableMemory& usable) {
    reader = usable.bytes / 10;
    waiting = usable.bytes / 10 * 7;
    store = waiting / 14;
    shelf = waiting / 14 * 6;
    tiles = usable.bytes / 10;
  }
};

/// The shares of --memory in bplod: VoxelizeBudget while it voxelizes. Then triangles and reader are gone, and all that
/// shelf and store leave is for tiles and surfaces at work and for measuring distances.
struct BuildBudget : VoxelizeBudget {
  static constexpr double kWorkShare = 0.5;
  MemoryShare work;
  BuildBudget(std::uint64_t memory, std::uint64_t pinned) : BuildBudget(UsableMemory(memory, kVoxelProgram, pinned)) {}

 private:
  explicit BuildBudget(const UsableMemory& usable) : VoxelizeBudget(usable) {
    work = {usable.bytes / 2, kWorkShare, usable.limit};
  }
};

/// The shares of --memory in bpmesh, bytes.
struct MeshBudget {
  std::uint64_t shelves;        ///< voxels
  std::uint64_t waiting, work;  ///< pieces of the surface that wait, and those at work
  std::uint64_t store;          ///< further pieces that wait, compressed
  static constexpr double kWaitingShare = 0.25, kWorkShare = 0.3;
  MemoryLimit limit;
  explicit MeshBudget(std::uint64_t memory) {
    const UsableMemory usable(memory, kMeshProgram);
    shelves = usable.bytes / 20 * 5;
    waiting = usable.bytes / 20 * 5;
    work = usable.bytes / 20 * 6;
    store = usable.bytes / 20;
    limit = usable.limit;
  }
};

}  // namespace bp
