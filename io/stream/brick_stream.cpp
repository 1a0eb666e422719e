#include "io/stream/brick_stream.h"

#include "lib/store/hex.h"

namespace bp {

std::string StreamTotals::checksum() const {
  return hex_of(checksum_high, checksum_low);
}

void StreamTotals::add(const StreamTotals& t) {
  for (std::size_t i = 0; i < layers.size(); ++i) {
    layers[i].bricks += t.layers[i].bricks;
    layers[i].full += t.layers[i].full;
    layers[i].voxels += t.layers[i].voxels;
  }
  checksum_low += t.checksum_low;
  checksum_high += t.checksum_high + (checksum_low < t.checksum_low ? 1 : 0);
}

}  // namespace bp
