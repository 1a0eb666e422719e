#include "lib/volume/dilate.h"

#include <algorithm>
#include <array>

namespace bp {

namespace {

/// Calls body(step) for steps that together reach `reach`. Voxels within r, moved by `step` both ways and ORed, give
/// the voxels within r + step, for steps up to r + 1. So no step skips a voxel or leaves the box.
template <class Body>
void for_each_step(std::int32_t reach, const Body& body) {
  for (std::int32_t r = 0; r < reach;) {
    const std::int32_t step = std::min(r + 1, reach - r);
    body(step);
    r += step;
  }
}

/// Returns the word that begins at `bit` of a row, which may lie outside of it.
std::uint64_t word_at(const std::uint64_t* row, std::int32_t words, std::int64_t bit) {
  const std::int64_t i = floor_div<std::int64_t>(bit, 64);
  const int b = int(bit - i * 64);
  const auto word = [&](std::int64_t k) { return k >= 0 && k < words ? row[k] : 0; };
  return b == 0 ? word(i) : word(i) >> b | word(i + 1) << (64 - b);
}

void dilate_row(std::uint64_t* row, std::int32_t words, std::int32_t reach, std::vector<std::uint64_t>& before) {
  for_each_step(reach, [&](std::int32_t step) {
    before.assign(row, row + words);
    for (std::int32_t i = 0; i < words; ++i) {
      const std::int64_t at = std::int64_t(i) * 64;
      row[i] |= word_at(before.data(), words, at - step) | word_at(before.data(), words, at + step);
    }
  });
}

/// Adds the voxels that lie `step` before and behind along y or z.
void add_moved(BitBox& voxels, const BitBox& before, int axis, std::int32_t step) {
  const VoxelBox& box = voxels.box();
  const std::int32_t words = voxels.words_per_row();
  for (std::int32_t z = box.min.z; z < box.max.z; ++z) {
    for (std::int32_t y = box.min.y; y < box.max.y; ++y) {
      std::uint64_t* row = voxels.row(y, z);
      for (const std::int32_t at : {(axis == 1 ? y : z) - step, (axis == 1 ? y : z) + step}) {
        if (at < box.min[axis] || at >= box.max[axis]) continue;
        const std::uint64_t* near = axis == 1 ? before.row(at, z) : before.row(y, at);
        for (std::int32_t i = 0; i < words; ++i) row[i] |= near[i];
      }
    }
  }
}

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

void dilate(BitBox& voxels, std::int32_t reach) {
  dilate(voxels, {reach, reach, reach});
}

void dilate(BitBox& voxels, VoxelCoord reach) {
  const VoxelBox& box = voxels.box();
  std::vector<std::uint64_t> line;
  for (std::int32_t z = box.min.z; z < box.max.z; ++z) {
    for (std::int32_t y = box.min.y; y < box.max.y; ++y)
      dilate_row(voxels.row(y, z), voxels.words_per_row(), reach.x, line);
  }
  for (const int axis : {1, 2}) {
    for_each_step(reach[axis], [&](std::int32_t step) {
      const BitBox before = voxels;
      add_moved(voxels, before, axis, step);
    });
  }
}

bool dilate_over_faces(const BitBox& within, BitBox& voxels) {
  const BitBox before = voxels;
  const VoxelBox& box = voxels.box();
  const std::int32_t words = voxels.words_per_row();
  bool any = false;
  for (std::int32_t z = box.min.z; z < box.max.z; ++z) {
    for (std::int32_t y = box.min.y; y < box.max.y; ++y) {
      const std::uint64_t* const old = before.row(y, z);
      const std::array<const std::uint64_t*, 4> beside{
          y > box.min.y ? before.row(y - 1, z) : nullptr, y + 1 < box.max.y ? before.row(y + 1, z) : nullptr,
          z > box.min.z ? before.row(y, z - 1) : nullptr, z + 1 < box.max.z ? before.row(y, z + 1) : nullptr};
      for (std::int32_t i = 0; i < words; ++i) {
        std::uint64_t near = old[i] << 1 | old[i] >> 1;
        if (i > 0) near |= old[i - 1] >> 63;
        if (i + 1 < words) near |= old[i + 1] << 63;
        for (const std::uint64_t* const row : beside) near |= row != nullptr ? row[i] : 0;
        near &= within.row(y, z)[i] & ~old[i];
        voxels.row(y, z)[i] |= near;
        any |= near != 0;
      }
    }
  }
  return any;
}

void grow_within(const BitBox& solid, BitBox& seeds) {
  Sweeper sweeper(solid, seeds);
  while (int(sweeper.forth()) | int(sweeper.back())) {
  }
}

}  // namespace bp
