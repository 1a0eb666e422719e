#include "lib/device/cpu/cpu_backend.h"
#include "tests/backend/available_backends.h"
#include "tests/catch.h"
#include "tests/reference/closing.h"
#include "tests/reference/random_closing.h"
#include "tests/support/memory_shelf.h"

using namespace bp;

namespace {

/// Returns a halo that is safe for any field: the one that halo_of gives if the largest sample is everywhere.
Halo widest_halo(const ScaleLattice& scale) {
  const std::int32_t r = scale.max / kScaleOne + 1;
  return {r + 1, r};
}

}  // namespace

TEST_CASE("closing a tile equals its definition on each backend", "[quick][backend]") {
  const auto backends = available_backends();
  const int seed = GENERATE(range(0, 48));
  reference::Random random{std::uint64_t(seed)};
  const Scale largest = Scale(random.between(1, seed % 4 == 0 ? 130 : 60));
  const VoxelBox interior = reference::random_box(random, seed % 3 == 0 ? 70 : 24);
  const Halo halo{largest / kScaleOne + 2, largest / kScaleOne + 1};
  const VoxelBox box = interior.grown(halo.total_vox());
  const BitBox solid = reference::random_solid(random, box);
  const ScaleLattice scale = reference::random_lattice(random, box, largest);
  const auto element = random.one_in(2) ? StructuringElement::cube : StructuringElement::ball;
  const BitBox want = reference::close(solid, scale, element, interior);
  for (const auto& backend : backends) {
    CAPTURE(backend->name(), seed, element == StructuringElement::cube, scale.min, scale.max);
    BitBox got;
    backend->close(solid, scale, widest_halo(scale), {element}, interior, got);
    CHECK(got == want);
    backend->close(solid, scale, widest_halo(scale), {element}, interior, got);  // buffers still hold the tile before
    CHECK(got == want);
  }
}

TEST_CASE("turned cubes close as their definition says on each backend", "[quick][backend][oriented]") {
  const auto backends = available_backends();
  const int seed = GENERATE(range(0, 6));
  reference::Random random{std::uint64_t(seed) + 900};
  const Scale largest = Scale(random.between(8, 5 * kScaleOne));
  const VoxelBox interior = seed == 0 ? VoxelBox{{0, 0, 0}, {64, 64, 64}} : reference::random_box(random, 24);
  const VoxelBox seen = interior.grown(largest / kScaleOne + 3);
  const ScaleLattice scale = reference::random_lattice(random, seen, largest);
  const OrientationField orientation = reference::random_orientation(random, seen);
  const Halo halo{largest / kScaleOne + 2, oriented_reach(orientation, largest)};
  const BitBox solid = reference::random_solid(random, interior.grown(seed == 0 ? 0 : halo.total_vox()));
  const ClosingParams params{StructuringElement::cube, &orientation};
  const BitBox want = reference::close_oriented(solid, scale, sample(orientation, seen), interior);
  test::MemoryShelf shelf;
  if (seed == 0) store_voxels(solid, shelf);
  for (const auto& backend : backends) {
    CAPTURE(backend->name(), seed);
    BitBox got;
    backend->close(solid, scale, halo, params, interior, got);
    CHECK(got == want);
    if (seed != 0) continue;
    backend->close_from_shelf(shelf, {{0, 0, 0}, {1, 1, 1}}, scale, halo, params, interior, got);
    CHECK(got == want);
  }
}

TEST_CASE("a tile of nothing closes to nothing and a full one stays full on each backend", "[quick][backend]") {
  const VoxelBox interior{{-64, 3, 5}, {64, 21, 30}};
  ScaleLattice scale;
  scale.origin = {-20, -10, -10};
  scale.size = {40, 30, 30};
  scale.samples.assign(40 * 30 * 30, 77);
  scale.min = scale.max = 77;
  for (const auto& backend : available_backends()) {
    CAPTURE(backend->name());
    BitBox solid(interior.grown(12)), closed;
    backend->close(solid, scale, {6, 5}, {}, interior, closed);
    CHECK(closed.count() == 0);
    for (std::int64_t i = 0; i < solid.word_count(); ++i) solid.data()[i] = ~std::uint64_t(0);
    backend->close(solid, scale, {6, 5}, {}, interior, closed);
    CHECK(closed.count() == std::uint64_t(interior.volume()));
  }
}

TEST_CASE("closing from a shelf of bricks equals closing a box on each backend", "[quick][backend]") {
  const auto backends = available_backends();
  const int seed = GENERATE(range(0, 6));
  reference::Random random{std::uint64_t(seed) + 77};
  const Scale largest = Scale(random.between(1, 200));
  // The last one: an interior that is not whole bricks.
  VoxelBox interior{{-64, 0, 64}, {64 * random.between(0, 2), 64 * random.between(1, 2), 128}};
  if (seed == 5) interior = interior.grown(-random.between(1, 9));
  const Halo halo{largest / kScaleOne + 2, largest / kScaleOne + 1};
  const BrickBox bricks{{-2, 0, 0}, {random.between(0, 2), 3, 2}};  // does not cover all of the region
  BitBox solid = reference::random_solid(random, voxels_of(bricks));
  for (int i = 0; i < 2; ++i) {  // a full brick and an empty one
    const BrickCoord c{random.between(-2, -1), random.between(0, 2), random.between(0, 1)};
    const VoxelCoord first = first_voxel(c);
    for (std::int32_t z = 0; z < kBrickEdge; ++z) {
      for (std::int32_t y = 0; y < kBrickEdge; ++y)
        solid.row(first.y + y, first.z + z)[c.x - bricks.min.x] = i == 0 ? ~std::uint64_t(0) : 0;
    }
  }
  test::MemoryShelf shelf;
  store_voxels(solid, shelf);
  const ScaleLattice scale = reference::random_lattice(random, interior.grown(64 + halo.total_vox()), largest);
  for (const auto element : {StructuringElement::cube, StructuringElement::ball}) {
    BitBox want;
    CpuBackend().close(solid, scale, widest_halo(scale), {element}, interior, want);
    for (const auto& backend : backends) {
      CAPTURE(backend->name(), seed, element == StructuringElement::cube, largest);
      BitBox got;
      for (int again = 0; again < 2; ++again) {
        backend->close_from_shelf(shelf, bricks, scale, widest_halo(scale), {element}, interior, got);
        CHECK(got == want);
      }
    }
  }
}
