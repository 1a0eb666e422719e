#include "lib/grid/bit_box.h"
#include "lib/volume/topology.h"
#include "tests/catch.h"
#include "tests/support/memory_shelf.h"

using namespace bp;

namespace {

SolidTopology topology(const std::vector<VoxelBox>& full, const std::vector<VoxelBox>& empty = {}) {
  BitBox bits(voxels_of(BrickBox{{-1, -1, -1}, {3, 3, 3}}));
  const auto set = [&](const VoxelBox& box, bool on) {
    for (std::int32_t z = box.min.z; z < box.max.z; ++z)
      for (std::int32_t y = box.min.y; y < box.max.y; ++y)
        for (std::int32_t x = box.min.x; x < box.max.x; ++x) {
          std::uint64_t& word = bits.row(y, z)[(x + 64) / 64];
          const std::uint64_t bit = std::uint64_t(1) << ((x + 64) % 64);
          word = on ? word | bit : word & ~bit;
        }
  };
  for (const VoxelBox& box : full) set(box, true);
  for (const VoxelBox& box : empty) set(box, false);
  test::MemoryShelf shelf;
  store_voxels(bits, shelf);
  return topology_of(shelf);
}

}  // namespace

TEST_CASE("parts and holes of voxels are counted across bricks", "[quick][grid]") {
  CHECK(topology({}).parts == 0);
  const VoxelBox box{{-5, -6, -7}, {140, 80, 70}};
  CHECK(topology({box}).parts == 1);
  CHECK(topology({box}).handles == 0);
  const SolidTopology holes = topology({box}, {{{10, -6, 3}, {12, 80, 5}}, {{60, -6, 60}, {70, 80, 66}}});
  CHECK(holes.parts == 1);
  CHECK(holes.handles == 2);
  const SolidTopology crossing = topology({box}, {{{20, -6, 3}, {22, 80, 5}}, {{-5, 30, 3}, {140, 32, 5}}});
  CHECK(crossing.handles == 3);  // four openings into one another
  const VoxelBox all{{-64, -64, -64},
                     {192, 192, 192}};  // a full brick may meet what is missing across an edge or corner
  CHECK(topology({all}, {{{64, 64, 64}, {192, 192, 192}}}).handles == 0);
  CHECK(topology({all}, {{{-64, 64, 64}, {192, 192, 192}}}).handles == 0);
  CHECK(topology({all}, {{{64, 64, 64}, {192, 70, 70}}}).handles == 0);  // blind
  CHECK(topology({all}, {{{-64, 64, 64}, {192, 70, 70}}}).handles == 1);
  const SolidTopology apart = topology({{{0, 0, 0}, {3, 3, 3}}, {{3, 3, 0}, {5, 5, 3}}, {{64, 0, 0}, {70, 3, 3}}});
  CHECK(apart.parts == 3);  // two of them touch along an edge only
  CHECK(apart.handles == 0);
}
