#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "lib/deform/coordinates.h"

namespace bp {

/// Coordinates as whole numbers: what is kept of them.
struct WeightBlock {
  static constexpr int kBits = 26;  ///< binary places of a weight, but for points whose weights are 32 or more

  std::size_t points = 0, columns = 0;  ///< columns_of()
  std::vector<std::uint8_t> bits;       ///< by point: its weights are units / 2^bits
  std::vector<std::int32_t> units;      ///< of column c and point i: [c * points + i]

  WeightBlock() = default;
  WeightBlock(std::size_t point_count, std::size_t column_count);
};

/// Rounds the rows of some points, the first of which is point `first` of the block. Rounds so, that the units of each
/// point add up to 2^bits, those of Green coordinates over the vertices: a cage that moves as a whole moves the points
/// by as much, without rounding. Each unit is off by less than 1, and sums of neighbouring columns, too. A point that
/// is nowhere gets zeros. Throws bad_input if a weight is 2^30 or more, as of a point too far outside, or not finite.
void round_weights(const CoordinateRows& rows, std::size_t first, WeightBlock& out);

/// Fills `out` with the coordinates of points, and `places`; both have room for as many. Points outside get weights
/// only if they are to be carried. Throws as round_weights() does. On the caller's thread. `rows` is kept from call to
/// call.
void weigh_points(const CageCoordinates& coordinates, std::span<const Vec3d> points, bool carry_outside,
                  CoordinateRows& rows, WeightBlock& out, std::span<CoordinateRows::Place> places);

/// The same for some of the points, by their numbers; the others keep what they have.
void weigh_some(const CageCoordinates& coordinates, std::span<const Vec3d> points,
                std::span<const std::uint32_t> numbers, bool carry_outside, CoordinateRows& rows, WeightBlock& out,
                std::span<CoordinateRows::Place> places);

/// out[i] = the sum over the columns of weight times moves[column]: by how much each point moves. `moves` are those of
/// CageCoordinates::moves_of_columns(). Exactly 0 where no vertex moves. The order of the sum is that of the columns.
void add_moves(const WeightBlock& block, std::span<const Vec3d> moves, std::span<Vec3d> out);

}  // namespace bp
