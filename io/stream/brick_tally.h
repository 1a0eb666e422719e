#pragma once
#include "io/stream/brick_stream.h"

namespace bp {

/// Reads a source to its end, and returns the counts and the checksum that a file of its bricks would have; bytes are
/// 0. Cost: about 10 us for each brick.
[[nodiscard]] StreamTotals totals_of(BrickSource& source);

}  // namespace bp
