#pragma once
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "io/scene/scene_options.h"
#include "lib/grid/stream.h"
#include "lib/volume/leaks.h"
#include "tools/cli/common_options.h"
#include "tools/cli/options/voxel.h"
#include "tools/cli/report.h"

/// bpinfo --leaks: where the inside of a scene, or of a stream of voxels, is open.
namespace bp {

/// Voxels that are walls.
struct WallVoxels {
  StreamHeader header;
  std::unique_ptr<BrickShelf> bricks;
};

/// The shares of --memory while leaks are looked for: the bricks, and the search.
struct LeakMemory {
  std::uint64_t shelf;
  MemoryShare search;
  explicit LeakMemory(std::uint64_t memory);
};

/// Throws NeedsMemory, or the refusal of outputs that waits, if `memory` is too little for dense_voxels() and
/// leak_info() of voxels with this header: before these are made or read.
void require_leak_memory(const StreamHeader& header, const MemoryShare& memory);

/// Voxelizes a scene as bplod does for an occluder: 512 voxels along its longest side unless another size is asked for,
/// without what can be seen through, and without filling. Throws as voxelize_stream(), and as require_leak_memory().
[[nodiscard]] WallVoxels wall_voxels(VoxelOptions voxels, const CommonOptions& common);
/// Returns all voxels in one box.
[[nodiscard]] BitBox dense_voxels(const WallVoxels& walls);

struct PlacedLeak : Leak {
  /// The parts of the scene with a triangle that bounds the opening. Empty: the scene has no names, or cannot be read
  /// again.
  std::set<std::string> parts;
};

struct LeakInfo {
  GridFrame frame;
  std::vector<PlacedLeak> leaks;  ///< the largest rooms
  std::size_t left_out = 0;       ///< further leaks
  double left_out_volume = 0;     ///< of their rooms, scene units
  double closed_volume = 0;       ///< of rooms that the outside does not reach, scene units
  bool on_ground = false;
  bool is_filled = false;  ///< the stream has what its surface encloses as solid: closed rooms cannot be seen
};

/// Finds the leaks of the walls, without names of parts. Throws as find_leaks().
[[nodiscard]] LeakInfo leak_info(const StreamHeader& header, const BitBox& walls, const MemoryShare& memory);
/// Names the parts at each leak. Reads the scene of the header once more; a scene that cannot be read again, or has
/// no names, leaves them empty.
void name_parts(const StreamHeader& header, SceneOptions how, LeakInfo& info);

[[nodiscard]] std::string leak_text(const LeakInfo& info, const std::string& name);
[[nodiscard]] Json leak_json(const LeakInfo& info);

}  // namespace bp
