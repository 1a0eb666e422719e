#pragma once
#include <cstdint>

namespace bp {

/// Returns whether a place is among about `share` of all. A hash of its three integers decides, since a regular choice
/// would beat with the steps of a surface of voxels.
template <class Place>
[[nodiscard]] bool is_among(const Place& place, double share) {
  constexpr std::uint64_t kMix = 0x9E3779B97F4A7C15;  // 2^64 over the golden ratio
  std::uint64_t hash = 0;
  for (int k = 0; k < 3; ++k) hash = ((hash ^ std::uint64_t(place[k])) * kMix) ^ (hash >> 29);
  return double((hash * kMix) >> 32) < share * 0x1p32;
}

}  // namespace bp
