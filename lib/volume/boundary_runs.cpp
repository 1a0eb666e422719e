#include "lib/volume/boundary_runs.h"

#include <atomic>
#include <bit>

#include "lib/core/parallel.h"
#include "lib/grid/clip.h"
#include "lib/grid/count_bits.h"

namespace bp {

namespace {

/// Returns the six neighbours of a row of voxels, moved onto it.
std::array<std::uint64_t, 6> neighbours(const BitBox& box, std::int32_t y, std::int32_t z) {
  const std::uint64_t* row = box.row(y, z);
  return {row[1] << 1 | row[0] >> 63, row[1] >> 1 | row[2] << 63, box.row(y - 1, z)[1],
          box.row(y + 1, z)[1],       box.row(y, z - 1)[1],       box.row(y, z + 1)[1]};
}

void add_runs(std::uint64_t boundary, VoxelCoord row, std::vector<VoxelRun>& runs) {
  while (boundary != 0) {
    const int begin = std::countr_zero(boundary), length = std::countr_one(boundary >> begin);
    runs.push_back({{row.x + begin, row.y, row.z}, length});
    if (begin + length == kBrickEdge) return;
    boundary &= ~std::uint64_t(0) << (begin + length);
  }
}

std::uint64_t count_runs(std::uint64_t boundary) {
  return std::uint64_t(std::popcount(boundary & ~(boundary << 1)));
}

/// Calls body(row, its boundary voxels, their faces) for each row of a brick.
template <class Body>
void scan(const BrickShelf& solid, BrickCoord brick, const Body& body) {
  if (is_buried(solid, brick)) return;
  const VoxelCoord first = first_voxel(brick);
  BitBox box(voxels_of(brick).grown(1));
  load_voxels(solid, box);
  for (std::int32_t z = first.z; z < first.z + kBrickEdge; ++z) {
    for (std::int32_t y = first.y; y < first.y + kBrickEdge; ++y) {
      const std::uint64_t occupied = box.row(y, z)[1];
      std::uint64_t boundary = 0, faces = 0;
      for (const std::uint64_t n : neighbours(box, y, z)) {
        boundary |= occupied & ~n;
        faces += std::uint64_t(std::popcount(occupied & ~n));
      }
      body(VoxelCoord{first.x, y, z}, boundary, faces);
    }
  }
}

}  // namespace

bool is_buried(const BrickShelf& solid, BrickCoord brick) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const int step : {-1, 1}) {
      BrickCoord n = brick;
      n[axis] += step;
      if (solid.fill(n) != BrickFill::full) return false;
    }
  }
  return solid.fill(brick) == BrickFill::full;
}

Boundary boundary_of(const BrickShelf& solid) {
  const std::vector<BrickCoord> bricks = solid.coords();
  std::vector<Boundary> parts(bricks.size());
  parallel_for(std::int64_t(bricks.size()), [&](std::int64_t i) {
    Boundary& part = parts[std::size_t(i)];
    scan(solid, bricks[std::size_t(i)], [&](VoxelCoord row, std::uint64_t boundary, std::uint64_t faces) {
      part.faces += faces;
      add_runs(boundary, row, part.runs);
    });
  });
  Boundary all;
  for (Boundary& part : parts) {
    all.faces += part.faces;
    all.runs.insert(all.runs.end(), part.runs.begin(), part.runs.end());
    part = {};
  }
  return all;
}

BoundarySize boundary_size(const BrickShelf& solid) {
  const std::vector<BrickCoord> bricks = solid.coords();
  std::vector<BoundarySize> parts(bricks.size());
  parallel_for(std::int64_t(bricks.size()), [&](std::int64_t i) {
    BoundarySize& part = parts[std::size_t(i)];
    scan(solid, bricks[std::size_t(i)], [&](VoxelCoord row, std::uint64_t boundary, std::uint64_t faces) {
      if (boundary == 0) return;
      part.runs += count_runs(boundary);
      part.faces += faces;
      const std::int32_t begin = row.x + std::countr_zero(boundary), end = row.x + 64 - std::countl_zero(boundary);
      part.box = hull(part.box, {{begin, row.y, row.z}, {end, row.y + 1, row.z + 1}});
    });
  });
  BoundarySize all;
  for (const BoundarySize& part : parts) {
    all.runs += part.runs;
    all.faces += part.faces;
    all.box = hull(all.box, part.box);
  }
  return all;
}

std::uint64_t count_voxels(const BrickShelf& solid) {
  std::atomic<std::uint64_t> count{0};
  const std::vector<BrickCoord> coords = solid.coords();
  parallel_for(std::int64_t(coords.size()), [&](std::int64_t i) {
    BrickBits bits;
    (void)solid.get(coords[std::size_t(i)], bits);
    count += count_bits(std::as_bytes(std::span(bits)));
  });
  return count;
}

std::uint64_t boundary_faces(const BrickShelf& solid, BrickCoord brick) {
  std::uint64_t sum = 0;
  scan(solid, brick, [&](VoxelCoord, std::uint64_t, std::uint64_t faces) { sum += faces; });
  return sum;
}

void boundary_layer(const BrickShelf& solid, BrickShelf& boundary) {
  const std::vector<BrickCoord> bricks = solid.coords();
  parallel_for(std::int64_t(bricks.size()), [&](std::int64_t i) {
    const BrickCoord brick = bricks[std::size_t(i)];
    BrickBits bits{};
    scan(solid, brick, [&](VoxelCoord row, std::uint64_t voxels, std::uint64_t) {
      const VoxelCoord p = row - first_voxel(brick);
      bits[std::size_t(p.z * kBrickEdge + p.y)] = voxels;
    });
    const BrickFill fill = classify(bits);
    if (fill != BrickFill::empty) boundary.put(brick, fill, bits);
  });
}

namespace {

/// Calls body(row, its voxels in the box) for each row.
template <class Body>
void for_each_row(const BrickShelf& shelf, const VoxelBox& box, const Body& body) {
  BrickBits bits;
  for_each_brick(box, [&](BrickCoord c) {
    if (get_within(shelf, c, box, bits) == BrickFill::empty) return;
    const VoxelCoord first = first_voxel(c);
    for (std::int32_t z = 0; z < kBrickEdge; ++z) {
      for (std::int32_t y = 0; y < kBrickEdge; ++y)
        body({first.x, first.y + y, first.z + z}, bits[std::size_t(z * kBrickEdge + y)]);
    }
  });
}

}  // namespace

std::uint64_t count_runs(const BrickShelf& shelf, const VoxelBox& box) {
  std::uint64_t sum = 0;
  for_each_row(shelf, box, [&](VoxelCoord, std::uint64_t voxels) { sum += count_runs(voxels); });
  return sum;
}

std::vector<VoxelRun> runs_of(const BrickShelf& shelf, const VoxelBox& box) {
  std::vector<VoxelRun> runs;
  runs.reserve(count_runs(shelf, box));
  for_each_row(shelf, box, [&](VoxelCoord row, std::uint64_t voxels) { add_runs(voxels, row, runs); });
  return runs;
}

}  // namespace bp
