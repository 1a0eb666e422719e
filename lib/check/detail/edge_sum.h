#pragma once
#include <array>
#include <cstdint>

#include "lib/core/coords.h"

/// Tells whether a set of triangles is closed, without keeping the set.
namespace bp {

/// A secret of 128 bits. Whoever knows the key can choose open sets of edges whose sum is zero, so the key of a run
/// must be drawn after its scenes were made.
struct EdgeKey {
  std::uint64_t words[2];
  [[nodiscard]] static EdgeKey drawn();  ///< from the system's source of random numbers
};

/// The sum over all directed edges ab of h(a, b) - h(b, a), with h a keyed hash of 128 bits. It is zero if each edge is
/// used as often as its reverse. For any other edges, chosen without the key, it is zero with a probability of about
/// 2^-128.
class EdgeSum {
 public:
  explicit EdgeSum(const EdgeKey& key) : key_(key) {}
  void add(const TriangleD& t);
  void add(const EdgeSum& s) { low_ += s.low_, high_ += s.high_; }  ///< both sums must have the same key
  [[nodiscard]] bool zero() const { return low_ == 0 && high_ == 0; }

 private:
  EdgeKey key_;
  std::uint64_t low_ = 0, high_ = 0;
};

}  // namespace bp
