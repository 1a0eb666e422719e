#include <atomic>
#include <map>
#include <random>
#include <string>

#include "lib/closing/closing.h"
#include "lib/closing/closing_scratch.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/grid/brick_voxels.h"
#include "lib/volume/detail/leak_search.h"
#include "lib/volume/dilate.h"
#include "lib/volume/leaks.h"
#include "tests/catch.h"

using namespace bp;

namespace {

constexpr GroundSide kYUp{1, false};

void put(BitBox& voxels, const VoxelBox& box) {
  for_each(box, [&](VoxelCoord p) { voxels.set(p); });
}
void cut(BitBox& voxels, const VoxelBox& box) {
  for_each(box, [&](VoxelCoord p) { voxels.clear(p); });
}

/// A hollow box with walls of `wall` voxels.
void put_house(BitBox& voxels, const VoxelBox& box, std::int32_t wall) {
  put(voxels, box);
  cut(voxels, box.grown(-wall));
}

std::int32_t off(VoxelCoord a, VoxelCoord b) {
  std::int32_t most = 0;
  for (int axis = 0; axis < 3; ++axis) most = std::max(most, std::abs(a[axis] - b[axis]));
  return most;
}

/// The definitions, voxel by voxel.
class PlainLeaks {
 public:
  explicit PlainLeaks(const BitBox& solid) : solid_(solid) {
    VoxelBox bounds;
    for_each_voxel(solid, [&](VoxelCoord p) { bounds = hull(bounds, VoxelBox{p, {p.x + 1, p.y + 1, p.z + 1}}); });
    box_ = bounds.grown(2);
    for_each(box_, [&](VoxelCoord p) { clearance_[p] = clearance_of(p); });
    widen();
  }

  /// Returns the clearances of the opening and of the room, and the room's voxels, in the order of find_leaks().
  [[nodiscard]] std::vector<std::array<std::int64_t, 3>> leaks() const {
    std::vector<std::array<std::int64_t, 3>> all;
    std::map<VoxelCoord, bool> seen;
    for (const auto& [first, reach] : reach_) {
      if (reach == 0 || clearance_.at(first) <= reach || seen[first]) continue;
      std::vector<VoxelCoord> room{first};
      seen[first] = true;
      std::int32_t most = 0;
      for (std::size_t k = 0; k < room.size(); ++k) {
        const VoxelCoord p = room[k];
        most = std::max(most, clearance_.at(p));
        for_each_neighbor(p, [&](VoxelCoord q) {
          if (clearance_.at(q) > reach && !seen[q]) seen[q] = true, room.push_back(q);
        });
      }
      if (4 * most < 5 * reach) continue;
      std::map<VoxelCoord, bool> cubes;
      for (const VoxelCoord p : room)
        for_each(VoxelBox{p, {p.x + 1, p.y + 1, p.z + 1}}.grown(reach), [&](VoxelCoord q) { cubes[q] = true; });
      all.push_back({std::int64_t(cubes.size()), reach, most});
    }
    std::sort(all.rbegin(), all.rend());
    return all;
  }
  [[nodiscard]] std::uint64_t closed() const {
    std::uint64_t n = 0;
    for (const auto& [p, reach] : reach_) n += std::uint64_t(reach == 0 && clearance_.at(p) > 0);
    return n;
  }
  [[nodiscard]] std::int32_t clearance(VoxelCoord p) const { return clearance_.at(p); }

 private:
  [[nodiscard]] std::int32_t clearance_of(VoxelCoord p) const {
    for (std::int32_t r = 0;; ++r) {
      bool any = false;
      for_each(VoxelBox{p, {p.x + 1, p.y + 1, p.z + 1}}.grown(r), [&](VoxelCoord q) { any = any || solid_.test(q); });
      if (any) return r;
    }
  }
  template <class F>
  void for_each_neighbor(VoxelCoord p, const F& f) const {
    for (int axis = 0; axis < 3; ++axis) {
      for (const std::int32_t way : {-1, 1}) {
        VoxelCoord q = p;
        q[axis] += way;
        if (box_.contains(q)) f(q);
      }
    }
  }
  /// Sets the bottleneck of the widest way from outside to each voxel, again and again until nothing changes.
  void widen() {
    for_each(box_, [&](VoxelCoord p) { reach_[p] = box_.grown(-1).contains(p) ? 0 : clearance_.at(p); });
    for (bool any = true; any;) {
      any = false;
      for (auto& [p, reach] : reach_) {
        for_each_neighbor(p, [&](VoxelCoord q) {
          const std::int32_t through = std::min(reach_.at(q), clearance_.at(p));
          if (through > reach) reach = through, any = true;
        });
      }
    }
  }

  const BitBox& solid_;
  VoxelBox box_;
  std::map<VoxelCoord, std::int32_t> clearance_, reach_;
};

}  // namespace

TEST_CASE("a slit of one voxel in a roof is found to the voxel", "[leaks]") {
  BitBox house(VoxelBox{{-10, -10, -10}, {70, 50, 50}});
  put_house(house, {{3, 5, 2}, {43, 35, 32}}, 2);
  cut(house, {{17, 33, 11}, {18, 35, 20}});  // 1 x 9 voxels through the roof
  const Leaks found = find_leaks(house);
  REQUIRE(found.leaks.size() == 1);
  const Leak& leak = found.leaks[0];
  CHECK(off(leak.place, {17, 33, 15}) <= 1);
  CHECK(leak.width == 1);
  CHECK(leak.clearance == 1);
  CHECK(leak.room_clearance == 13);
  CHECK(leak.room_voxels == 36 * 26 * 26);
  CHECK(leak.inner.y < leak.outer.y);
  CHECK(found.closed_voxels == 0);
}

TEST_CASE("a missing pane is found in its middle", "[leaks]") {
  BitBox house(VoxelBox{{0, 0, 0}, {64, 40, 40}});
  put_house(house, {{1, 1, 1}, {51, 31, 31}}, 1);
  cut(house, {{20, 12, 30}, {28, 18, 31}});  // 8 x 6 voxels in the wall at the largest z
  const Leaks found = find_leaks(house);
  REQUIRE(found.leaks.size() == 1);
  CHECK(found.leaks[0].width == 6);
  CHECK(found.leaks[0].clearance == 3);
  CHECK(off(found.leaks[0].place, {23, 14, 30}) <= 1);
  CHECK(found.leaks[0].outer.z > found.leaks[0].inner.z);
}

TEST_CASE("a hole in a floor and an open door are two leaks, if the hole is the narrower one", "[leaks]") {
  BitBox house(VoxelBox{{0, 0, 0}, {80, 50, 50}});
  put_house(house, {{2, 2, 2}, {62, 42, 32}}, 1);
  put(house, {{2, 21, 2}, {62, 22, 32}});    // the floor between the storeys
  cut(house, {{40, 21, 10}, {43, 22, 14}});  // 3 x 4
  cut(house, {{10, 3, 2}, {17, 17, 3}});     // 7 x 14
  const Leaks found = find_leaks(house);
  REQUIRE(found.leaks.size() == 2);
  const Leak &above = found.leaks[0], &below = found.leaks[1];
  CHECK(above.room_voxels == 58 * 19 * 28);
  CHECK(above.width == 3);
  CHECK(off(above.place, {41, 21, 12}) <= 1);
  CHECK(below.room_voxels == 58 * 18 * 28);
  CHECK(below.width == 7);
  CHECK(off(below.place, {13, 10, 2}) <= 1);

  cut(house, {{40, 21, 10}, {50, 22, 20}});  // 10 x 10: both storeys leak through the door
  const Leaks one = find_leaks(house);
  REQUIRE(one.leaks.size() == 1);
  CHECK(one.leaks[0].width == 7);
  CHECK(off(one.leaks[0].place, {13, 10, 2}) <= 1);
}

TEST_CASE("rooms are closed, or open to the ground", "[leaks]") {
  BitBox house(VoxelBox{{0, 0, 0}, {64, 40, 40}});
  put_house(house, {{2, 2, 2}, {42, 32, 32}}, 1);
  CHECK(find_leaks(house).leaks.empty());
  CHECK(find_leaks(house).closed_voxels == 38 * 28 * 28);
  cut(house, {{3, 2, 3}, {41, 3, 31}});  // no floor
  CHECK(find_leaks(house).closed_voxels == 0);
  const GroundedLeaks stands = find_grounded_leaks(house, kYUp);
  CHECK(stands.on_ground);
  CHECK(stands.closed_voxels == 38 * 28 * 28);
  CHECK_FALSE(find_grounded_leaks(house, {1, true}).on_ground);
  CHECK(find_leaks(BitBox(VoxelBox{{0, 0, 0}, {64, 2, 2}})).leaks.empty());
}

TEST_CASE("leaks are as their definition says", "[leaks]") {
  std::mt19937 random(7);
  const auto below = [&](std::int32_t n) { return std::int32_t(random() % std::uint32_t(n)); };
  std::size_t seen = 0;
  for (int seed = 0; seed < 30; ++seed) {
    CAPTURE(seed);
    BitBox solid(VoxelBox{{-64, -3, 5}, {64, 20, 30}});
    put_house(solid, {{2, -2, 6}, {24 + below(6), 14, 24}}, 1 + below(2));
    for (int i = 0; i < 3; ++i) {
      const std::int32_t at = 4 + below(18);
      put(solid, {{at, -2, 6}, {at + 1, 14, 24}});
    }
    for (int i = 0; i < 12; ++i) {
      const VoxelCoord first{below(26), -2 + below(15), 6 + below(17)};
      cut(solid, {first, first + VoxelCoord{1 + below(4), 1 + below(4), 1 + below(4)}});
    }
    const PlainLeaks plain(solid);
    const Leaks found = find_leaks(solid);
    CHECK(found.closed_voxels == plain.closed());
    std::vector<std::array<std::int64_t, 3>> leaks;
    for (const Leak& leak : found.leaks) {
      leaks.push_back({std::int64_t(leak.room_voxels), leak.clearance, leak.room_clearance});
      CHECK(plain.clearance(leak.place) == leak.clearance);
      CHECK(plain.clearance(leak.inner) > leak.clearance);
      CHECK(leak.width >= 2 * leak.clearance - 1);
    }
    std::sort(leaks.rbegin(), leaks.rend());
    CHECK(leaks == plain.leaks());
    seen += leaks.size();
    for (const int threads : {1, 3}) {
      const ThreadLimit limit(threads);
      const Leaks again = find_leaks(solid);
      REQUIRE(again.leaks.size() == found.leaks.size());
      for (std::size_t i = 0; i < again.leaks.size(); ++i) CHECK(again.leaks[i].place == found.leaks[i].place);
    }
  }
  CHECK(seen > 30);
}

namespace {

/// A room of 78 x 58 voxels whose walls are `wall` voxels thick, turned around the vertical axis. One door of `width`
/// voxels leads out.
struct TurnedHouse {
  double degrees, wall, width;
  std::int32_t height = 36, sill = 6;

  [[nodiscard]] BitBox voxels() const {
    const double turn = degrees * 3.14159265358979 / 180;
    const auto far = std::int32_t(1.5 * (40 + wall));
    BitBox house(VoxelBox{{-far - 10, -5, -far - 10}, {far + 10, height + 10, far + 10}});
    for_each(VoxelBox{{-far, 0, -far}, {far, height + 4, far}}, [&](VoxelCoord p) {
      const double x = std::cos(turn) * p.x - std::sin(turn) * p.z, z = std::sin(turn) * p.x + std::cos(turn) * p.z;
      const double out = std::max(std::abs(x) - 39, std::abs(z) - 29);
      const bool door = z > 0 && std::abs(x) < width / 2 && p.y >= 2 + sill && p.y < height - sill;
      const bool is_wall = out >= 0 && out < wall, is_deck = out < wall && (p.y < 2 || p.y >= height + 2);
      if ((is_wall && !door) || is_deck) house.set(p);
    });
    return house;
  }
};

/// Closes all voxels with cubes just above a scale of whole voxels.
BitBox closed_at(const BitBox& solid, std::int32_t scale_vox) {
  GridFrame frame;
  frame.voxel = 1;
  ScaleField field;
  field.base = scale_vox + kBeyondWholeVox;
  const Halo halo = halo_of(solid.box(), field, frame);
  BitBox closed;
  ClosingScratch scratch;
  close_tile(solid, field.sample(frame, solid.box().grown(halo.erosion_vox)), halo, {}, solid.box(), closed, scratch);
  return closed;
}

/// Returns whether the middle of the room is empty, and the outside does not reach it.
bool is_shut(const BitBox& solid, VoxelCoord middle) {
  BitBox open(solid.box()), reached(solid.box());
  for_each(solid.box(), [&](VoxelCoord p) {
    if (!solid.test(p)) open.set(p);
  });
  reached.set(solid.box().min);
  grow_within(open, reached);
  return open.test(middle) && !reached.test(middle);
}

LeakSearchOptions with_trials(std::size_t trials) {
  LeakSearchOptions options;
  options.trials = trials;
  return options;
}

}  // namespace

TEST_CASE("the scale that is told shuts the leak, however thick or turned the walls are", "[leaks]") {
  for (const double degrees : {0, 15, 30, 45}) {
    for (const double wall : {2, 20, 40}) {
      for (const double width : {4, 9}) {
        CAPTURE(degrees, wall, width);
        const BitBox house = TurnedHouse{degrees, wall, width}.voxels();
        REQUIRE_FALSE(is_shut(house, {0, 20, 0}));
        const Leaks found = find_leaks(house, {}, with_trials(1));
        REQUIRE(!found.leaks.empty());
        const Leak& leak = found.leaks[0];
        REQUIRE(leak.trial.answer == ShutTrial::Answer::shut);
        CHECK(leak.trial.scale_vox >= leak.clearance);
        if (degrees == 0) CHECK(leak.trial.scale_vox == leak.clearance);
        CHECK(is_shut(closed_at(house, leak.trial.scale_vox), {0, 20, 0}));
        CHECK_FALSE(is_shut(closed_at(house, leak.clearance - 1), {0, 20, 0}));
      }
    }
  }
}

TEST_CASE("a scale that fills the room does not count as shutting it", "[leaks]") {
  const BitBox house = TurnedHouse{15, 2, 16, 19, 0}.voxels();  // a low room behind a wide door
  const Leaks found = find_leaks(house, {}, with_trials(1));
  REQUIRE(found.leaks.size() == 1);
  const Leak& leak = found.leaks[0];
  CHECK(leak.room_clearance == 10);
  CHECK(leak.trial.answer == ShutTrial::Answer::shut);
  CHECK(leak.trial.scale_vox < leak.room_clearance);
  CHECK(is_shut(closed_at(house, leak.trial.scale_vox), {0, 11, 0}));

  const VoxelBox box = bounds_of_voxels(house).grown(2);
  FoundLeaks lower = search_leaks(Clearance(house, box), 1, [](std::uint64_t) {});
  lower.sides[0].filled = leak.trial.scale_vox;  // as if the room were lower
  const ShutTrial trial = try_closings(house, lower.sides[0], [] {});
  CHECK(trial.answer == ShutTrial::Answer::filled);
  CHECK(trial.scale_vox == 0);
}

TEST_CASE("no scale is told where room and outside are too far apart for a trial", "[leaks]") {
  BitBox house(VoxelBox{{0, 0, 0}, {512, 130, 130}});
  put(house, {{1, 2, 2}, {510, 128, 128}});
  cut(house, {{3, 4, 4}, {160, 126, 126}});    // a room
  cut(house, {{160, 60, 60}, {510, 64, 64}});  // a duct of 350 voxels
  const Leaks found = find_leaks(house, {}, with_trials(1));
  REQUIRE(found.leaks.size() == 1);
  CHECK(found.leaks[0].trial.answer == ShutTrial::Answer::untried);
  CHECK(found.leaks[0].trial.scale_vox == 0);
}

TEST_CASE("closings are tried around as many leaks as are asked for, on the voxels that count", "[leaks]") {
  BitBox house(VoxelBox{{0, 0, 0}, {128, 40, 40}});
  for (const std::int32_t at : {2, 34, 66}) {
    put_house(house, {{at, 2, 2}, {at + 26 + at / 20, 32, 32}}, 1);
    cut(house, {{at + 10, 10, 31}, {at + 14, 14, 32}});
  }
  std::map<std::string, std::size_t> steps;
  LeakSearchOptions options;
  options.progress = [&](const char* step, const char*, std::uint64_t done, std::uint64_t total) {
    ++steps[step];
    CHECK(done <= total);
  };
  for (const std::size_t trials : {0, 1, 2, 20}) {
    CAPTURE(trials);
    options.trials = trials;
    steps.clear();
    for (const bool floor : {true, false}) {
      if (!floor) cut(house, {{3, 2, 3}, {27, 3, 31}});  // one house stands on the ground then
      const Leaks found = floor ? find_leaks(house, {}, options) : find_grounded_leaks(house, kYUp, options);
      REQUIRE(found.leaks.size() == 3);
      for (std::size_t i = 0; i < 3; ++i)
        CHECK((found.leaks[i].trial.answer == ShutTrial::Answer::shut) == (i < trials));
    }
    CHECK(steps["trying scales"] == 2 * std::min<std::size_t>(trials, 3));
    if (trials == 20) CHECK(steps["looking for leaks"] > 0);
    put(house, {{3, 2, 3}, {27, 3, 31}});
  }
}

TEST_CASE("a search for leaks ends when it is asked to stop", "[leaks]") {
  const BitBox house = TurnedHouse{0, 2, 4}.voxels();
  const std::atomic<bool> stop = true;
  WorkArena arena(1, &stop);
  CHECK_THROWS_AS(arena.run([&] { (void)find_leaks(house); }), Cancelled);
}

TEST_CASE("looking for leaks beyond the memory is refused", "[leaks]") {
  BitBox house(VoxelBox{{0, 0, 0}, {64, 40, 40}});
  put_house(house, {{2, 2, 2}, {42, 32, 32}}, 1);
  const auto with_memory = [](std::uint64_t bytes) { return LeakSearchOptions{{bytes}, 0, {}}; };
  const std::uint64_t needed = leaks_bytes({{2, 2, 2}, {42, 32, 32}});
  CHECK_NOTHROW(find_leaks(house, {}, with_memory(needed)));
  CHECK_THROWS_AS(find_leaks(house, {}, with_memory(needed - 1)), NeedsMemory);
}
