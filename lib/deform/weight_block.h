#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "lib/deform/coordinates.h"

namespace bp {

/// Coordinates as whole numbers, as files keep them.
struct WeightBlock {
  static constexpr int kBits = 26;  ///< binary places of a weight, except for points whose weights are 32 or more

  std::size_t points = 0, columns = 0;  ///< columns_of()
  std::vector<std::uint8_t> bits;       ///< by point: its weights are units / 2^bits
  std::vector<std::int32_t> units;      ///< of column c and point i: [c * points + i]

  WeightBlock() = default;
  WeightBlock(std::size_t point_count, std::size_t column_count);
};

/// Rounds the rows of some points; the first is point `first` of the block. The units of each point add up to 2^bits
/// (for Green coordinates those of the vertices). So a cage that moves as a whole moves the points by as much, without
/// rounding. Each unit is off by less than 1, and so are sums of neighbouring columns. A point that is nowhere gets
/// zeros. Throws bad_argument if a weight is 2^30 or more, as for a point too far outside, or not finite.
void round_weights(const CoordinateRows& rows, std::size_t first, WeightBlock& out);

/// Fills `out` with the coordinates of points, and `places`; both have room for as many. Points outside get weights
/// only if they are to be carried. Throws as round_weights() does. It works on the caller's thread. `rows` is kept from
/// call to call.
void weigh_points(const CageCoordinates& coordinates, std::span<const Vec3d> points, bool carry_outside,
                  CoordinateRows& rows, WeightBlock& out, std::span<CoordinateRows::Place> places);

/// Does the same for some of the points, by their numbers. The others keep their weights.
void weigh_some(const CageCoordinates& coordinates, std::span<const Vec3d> points,
                std::span<const std::uint32_t> numbers, bool carry_outside, CoordinateRows& rows, WeightBlock& out,
                std::span<CoordinateRows::Place> places);

/// Sets out[i] to the sum over the columns of weight times moves[column]: the move of each point. `moves` are those of
/// CageCoordinates::moves_of_columns(). The result is exactly 0 where no vertex moves. The order of the sum is that of
/// the columns.
void add_moves(const WeightBlock& block, std::span<const Vec3d> moves, std::span<Vec3d> out);

}  // namespace bp
