#include "lib/pass/close/same_scales.h"

#include "lib/core/vec3.h"

namespace bp {

bool same_scales(const ScaleField& a, const ScaleField& b, const GridFrame& frame, const VoxelBox& box) {
  constexpr std::int32_t kLeaf = 64;  // voxels: boxes up to this size are sampled, larger ones are split
  if (box.empty()) return true;
  const VoxelBox around = box.grown(2 * kScaleStep);  // the samples of the box's voxels lie there
  const std::int64_t unit = kLatticePerVoxel;
  const Vec3d low = frame.world({around.min.x * unit, around.min.y * unit, around.min.z * unit}),
              high = frame.world({around.max.x * unit, around.max.y * unit, around.max.z * unit});
  const Vec3d centre = 0.5 * (low + high);
  const double radius = length(high - low) / 2;
  const ScaleField here_a = a.near(centre, radius), here_b = b.near(centre, radius);
  if (here_a == here_b) return true;
  int longest = 0;
  for (int axis = 1; axis < 3; ++axis) {
    if (box.size()[axis] > box.size()[longest]) longest = axis;
  }
  if (box.size()[longest] <= kLeaf) return here_a.sample(frame, box).samples == here_b.sample(frame, box).samples;
  VoxelBox lower = box, upper = box;
  lower.max[longest] = upper.min[longest] = box.min[longest] + box.size()[longest] / 2;
  return same_scales(here_a, here_b, frame, lower) && same_scales(here_a, here_b, frame, upper);
}

}  // namespace bp
