#include "lib/volume/leaks.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/grid/brick_voxels.h"
#include "lib/volume/detail/leak_search.h"

namespace bp {

namespace {

constexpr double kGroundAdds = 1.25;  // standing on the ground multiplies what rooms hold by more than this
// Clearance 2, state 1, lists 4, a way through an opening 8 at most, sets of voxels 1, both sides of the openings that
// are tried 3. Closings are tried after the search has gone, and take less.
constexpr std::uint64_t kBytesPerVoxel = 19;
// Empty voxels around the solid ones: openings in the bounds have an outside.
constexpr std::int32_t kPadding = 2;

/// Returns the solid voxels' bounds with padding; the ground has none below it.
VoxelBox box_of(const BitBox& solid, const std::optional<GroundSide>& ground) {
  VoxelBox box = bounds_of_voxels(solid);
  if (box.empty()) return box;
  const VoxelBox tight = box;
  box = box.grown(kPadding);
  if (ground) (ground->down ? box.max : box.min)[ground->axis] = (ground->down ? tight.max : tight.min)[ground->axis];
  return box;
}

/// Makes the lowest layer of the box solid.
void add_ground(const VoxelBox& box, const GroundSide& ground, BitBox& solid) {
  VoxelBox layer = box;
  (ground.down ? layer.min : layer.max)[ground.axis] =
      ground.down ? box.max[ground.axis] - 1 : box.min[ground.axis] + 1;
  for_each(layer, [&](VoxelCoord p) { solid.set(p); });
}

/// The voxels that are searched, with their ground.
struct Walls {
  VoxelBox box;
  BitBox voxels;
};

Walls walls_of(const BitBox& solid, const std::optional<GroundSide>& ground) {
  Walls walls{box_of(solid, ground), {}};
  walls.voxels.reset(walls.box);
  copy_voxels(solid, walls.voxels);
  if (ground) add_ground(walls.box, *ground, walls.voxels);
  return walls;
}

void check_leak_memory(const VoxelBox& bounds, const MemoryShare& memory) {
  const std::uint64_t needed = leaks_bytes(bounds);
  if (needed > memory.bytes)
    throw NeedsMemory("looking for leaks", needed, memory.bytes, memory.limit_for(needed), {Remedy::larger_voxels});
  if (bounds.grown(kPadding).volume() > std::numeric_limits<std::uint32_t>::max())
    fail(ErrorCode::out_of_resource, {Remedy::larger_voxels}, "looking for leaks: the grid has more than 2^32 voxels");
}

/// Floods from outside; `turn` of `turns` such searches.
FoundLeaks flood_from_outside(const BitBox& solid, const std::optional<GroundSide>& ground,
                              const LeakSearchOptions& options, std::uint64_t turn, std::uint64_t turns) {
  Walls walls = walls_of(solid, ground);
  const auto all = std::uint64_t(walls.box.volume());
  return search_leaks(Clearance(std::move(walls.voxels), walls.box), std::min(options.trials, kMostTrials),
                      [&](std::uint64_t reached) {
                        stop_if_asked();
                        if (options.progress)
                          options.progress("looking for leaks", "voxels", turn * all + reached, turns * all);
                      });
}

/// Tries closings around the leaks of which the sides are known.
void try_leaks(const BitBox& solid, const std::optional<GroundSide>& ground, const LeakSearchOptions& options,
               FoundLeaks& found) {
  if (found.sides.empty()) return;
  const Walls walls = walls_of(solid, ground);
  for (std::size_t i = 0; i < found.sides.size(); ++i) {
    found.leaks.leaks[i].trial = try_closings(walls.voxels, found.sides[i], [&] {
      stop_if_asked();
      if (options.progress) options.progress("trying scales", "leaks", i, found.sides.size());
    });
  }
}

}  // namespace

std::uint64_t leaks_bytes(const VoxelBox& box) {
  return std::uint64_t(box.grown(kPadding).volume()) * kBytesPerVoxel;
}

Leaks find_leaks(const BitBox& solid, const std::optional<GroundSide>& ground, const LeakSearchOptions& options) {
  const VoxelBox bounds = bounds_of_voxels(solid);
  if (bounds.empty()) return {};
  check_leak_memory(bounds, options.memory);
  FoundLeaks found = flood_from_outside(solid, ground, options, 0, 1);
  try_leaks(solid, ground, options, found);
  return std::move(found.leaks);
}

GroundedLeaks find_grounded_leaks(const BitBox& solid, const GroundSide& ground, const LeakSearchOptions& options) {
  const VoxelBox bounds = bounds_of_voxels(solid);
  if (bounds.empty()) return {};
  check_leak_memory(bounds, options.memory);
  FoundLeaks found = flood_from_outside(solid, {}, options, 0, 2);
  FoundLeaks grounded = flood_from_outside(solid, ground, options, 1, 2);
  const bool gains = double(grounded.leaks.all_voxels()) > kGroundAdds * double(found.leaks.all_voxels());
  if (gains) found = std::move(grounded);
  grounded = {};
  try_leaks(solid, gains ? std::optional(ground) : std::nullopt, options, found);
  return {std::move(found.leaks), gains};
}

}  // namespace bp
