#include "lib/pass/hide/possible_rooms.h"

#include "lib/grid/bit_box.h"
#include "lib/grid/scale_field.h"
#include "lib/volume/boundary_runs.h"
#include "lib/volume/dilate.h"
#include "lib/volume/outside.h"

namespace bp {

namespace {

constexpr double kSetsOfBits = 3;  // sets of voxels in memory: the dilation, the one before, and runs of the flood

/// Returns whether the empty voxels of the box have a part that does not reach its sides.
bool has_enclosed(const BitBox& walls) {
  const VoxelBox& box = walls.box();
  OutsideFlood flood(box, box.size());
  flood.join(OutsideFlood::label(walls, box));
  flood.resolve();
  return flood.has_enclosed(box);
}

}  // namespace

std::vector<bool> possible_rooms(const StreamHeader& header, const BrickShelf& enclosed,
                                 const std::vector<double>& scales, const HiddenOptions& options) {
  std::vector<bool> possible(scales.size(), true);
  if (options.element != StructuringElement::cube || scales.empty()) return possible;
  if (scales.back() > kMaxScaleVoxels * header.frame.voxel) return possible;  // refused later
  const auto reach_of = [&](double scale) { return cube_radius(scale_of(scale, header.frame)); };
  const VoxelBox box = boundary_size(enclosed).box.grown(reach_of(scales.back()) + 1);
  if (double(box.volume()) / 8 * kSetsOfBits > double(options.context.memory.bytes)) return possible;
  BitBox walls(box);
  load_voxels(enclosed, walls);
  std::int32_t reach = 0;
  for (std::size_t i = 0; i < scales.size(); ++i) {
    const std::int32_t next = scales[i] < header.frame.voxel ? 0 : reach_of(scales[i]);
    dilate(walls, next - reach);
    reach = next;
    options.context.check();
    possible[i] = next > 0 && has_enclosed(walls);  // the enclosed voxels have no hollows
  }
  return possible;
}

}  // namespace bp
