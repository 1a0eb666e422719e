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

}  // namespace

void round_weights(const CoordinateRows& rows, WeightBlock& out) {
  const std::size_t n = rows.points;
  out.points = n;
  out.columns = n == 0 ? 0 : rows.weights.size() / n;
  out.bits.resize(n);
  out.units.resize(n * out.columns);
  std::vector<double> largest(n), sum(n), scale(n);
  std::vector<std::int64_t> before(n);
  for (std::size_t c = 0; c < out.columns; ++c) {
    for (std::size_t i = 0; i < n; ++i) largest[i] = std::max(largest[i], std::abs(rows.weights[c * n + i]));
  }
  for (std::size_t i = 0; i < n; ++i) {
    out.bits[i] = std::uint8_t(bits_for(largest[i]));
    scale[i] = std::ldexp(1.0, out.bits[i]);
  }
  // The sum so far is rounded, not the weight: what rounding takes from one column it gives to the next.
  for (std::size_t c = 0; c < out.columns; ++c) {
    for (std::size_t i = 0; i < n; ++i) {
      sum[i] += rows.weights[c * n + i];
      const std::int64_t rounded = std::llrint(sum[i] * scale[i]);
      out.units[c * n + i] = std::int32_t(rounded - before[i]);
      before[i] = rounded;
    }
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
