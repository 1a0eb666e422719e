#pragma once
#include <string>

#include "lib/core/box.h"
#include "lib/grid/stream.h"

/// Returns a note if nobody told which axis is up and glTF is written, which has y up, and the scene seems to have z
/// up: it lies flat in x and y, as maps do, or begins near z = 0 and not near y = 0, or hangs below y = 0. Nothing
/// otherwise.
namespace bp {

[[nodiscard]] std::string up_note(const Bounds3d& scene, bool told);
/// For a stream: bpvox writes into its provenance whether the axis was told.
[[nodiscard]] std::string up_note(const StreamHeader& header);
/// The key of the provenance that says so.
constexpr const char* kUpTold = "up-told";

}  // namespace bp
