#include "lib/volume/leaks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/grid/brick_voxels.h"
#include "lib/volume/detail/clearance.h"
#include "lib/volume/detail/shut_trial.h"
#include "lib/volume/dilate.h"

namespace bp {

namespace {

// A room is wider than its opening by this factor, at least; less is an uneven wall of an alley or of a court.
constexpr std::int32_t kWiderBy = 5, kWiderOf = 4;
constexpr std::uint64_t kLeastRoom = 1000;  // rooms below one part in so many of the largest are left out
constexpr double kGroundAdds = 1.25;        // standing on the ground multiplies what rooms hold by more than this
// Clearance 2, state 1, lists 4, a way through an opening 8 at most, sets of voxels 1, a closing around an opening 2.
constexpr std::uint64_t kBytesPerVoxel = 18;
// Empty voxels around the solid ones: openings in the bounds have an outside.
constexpr std::int32_t kPadding = 2;
// Voxels from the middle of a way within which an opening is looked at; doubled while it is longer.
constexpr std::int32_t kFirstReach = 16, kLastReach = 128;

/// Floods the empty voxels from the outside along the widest ways first (Prim's maximum spanning tree).
class LeakSearch {
 public:
  explicit LeakSearch(Clearance clearance)
      : clearance_(std::move(clearance)),
        box_(clearance_.box()),
        steps_{1, Index(box_.size().x), Index(box_.size().x) * Index(box_.size().y)},
        state_(std::size_t(box_.volume())),
        next_(state_.size()),
        queue_(std::size_t(clearance_.largest()) + 1, kNone) {}

  Leaks run() {
    enter();
    for (std::int32_t level = clearance_.largest(); level > 0; --level) {
      while (queue_[std::size_t(level)] != kNone) flood(pop(level), level);
    }
    Leaks out;
    for (std::size_t i = 0; i < state_.size(); ++i)
      out.closed_voxels += std::uint64_t((state_[i] & kReached) == 0 && clearance_[i] > 0);
    std::sort(leaks_.begin(), leaks_.end(), [](const Leak& a, const Leak& b) {
      return a.room_voxels != b.room_voxels ? a.room_voxels > b.room_voxels : a.place < b.place;
    });
    while (!leaks_.empty() && leaks_.back().room_voxels < leaks_.front().room_voxels / kLeastRoom) leaks_.pop_back();
    out.leaks = std::move(leaks_);
    return out;
  }

 private:
  using Index = std::uint32_t;
  static constexpr std::uint8_t kReached = 1, kInRoom = 2, kOnWay = 4, kAtSide = 8;

  /// Begins at the sides of the box. From there a straight way leads out, and its clearance never falls: all solid
  /// voxels lie behind. On the ground that side is solid.
  void enter() {
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool high : {false, true}) {
        VoxelBox side = box_;
        (high ? side.min : side.max)[axis] = high ? box_.max[axis] - 1 : box_.min[axis] + 1;
        for_each(side, [&](VoxelCoord p) { state_[index_of(p)] = kAtSide; });
      }
    }
    for (std::size_t i = 0; i < state_.size(); ++i) {
      if (state_[i] == kAtSide && clearance_[i] > 0) push(Index(i));
    }
  }

  /// Handles a voxel of the outside whose clearance is the least so far. Neighbours with more are behind an opening.
  void flood(Index i, std::int32_t level) {
    for_each_neighbor(i, [&](Index next) {
      if ((state_[next] & kReached) != 0 || clearance_[next] == 0) return;
      if (clearance_[next] > level) {
        fill_room(next, level);
      } else {
        push(next);
      }
    });
  }

  /// Floods a room: all that is reached from `first` with a clearance above the level.
  void fill_room(Index first, std::int32_t level) {
    room_ = kNone;
    std::int32_t most = level;
    push(first);
    for (std::int32_t key = clearance_[first]; key > level;) {
      if (queue_[std::size_t(key)] == kNone) {
        --key;
        continue;
      }
      const Index i = pop(key);
      next_[i] = std::exchange(room_, i);
      most = std::max(most, clearance_[i]);
      for_each_neighbor(i, [&](Index next) {
        if ((state_[next] & kReached) != 0 || clearance_[next] == 0) return;
        push(next);
        key = std::max(key, clearance_[next]);
      });
    }
    if (most * kWiderOf >= level * kWiderBy) add_leak(level, most);
  }

  void add_leak(std::int32_t level, std::int32_t most) {
    for_each_in_room([&](Index i) { state_[i] |= kInRoom; });
    Leak leak;
    leak.clearance = level;
    leak.room_clearance = most;
    if (find_way(level, leak)) {
      leak.room_voxels = room_voxels(level);
      leak.shut_at = shut_at(leak);
      leaks_.push_back(leak);
    }
    for_each_in_room([&](Index i) { state_[i] &= std::uint8_t(~kInRoom); });
  }

  /// Tries closings around the opening, while the voxels of the room are marked.
  [[nodiscard]] std::int32_t shut_at(const Leak& leak) const {
    const OpeningSides sides{
        clearance_.solid(), leak.place, [&](VoxelCoord p) { return (state_[index_of(p)] & kInRoom) != 0; },
        [&](VoxelCoord p) { return is_outside(index_of(p), leak.clearance) || (state_[index_of(p)] & kAtSide) != 0; }};
    return least_shutting_scale(sides, leak.clearance);
  }

  /// Returns whether the outside has reached a voxel that is wider than the opening of the marked room.
  [[nodiscard]] bool is_outside(Index i, std::int32_t level) const {
    return clearance_[i] > level && (state_[i] & (kReached | kInRoom)) == kReached;
  }

  /// Finds the shortest way through voxels of the level, from the room to what was reached before it, and the middle of
  /// the opening on it.
  bool find_way(std::int32_t level, Leak& leak) {
    way_.clear();
    way_.reserve(clearance_.count(level));
    const auto add = [&](Index i, Index from) {
      if (clearance_[i] != level || (state_[i] & kOnWay) != 0) return;
      state_[i] |= kOnWay;
      way_.push_back({i, from});
    };
    for_each_in_room([&](Index i) { for_each_neighbor(i, [&](Index next) { add(next, kNone); }); });
    std::optional<Index> last;  // of the way
    for (std::size_t k = 0; k < way_.size() && !last; ++k) {
      if ((state_[way_[k].voxel] & kAtSide) != 0) last = Index(k), leak.outer = coord_of(way_[k].voxel);
      for_each_neighbor(way_[k].voxel, [&](Index next) {
        if (!last && is_outside(next, level)) last = Index(k), leak.outer = coord_of(next);
      });
      if (!last) for_each_neighbor(way_[k].voxel, [&](Index next) { add(next, Index(k)); });
    }
    for (const Step& step : way_) state_[step.voxel] &= std::uint8_t(~kOnWay);
    if (last) finish(*last, leak);
    return last.has_value();
  }

  /// Sets the place, the inner end and the width.
  void finish(Index last, Leak& leak) {
    std::vector<VoxelCoord> way;
    Index first = last;
    for (Index k = last; k != kNone; first = k, k = way_[k].from) way.push_back(coord_of(way_[k].voxel));
    for_each_neighbor(way_[first].voxel, [&](Index next) {
      if ((state_[next] & kInRoom) != 0) leak.inner = coord_of(next);
    });
    for (std::int32_t reach = kFirstReach; reach <= kLastReach; reach *= 2) {
      if (set_place(way, reach, leak)) break;
    }
    const double straight = 2 * std::sqrt(double(clearance_.squared_distance(leak.place)));
    leak.width = std::min(std::int32_t(std::ceil(straight)), clearance_.least_run(leak.place));
  }

  /// Sets the place to the middle of the opening's voxels that are nearest to solid ones, straight, and connected with
  /// the way. The opening's voxels lie in no free cube that is wider. Returns false if there are some farther away than
  /// `reach` from the middle of the way; these do not count.
  [[nodiscard]] bool set_place(const std::vector<VoxelCoord>& way, std::int32_t reach, Leak& leak) const {
    const VoxelCoord middle = way[way.size() / 2];
    const VoxelBox near = intersect(box_, VoxelBox{middle, middle + VoxelCoord{1, 1, 1}}.grown(reach + leak.clearance));
    BitBox wide(near), opening(near);
    for_each(near, [&](VoxelCoord p) {
      if (clearance_[index_of(p)] > leak.clearance) wide.set(p);
    });
    dilate(wide, leak.clearance);
    std::vector<VoxelCoord> open = narrowest(way, wide);
    const std::int64_t squared = clearance_.squared_distance(open[0]);
    for (const VoxelCoord p : open) opening.set(p);
    bool all = true;
    for (std::size_t k = 0; k < open.size(); ++k) {
      const VoxelBox around = VoxelBox{open[k], open[k] + VoxelCoord{1, 1, 1}}.grown(1);
      for_each(intersect(near, around), [&](VoxelCoord p) {
        if (clearance_[index_of(p)] != leak.clearance || opening.test(p) || wide.test(p) ||
            clearance_.squared_distance(p) != squared)
          return;
        opening.set(p);
        all = all && distance(p, middle) < reach;
        if (distance(p, middle) <= reach) open.push_back(p);
      });
    }
    leak.place = nearest_to_mean(open);
    return all;
  }

  /// Returns the voxels of the way that are nearest to solid ones, straight: of those in no wider cube, if there are
  /// any near.
  [[nodiscard]] std::vector<VoxelCoord> narrowest(const std::vector<VoxelCoord>& way, const BitBox& wide) const {
    std::vector<VoxelCoord> best;
    std::int64_t least = 0;
    for (const bool in_any : {false, true}) {
      for (const VoxelCoord p : way) {
        if (!wide.box().contains(p) || (wide.test(p) && !in_any)) continue;
        const std::int64_t squared = clearance_.squared_distance(p);
        if (best.empty() || squared < least) best.clear(), least = squared;
        if (squared == least) best.push_back(p);
      }
      if (!best.empty()) break;
    }
    return best;
  }

  [[nodiscard]] static std::int32_t distance(VoxelCoord a, VoxelCoord b) {
    return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
  }

  [[nodiscard]] static VoxelCoord nearest_to_mean(const std::vector<VoxelCoord>& voxels) {
    std::int64_t sum[3] = {0, 0, 0};
    const auto n = std::int64_t(voxels.size());
    for (const VoxelCoord p : voxels) {
      for (int axis = 0; axis < 3; ++axis) sum[axis] += p[axis];
    }
    const auto off = [&](VoxelCoord p) {  // n times the distance
      double squared = 0;
      for (int axis = 0; axis < 3; ++axis) squared += std::pow(double(p[axis] * n - sum[axis]), 2);
      return squared;
    };
    return *std::min_element(voxels.begin(), voxels.end(),
                             [&](VoxelCoord a, VoxelCoord b) { return off(a) != off(b) ? off(a) < off(b) : a < b; });
  }

  /// Counts the voxels of the cubes around the room's voxels that are free, and wider than the opening.
  [[nodiscard]] std::uint64_t room_voxels(std::int32_t level) const {
    VoxelBox bounds;
    for_each_in_room([&](Index i) {
      const VoxelCoord p = coord_of(i);
      bounds = hull(bounds, VoxelBox{p, {p.x + 1, p.y + 1, p.z + 1}});
    });
    BitBox room(intersect(bounds.grown(level), box_));
    for_each_in_room([&](Index i) { room.set(coord_of(i)); });
    dilate(room, level);
    std::uint64_t count = 0;  // the words of a row may end beyond the box
    for_each_voxel(room, [&](VoxelCoord p) { count += std::uint64_t(box_.contains(p)); });
    return count;
  }

  void push(Index i) {
    state_[i] |= kReached;
    next_[i] = std::exchange(queue_[std::size_t(clearance_[i])], i);
  }
  Index pop(std::int32_t key) {
    const Index i = queue_[std::size_t(key)];
    queue_[std::size_t(key)] = next_[i];
    return i;
  }
  template <class F>
  void for_each_in_room(const F& f) const {
    for (Index i = room_; i != kNone; i = next_[i]) f(i);
  }

  [[nodiscard]] Index index_of(VoxelCoord p) const { return Index(clearance_.index_of(p)); }
  [[nodiscard]] VoxelCoord coord_of(Index i) const { return clearance_.coord_of(i); }

  template <class F>
  void for_each_neighbor(Index i, const F& f) const {
    if ((state_[i] & kAtSide) == 0) {  // nearly all; no coordinates are needed
      for (const Index step : steps_) {
        f(i - step);
        f(i + step);
      }
      return;
    }
    const VoxelCoord p = coord_of(i);
    for (int axis = 0; axis < 3; ++axis) {
      for (const std::int32_t way : {-1, 1}) {
        VoxelCoord q = p;
        q[axis] += way;
        if (q[axis] >= box_.min[axis] && q[axis] < box_.max[axis]) f(index_of(q));
      }
    }
  }

  static constexpr Index kNone = ~Index(0);
  struct Step {
    Index voxel, from;  // from: position in way_ of the step before
  };
  const Clearance clearance_;
  const VoxelBox box_;
  const Index steps_[3];  // between neighbours along the axes
  std::vector<std::uint8_t> state_;
  std::vector<Index> next_;   // the next voxel of the list that holds one: of queue_, or of the room
  std::vector<Index> queue_;  // first voxel by clearance
  Index room_ = kNone;        // first voxel
  std::vector<Step> way_;
  std::vector<Leak> leaks_;
};

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

}  // namespace

std::uint64_t leaks_bytes(const VoxelBox& box) {
  return std::uint64_t(box.grown(kPadding).volume()) * kBytesPerVoxel;
}

Leaks find_leaks(const BitBox& solid, const std::optional<GroundSide>& ground, const MemoryShare& memory) {
  const VoxelBox box = box_of(solid, ground);
  if (box.empty()) return {};
  const std::uint64_t needed = leaks_bytes(bounds_of_voxels(solid));
  if (needed > memory.bytes)
    throw NeedsMemory("looking for leaks", needed, memory.bytes, memory.limit_for(needed), {Remedy::larger_voxels});
  if (box.volume() > std::numeric_limits<std::uint32_t>::max())
    fail(ErrorCode::out_of_resource, {Remedy::larger_voxels}, "looking for leaks: the grid has more than 2^32 voxels");
  BitBox walls(box);
  copy_voxels(solid, walls);
  if (ground) add_ground(box, *ground, walls);
  return LeakSearch(Clearance(std::move(walls), box)).run();
}

GroundedLeaks find_grounded_leaks(const BitBox& solid, const GroundSide& ground, const MemoryShare& memory) {
  Leaks floating = find_leaks(solid, {}, memory), grounded = find_leaks(solid, ground, memory);
  const bool gains = double(grounded.all_voxels()) > kGroundAdds * double(floating.all_voxels());
  return {gains ? std::move(grounded) : std::move(floating), gains};
}

}  // namespace bp
