#include "tests/backend/available_backends.h"
#include "tests/catch.h"
#include "tests/reference/closing.h"
#include "tests/reference/random_closing.h"

using namespace bp;

namespace {

/// A halo that is safe for any field: what halo_of gives where the largest sample is everywhere.
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
    backend->close(solid, scale, widest_halo(scale), {element}, interior, got);  // buffers hold the tile before
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
