#pragma once
#include <cstdint>
#include <functional>
#include <string>

#include "io/deform/weight_file.h"
#include "io/scene/scene_reader.h"
#include "lib/device/backend.h"
#include "tools/cli/progress.h"

namespace bp {

/// Returns how many blocks of weights may be at work at the same time, each with its coordinates: as many as memory and
/// threads allow, at most two for each thread. `held`: bytes of the memory that are in use. Throws NeedsMemory if not
/// even one fits.
[[nodiscard]] int blocks_at_work(std::uint64_t memory_bytes, std::uint64_t held, const CageCoordinates& coordinates);

/// Returns the limit on memory at which one block fits.
[[nodiscard]] std::uint64_t limit_for_blocks(std::uint64_t held, const CageCoordinates& coordinates);

/// Gets a sentence on content of a cage's file that was not read.
using NoteOfCage = std::function<void(const std::string&)>;

/// Passes a sentence to `note` if content of the cage's file was not read. `path`: the cage's file.
void note_of_cage(const IndexedMesh& cage, const std::string& path, const NoteOfCage& note);

struct BindRequest {
  std::string scene, cage, weights;  ///< weights: the name of `out`
  CoordinateKind kind = CoordinateKind::mean_value;
  bool carry_outside = false;  ///< points outside follow the nearest face; else they are refused
  std::uint64_t memory_bytes = 0;
  SceneOptions scene_options;
  /// Returns the backends that compute coordinates, given about how many seconds one core would need. Their pinned
  /// memory is subtracted from memory_bytes.
  std::function<const Backends&(double core_seconds)> backends;
  NoteOfCage note;
};

/// Binds a scene: streams its vertices through the coordinates of the cage into `out`. Throws bad_input, with the
/// number of such points, if points lie outside and are not to be carried.
[[nodiscard]] WeightTotals bind_scene(const BindRequest& request, OutputFile& out, Progress& progress);

}  // namespace bp
