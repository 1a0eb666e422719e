#include <cmath>
#include <map>
#include <random>

#include "lib/core/error.h"
#include "lib/device/cpu/cpu_backend.h"
#include "lib/grid/brick_voxels.h"
#include "lib/pass/hide/entered_rooms.h"
#include "lib/pass/hide/hidden_pass.h"
#include "lib/pass/hide/possible_rooms.h"
#include "lib/volume/entered.h"
#include "tests/catch.h"
#include "tests/reference/closing.h"
#include "tests/reference/flood.h"
#include "tests/support/memory_scene.h"
#include "tests/support/voxel_source.h"

using namespace bp;
using namespace bp::test;

namespace {

constexpr VoxelBox kBox{{0, 0, 0}, {72, 40, 40}};

struct Made {
  BitBox bits;
  std::uint64_t count = 0;
};

/// The solids that hidden voxels are made from.
struct Scene {
  MemoryShelf shelf;
  StreamHeader header;
  Backends backends;
  HiddenOptions options;

  Scene(const Solid& touched, double scale, StructuringElement element, std::int32_t threads = 2)
      : backends(plain_backends(threads)) {
    VoxelSource source(kBox, touched);
    for (Brick brick; source.read(brick);) shelf.put(brick.coord, brick.fill, brick.bits);
    header = source.header();
    header.slab_axis = longest_axis(header.bricks);
    options.scale_world = scale;
    options.element = element;
    options.context.make_shelf = memory_shelves();
  }
};

Made made(const Solid& touched, double scale, StructuringElement element, std::int32_t threads = 2,
          const BitBox* entered = nullptr) {
  Scene scene(touched, scale, element, threads);
  scene.options.entered = entered;
  const HiddenVoxels hidden = hidden_voxels(scene.header, scene.shelf, scene.backends, scene.options);
  Made out{BitBox(voxels_of(bricks_of(kBox))), hidden.count};
  load_voxels(*hidden.voxels, out.bits);
  return out;
}

bool beside(const BitBox& bits, VoxelCoord p) {
  for (VoxelCoord d{-1, -1, -1}; d.x < 2; ++d.x)
    for (d.y = -1; d.y < 2; ++d.y)
      for (d.z = -1; d.z < 2; ++d.z)
        if (bits.test(p + d)) return true;
  return false;
}

constexpr VoxelBox kWide = kBox.grown(16);

BitBox wide_bits_of(const Solid& touched) {
  BitBox g(kWide);
  copy_voxels(bits_of(kBox, touched), g);
  return g;
}

BitBox closing_of(const Solid& touched, double scale, StructuringElement element) {
  ScaleField field;
  field.base = scale;
  return reference::close(wide_bits_of(touched), field.sample(GridFrame{}, kWide.grown(16)), element, kWide);
}

/// Returns the same set by the fast code.
BitBox passed_closing_of(const Solid& touched, double scale, StructuringElement element) {
  Scene scene(touched, scale, element);
  ScaleField field;
  field.base = scale;
  CloseOptions options;
  options.keep_cavities = true;
  options.context = scene.options.context;
  BitBox e(kWide);
  load_voxels(*close_shelf(scene.header, scene.shelf, scene.backends, field, {element}, options), e);
  return e;
}

constexpr VoxelCoord kSides[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

/// Takes the rooms that hold an entered voxel out of `filled`, which has them and the closing `e`.
void leave_open_by_walks(const BitBox& entered, const BitBox& e, BitBox& filled) {
  std::vector<VoxelCoord> left;
  const auto add = [&](VoxelCoord p) {
    if (!filled.test(p) || e.test(p)) return;
    filled.clear(p);
    left.push_back(p);
  };
  for_each_voxel(entered, add);
  while (!left.empty()) {
    const VoxelCoord p = left.back();
    left.pop_back();
    for (const VoxelCoord d : kSides) add(p + d);
  }
}

/// The definition, voxel by voxel. `e`: the closing.
BitBox defined(const Solid& touched, const BitBox& e, double scale, const BitBox* entered = nullptr) {
  const VoxelBox wide = kWide;
  const BitBox g = wide_bits_of(touched);
  BitBox filled = reference::fill_enclosed(e, wide);
  if (entered != nullptr) leave_open_by_walks(*entered, e, filled);
  BitBox walls = g, seen(wide), seen_more(wide), hidden(voxels_of(bricks_of(kBox)));
  for (std::int64_t i = 0; i < walls.word_count(); ++i) walls.data()[i] |= filled.data()[i] & ~e.data()[i];
  const auto is_added = [&](VoxelCoord p) { return e.test(p) && !g.test(p); };
  const auto in_gap = [&](VoxelCoord p) {
    for (int axis = 0; axis < 3; ++axis) {
      int length = -1;  // the voxel itself counts twice
      bool all_walls = true;
      for (const int way : {-1, 1}) {
        VoxelCoord q = p;
        for (; is_added(q); q[axis] += way) ++length;
        all_walls = all_walls && g.test(q);
      }
      if (all_walls && length <= int(2 * std::sqrt(2.0) * scale)) return true;
    }
    return false;
  };
  std::map<VoxelCoord, bool> shared;  // whether an added voxel belongs to the rooms
  std::vector<VoxelCoord> outside, rooms;
  const auto add_neighbours = [&](std::vector<VoxelCoord>& front, bool is_room) {
    std::vector<VoxelCoord> next;
    for (const VoxelCoord p : front)
      for (const VoxelCoord d : kSides) {
        if (is_added(p + d) && !in_gap(p + d) && shared.emplace(p + d, is_room).second) next.push_back(p + d);
      }
    front = std::move(next);
  };
  for (VoxelCoord p = wide.min; p.z < wide.max.z; ++p.z)
    for (p.y = wide.min.y; p.y < wide.max.y; ++p.y)
      for (p.x = wide.min.x; p.x < wide.max.x; ++p.x)
        if (!e.test(p)) (filled.test(p) ? rooms : outside).push_back(p);
  for (int step = 0; step < 2 * int(std::ceil(scale)); ++step) {
    add_neighbours(outside, false);
    add_neighbours(rooms, true);
  }
  for (const auto& [p, is_room] : shared)
    if (is_room && (entered == nullptr || !entered->test(p))) walls.set(p);
  const BitBox unreached = reference::fill_enclosed(walls, wide);
  const auto each = [&](const auto& f) {
    for (VoxelCoord p = wide.min; p.z < wide.max.z; ++p.z)
      for (p.y = wide.min.y; p.y < wide.max.y; ++p.y)
        for (p.x = wide.min.x; p.x < wide.max.x; ++p.x) f(p);
  };
  BitBox reached(wide);
  each([&](VoxelCoord p) {
    if (!unreached.test(p)) reached.set(p);
  });
  each([&](VoxelCoord p) {
    if (g.test(p) && beside(reached, p)) seen.set(p);
  });
  each([&](VoxelCoord p) {
    if (g.test(p) && beside(seen, p)) seen_more.set(p);
  });
  each([&](VoxelCoord p) {
    if (unreached.test(p) && !seen.test(p) && !seen_more.test(p)) hidden.set(p);
  });
  return hidden;
}

/// A room from (8,8,8) to (40,32,32) with walls of three voxels, and a door in it, 6 voxels wide.
bool room(VoxelCoord p) {
  const auto within = [&](int margin) {
    return p.x >= 8 + margin && p.x < 40 - margin && p.y >= 8 + margin && p.y < 32 - margin && p.z >= 8 + margin &&
           p.z < 32 - margin;
  };
  const bool door = p.x >= 37 && p.y >= 16 && p.y < 22 && p.z >= 11 && p.z < 24;
  return within(0) && !within(3) && !door;
}

/// Plates that begin in the box of size `within` at the origin. Their sides are 6 voxels and up to `more` further ones,
/// but for their thickness, along each axis in turn.
std::vector<VoxelBox> random_plates(unsigned seed, int count, VoxelCoord within, VoxelCoord more,
                                    std::int32_t thickness) {
  std::mt19937 random(seed);
  const auto number = [&](std::int32_t most) { return std::int32_t(random() % unsigned(most)); };
  std::vector<VoxelBox> plates;
  for (int i = 0; i < count; ++i) {
    const VoxelCoord at{number(within.x), number(within.y), number(within.z)};
    VoxelCoord size{6 + number(more.x), 6 + number(more.y), 6 + number(more.z)};
    size[i % 3] = thickness;
    plates.push_back({at, at + size});
  }
  return plates;
}

}  // namespace

TEST_CASE("hidden voxels are those of the definition", "[quick][pass][occluder]") {
  const auto element = GENERATE(StructuringElement::ball, StructuringElement::cube);
  const double scale = GENERATE(0.0, 2.0, 3.5);
  const int seed = GENERATE(0, 1, 2);
  const std::vector<VoxelBox> plates = random_plates(unsigned(seed) * 7 + 1, 14, {50, 28, 28}, {12, 8, 8}, 2);
  const Solid touched = [&](VoxelCoord p) {
    return room(p) || std::any_of(plates.begin(), plates.end(), [&](const VoxelBox& b) { return b.contains(p); });
  };
  CAPTURE(scale, seed);
  const Made got = made(touched, scale, element);
  CHECK(got.bits == defined(touched, closing_of(touched, scale, element), scale));
  CHECK(got.count == got.bits.count());
  CHECK(got.bits == made(touched, scale, element, 1).bits);
}

TEST_CASE("hidden voxels are those of the definition where a body enters", "[quick][pass][occluder]") {
  const auto element = GENERATE(StructuringElement::ball, StructuringElement::cube);
  const double scale = GENERATE(0.0, 3.5, 4.5);
  const auto reach = GENERATE(VoxelCoord{1, 1, 3}, VoxelCoord{1, 1, 5}, VoxelCoord{2, 2, 6});
  const int seed = GENERATE(0, 1, 2);
  const std::vector<VoxelBox> plates = random_plates(unsigned(seed) * 7 + 1, seed * 5, {50, 28, 28}, {12, 8, 8}, 2);
  const Solid touched = [&](VoxelCoord p) {  // the room, another one behind it, a closed one
    return room(p) || room({p.x - 26, p.y, p.z}) ||
           (p.x >= 14 && p.x < 16 && p.y >= 8 && p.y < 32 && p.z >= 8 && p.z < 32) ||
           std::any_of(plates.begin(), plates.end(), [&](const VoxelBox& b) { return b.contains(p); });
  };
  const BitBox entered = entered_voxels(wide_bits_of(touched), reach);
  CAPTURE(scale, seed, reach.z);
  const Made got = made(touched, scale, element, 2, &entered);
  CHECK(got.bits == defined(touched, passed_closing_of(touched, scale, element), scale, &entered));
  CHECK(got.count == got.bits.count());
  CHECK(got.bits == made(touched, scale, element, 1, &entered).bits);
  for_each_voxel(got.bits, [&](VoxelCoord p) { REQUIRE_FALSE(entered.test(p)); });
}

TEST_CASE("the usual height of rooms is that of most of their volume", "[quick][pass][occluder]") {
  const auto height = [](const Solid& touched, int up = 2) { return usual_height(bits_of(kBox, touched), up); };
  CHECK(height(room) == 18);
  CHECK(height(room, 0) == 26);
  CHECK(height([](VoxelCoord p) { return p.z == 5; }) == 0);
  CHECK(height([](VoxelCoord p) { return p.z == 5 || p.z == 8 || (p.z == 15 && p.x < 10); }) == 2);
}

TEST_CASE("hollows that nothing opens change no room that a closing makes beside them", "[quick][pass][occluder]") {
  const auto element = GENERATE(StructuringElement::ball, StructuringElement::cube);
  const double scale = GENERATE(2.0, 2.0625, 5.0);
  const bool thick = GENERATE(false, true);
  const VoxelBox outer{{43, 8, 8}, {64, 30, 32}};
  const Solid touched = [&](VoxelCoord p) {  // the room with a door, and a hollow that shuts the door but for a gap
    return room(p) || (outer.contains(p) && !outer.grown(thick ? -4 : -1).contains(p));
  };
  CAPTURE(scale, thick);
  const Made got = made(touched, scale, element);
  CHECK(got.bits == defined(touched, passed_closing_of(touched, scale, element), scale));
  CHECK(got.bits == made(touched, scale, element, 1).bits);
}

TEST_CASE("a closing is known to make no room, and where it makes one", "[quick][pass][occluder]") {
  constexpr auto kCube = StructuringElement::cube;
  const auto makes_room = [](double scale, const Solid& touched) {
    Scene scene(touched, scale, kCube);
    const auto enclosed = enclosed_voxels(scene.header, scene.shelf, scene.backends, scene.options);
    return unreached_voxels(scene.header, *enclosed, scene.backends, scene.options) != nullptr;
  };
  constexpr VoxelBox outer{{8, 8, 8}, {40, 32, 32}};
  const Solid closed = [&](VoxelCoord p) { return outer.contains(p) && !outer.grown(-3).contains(p); };
  const BitBox open_room = defined(room, wide_bits_of(room), 0);
  for (const double scale : {0.0, 1.0, 2.0, 2.0625, 3.0, 4.0, 6.0}) {
    CAPTURE(scale);
    CHECK_FALSE(makes_room(scale, closed));
    CHECK(makes_room(scale, room) == (scale >= 3));
    CHECK(makes_room(scale, room) == (defined(room, passed_closing_of(room, scale, kCube), scale) != open_room));
  }
}

TEST_CASE("a scale at which no room is possible makes none, and the dilation knows of all that a closing makes",
          "[quick][pass][occluder]") {
  const int seed = GENERATE(range(0, 6));
  const std::vector<VoxelBox> plates = random_plates(unsigned(seed) * 5 + 3, 40, {40, 25, 25}, {14, 10, 10}, 1);
  const Solid touched = [&](VoxelCoord p) {
    if (seed == 0) return p.x + p.y + p.z > 20 && kBox.contains(p);  // no room at any scale
    return (seed == 1 && room(p)) ||
           std::any_of(plates.begin(), plates.end(), [&](const VoxelBox& b) { return b.contains(p); });
  };
  const std::vector<double> scales{0, 1, 2, 2.0625, 2.9, 3.0625, 4, 5.5, 8};
  Scene scene(touched, 0, StructuringElement::cube);
  const auto enclosed = enclosed_voxels(scene.header, scene.shelf, scene.backends, scene.options);
  const std::vector<bool> possible = possible_rooms(scene.header, *enclosed, scales, scene.options);
  for (std::size_t i = 0; i < scales.size(); ++i) {
    CAPTURE(seed, scales[i]);
    scene.options.scale_world = scales[i];
    const bool has_rooms = closed_voxels(scene.header, *enclosed, scene.backends, scene.options).has_rooms;
    CHECK((possible[i] || !has_rooms));
    if (seed == 0) CHECK_FALSE(possible[i]);
  }
}

TEST_CASE("a room is hidden once its door is closed, and nothing before its walls ever is", "[quick][pass][occluder]") {
  const VoxelCoord middle{20, 20, 20}, in_door{38, 18, 14};
  const Made open = made(room, 2, StructuringElement::cube);
  CHECK_FALSE(open.bits.test(middle));
  const Made closed = made(room, 3, StructuringElement::cube);
  CHECK(closed.bits.test(middle));
  CHECK_FALSE(closed.bits.test(in_door));
  const Solid corner = [](VoxelCoord p) {
    return room(p) || (p.x >= 40 && p.x < 60 && p.y >= 8 && p.y < 10 && p.z >= 8 && p.z < 32);
  };
  const Made beside_wall = made(corner, 3, StructuringElement::cube);
  for (VoxelCoord p{40, 8, 8}; p.z < 32; ++p.z)
    for (p.y = 8; p.y < 32; ++p.y)
      for (p.x = 40; p.x < 60; ++p.x) REQUIRE_FALSE(beside_wall.bits.test(p));  // the closing adds some in the corner
}

TEST_CASE("what is hidden does not depend on tiles, and too little memory is refused", "[quick][pass][occluder]") {
  // 45 and 109: the door lies across a border of bricks, and 109 of tiles of two bricks, too.
  const std::int32_t at = GENERATE(0, 45, 109);
  const Solid moved = [&](VoxelCoord p) { return room({p.x, p.y - at, p.z}) || (p.x < 6 && p.y < 6 && p.z < 6); };
  constexpr VoxelBox box{{0, 0, 0}, {60, 160, 40}};
  VoxelSource source(box, moved);
  MemoryShelf shelf;
  for (Brick brick; source.read(brick);) shelf.put(brick.coord, brick.fill, brick.bits);
  Backends backends = plain_backends(2);
  HiddenOptions options;
  options.scale_world = 3.0625;
  options.context.make_shelf = memory_shelves();
  const auto hidden_with = [&](std::uint64_t memory) {
    options.context.memory = {memory};
    BitBox bits(voxels_of(bricks_of(box)));
    load_voxels(*hidden_voxels(source.header(), shelf, backends, options).voxels, bits);
    return bits;
  };
  const BitBox whole = hidden_with(std::uint64_t(1) << 30);
  CHECK(whole.test({20, 20 + at, 20}));
  std::uint64_t memory = 1, refused = 0;
  for (; refused < 10; ++refused) {
    try {
      const BitBox bits = hidden_with(memory);
      CHECK(bits == whole);
      break;
    } catch (const NeedsMemory& e) {
      REQUIRE(e.needed_bytes() > memory);
      memory = e.needed_bytes();
    }
  }
  CHECK(refused > 0);
  CHECK(refused < 10);
}

TEST_CASE("an alley that the closing fills is not hidden", "[quick][pass][occluder]") {
  const Solid houses = [](VoxelCoord p) {
    return p.y >= 8 && p.y < 30 && p.z >= 8 && p.z < 30 && p.x >= 8 && p.x < 60 && !(p.x >= 30 && p.x < 34);
  };
  const Made alley = made(houses, 4, StructuringElement::cube);
  CHECK(alley.bits.test({20, 20, 20}));
  CHECK_FALSE(alley.bits.test({32, 20, 20}));
}

TEST_CASE("an alley stays free where a window opens into it", "[quick][pass][occluder]") {
  const Solid houses = [](VoxelCoord p) {  // the left one is a room with a wall of three and a window to the alley
    if (p.y < 8 || p.y >= 34 || p.z < 8 || p.z >= 34) return false;
    const bool window = p.x >= 31 && p.y >= 19 && p.y < 23 && p.z >= 19 && p.z < 23;
    const bool room = p.x >= 11 && p.x < 31 && p.y >= 11 && p.y < 31 && p.z >= 11 && p.z < 31;
    return (p.x >= 8 && p.x < 34 && !room && !window) || (p.x >= 38 && p.x < 60);
  };
  const Made hidden = made(houses, 4.0625, StructuringElement::cube);
  CHECK(hidden.bits.test({20, 20, 20}));
  CHECK(hidden.bits.test({12, 12, 20}));  // the edge of the room
  for (VoxelCoord p{34, 8, 8}; p.z < 34; ++p.z)
    for (p.y = 8; p.y < 34; ++p.y)
      for (p.x = 34; p.x < 38; ++p.x) REQUIRE_FALSE(hidden.bits.test(p));
}

TEST_CASE("an opening leaves what is wider than twice the scale", "[quick][pass][occluder]") {
  const Solid shape = [](VoxelCoord p) {
    const bool block = p.x >= 4 && p.x < 24 && p.y >= 4 && p.y < 24 && p.z >= 4 && p.z < 24;
    return block || (p.x >= 24 && p.x < 60 && p.y >= 8 && p.y < 11 && p.z >= 8 && p.z < 11);
  };
  VoxelSource source(kBox, shape);
  MemoryShelf shelf;
  Brick brick;
  while (source.read(brick)) shelf.put(brick.coord, brick.fill, brick.bits);
  Backends backends = plain_backends(1);
  HiddenOptions options;
  options.context.make_shelf = memory_shelves();
  options.scale_world = 4;
  const auto opened = opening(source.header(), shelf, backends, options);
  REQUIRE(opened);
  BitBox bits(voxels_of(bricks_of(kBox)));
  load_voxels(*opened, bits);
  CHECK(bits.test({14, 14, 14}));
  CHECK_FALSE(bits.test({40, 9, 9}));
  options.scale_world = 30;
  CHECK(opening(source.header(), shelf, backends, options) == nullptr);
}
