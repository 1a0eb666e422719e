#pragma once
#include "lib/grid/stream.h"

/// The limits of a stream's numbers (docs/brick-stream.md, sections 4 and 10). Readers and writers ask here, so that a
/// pass may rely on every header that it gets.
namespace bp {

/// What is out of range in a header, as a fact about it; null if all is well. The scale field is checked as far as its
/// numbers go, not against the memory of the passes.
[[nodiscard]] const char* header_fault(const StreamHeader& header);

/// The same of a grid alone: bricks beyond kBrickReach, or more of them a side.
[[nodiscard]] const char* brick_box_fault(const BrickBox& bricks);

}  // namespace bp
