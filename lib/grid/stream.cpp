#include "lib/grid/stream.h"

#include <cstring>
#include <tuple>

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

void load_voxels(const BrickShelf& shelf, BitBox& box) {
  const BrickBox bricks = bricks_of(box.box());
  BrickBits bits;
  for (std::int32_t bz = bricks.min.z; bz < bricks.max.z; ++bz) {
    for (std::int32_t by = bricks.min.y; by < bricks.max.y; ++by) {
      for (std::int32_t bx = bricks.min.x; bx < bricks.max.x; ++bx) {
        if (shelf.get({bx, by, bz}, bits) == BrickFill::empty) continue;
        const VoxelBox brick = voxels_of(BrickBox{{bx, by, bz}, {bx + 1, by + 1, bz + 1}});
        const VoxelBox both = intersect(brick, box.box());
        for (std::int32_t z = both.min.z; z < both.max.z; ++z) {
          for (std::int32_t y = both.min.y; y < both.max.y; ++y) {
            box.row(y, z)[(brick.min.x - box.box().min.x) / 64] =
                bits[std::size_t(z - brick.min.z) * kBrickEdge + std::size_t(y - brick.min.y)];
          }
        }
      }
    }
  }
}

void store_voxels(const BitBox& box, BrickShelf& shelf) {
  const BrickBox bricks = bricks_of(box.box());
  BrickBits bits;
  for (std::int32_t bz = bricks.min.z; bz < bricks.max.z; ++bz) {
    for (std::int32_t by = bricks.min.y; by < bricks.max.y; ++by) {
      for (std::int32_t bx = bricks.min.x; bx < bricks.max.x; ++bx) {
        const VoxelCoord first = first_voxel(BrickCoord{bx, by, bz});
        for (std::int32_t z = 0; z < kBrickEdge; ++z) {
          for (std::int32_t y = 0; y < kBrickEdge; ++y) {
            bits[std::size_t(z * kBrickEdge + y)] = box.row(first.y + y, first.z + z)[(first.x - box.box().min.x) / 64];
          }
        }
        shelf.put({bx, by, bz}, classify(bits), bits);
      }
    }
  }
}

}  // namespace bp
