#include <bit>

#include "lib/core/parallel.h"
#include "lib/volume/dilate_ball.h"
#include "tests/catch.h"
#include "tests/support/memory_shelf.h"

using namespace bp;

TEST_CASE("a ball's dilation holds the voxels with cubes nearer than its reach, across bricks, and no others",
          "[quick][grid]") {
  const double reach = GENERATE(0.0, 0.5, 1.0, 1.01, 1.5, 2.0, 3.7, 9.2);
  const ThreadLimit threads(GENERATE(1, 2));
  const std::vector<VoxelCoord> seeds = {{0, 0, 0}, {63, 5, -64}, {64, 7, -61}, {-1, -1, 40}};
  test::MemoryShelf in, out;
  BitBox bits(voxels_of(BrickBox{{-1, -1, -1}, {2, 1, 1}}));
  for (const VoxelCoord& s : seeds) bits.set(s);
  store_voxels(bits, in);
  dilate_ball(in, reach, out);
  const VoxelBox box = VoxelBox{{-1, -1, -64}, {65, 8, 41}}.grown(12);
  BitBox grown(box);
  load_voxels(out, grown);
  std::uint64_t expected = 0, held = 0;
  for (VoxelCoord p = box.min; p.z < box.max.z; ++p.z) {
    for (p.y = box.min.y; p.y < box.max.y; ++p.y) {
      for (p.x = box.min.x; p.x < box.max.x; ++p.x) {
        bool near = false;
        for (const VoxelCoord& s : seeds) {
          double squared = 0;
          for (int i = 0; i < 3; ++i) {
            const double gap = std::max(std::abs(p[i] - s[i]) - 1, 0);
            squared += gap * gap;
          }
          near = near || p == s || squared < reach * reach;
        }
        expected += near;
        held += near && grown.test(p);
      }
    }
  }
  CHECK(held == expected);
  std::uint64_t all = 0;
  BrickBits one;
  for (const BrickCoord& c : out.coords()) {
    (void)out.get(c, one);
    for (const std::uint64_t w : one) all += std::uint64_t(std::popcount(w));
  }
  CHECK(all == expected);
}
