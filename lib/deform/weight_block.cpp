#include "lib/deform/weight_block.h"

#include <algorithm>
#include <cmath>

#include "lib/core/error.h"
#include "lib/deform/formulas/weights.h"

namespace bp {

namespace {

using detail::kMostUnits;

int bits_for(double largest) {
  int bits = WeightBlock::kBits;
  while (bits > 0 && std::ldexp(largest, bits) >= kMostUnits) --bits;
  if (!(std::ldexp(largest, bits) < kMostUnits))
    fail(ErrorCode::bad_input, "a point lies too far from the cage to follow it");
  return bits;
}

/// Rounds a row. `units` are `stride` apart. Returns the bits.
int round_row(std::span<const double> weights, std::int32_t* units, std::size_t stride) {
  const detail::RowOfWeights<const double> row{weights.data()};
  const auto columns = std::uint32_t(weights.size());
  double largest, all;
  detail::sizes_of(columns, row, largest, all);
  if (!std::isfinite(all))
    fail(ErrorCode::bad_input, "a point has weights that are not finite: the cage is degenerate");
  const int bits = bits_for(largest);
  detail::round_to_units(columns, row, std::ldexp(1.0, bits),
                         [&](std::uint32_t c, std::int32_t unit) { units[c * stride] = unit; });
  return bits;
}

}  // namespace

WeightBlock::WeightBlock(std::size_t point_count, std::size_t column_count)
    : points(point_count), columns(column_count), bits(points), units(points * columns) {}

void round_weights(const CoordinateRows& rows, std::size_t first, WeightBlock& out) {
  constexpr std::size_t kTile = 16;  // points: one line of the processor's cache in each column
  std::vector<std::int32_t> tile(kTile * rows.columns);
  for (std::size_t at = 0; at < rows.points(); at += kTile) {
    const std::size_t count = std::min(kTile, rows.points() - at);
    for (std::size_t i = 0; i < count; ++i)
      out.bits[first + at + i] = std::uint8_t(round_row(rows.row(at + i), tile.data() + i, kTile));
    for (std::size_t c = 0; c < rows.columns; ++c)
      std::copy_n(tile.data() + c * kTile, count, out.units.data() + c * out.points + first + at);
  }
}

void weigh_points(const CageCoordinates& coordinates, std::span<const Vec3d> points, bool carry_outside,
                  CoordinateRows& rows, WeightBlock& out, std::span<CoordinateRows::Place> places) {
  const std::size_t step = coordinates.points_at_once();
  for (std::size_t first = 0; first < points.size(); first += step) {
    const std::size_t count = std::min(step, points.size() - first);
    coordinates.evaluate(points.subspan(first, count), rows);
    std::copy_n(rows.places.begin(), count, places.begin() + std::ptrdiff_t(first));
    const bool none_outside =
        std::find(rows.places.begin(), rows.places.end(), CoordinateRows::Place::outside) == rows.places.end();
    if (none_outside || carry_outside) round_weights(rows, first, out);
  }
}

void weigh_some(const CageCoordinates& coordinates, std::span<const Vec3d> points,
                std::span<const std::uint32_t> numbers, bool carry_outside, CoordinateRows& rows, WeightBlock& out,
                std::span<CoordinateRows::Place> places) {
  const std::size_t step = coordinates.points_at_once();
  for (std::size_t first = 0; first < numbers.size(); first += step) {
    const std::span<const std::uint32_t> some = numbers.subspan(first, std::min(step, numbers.size() - first));
    std::vector<Vec3d> there;
    for (const std::uint32_t i : some) there.push_back(points[i]);
    WeightBlock block(some.size(), out.columns);
    std::vector<CoordinateRows::Place> places_there(some.size());
    weigh_points(coordinates, there, carry_outside, rows, block, places_there);
    for (std::size_t i = 0; i < some.size(); ++i) {
      out.bits[some[i]] = block.bits[i], places[some[i]] = places_there[i];
      for (std::size_t c = 0; c < out.columns; ++c)
        out.units[c * out.points + some[i]] = block.units[c * block.points + i];
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
