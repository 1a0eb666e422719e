#pragma once
#include <bit>
#include <cstdint>

#include "lib/core/coords.h"

/// Is a set of triangles closed? Told without keeping it.
namespace bp {

namespace detail {
inline std::uint64_t mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

inline std::uint64_t hash(const Vec3d& p, std::uint64_t seed) {
  for (const double x : p) seed = mix(seed + 0x9E3779B97F4A7C15u + std::bit_cast<std::uint64_t>(x + 0.0));
  return seed;
}
}  // namespace detail

/// The sum over all directed edges ab of h(a, b) - h(b, a): zero if each is used as often as its reverse, and for any
/// other set of edges zero with a probability of 2^-128.
struct EdgeSum {
  std::uint64_t low = 0, high = 0;
  void add(const TriangleD& t) {
    using detail::hash;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d &a = t[k], &b = t[(k + 1) % 3];
      low += hash(b, hash(a, 1)) - hash(a, hash(b, 1));
      high += hash(b, hash(a, 2)) - hash(a, hash(b, 2));
    }
  }
  void add(const EdgeSum& s) { low += s.low, high += s.high; }
  [[nodiscard]] bool zero() const { return low == 0 && high == 0; }
};

}  // namespace bp
