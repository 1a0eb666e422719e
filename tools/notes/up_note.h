#pragma once
#include <string>

#include "lib/core/box.h"
#include "lib/grid/stream.h"

/// The note about a scene that lies flat in x and y, as maps do, or begins near z = 0 and not near y = 0, or hangs
/// below y = 0, if nobody told which axis is up and glTF is written, which has y up; else empty.
namespace bp {

[[nodiscard]] std::string up_note(const Bounds3d& scene, bool told);
/// Of a stream: bpvox leaves word in its provenance whether it was told.
[[nodiscard]] std::string up_note(const StreamHeader& header);
/// The option that says so.
constexpr const char* kUpTold = "up-told";

}  // namespace bp
