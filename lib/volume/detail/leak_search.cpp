#include "lib/volume/detail/leak_search.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "lib/grid/brick_voxels.h"
#include "lib/volume/dilate.h"

namespace bp {

namespace {

// A room is wider than its opening by this factor, at least; less is an uneven wall of an alley or of a court.
constexpr std::int32_t kWiderBy = 5, kWiderOf = 4;
constexpr std::uint64_t kLeastRoom = 1000;  // rooms below one part in so many of the largest are left out
// Voxels from the middle of a way within which an opening is looked at; doubled while it is longer.
constexpr std::int32_t kFirstReach = 16, kLastReach = 128;
constexpr std::uint64_t kReportEvery = 1 << 16;  // voxels

/// Floods the empty voxels from the outside along the widest ways first (Prim's maximum spanning tree).
class LeakSearch {
 public:
  LeakSearch(Clearance clearance, const std::function<void(std::uint64_t)>& reached)
      : clearance_(std::move(clearance)),
        reached_(reached),
        box_(clearance_.box()),
        steps_{1, Index(box_.size().x), Index(box_.size().x) * Index(box_.size().y)},
        state_(std::size_t(box_.volume())),
        next_(state_.size()),
        queue_(std::size_t(clearance_.largest()) + 1, kNone) {}

  /// `trials`: the number of leaks of which the sides are wanted.
  FoundLeaks run(std::size_t trials) {
    enter();
    for (std::int32_t level = clearance_.largest(); level > 0; --level) {
      while (queue_[std::size_t(level)] != kNone) flood(pop(level), level);
    }
    FoundLeaks out;
    for (std::size_t i = 0; i < state_.size(); ++i)
      out.leaks.closed_voxels += std::uint64_t((state_[i] & kReached) == 0 && clearance_[i] > 0);
    std::sort(found_.begin(), found_.end(), [](const Found& a, const Found& b) {
      return a.leak.room_voxels != b.leak.room_voxels ? a.leak.room_voxels > b.leak.room_voxels
                                                      : a.leak.place < b.leak.place;
    });
    for (const Found& found : found_) {
      if (found.leak.room_voxels < found_.front().leak.room_voxels / kLeastRoom) break;
      out.leaks.leaks.push_back(found.leak);
      if (out.sides.size() < trials) out.sides.push_back(sides_of(found));
    }
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
    ++rooms_;
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
    for (Index i = room_; i != kNone;) i = std::exchange(next_[i], rooms_);
  }

  void add_leak(std::int32_t level, std::int32_t most) {
    for_each_in_room([&](Index i) { state_[i] |= kInRoom; });
    Leak leak;
    leak.clearance = level;
    leak.room_clearance = most;
    if (find_way(level, leak)) {
      leak.room_voxels = room_voxels(level);
      found_.push_back({leak, rooms_});
    }
    for_each_in_room([&](Index i) { state_[i] &= std::uint8_t(~kInRoom); });
  }

  struct Found {
    Leak leak;
    std::uint32_t room;
  };

  /// Returns the voxels on both sides of a leak. The outside is what had been reached before the room.
  [[nodiscard]] OpeningSides sides_of(const Found& found) const {
    const Leak& leak = found.leak;
    OpeningSides sides{leak.place,         box_, most_trial_reach(leak.place, box_), {}, {}, leak.clearance,
                       leak.room_clearance};
    const VoxelBox near = sides.around(sides.most_reach);
    sides.room.reset(near);
    sides.outside.reset(near);
    for_each(near, [&](VoxelCoord p) {
      const Index i = index_of(p);
      const bool is_wide = clearance_[i] > leak.clearance && (state_[i] & kReached) != 0;
      if (is_wide && next_[i] == found.room) sides.room.set(p);
      if ((is_wide && next_[i] < found.room) || (state_[i] & kAtSide) != 0) sides.outside.set(p);
    });
    return sides;
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
    if (++pushed_ % kReportEvery == 0) reached_(pushed_);
  }
  Index pop(std::int32_t key) {
    const Index i = queue_[std::size_t(key)];
    queue_[std::size_t(key)] = std::exchange(next_[i], rooms_);
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
  const std::function<void(std::uint64_t)>& reached_;
  const VoxelBox box_;
  const Index steps_[3];  // between neighbours along the axes
  std::vector<std::uint8_t> state_;
  // The next voxel of the list that holds one: of queue_, or of the room. After the flood has left a voxel: the number
  // of the room that holds it or that was flooded last.
  std::vector<Index> next_;
  std::vector<Index> queue_;  // first voxel by clearance
  Index room_ = kNone;        // first voxel
  std::uint32_t rooms_ = 0;   // rooms that were flooded
  std::uint64_t pushed_ = 0;  // voxels that were reached
  std::vector<Step> way_;
  std::vector<Found> found_;
};

}  // namespace

FoundLeaks search_leaks(Clearance clearance, std::size_t trials, const std::function<void(std::uint64_t)>& reached) {
  return LeakSearch(std::move(clearance), reached).run(trials);
}

}  // namespace bp
