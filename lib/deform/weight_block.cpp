#include "lib/deform/weight_block.h"

#include <algorithm>
#include <cmath>

#include "lib/core/error.h"

namespace bp {

namespace {

constexpr double kMostUnits = double(1u << 31) - 2;

int bits_for(double largest) {
  int bits = WeightBlock::kBits;
  while (bits > 0 && std::ldexp(largest, bits) >= kMostUnits) --bits;
  if (!(std::ldexp(largest, bits) < kMostUnits))
    fail(ErrorCode::bad_input, "a point lies too far from the cage to follow it");
  return bits;
}

/// The sum so far is rounded, not the weight: what rounding takes from one column it gives to the next. `units` are
/// `stride` apart. Returns the bits.
int round_row(std::span<const double> weights, std::int32_t* units, std::size_t stride) {
  double largest = 0, all = 0, sum = 0;
  for (const double w : weights) largest = std::max(largest, std::abs(w)), all += w;
  if (!std::isfinite(all))
    fail(ErrorCode::bad_input, "a point has weights that are not finite: the cage is degenerate");
  const int bits = bits_for(largest);
  const double scale = std::ldexp(1.0, bits);
  std::int64_t before = 0;
  for (std::size_t c = 0; c < weights.size(); ++c) {
    sum += weights[c];
    const auto rounded = std::int64_t(std::nearbyint(sum * scale));
    units[c * stride] = std::int32_t(rounded - before);
    before = rounded;
  }
  return bits;
}

}  // namespace

WeightBlock::WeightBlock(std::size_t point_count, std::size_t column_count)
    : points(point_count), columns(column_count), bits(points), units(points * columns) {}

void round_weights(const CoordinateRows& rows, std::size_t first, WeightBlock& out) {
  constexpr std::size_t kTile = 16;  // points: one line of the cache in each column
  std::vector<std::int32_t> tile(kTile * rows.columns);
  for (std::size_t at = 0; at < rows.points(); at += kTile) {
    const std::size_t count = std::min(kTile, rows.points() - at);
    for (std::size_t i = 0; i < count; ++i)
      out.bits[first + at + i] = std::uint8_t(round_row(rows.row(at + i), tile.data() + i, kTile));
    for (std::size_t c = 0; c < rows.columns; ++c)
      std::copy_n(tile.data() + c * kTile, count, out.units.data() + c * out.points + first + at);
  }
}

void add_moves(const WeightBlock& block, std::span<const Vec3d> moves, std::span<Vec3d> out) {
  const std::size_t n = block.points;
  std::vector<double> x(n), y(n), z(n);
  for (std::size_t c = 0; c < block.columns; ++c) {
    const Vec3d move = moves[c];
    const std::int32_t* const units = block.units.data() + c * n;
    for (std::size_t i = 0; i < n; ++i) {
      const double w = units[i];
      x[i] += w * move[0];
      y[i] += w * move[1];
      z[i] += w * move[2];
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double unit = std::ldexp(1.0, -int(block.bits[i]));
    out[i] = {x[i] * unit, y[i] * unit, z[i] * unit};
  }
}

}  // namespace bp
