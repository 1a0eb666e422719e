#include "lib/volume/dilate_ball.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "lib/core/parallel.h"

namespace bp {

namespace {

/// Of two voxels so many apart along an axis: the space between their cubes.
std::int64_t gap(std::int32_t apart) {
  return std::max(std::abs(apart) - 1, 0);
}

/// How far along x the cubes are near enough, where they are dy and dz apart; -1: nowhere.
std::int32_t reach_along_x(std::int32_t dy, std::int32_t dz, double squared, std::int32_t most) {
  const std::int64_t across = gap(dy) * gap(dy) + gap(dz) * gap(dz);
  std::int32_t dx = most;
  while (dx >= 0 && double(across + gap(dx) * gap(dx)) >= squared) --dx;
  return dx;
}

/// The rows of a ball: row (y, z) of the result has what is within reach_x of row (y + dy, z + dz).
struct Row {
  std::int32_t dy, dz, reach_x;
};

std::vector<Row> rows_of_ball(double reach) {
  std::vector<Row> rows;
  const auto most = std::int32_t(std::ceil(reach)) + 1;
  for (std::int32_t dz = -most; dz <= most; ++dz) {
    for (std::int32_t dy = -most; dy <= most; ++dy) {
      const std::int32_t x = reach_along_x(dy, dz, reach * reach, most);
      if (x >= 0 || (dy == 0 && dz == 0)) rows.push_back({dy, dz, std::max(x, 0)});
    }
  }
  std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.reach_x < b.reach_x; });
  return rows;
}

/// Adds to each row what lies one voxel before and behind.
void widen(BitBox& box, std::vector<std::uint64_t>& before) {
  const VoxelBox& b = box.box();
  const auto words = std::size_t(box.words_per_row());
  for (std::int32_t z = b.min.z; z < b.max.z; ++z) {
    for (std::int32_t y = b.min.y; y < b.max.y; ++y) {
      std::uint64_t* const row = box.row(y, z);
      before.assign(row, row + words);
      for (std::size_t i = 0; i < words; ++i) {
        row[i] |= before[i] << 1 | before[i] >> 1;
        if (i > 0) row[i] |= before[i - 1] >> 63;
        if (i + 1 < words) row[i] |= before[i + 1] << 63;
      }
    }
  }
}

/// The brick of the result.
void dilate_brick(BitBox& around, const std::vector<Row>& rows, BrickCoord brick, BrickBits& bits) {
  const VoxelCoord first = first_voxel(brick);
  const std::size_t word = std::size_t(first.x - around.box().min.x) / 64;
  bits.fill(0);
  std::vector<std::uint64_t> scratch;
  std::int32_t widened = 0;
  for (const Row& r : rows) {
    for (; widened < r.reach_x; ++widened) widen(around, scratch);
    for (std::int32_t z = 0; z < kBrickEdge; ++z) {
      for (std::int32_t y = 0; y < kBrickEdge; ++y)
        bits[std::size_t(z * kBrickEdge + y)] |= around.row(first.y + y + r.dy, first.z + z + r.dz)[word];
    }
  }
}

/// Bricks that the ball around an occupied brick reaches, in order, each once.
std::vector<BrickCoord> reached_bricks(const BrickShelf& voxels, std::int32_t most) {
  std::vector<BrickCoord> reached;
  for (const BrickCoord& c : voxels.coords()) {
    const BrickBox box = bricks_of(VoxelBox{first_voxel(c), first_voxel({c.x + 1, c.y + 1, c.z + 1})}.grown(most));
    for (BrickCoord b = box.min; b.x < box.max.x; ++b.x) {
      for (b.y = box.min.y; b.y < box.max.y; ++b.y) {
        for (b.z = box.min.z; b.z < box.max.z; ++b.z) reached.push_back(b);
      }
    }
  }
  const auto key = [](const BrickCoord& c) { return std::tuple(c.x, c.y, c.z); };
  std::sort(reached.begin(), reached.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  reached.erase(std::unique(reached.begin(), reached.end()), reached.end());
  return reached;
}

}  // namespace

void dilate_ball(const BrickShelf& voxels, double reach, BrickShelf& out) {
  const std::vector<Row> rows = rows_of_ball(reach);
  const std::int32_t most = std::int32_t(std::ceil(reach)) + 1;
  const std::vector<BrickCoord> bricks = reached_bricks(voxels, most);
  struct Item {
    BrickCoord brick;
    BrickBits bits;
  };
  std::size_t next = 0;
  pipeline<Item>(
      2 * thread_count(), [&](Item& item) { return next < bricks.size() && (item.brick = bricks[next++], true); },
      [&](Item& item) {
        const BrickCoord& c = item.brick;
        BitBox around(VoxelBox{first_voxel(c), first_voxel({c.x + 1, c.y + 1, c.z + 1})}.grown(most));
        load_voxels(voxels, around);
        dilate_brick(around, rows, c, item.bits);
      },
      [&](Item& item) { out.put(item.brick, classify(item.bits), item.bits); });
}

}  // namespace bp
