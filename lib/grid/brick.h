#pragma once
#include <array>
#include <cstdint>

#include "lib/core/coords.h"

/// A brick: 64^3 voxels as bits (32 KiB), the unit of storage and of the stream.
namespace bp {

constexpr std::size_t kBrickWords = std::size_t(kBrickEdge) * kBrickEdge;  ///< one 64-bit word per row of voxels in x

/// Word z * 64 + y holds the row (0..63, y, z). Bit x of it is voxel (x, y, z).
using BrickBits = std::array<std::uint64_t, kBrickWords>;

/// The content of a brick, so that the common cases need no bits. An empty brick is not stored at all.
enum class BrickFill : std::uint8_t { empty = 0, full = 1, mixed = 2 };

/// The set of voxels that a brick belongs to. A stream carries one or both.
enum class Layer : std::uint8_t { solid = 0, closing = 1 };  ///< the input, filled; its closing

struct Brick {
  BrickCoord coord;
  Layer layer = Layer::solid;
  BrickFill fill = BrickFill::empty;
  BrickBits bits{};  ///< all ones if the brick is full; valid for each fill
};

/// Returns which of the three cases `bits` is.
[[nodiscard]] BrickFill classify(const BrickBits& bits);

}  // namespace bp
