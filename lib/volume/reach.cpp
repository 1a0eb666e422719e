#include "lib/volume/reach.h"

namespace bp {

namespace {

/// Spreads the bits of `seed` over the runs of `open` that they lie in, both ways, in six doublings.
std::uint64_t spread(std::uint64_t seed, std::uint64_t open) {
  std::uint64_t up = seed, down = seed, way_up = open, way_down = open;
  for (int step = 1; step < 64; step *= 2) {
    up |= way_up & up << step;
    way_up &= way_up << step;
    down |= way_down & down >> step;
    way_down &= way_down >> step;
  }
  return up | down;
}

class Sweeper {
 public:
  Sweeper(const BitBox& solid, BitBox& seeds) : solid_(solid), seeds_(seeds), box_(seeds.box()) {}

  bool forth() {
    bool changed = false;
    for (std::int32_t z = box_.min.z; z < box_.max.z; ++z) {
      for (std::int32_t y = box_.min.y; y < box_.max.y; ++y) changed |= row(y, z, -1);
    }
    return changed;
  }
  bool back() {
    bool changed = false;
    for (std::int32_t z = box_.max.z; z-- > box_.min.z;) {
      for (std::int32_t y = box_.max.y; y-- > box_.min.y;) changed |= row(y, z, 1);
    }
    return changed;
  }

 private:
  /// Spreads into one row, from the row before it in the order of the sweep, and along itself. Returns whether it
  /// changed.
  bool row(std::int32_t y, std::int32_t z, std::int32_t before) {
    std::uint64_t* seeds = seeds_.row(y, z);
    const std::uint64_t* solid = solid_.row(y, z);
    const bool has_y = y + before >= box_.min.y && y + before < box_.max.y;
    const bool has_z = z + before >= box_.min.z && z + before < box_.max.z;
    const std::uint64_t* y_row = has_y ? seeds_.row(y + before, z) : seeds;
    const std::uint64_t* z_row = has_z ? seeds_.row(y, z + before) : seeds;
    bool changed = false;
    const std::int32_t n = seeds_.words_per_row();
    for (std::int32_t k = 0; k < n; ++k) {
      const std::int32_t i = before < 0 ? k : n - 1 - k;
      if (solid[i] == 0 || seeds[i] == solid[i]) continue;
      std::uint64_t found = seeds[i] | y_row[i] | z_row[i];
      if (i > 0) found |= seeds[i - 1] >> 63;
      if (i + 1 < n) found |= seeds[i + 1] << 63;
      found = spread(found & solid[i], solid[i]);
      changed |= found != seeds[i];
      seeds[i] = found;
    }
    return changed;
  }

  const BitBox& solid_;
  BitBox& seeds_;
  const VoxelBox box_;
};

}  // namespace

void grow_within(const BitBox& solid, BitBox& seeds) {
  Sweeper sweeper(solid, seeds);
  while (int(sweeper.forth()) | int(sweeper.back())) {
  }
}

}  // namespace bp
