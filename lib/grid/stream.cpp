#include "lib/grid/stream.h"

#include <cstring>
#include <span>
#include <tuple>
#include <vector>

#include "lib/core/parallel.h"

namespace bp {

namespace {

auto slab_key(int axis, BrickCoord c) {
  const int high = axis == 2 ? 1 : 2, low = axis == 0 ? 1 : 0;
  return std::tuple(c[axis], c[high], c[low]);
}

}  // namespace

int longest_axis(const BrickBox& bricks) {
  int best = 0;
  for (int axis = 1; axis < 3; ++axis) {
    if (bricks.size()[axis] >= bricks.size()[best]) best = axis;
  }
  return best;
}

bool slab_order(int slab_axis, BrickCoord a, BrickCoord b) {
  return slab_key(slab_axis, a) < slab_key(slab_axis, b);
}

bool slab_order(int slab_axis, const Brick& a, const Brick& b) {
  return std::pair(slab_key(slab_axis, a.coord), a.layer) < std::pair(slab_key(slab_axis, b.coord), b.layer);
}

void for_bricks(BrickSource& source, const std::function<void(const Brick&)>& take) {
  for_bricks([&](Brick& brick) { return source.read(brick); }, take);
}

void for_bricks(const std::function<bool(Brick&)>& next, const std::function<void(const Brick&)>& take) {
  constexpr std::size_t kTogether = 8;  // 256 KiB
  struct Some {
    std::vector<Brick> bricks;  // made for those of the ring that are used: a slab may have few bricks
    SideWork taking;
  };
  auto ring = std::vector<Some>(std::size_t(thread_count()));
  bool more = true;
  for (std::size_t i = 0; more; i = (i + 1) % ring.size()) {
    Some& some = ring[i];
    some.taking.wait();
    some.bricks.resize(kTogether);
    std::size_t count = 0;
    while (count < kTogether && (more = next(some.bricks[count]))) ++count;
    some.taking.begin([&take, bricks = std::span(some.bricks).first(count)] {
      for (const Brick& brick : bricks) take(brick);
    });
  }
  for (Some& some : ring) some.taking.wait();
}

void load_voxels(const BrickShelf& shelf, BitBox& box) {
  BrickBits bits;
  for_each(bricks_of(box.box()), [&](BrickCoord c) {
    if (shelf.fill(c) == BrickFill::empty || shelf.get(c, bits) == BrickFill::empty) return;
    const VoxelCoord first = first_voxel(c);
    const VoxelBox both = intersect({first, first_voxel({c.x + 1, c.y + 1, c.z + 1})}, box.box());
    for (std::int32_t z = both.min.z; z < both.max.z; ++z) {
      for (std::int32_t y = both.min.y; y < both.max.y; ++y) {
        box.row(y, z)[(first.x - box.box().min.x) / 64] =
            bits[std::size_t(z - first.z) * kBrickEdge + std::size_t(y - first.y)];
      }
    }
  });
}

void store_voxels(const BitBox& box, BrickShelf& shelf) {
  BrickBits bits;
  for_each(bricks_of(box.box()), [&](BrickCoord c) {
    const VoxelCoord first = first_voxel(c);
    for (std::int32_t z = 0; z < kBrickEdge; ++z) {
      for (std::int32_t y = 0; y < kBrickEdge; ++y) {
        bits[std::size_t(z * kBrickEdge + y)] = box.row(first.y + y, first.z + z)[(first.x - box.box().min.x) / 64];
      }
    }
    shelf.put(c, classify(bits), bits);
  });
}

}  // namespace bp
