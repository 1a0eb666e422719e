#pragma once
#include "lib/grid/stream.h"

/// The limits of a stream's numbers (docs/brick-stream.md, sections 4 and 10). Readers and writers call these
/// functions, so that a pass may rely on every header that it gets.
namespace bp {

/// Returns what is out of range in a header, as a fact about it; null if all is well. The numbers of the scale field
/// are checked, but not against the memory of the passes.
[[nodiscard]] const char* header_fault(const StreamHeader& header);

/// Returns the same for a grid alone: bricks beyond kBrickReach, or more than kBrickReach of them a side.
[[nodiscard]] const char* brick_box_fault(const BrickBox& bricks);

}  // namespace bp
