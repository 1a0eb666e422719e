#include "lib/pass/hide/entered_rooms.h"

#include <limits>
#include <numeric>
#include <vector>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/grid/brick_voxels.h"
#include "lib/volume/boundary_runs.h"
#include "lib/volume/dilate.h"
#include "lib/volume/entered.h"

namespace bp {

namespace {

constexpr double kSetsForRooms = 4;  // in memory at most: the rooms, those that are entered, P, and one at work

/// Keeps the voxels of `a` that are, or are not, in `b`; the boxes are equal.
void keep(BitBox& a, const BitBox& b, bool in_b) {
  const std::uint64_t turn = in_b ? 0 : ~std::uint64_t(0);
  for (std::int64_t i = 0; i < a.word_count(); ++i) a.data()[i] &= b.data()[i] ^ turn;
}

void check_memory(const VoxelBox& box, const PassContext& context) {
  constexpr double kWord = 64;  // a row of bits has whole words
  const VoxelCoord size = box.size();
  const auto needed = std::uint64_t((size.x + 2 * kWord) * size.y * size.z / 8 * kSetsForRooms);
  if (needed > context.memory.bytes)
    throw NeedsMemory("finding the rooms that can be entered", needed, context.memory.bytes,
                      context.memory.limit_for(needed), {Remedy::larger_voxels});
}

/// Returns the voxels in `box`.
BitBox loaded(const BrickShelf& shelf, const VoxelBox& box) {
  BitBox voxels(box);
  load_voxels(shelf, voxels);
  return voxels;
}

VoxelBox one(VoxelCoord p) {
  return {p, {p.x + 1, p.y + 1, p.z + 1}};
}

/// Takes the voxels out of `voxels` that are connected with `first`, over faces, edges and corners.
std::vector<VoxelCoord> take_part(VoxelCoord first, BitBox& voxels) {
  std::vector<VoxelCoord> part{first};
  voxels.clear(first);
  for (std::size_t i = 0; i < part.size(); ++i) {
    for_each(one(part[i]).grown(1), [&](VoxelCoord p) {
      if (!voxels.test(p)) return;
      voxels.clear(p);
      part.push_back(p);
    });
  }
  return part;
}

}  // namespace

std::int32_t usual_height(const BitBox& solid, int up) {
  constexpr std::int32_t kNone = std::numeric_limits<std::int32_t>::min();
  const VoxelBox& box = solid.box();
  const int u = (up + 1) % 3, v = (up + 2) % 3;
  std::vector<std::int32_t> below(std::size_t(box.size()[u]) * std::size_t(box.size()[v]), kNone);  // by column
  std::vector<std::uint64_t> voxels(std::size_t(box.size()[up]) + 1);                               // by height
  for_each_voxel(solid, [&](VoxelCoord p) {  // upwards in each column
    std::int32_t& last =
        below[std::size_t(p[u] - box.min[u]) * std::size_t(box.size()[v]) + std::size_t(p[v] - box.min[v])];
    if (last != kNone) voxels[std::size_t(p[up] - last - 1)] += std::uint64_t(p[up] - last - 1);
    last = p[up];
  });
  const std::uint64_t all = std::accumulate(voxels.begin(), voxels.end(), std::uint64_t(0));
  std::uint64_t lower = 0;
  for (std::size_t height = 0; height < voxels.size(); ++height) {
    lower += voxels[height];
    if (2 * lower >= all) return std::int32_t(height);
  }
  return 0;
}

std::optional<Entered> entered_by(const StreamHeader& header, const BrickShelf& touched, double body_world,
                                  const PassContext& context) {
  const GridFrame& frame = header.frame;
  const VoxelBox bounds = boundary_size(touched).box;
  check_memory(bounds, context);
  Entered out{body_world, {}};
  if (body_world == 0)
    out.body_world = kBodyOfRoom * frame.voxel * usual_height(loaded(touched, bounds), to_y_up(frame.up).axis[1]);
  if (out.body_world * kBodyWidth < 2 * frame.voxel) {
    if (body_world == 0) return {};
    fail(ErrorCode::bad_argument, {Remedy::smaller_voxels}, "a body {:.4g} high is less than two voxels of {:.4g} wide",
         body_world, frame.voxel);
  }
  if (out.body_world > kMostBodyVox * frame.voxel)
    fail(ErrorCode::bad_argument, {Remedy::larger_voxels}, "a body {:.4g} high is more than {} voxels of {:.4g}",
         out.body_world, kMostBodyVox, frame.voxel);
  const VoxelCoord reach = body_reach(frame, out.body_world, bounds.size());
  const VoxelBox box = box_for_bodies(bounds, reach);
  check_memory(box, context);
  out.voxels = entered_voxels(loaded(touched, box), reach);
  return out;
}

bool leave_open(const BitBox& entered, const BrickShelf& closed, BrickShelf& filled) {
  BitBox rooms = loaded(filled, entered.box());
  keep(rooms, loaded(closed, entered.box()), false);
  BitBox open = rooms;
  keep(open, entered, true);
  grow_within(rooms, open);
  keep(rooms, open, false);
  take_out(open, filled);
  return rooms.count() > 0;
}

void take_out(const BitBox& voxels, BrickShelf& from) {
  const std::vector<BrickCoord> coords = from.coords();
  parallel_for(std::int64_t(coords.size()), [&](std::int64_t i) {
    const BrickCoord at = coords[std::size_t(i)];
    BitBox left = loaded(from, voxels_of({at, {at.x + 1, at.y + 1, at.z + 1}})), taken(left.box());
    copy_voxels(voxels, taken);
    keep(left, taken, false);
    store_voxels(left, from);
  });
}

Entrance entrance_of(const BitBox& entered, const BrickShelf& hidden) {
  BitBox inside = loaded(hidden, entered.box()), border = entered;
  keep(inside, entered, true);
  keep(border, inside, false);
  Entrance out{inside.count(), {}};
  dilate_over_faces(inside, border);
  keep(border, inside, true);
  std::size_t most = 0;
  for_each_voxel(border, [&](VoxelCoord first) {
    if (!border.test(first)) return;  // of an opening before
    const std::vector<VoxelCoord> part = take_part(first, border);
    if (part.size() <= most) return;
    most = part.size(), out.opening = {};
    for (const VoxelCoord p : part) out.opening = hull(out.opening, one(p));
  });
  return out;
}

}  // namespace bp
