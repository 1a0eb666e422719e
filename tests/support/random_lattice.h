#pragma once
#include <random>

#include "lib/core/coords.h"

namespace bp::test {

/// Random whole numbers and points with whole coordinates, uniform in [low, high]; and other numbers.
class RandomLattice {
 public:
  explicit RandomLattice(unsigned seed) : random_(seed) {}
  std::int64_t between(std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random_);
  }
  /// One of 2^20 + 1 in a row.
  double real(double low, double high) { return low + (high - low) * double(between(0, 1 << 20)) / (1 << 20); }
  LatticeCoord point(std::int64_t low, std::int64_t high) {
    return {between(low, high), between(low, high), between(low, high)};
  }

 private:
  std::mt19937 random_;
};

}  // namespace bp::test
