#include "lib/grid/brick.h"

namespace bp {

BrickFill classify(const BrickBits& bits) {
  std::uint64_t any = 0, all = ~std::uint64_t(0);
  for (const std::uint64_t w : bits) {
    any |= w;
    all &= w;
  }
  return any == 0 ? BrickFill::empty : all == ~std::uint64_t(0) ? BrickFill::full : BrickFill::mixed;
}

}  // namespace bp
