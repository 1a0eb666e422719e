#include "lib/volume/mirror.h"

#include <algorithm>

#include "lib/grid/brick_voxels.h"
#include "lib/volume/dilate_ball.h"

namespace bp {

namespace {

/// Adds the part of the mirror image of a brick that lies in the brick `to`.
void add_part(const BrickBits& bits, BrickCoord from, const MirrorPlane& plane, BrickCoord to, BrickShelf& out) {
  BrickBits image;
  (void)out.get(to, image);
  const VoxelCoord origin = first_voxel(to);
  for_each_voxel(bits, from, [&](const VoxelCoord& p) {
    const VoxelCoord q = plane.mirrored(p) - origin;
    if (q[plane.axis] < 0 || q[plane.axis] >= kBrickEdge) return;
    image[std::size_t(q.z * kBrickEdge + q.y)] |= std::uint64_t(1) << q.x;
  });
  out.put(to, classify(image), image);
}

bool holds(const BrickShelf& all, const BrickShelf& part) {
  BrickBits a, b;
  const std::vector<BrickCoord> coords = part.coords();
  return std::all_of(coords.begin(), coords.end(), [&](const BrickCoord& c) {
    (void)all.get(c, a);
    (void)part.get(c, b);
    for (std::size_t i = 0; i < a.size(); ++i) {
      if ((b[i] & ~a[i]) != 0) return false;
    }
    return true;
  });
}

}  // namespace

void add_mirrored(const BrickShelf& voxels, const MirrorPlane& plane, BrickShelf& out) {
  BrickBits bits;
  for (const BrickCoord& c : voxels.coords()) {
    (void)voxels.get(c, bits);
    VoxelCoord last = first_voxel(c);
    last[plane.axis] += kBrickEdge - 1;
    BrickCoord to = brick_of(plane.mirrored(last));
    add_part(bits, c, plane, to, out);
    if (brick_of(plane.mirrored(first_voxel(c))) == to) continue;
    ++to[plane.axis];
    add_part(bits, c, plane, to, out);
  }
}

bool is_symmetric(const BrickShelf& voxels, const MirrorPlane& plane, double reach, const ShelfFactory& make_shelf,
                  const MemoryShare& memory) {
  const auto near = make_shelf(), image = make_shelf();
  dilate_ball(voxels, reach, *near, memory);
  add_mirrored(voxels, plane, *image);
  return holds(*near, *image);
}

}  // namespace bp
