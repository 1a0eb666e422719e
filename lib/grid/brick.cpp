#include "lib/grid/brick.h"

namespace bp {

BrickFill classify(const BrickBits& bits) {
  const std::uint64_t first = bits[0];
  if (first != 0 && first != ~std::uint64_t(0)) return BrickFill::mixed;
  for (std::size_t z = 0; z < kBrickWords; z += kBrickEdge) {
    std::uint64_t other = 0;
    for (std::size_t i = z; i < z + kBrickEdge; ++i) other |= bits[i] ^ first;
    if (other != 0) return BrickFill::mixed;
  }
  return first == 0 ? BrickFill::empty : BrickFill::full;
}

}  // namespace bp
