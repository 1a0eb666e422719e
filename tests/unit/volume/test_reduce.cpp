#include <random>
#include <set>

#include "lib/grid/shelf_stream.h"
#include "lib/volume/boundary_runs.h"
#include "lib/volume/reduce.h"
#include "tests/catch.h"
#include "tests/support/memory_scene.h"
#include "tests/support/memory_shelf.h"

namespace bp::test {

namespace {

using Voxels = std::set<VoxelCoord>;

void put(const Voxels& voxels, BrickShelf& shelf) {
  std::map<BrickCoord, BrickBits> bricks;
  for (const VoxelCoord v : voxels) {
    const VoxelCoord p = v - first_voxel(brick_of(v));
    bricks[brick_of(v)][std::size_t(p.z * kBrickEdge + p.y)] |= std::uint64_t(1) << p.x;
  }
  for (const auto& [coord, bits] : bricks) shelf.put(coord, classify(bits), bits);
}

Voxels voxels_on(const BrickShelf& shelf) {
  Voxels voxels;
  for (const BrickCoord b : shelf.coords()) {
    BrickBits bits;
    shelf.get(b, bits);
    for (std::int32_t i = 0; i < std::int32_t(kBrickWords); ++i) {
      for (std::int32_t x = 0; x < kBrickEdge; ++x) {
        if (bits[std::size_t(i)] >> x & 1) voxels.insert(first_voxel(b) + VoxelCoord{x, i % 64, i / 64});
      }
    }
  }
  return voxels;
}

/// The definition: the coarse voxel whose cube, in scene units, holds the middle of the fine one.
Voxels reduced_slowly(const Voxels& fine, const GridFrame& frame) {
  const GridFrame coarse = reduced(frame);
  Voxels out;
  for (const VoxelCoord v : fine) {
    VoxelCoord q;
    for (int i = 0; i < 3; ++i) {
      const double middle = (double(frame.origin[std::size_t(i)]) + v[i] + 0.5) * frame.voxel;
      q[i] = std::int32_t(std::floor(middle / coarse.voxel) - double(coarse.origin[std::size_t(i)]));
    }
    out.insert(q);
  }
  return out;
}

/// Clusters around corners of bricks, on either side of zero.
Voxels random_voxels(std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto between = [&](int lo, int hi) {
    return std::int32_t(lo + std::int32_t(random() % std::uint32_t(hi - lo + 1)));
  };
  Voxels voxels;
  for (int cluster = 0; cluster < 6; ++cluster) {
    const VoxelCoord centre{between(-2, 3) * 64, between(-2, 3) * 64, between(-2, 3) * 64};
    for (int i = 0; i < 60; ++i) voxels.insert(centre + VoxelCoord{between(-4, 4), between(-4, 4), between(-4, 4)});
  }
  return voxels;
}

}  // namespace

TEST_CASE("a reduced voxel is occupied exactly if one of its eight is", "[quick][grid][reduce]") {
  const auto seed = GENERATE(range(0u, 12u));
  const int parity = GENERATE(range(0, 8));
  GridFrame frame;
  frame.voxel = 0.375;
  for (std::size_t i = 0; i < 3; ++i) frame.origin[i] = (seed % 2 == 0 ? -10 : 6) + (parity >> i & 1);
  CAPTURE(seed, parity);
  const Voxels fine = random_voxels(seed);
  MemoryShelf shelf, coarse;
  put(fine, shelf);
  reduce(shelf, frame, coarse);
  CHECK(voxels_on(coarse) == reduced_slowly(fine, frame));
}

TEST_CASE("full bricks reduce to full bricks, and the header's box holds every brick", "[quick][grid][reduce]") {
  const int parity = GENERATE(0, 1);
  StreamHeader header;
  header.frame.origin = {parity, 0, -parity};
  header.bricks = {{-1, 0, 0}, {3, 4, 5}};
  MemoryShelf shelf, coarse;
  BrickBits all;
  all.fill(~std::uint64_t(0));
  for (std::int32_t z = 0; z < 5; ++z)
    for (std::int32_t y = 0; y < 4; ++y)
      for (std::int32_t x = -1; x < 3; ++x) shelf.put({x, y, z}, BrickFill::full, all);
  reduce(shelf, header.frame, coarse);
  const StreamHeader out = reduced(header);
  CHECK(coarse.fill({0, 1, 1}) == BrickFill::full);
  CHECK(coarse.fill({-1, 1, 0}) == BrickFill::mixed);
  for (const BrickCoord c : coarse.coords()) CHECK(out.bricks.contains(c));
  CHECK(out.slab_axis == longest_axis(out.bricks));
  CHECK(out.frame.voxel == 2);
}

TEST_CASE("a reduced frame keeps every lattice point an exact double", "[quick][grid][reduce]") {
  Bounds3d bounds;
  bounds.add({5.1e5, -4.4e6, -3.7});
  bounds.add({5.2e5, -4.3e6, 88.1});
  GridFrame frame = make_frame(bounds, 0.37);
  for (int level = 0; level < 5; ++level) {
    const GridFrame coarse = reduced(frame);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int64_t shift = frame.origin[i] - 2 * coarse.origin[i];
      CHECK((shift == 0 || shift == 1));
      CHECK(coarse.world_origin()[i] == frame.world_origin()[i] - double(shift) * frame.voxel);
      CHECK(coarse.world_origin()[i] / coarse.voxel == double(coarse.origin[i]));
    }
    frame = coarse;
  }
}

TEST_CASE("bricks come off shelves in slab order, each layer in its turn", "[quick][grid][reduce]") {
  StreamHeader header;
  header.bricks = {{-3, -3, -3}, {4, 4, 4}};
  header.slab_axis = GENERATE(0, 1, 2);
  MemoryShelf solid, closing;
  put(random_voxels(1), solid);
  put(random_voxels(1), closing);
  put(random_voxels(2), closing);
  const Voxels before = voxels_on(solid);
  const std::size_t bricks = solid.coords().size() + closing.coords().size();
  ShelfSource source(header, solid, &closing, ShelfSource::Keep::solid);
  MemoryShelf copy;
  ShelfSink sink(&copy);
  MemorySink checked;  // fails if bricks come out of order
  checked.header = header;
  for (Brick brick; source.read(brick);) {
    checked.write(brick);
    sink.write(brick);
  }
  CHECK(checked.bricks.size() == bricks);
  CHECK(voxels_on(copy) == before);
  CHECK(voxels_on(solid) == before);
  CHECK(closing.coords().empty());
}

TEST_CASE("runs hold exactly the voxels that have an empty neighbour", "[quick][grid][reduce]") {
  const auto seed = GENERATE(0u, 1u);
  CAPTURE(seed);
  Voxels solid = random_voxels(seed);
  for (std::int32_t i = 0; i < 70 * 10 * 12; ++i) solid.insert({i % 70 - 3, i / 70 % 10 - 6, i / 700 - 6});
  Voxels expected;
  std::uint64_t faces = 0;
  for (const VoxelCoord v : solid) {
    for (const VoxelCoord d : {VoxelCoord{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}) {
      if (solid.count(v + d) != 0) continue;
      expected.insert(v);
      ++faces;
    }
  }
  MemoryShelf shelf;
  put(solid, shelf);
  const Boundary boundary = boundary_of(shelf);
  Voxels found;
  int twice = 0;
  for (const VoxelRun& run : boundary.runs) {
    CHECK(brick_of(run.first) == brick_of(run.first + VoxelCoord{run.length - 1, 0, 0}));
    for (std::int32_t i = 0; i < run.length; ++i) twice += !found.insert(run.first + VoxelCoord{i, 0, 0}).second;
  }
  CHECK(twice == 0);
  CHECK(found == expected);
  CHECK(boundary.faces == faces);
}

}  // namespace bp::test
