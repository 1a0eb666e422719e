#pragma once
#include "lib/deform/formulas/cage_view.h"
#include "lib/deform/formulas/numbers.h"

/// Functions of the weights of one point; `w` has get(column) and put(column, value).
namespace bp::detail {

constexpr double kFarAway = 8;  ///< diagonals: points farther away are outside, and their weights have few digits
constexpr double kMostUnits = double(1u << 31) - 2;

/// Weights side by side in memory.
template <class T>
struct RowOfWeights {
  T* row;
  [[nodiscard]] double get(std::uint32_t c) const { return row[c]; }
  void put(std::uint32_t c, double weight) const { row[c] = weight; }
};

/// Divides the weights by the vertices' sum, so that the vertices' weights sum to 1.
BP_FORMULA void divide_by_sum(const CageView& cage, const auto& w) {
  double sum = 0;
  for (std::uint32_t v = 0; v < cage.vertex_count; ++v) sum += w.get(v);
  const double scale = 1 / sum;
  for (std::uint32_t c = 0; c < cage.columns(); ++c) w.put(c, w.get(c) * scale);
}

/// Makes the least change of the vertices' weights, by squares, after which all weights give the point exactly. It
/// removes rounding, or carries the offset of a point outside. The origin is the mean of the vertices, so the sum
/// stays.
BP_FORMULA void reproduce_point(const CageView& cage, const Vec<double>& point, const auto& w) {
  Vec<double> missing = point;
  for (std::uint32_t c = 0; c < cage.columns(); ++c) {
    const double weight = w.get(c);
    const Vec3d& at = c < cage.vertex_count ? cage.vertices[c] : cage.green[c - cage.vertex_count].normal;
    missing.x = missing.x - weight * at[0], missing.y = missing.y - weight * at[1],
    missing.z = missing.z - weight * at[2];
  }
  const auto along = [&](const Vec3d& row) { return row[0] * missing.x + row[1] * missing.y + row[2] * missing.z; };
  const double x = along(cage.spread[0]), y = along(cage.spread[1]), z = along(cage.spread[2]);
  for (std::uint32_t v = 0; v < cage.vertex_count; ++v) {
    const Vec3d& at = cage.vertices[v];
    w.put(v, w.get(v) + (x * at[0] + y * at[1] + z * at[2]));
  }
}

/// Computes the largest absolute weight, and their sum.
BP_FORMULA void sizes_of(std::uint32_t columns, const auto& w, double& largest, double& all) {
  largest = all = 0;
  for (std::uint32_t c = 0; c < columns; ++c) {
    const double weight = w.get(c), size = weight < 0 ? -weight : weight;
    largest = largest < size ? size : largest;
    all += weight;
  }
}

/// Calls put(column, unit). The running sum is rounded, not the weight: what rounding takes from one column it gives to
/// the next. `scale`: units of 1.
BP_FORMULA void round_to_units(std::uint32_t columns, const auto& w, double scale, const auto& put) {
  double sum = 0;
  std::int64_t before = 0;
  for (std::uint32_t c = 0; c < columns; ++c) {
    sum += w.get(c);
    const auto rounded = std::int64_t(nearbyint(sum * scale));
    put(c, std::int32_t(rounded - before));
    before = rounded;
  }
}

}  // namespace bp::detail
