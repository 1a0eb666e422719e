#include "lib/surface/repair.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <mutex>
#include <set>

#include "lib/core/parallel.h"

namespace bp {

namespace {

/// Returns the number of face-connected parts of a set of cells of a 2x2x2 block.
int parts_of(unsigned cells) {
  int parts = 0;
  while (cells != 0) {
    unsigned part = cells & (~cells + 1), grown = part;
    do {
      part = grown;
      for (int i = 0; i < 8; ++i) {
        if ((part >> i) & 1) grown |= (1u << (i ^ 1)) | (1u << (i ^ 2)) | (1u << (i ^ 4));
      }
      grown &= cells;
    } while (grown != part);
    cells &= ~part;
    ++parts;
  }
  return parts;
}

/// Returns the four cells of the 2x2 square that is perpendicular to `axis`, on its low or high side.
unsigned square_of(int axis, int side) {
  unsigned cells = 0;
  for (unsigned i = 0; i < 8; ++i) {
    if (int((i >> axis) & 1) == side) cells |= 1u << i;
  }
  return cells;
}

unsigned repaired_squares(unsigned block) {
  unsigned add = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const unsigned square = square_of(axis, side), in = block & square;
      if (std::popcount(in) == 2 && parts_of(in) == 2) add |= square & ~block;
    }
  }
  return add;
}

}  // namespace

bool corner_is_manifold(Corner block) {
  return parts_of(block) <= 1 && parts_of(~unsigned(block) & 0xff) <= 1;
}

Corner corner_repair(Corner block) {
  if (corner_is_manifold(block)) return 0;
  unsigned grown = block;
  while (const unsigned add = repaired_squares(grown)) grown |= add;
  for (unsigned low = 0; low < 4; ++low) {  // space diagonals, by their end with dz = 0
    const unsigned pair = (1u << low) | (1u << (7 - low));
    if (grown == pair) grown |= (1u << (low ^ 1)) | (1u << (low ^ 3));
    if ((~grown & 0xff) == pair) grown = 0xff;
  }
  return Corner(grown & ~unsigned(block));
}

namespace {

constexpr int kRow = 3;  // words per row of a brick with its halo: one word on each side

/// A brick and the voxels around it.
struct Neighbourhood {
  BitBox bits;
  BrickCoord brick;

  void load(const BrickShelf& shelf, BrickCoord coord) {
    brick = coord;
    const VoxelCoord first = first_voxel(coord);
    bits.reset({{first.x - 64, first.y - 1, first.z - 1}, {first.x + 128, first.y + 65, first.z + 65}});
    load_voxels(shelf, bits);
  }
};

/// Bits of row `r` moved down by one, so that bit x holds voxel x + 1. Index 0..2 of a row of three words.
std::uint64_t next_voxel(const std::uint64_t* r, int word) {
  return (r[word] >> 1) | (word + 1 < kRow ? r[word + 1] << 63 : 0);
}

/// Voxels that repair adds to a brick, as words. Few bricks get many.
struct Addition {
  BrickCoord brick;
  std::vector<std::pair<std::uint16_t, std::uint64_t>> words;  // index, bits
};

std::vector<std::pair<std::uint16_t, std::uint64_t>> words_of(const BrickBits& bits) {
  std::vector<std::pair<std::uint16_t, std::uint64_t>> words;
  for (std::size_t i = 0; i < kBrickWords; ++i) {
    if (bits[i] != 0) words.emplace_back(std::uint16_t(i), bits[i]);
  }
  words.shrink_to_fit();
  return words;
}

/// 64 blocks of eight voxels: bit x of word i is voxel i of block x.
using Blocks = std::array<std::uint64_t, 8>;

/// Returns the blocks around the low corners of the voxels of `word`, between rows y and y + 1, z and z + 1.
Blocks blocks_at(const BitBox& bits, std::int32_t y, std::int32_t z, int word) {
  Blocks v;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::uint64_t* row = bits.row(y + std::int32_t(i & 1), z + std::int32_t(i >> 1));
    v[2 * i] = row[word];
    v[2 * i + 1] = next_voxel(row, word);
  }
  return v;
}

/// Returns a mask, one bit for each block: whether the block is neither empty nor full.
std::uint64_t mixed(const Blocks& v) {
  std::uint64_t some = 0, all = ~std::uint64_t(0);
  for (const std::uint64_t voxels : v) some |= voxels, all &= voxels;
  return some & ~all;
}

/// The blocks that are not manifold.
std::uint64_t not_manifold(const Blocks& v) {
  const auto crossed = [&](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
    return ~(v[a] ^ v[d]) & ~(v[b] ^ v[c]) & (v[a] ^ v[b]);
  };
  std::uint64_t bad = crossed(0, 1, 2, 3) | crossed(4, 5, 6, 7) | crossed(0, 1, 4, 5) | crossed(2, 3, 6, 7) |
                      crossed(0, 2, 4, 6) | crossed(1, 3, 5, 7);
  for (std::size_t low = 0; low < 4; ++low) {  // a space diagonal that differs from all six others
    std::uint64_t alone = ~(v[low] ^ v[7 - low]);
    for (std::size_t i = 0; i < 8; ++i) {
      if (i != low && i != 7 - low) alone &= v[low] ^ v[i];
    }
    bad |= alone;
  }
  return bad;
}

/// Adds the voxels of `fill` that lie in the brick; (x, y, z) is the low corner of their block. Returns false if none
/// does.
bool add_fill(Corner fill, std::int32_t x, std::int32_t y, std::int32_t z, BrickBits& add) {
  bool any = false;
  for (int i = 0; i < 8; ++i) {
    const std::int32_t bx = x + (i & 1), by = y + ((i >> 1) & 1), bz = z + (i >> 2);
    if (!((fill >> i) & 1) || bx < 0 || bx > 63 || by < 0 || by > 63 || bz < 0 || bz > 63) continue;
    add[std::size_t(bz * kBrickEdge + by)] |= std::uint64_t(1) << bx;
    any = true;
  }
  return any;
}

/// Finds the voxels that blocks add to the brick; returns false if there are none. Blocks that are not manifold are
/// found 64 at a time; only for these the table is used.
bool additions(const Neighbourhood& n, const std::array<Corner, 256>& table, BrickBits& add) {
  const VoxelCoord first = first_voxel(n.brick);
  bool any = false;
  for (std::int32_t z = -1; z < kBrickEdge; ++z) {
    for (std::int32_t y = -1; y < kBrickEdge; ++y) {
      for (int word = 0; word < 2; ++word) {  // word 0: only its last block, x = -1, reaches the brick
        const Blocks v = blocks_at(n.bits, first.y + y, first.z + z, word);
        std::uint64_t bad = mixed(v) & (word == 0 ? std::uint64_t(1) << 63 : ~std::uint64_t(0));
        if (bad == 0) continue;
        for (bad &= not_manifold(v); bad != 0; bad &= bad - 1) {
          const int bit = std::countr_zero(bad);
          unsigned block = 0;
          for (std::size_t i = 0; i < 8; ++i) block |= unsigned((v[i] >> bit) & 1) << i;
          any |= add_fill(table[block], (word - 1) * 64 + bit, y, z, add);
        }
      }
    }
  }
  return any;
}

/// Returns whether a brick has voxels at its low sides along x, y and z (even numbers), and at its high sides (odd
/// numbers).
std::array<bool, 6> sides_of(const BrickShelf& shelf, BrickCoord coord) {
  BrickBits bits;
  shelf.get(coord, bits);
  std::uint64_t any = 0, low_y = 0, high_y = 0, low_z = 0, high_z = 0;
  for (std::size_t z = 0; z < kBrickEdge; ++z) {
    const std::uint64_t* rows = &bits[z * kBrickEdge];
    std::uint64_t layer = 0;
    for (std::size_t y = 0; y < kBrickEdge; ++y) layer |= rows[y];
    low_y |= rows[0];
    high_y |= rows[kBrickEdge - 1];
    if (z == 0) low_z = layer;
    high_z = layer;
    any |= layer;
  }
  return {(any & 1) != 0, any >> 63 != 0, low_y != 0, high_y != 0, low_z != 0, high_z != 0};
}

/// Returns the bricks and the neighbours that their voxels may touch, sorted.
std::vector<BrickCoord> with_neighbours(const BrickShelf& shelf, const std::vector<BrickCoord>& bricks) {
  std::vector<std::array<bool, 6>> sides(bricks.size());
  parallel_for(std::int64_t(bricks.size()),
               [&](std::int64_t i) { sides[std::size_t(i)] = sides_of(shelf, bricks[std::size_t(i)]); });
  std::set<BrickCoord> all;
  for (std::size_t k = 0; k < bricks.size(); ++k) {
    for (int i = 0; i < 27; ++i) {
      const std::array<int, 3> step = {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
      bool touched = true;
      for (std::size_t axis = 0; axis < 3; ++axis)
        touched = touched && (step[axis] == 0 || sides[k][2 * axis + (step[axis] > 0)]);
      if (touched) all.insert(bricks[k] + BrickCoord{step[0], step[1], step[2]});
    }
  }
  return {all.begin(), all.end()};
}

}  // namespace

std::uint64_t repair_contacts(BrickShelf& shelf) {
  std::array<Corner, 256> table;
  for (unsigned i = 0; i < 256; ++i) table[i] = corner_repair(Corner(i));

  std::uint64_t added = 0;
  std::vector<BrickCoord> changed = shelf.coords();
  while (!changed.empty()) {
    const std::vector<BrickCoord> active = with_neighbours(shelf, changed);
    std::vector<Addition> found;
    std::mutex mutex;
    parallel_for(std::int64_t(active.size()), [&](std::int64_t i) {
      thread_local Neighbourhood n;
      BrickBits add{};
      n.load(shelf, active[std::size_t(i)]);
      if (!additions(n, table, add)) return;
      Addition addition{active[std::size_t(i)], words_of(add)};
      const std::lock_guard lock(mutex);
      found.push_back(std::move(addition));
    });
    changed.clear();
    for (const auto& [coord, words] : found) {  // the solid grows only now: all blocks saw the same voxels
      BrickBits bits;
      shelf.get(coord, bits);
      for (const auto& [i, add] : words) {
        added += std::uint64_t(std::popcount(add & ~bits[i]));
        bits[i] |= add;
      }
      shelf.put(coord, classify(bits), bits);
      changed.push_back(coord);
    }
  }
  return added;
}

}  // namespace bp
