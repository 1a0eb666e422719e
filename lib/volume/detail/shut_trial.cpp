#include "lib/volume/detail/shut_trial.h"

#include <vector>

#include "lib/closing/closing.h"
#include "lib/closing/closing_scratch.h"

namespace bp {

namespace {

/// Returns whether the closing separates both sides of the opening within the box `near`.
bool shuts(const OpeningSides& sides, std::int32_t scale_vox, const VoxelBox& near) {
  GridFrame frame;
  frame.voxel = 1;
  ScaleField field;
  field.base = scale_vox + kBeyondWholeVox;
  const Halo halo = halo_of(near, field, frame);
  BitBox around(intersect(near.grown(halo.total_vox()), sides.solid.box())), closed;
  copy_voxels(sides.solid, around);
  ClosingScratch scratch;
  close_tile(around, field.sample(frame, near.grown(halo.erosion_vox)), halo, {}, near, closed, scratch);
  std::vector<VoxelCoord> reached;
  const auto reach = [&](VoxelCoord p) {
    closed.set(p);
    reached.push_back(p);
  };
  for_each(near, [&](VoxelCoord p) {
    if (!closed.test(p) && sides.room(p)) reach(p);
  });
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const VoxelCoord p = reached[i];
    if (sides.outside(p)) return false;
    for (int axis = 0; axis < 3; ++axis) {
      for (const std::int32_t step : {-1, 1}) {
        VoxelCoord q = p;
        q[axis] += step;
        if (near.contains(q) && !closed.test(q)) reach(q);
      }
    }
  }
  return true;
}

}  // namespace

std::int32_t least_shutting_scale(const OpeningSides& sides, std::int32_t least) {
  constexpr std::int32_t kSteps = 8;
  for (std::int32_t scale = least; scale <= 3 * least; scale += least / kSteps + 1) {
    const VoxelBox around = VoxelBox{sides.place, sides.place + VoxelCoord{1, 1, 1}}.grown(trial_reach(scale));
    const VoxelBox near = intersect(around, sides.solid.box());
    if (near.volume() > kMostTried) return 0;
    if (shuts(sides, scale, near)) return scale;
  }
  return 0;
}

}  // namespace bp
