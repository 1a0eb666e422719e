#pragma once
#include <cstdint>
#include <functional>
#include <string>

#include "io/deform/weight_file.h"
#include "io/scene/scene_reader.h"
#include "lib/device/backend.h"
#include "tools/cli/progress.h"

namespace bp {

/// Blocks of weights at work at the same time, each with coordinates at work: as many as memory and threads allow, at
/// most two for each thread. `held`: bytes of it that are in use. Throws NeedsMemory if not even one fits.
[[nodiscard]] int blocks_at_work(std::uint64_t memory_bytes, std::uint64_t held, const CageCoordinates& coordinates);

/// The limit on memory at which one fits.
[[nodiscard]] std::uint64_t limit_for_blocks(std::uint64_t held, const CageCoordinates& coordinates);

/// Gets a sentence on what the file of a cage says that was not read.
using NoteOfCage = std::function<void(const std::string&)>;

/// Passes on what a cage was read without, if anything. `path`: of its file.
void note_of_cage(const IndexedMesh& cage, const std::string& path, const NoteOfCage& note);

struct BindRequest {
  std::string scene, cage, weights;  ///< weights: the name of `out`
  CoordinateKind kind = CoordinateKind::mean_value;
  bool carry_outside = false;  ///< points outside follow the nearest face; else they are refused
  std::uint64_t memory_bytes = 0;
  SceneOptions scene_options;
  /// What computes coordinates. Gets the seconds that they would take on one core, about. Their pinned memory is taken
  /// off memory_bytes.
  std::function<const Backends&(double core_seconds)> backends;
  NoteOfCage note;
};

/// Binds a scene: streams its vertices through the coordinates of the cage into `out`. Throws bad_input if points lie
/// outside and are not to be carried, with their number.
[[nodiscard]] WeightTotals bind_scene(const BindRequest& request, OutputFile& out, Progress& progress);

}  // namespace bp
