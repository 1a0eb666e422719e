#include <map>
#include <random>

#include "lib/closing/closing.h"
#include "lib/closing/closing_scratch.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/grid/brick_voxels.h"
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

TEST_CASE("the scale that is told shuts the leak, also in a turned house", "[leaks]") {
  for (const int degrees : {0, 15, 30, 45}) {
    for (const double width : {4.0, 9.0}) {
      CAPTURE(degrees, width);
      const double turn = degrees * 3.14159265358979 / 180;
      BitBox house(VoxelBox{{-70, -5, -70}, {70, 45, 70}});
      for_each(VoxelBox{{-60, 0, -60}, {60, 40, 60}}, [&](VoxelCoord p) {
        const double x = std::cos(turn) * p.x - std::sin(turn) * p.z, z = std::sin(turn) * p.x + std::cos(turn) * p.z;
        const double wall = std::min({40 - std::abs(x), 30 - std::abs(z), p.y + 0.5, 39.5 - p.y});
        const bool door = z > 0 && std::abs(x) < width / 2 && p.y >= 8 && p.y < 28;
        if (wall >= 0 && wall < 2 && !door) house.set(p);
      });
      const Leaks found = find_leaks(house);
      REQUIRE(found.leaks.size() == 1);
      const Leak& leak = found.leaks[0];
      CHECK(leak.shut_at >= leak.clearance);
      if (degrees == 0) CHECK(leak.shut_at == leak.clearance);
      // The whole house is closed at that scale, and nothing else is open.
      GridFrame frame;
      frame.voxel = 1;
      ScaleField field;
      field.base = leak.shut_at + kBeyondWholeVox;
      const Halo halo = halo_of(house.box(), field, frame);
      BitBox closed;
      ClosingScratch scratch;
      close_tile(house, field.sample(frame, house.box().grown(halo.erosion_vox)), halo, {}, house.box(), closed,
                 scratch);
      CHECK(find_leaks(closed).leaks.empty());
      CHECK((closed.test({0, 20, 0}) || find_leaks(closed).closed_voxels > 1000));
    }
  }
}

TEST_CASE("looking for leaks beyond the memory is refused", "[leaks]") {
  BitBox house(VoxelBox{{0, 0, 0}, {64, 40, 40}});
  put_house(house, {{2, 2, 2}, {42, 32, 32}}, 1);
  const std::uint64_t needed = leaks_bytes({{2, 2, 2}, {42, 32, 32}});
  CHECK_NOTHROW(find_leaks(house, {}, {needed}));
  CHECK_THROWS_AS(find_leaks(house, {}, {needed - 1}), NeedsMemory);
}
