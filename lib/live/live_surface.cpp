#include "lib/live/live_surface.h"

#include <algorithm>
#include <bit>

#include "lib/core/parallel.h"
#include "lib/pass/close/same_scales.h"
#include "lib/volume/boundary_runs.h"
#include "lib/volume/reduce.h"

namespace bp {

namespace {

/// Returns the voxels of a brick in which two solids differ, as a box; empty if they agree.
VoxelBox differing(const BrickBits& of_a, const BrickBits& of_b, BrickCoord brick) {
  VoxelBox box;
  const VoxelCoord first = first_voxel(brick);
  for (std::int32_t i = 0; i < std::int32_t(of_a.size()); ++i) {
    const std::uint64_t bits = of_a[std::size_t(i)] ^ of_b[std::size_t(i)];
    if (bits == 0) continue;
    const std::int32_t y = first.y + i % kBrickEdge, z = first.z + i / kBrickEdge;
    box = hull(box, {{first.x + std::countr_zero(bits), y, z}, {first.x + 64 - std::countl_zero(bits), y + 1, z + 1}});
  }
  return box;
}

}  // namespace

SurfacePiece LiveSurface::Change::piece(BrickCoord brick) const {
  return piece_of(*voxels, brick, scale->sample(frame, voxels_of(brick).grown(1)));
}

LiveSurface::LiveSurface(ShelfFactory make_shelf, std::uint64_t most_faces)
    : make_shelf_(std::move(make_shelf)), most_faces_(most_faces) {}

std::uint64_t LiveSurface::show(const GridFrame& frame, std::shared_ptr<const BrickShelf> voxels,
                                const ScaleField& scale) {
  Shown next{frame, std::move(voxels), std::make_shared<const ScaleField>(scale)};
  const std::uint64_t count = make_drawable(next);
  const bool whole = shown_.voxels == nullptr || !(shown_.frame == next.frame);
  std::set<BrickCoord> changed;
  if (whole) {
    for (const BrickCoord c : next.voxels->coords()) changed.insert(c);
  } else {
    changed = changed_voxels(next);
    add_changed_scales(next, changed);
  }
  const std::lock_guard lock(mutex_);
  if (whole || !changed.empty()) ++generation_;
  if (whole) {
    changed_in_.clear();
    whole_since_ = generation_;
  }
  for (const BrickCoord c : changed) {
    const bool has_none = next.voxels->fill(c) == BrickFill::empty || is_buried(*next.voxels, c);
    if (!has_none || changed_in_.contains(c)) changed_in_[c] = generation_;
  }
  shown_ = std::move(next);
  return count;
}

std::uint64_t LiveSurface::make_drawable(Shown& next) const {
  const std::uint64_t count = count_voxels(*next.voxels);
  while (boundary_size(*next.voxels).faces > most_faces_) {
    const std::shared_ptr<BrickShelf> coarse = make_shelf_();
    reduce(*next.voxels, next.frame, *coarse);
    next.frame = reduced(next.frame);
    next.voxels = coarse;
  }
  return count;
}

std::set<BrickCoord> LiveSurface::changed_voxels(const Shown& next) const {
  const std::vector<BrickCoord> before = shown_.voxels->coords(), now = next.voxels->coords();
  std::vector<BrickCoord> all;
  std::set_union(before.begin(), before.end(), now.begin(), now.end(), std::back_inserter(all));
  std::vector<VoxelBox> boxes(all.size());
  parallel_for(std::int64_t(all.size()), [&](std::int64_t i) {
    BrickBits of_a, of_b;
    (void)shown_.voxels->get(all[std::size_t(i)], of_a);
    (void)next.voxels->get(all[std::size_t(i)], of_b);
    boxes[std::size_t(i)] = differing(of_a, of_b, all[std::size_t(i)]);
  });
  std::set<BrickCoord> changed;
  for (const VoxelBox& box : boxes) {
    if (!box.empty()) for_each(bricks_of(box.grown(piece_apron())), [&](BrickCoord c) { changed.insert(c); });
  }
  return changed;
}

void LiveSurface::add_changed_scales(const Shown& next, std::set<BrickCoord>& changed) const {
  if (*shown_.scale == *next.scale) return;
  const std::vector<BrickCoord> bricks = next.voxels->coords();
  std::vector<char> differs(bricks.size());
  parallel_for(std::int64_t(bricks.size()), [&](std::int64_t i) {
    const BrickCoord c = bricks[std::size_t(i)];
    differs[std::size_t(i)] = !same_scales(*shown_.scale, *next.scale, next.frame, voxels_of(c).grown(1));
  });
  for (std::size_t i = 0; i < bricks.size(); ++i) {
    if (differs[i] != 0) changed.insert(bricks[i]);
  }
}

std::uint64_t LiveSurface::generation() const {
  const std::lock_guard lock(mutex_);
  return generation_;
}

double LiveSurface::drawn_voxel() const {
  const std::lock_guard lock(mutex_);
  return shown_.voxels == nullptr ? 0 : shown_.frame.voxel;
}

LiveSurface::Change LiveSurface::since(std::uint64_t generation) const {
  const std::lock_guard lock(mutex_);
  Change change{generation_, generation < whole_since_, shown_.frame, shown_.voxels, shown_.scale, {}};
  for (const auto& [brick, number] : changed_in_) {
    if (change.whole || number > generation) change.bricks.push_back(brick);
  }
  return change;
}

}  // namespace bp
