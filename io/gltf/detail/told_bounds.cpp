#include "io/gltf/detail/told_bounds.h"

#include <algorithm>
#include <cmath>

namespace bp {

namespace {

/// Returns the largest integer of a type: what a normalised 1 is stored as. The bounds of integers are as stored, too.
double one_of(ComponentType type) {
  const int bits = 8 * int(bytes_of(type));
  const bool is_signed = type == ComponentType::i8 || type == ComponentType::i16;
  return std::ldexp(1, bits - int(is_signed)) - 1;
}

}  // namespace

std::optional<Bounds3d> told_bounds(const GltfObject& accessor, const Accessor& positions, bool packed) {
  constexpr double kRounding = 0x1p-20, kPacked = 0x1p-10;  // six digits; a cell of the packed lattice
  if (!accessor.has("min") || !accessor.has("max")) return {};
  Bounds3d told{accessor.numbers<3>("min", {}), accessor.numbers<3>("max", {})};
  const double one = positions.normalized ? one_of(positions.type) : 1;
  double largest = 0;  // the packed lattice has one cell for all axes
  for (std::size_t i = 0; i < 3; ++i) largest = std::max(largest, (told.max[i] - told.min[i]) / one);
  for (std::size_t i = 0; i < 3; ++i) {
    double &min = told.min[i], &max = told.max[i];
    min = min / one, max = max / one;
    const double off = kRounding * std::max(std::abs(min), std::abs(max)) + (packed ? kPacked * largest : 0);
    min -= off, max += off;
  }
  return told;
}

bool lies_in(const GltfDocument& doc, const Accessor& positions, const Bounds3d& bounds) {
  const std::vector<double> numbers = doc.numbers(positions, "the vertices of a pose");
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] < bounds.min[i % 3] || numbers[i] > bounds.max[i % 3]) return false;
  }
  return true;
}

}  // namespace bp
