#include "lib/volume/detail/shut_trial.h"

#include <algorithm>

#include "lib/closing/closing.h"
#include "lib/closing/closing_scratch.h"
#include "lib/volume/dilate.h"

namespace bp {

namespace {

/// Returns whether a way over faces of voxels that are not solid leads from the room to the outside within `near`.
bool are_joined(const BitBox& solid, const OpeningSides& sides, const VoxelBox& near) {
  BitBox open(near), reached(near), outside(near);
  for_each(near, [&](VoxelCoord p) {
    if (solid.test(p)) return;
    open.set(p);
    if (sides.room.test(p)) reached.set(p);
    if (sides.outside.test(p)) outside.set(p);
  });
  grow_within(open, reached);
  for (std::int64_t i = 0; i < reached.word_count(); ++i) {
    if ((reached.data()[i] & outside.data()[i]) != 0) return true;
  }
  return false;
}

/// Returns whether a closing leaves no such way.
bool shuts(const BitBox& solid, const OpeningSides& sides, std::int32_t scale_vox, const VoxelBox& near) {
  GridFrame frame;
  frame.voxel = 1;
  ScaleField field;
  field.base = scale_vox + kBeyondWholeVox;
  const Halo halo = halo_of(near, field, frame);
  BitBox known(intersect(near.grown(halo.total_vox()), solid.box())), closed;
  copy_voxels(solid, known);
  ClosingScratch scratch;
  close_tile(known, field.sample(frame, near.grown(halo.erosion_vox)), halo, {}, near, closed, scratch);
  return !are_joined(closed, sides, near);
}

}  // namespace

std::int32_t most_trial_reach(VoxelCoord place, const VoxelBox& all) {
  const auto box = [&](std::int32_t reach) { return OpeningSides::surroundings(place, reach, all); };
  std::int32_t fits = 0, beyond = 1;
  while (box(beyond).volume() <= kMostTried) {
    if (box(beyond) == all) return beyond;
    fits = beyond;
    beyond *= 2;
  }
  while (fits + 1 < beyond) {
    const std::int32_t middle = fits + (beyond - fits) / 2;
    (box(middle).volume() <= kMostTried ? fits : beyond) = middle;
  }
  return fits;
}

ShutTrial try_closings(const BitBox& solid, const OpeningSides& sides, const std::function<void()>& tried) {
  constexpr std::int32_t kSteps = 8;
  using Answer = ShutTrial::Answer;
  const std::int32_t most = sides.most_reach;
  std::int32_t joined = std::min(trial_reach(sides.least), most);
  for (; !are_joined(solid, sides, sides.around(joined)); joined = std::min(2 * joined, most)) {
    if (joined == most) return {};
    tried();
  }
  const std::int32_t last = std::min(3 * sides.least, sides.filled - 1);
  for (std::int32_t scale = sides.least; scale <= last;) {
    const std::int32_t reach = std::max(joined, trial_reach(scale));
    if (reach > most && sides.around(most) != sides.all) return {};
    tried();
    if (shuts(solid, sides, scale, sides.around(reach))) return {Answer::shut, scale};
    scale = scale < last ? std::min(scale + sides.least / kSteps + 1, last) : last + 1;
  }
  return {last == 3 * sides.least ? Answer::open : Answer::filled, 0};
}

}  // namespace bp
