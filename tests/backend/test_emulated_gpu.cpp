// What only an emulated device can be asked for: another order of its threads, and a memory that is too small.
#include <cuda_runtime.h>

#include "gpu/cuda_backend.h"
#include "lib/core/error.h"
#include "lib/voxel/voxelize.h"
#include "tests/catch.h"
#include "tests/reference/closing.h"
#include "tests/reference/random_closing.h"

using namespace bp;

namespace {

struct Tile {
  VoxelBox interior{{-64, 0, -20}, {192, 70, 100}};
  Halo halo{4, 3};
  ScaleLattice scale;
  BitBox solid, want;
  Tile() : solid(interior.grown(halo.total_vox())) {
    reference::Random random{5};
    scale = reference::random_lattice(random, solid.box().grown(8), 48);
    for (int i = 0; i < 700; ++i) {
      const VoxelBox& b = solid.box();
      solid.set({random.between(b.min.x, b.max.x - 1), random.between(b.min.y, b.max.y - 1),
                 random.between(b.min.z, b.max.z - 1)});
    }
    want = reference::close(solid, scale, StructuringElement::ball, interior);
  }
};

}  // namespace

TEST_CASE("the order in which a block's threads run changes no bit", "[quick][emulated]") {
  const Tile tile;
  for (const unsigned order : {0u, 1u, 2u, 77u}) {
    CAPTURE(order);
    emulator::set_thread_order(order);
    BitBox got;
    make_cuda_backend(0)->close(tile.solid, tile.scale, tile.halo, {StructuringElement::ball}, tile.interior, got);
    CHECK(got == tile.want);
  }
  emulator::set_thread_order(0);
}

TEST_CASE("a tile that does not fit in device memory is closed or voxelized in parts, to the same bits",
          "[quick][emulated]") {
  const Tile tile;
  std::size_t whole = 0;
  {
    const auto backend = make_cuda_backend(0);
    BitBox got;
    const std::size_t before = emulator::memory_in_use();
    backend->close(tile.solid, tile.scale, tile.halo, {StructuringElement::ball}, tile.interior, got);
    whole = emulator::memory_in_use() - before;
    CHECK(got == tile.want);
  }
  CHECK(emulator::memory_in_use() == 0);
  {
    const VoxelBox box{{0, 0, 0}, {256, 128, 200}};
    const std::vector<FixedTriangle> triangles{
        {{0, 0, 0}, {250 * kFixedOne, 3, 190 * kFixedOne}, {7, 120 * kFixedOne, 90 * kFixedOne}}};
    BitBox got(box), want(box);
    voxelize_surface(triangles, want);
    emulator::set_memory_limit(std::size_t(want.word_count()) * 8 / 3);
    make_cuda_backend(0)->voxelize(triangles, got);
    CHECK(got == want);
    emulator::set_memory_limit(std::size_t(-1));
  }
  const auto backend = make_cuda_backend(0);
  for (const std::size_t share : {2, 4}) {
    CAPTURE(whole, share);
    emulator::set_memory_limit(whole / share);
    BitBox got;
    backend->close(tile.solid, tile.scale, tile.halo, {StructuringElement::ball}, tile.interior, got);
    CHECK(got == tile.want);
  }
  emulator::set_memory_limit(1000);
  BitBox got;
  CHECK_THROWS_AS(backend->close(tile.solid, tile.scale, tile.halo, {StructuringElement::ball}, tile.interior, got),
                  Error);
  emulator::set_memory_limit(std::size_t(-1));
  backend->close(tile.solid, tile.scale, tile.halo, {StructuringElement::ball}, tile.interior, got);
  CHECK(got == tile.want);
}
