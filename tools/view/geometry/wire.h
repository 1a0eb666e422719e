#pragma once
#include <string>
#include <vector>

#include "lib/live/live_closing.h"

/// The closing as bytes for the page (page/src/wire.ts reads them). Numbers are little-endian and aligned to four
/// bytes.
namespace bp {

/// Returns the pieces of the closing's surface: generation (u32), number of pieces (u32); for each piece its brick (3
/// i32), vertices (u32), triangles (u32), vertices of 12 bytes, corners (u32).
[[nodiscard]] std::string surface_bytes(const std::vector<LiveClosing::Piece>& pieces, std::uint64_t generation);

}  // namespace bp
