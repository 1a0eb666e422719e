#include "lib/volume/cell_boxes.h"

#include <bit>

namespace bp {

namespace {

bool holds_next(const BitBox& voxels, const VoxelBox& box, int axis) {
  VoxelBox next = box;
  next.min[axis] = box.max[axis];
  next.max[axis] = box.max[axis] + 1;
  bool all = true;
  for_each(next, [&](VoxelCoord p) { all = all && voxels.test(p); });
  return all;
}

void clear(BitBox& voxels, const VoxelBox& box) {
  for_each(box, [&](VoxelCoord p) { voxels.clear(p); });
}

/// Calls f(voxel) for each voxel that is still set when its turn comes.
template <class F>
void for_each_set(const BitBox& voxels, const F& f) {
  const VoxelBox& box = voxels.box();
  for (std::int32_t z = box.min.z; z < box.max.z; ++z) {
    for (std::int32_t y = box.min.y; y < box.max.y; ++y) {
      const std::uint64_t* row = voxels.row(y, z);
      for (std::int32_t i = 0; i < voxels.words_per_row(); ++i) {
        for (std::uint64_t left = row[i]; left != 0; left &= row[i]) {
          const int bit = std::countr_zero(left);
          f(VoxelCoord{box.min.x + i * 64 + bit, y, z});
          left &= left - 1;
        }
      }
    }
  }
}

/// Returns the first boxes, at most `most`: rows of voxels, adjacent rows joined to plates, adjacent plates joined to
/// boxes.
std::vector<VoxelBox> boxes_of(BitBox voxels, std::size_t most) {
  std::vector<VoxelBox> boxes;
  for_each_set(voxels, [&](VoxelCoord p) {
    if (boxes.size() == most) return;
    VoxelBox box{p, {p.x + 1, p.y + 1, p.z + 1}};
    for (const int axis : {0, 1, 2}) {
      while (holds_next(voxels, box, axis)) ++box.max[axis];
    }
    clear(voxels, box);
    boxes.push_back(box);
  });
  return boxes;
}

/// Returns the set in voxels twice as large: v lies in floor(v / 2).
BitBox halved(const BitBox& voxels) {
  VoxelBox box = voxels.box();
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = floor_div(box.min[axis], 2);
    box.max[axis] = ceil_div(box.max[axis], 2);
  }
  BitBox out(box);
  for_each_set(voxels, [&](VoxelCoord p) { out.set({floor_div(p.x, 2), floor_div(p.y, 2), floor_div(p.z, 2)}); });
  return out;
}

}  // namespace

FewBoxes few_boxes_of(BitBox voxels, std::size_t most) {
  FewBoxes few{boxes_of(voxels, most + 1)};
  while (few.boxes.size() > most) {
    voxels = halved(voxels);
    few = {boxes_of(voxels, most + 1), few.unit * 2};
  }
  return few;
}

}  // namespace bp
