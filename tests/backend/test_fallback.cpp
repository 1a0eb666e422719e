// A device that fails: the CPU finishes the call, with the arguments as they were.
#include "lib/device/cpu/fallback_backend.h"
#include "lib/device/device_error.h"
#include "tests/catch.h"
#include "tests/reference/random_closing.h"
#include "tests/support/memory_shelf.h"

using namespace bp;

namespace {

/// Works like the CPU for some calls, then spoils its outputs and fails.
class FailingBackend final : public Backend {
 public:
  FailingBackend(int good_calls, int* living) : good_(good_calls), living_(living) { ++*living_; }
  ~FailingBackend() override { --*living_; }
  [[nodiscard]] std::string name() const override { return "fake:0"; }
  [[nodiscard]] std::uint64_t pinned_bytes() const override { return 8; }
  void close(const BitBox& solid, const ScaleLattice& scale, const Halo& halo, const ClosingParams& params,
             const VoxelBox& interior, BitBox& closed) override {
    if (good_-- > 0) return cpu_.close(solid, scale, halo, params, interior, closed);
    closed.reset(interior);
    spoil(closed);
  }
  void weigh(const CageCoordinates& coordinates, std::span<const Vec3d> points, bool carry_outside, WeightBlock& out,
             std::span<CoordinateRows::Place> places) override {
    if (good_-- > 0) return cpu_.weigh(coordinates, points, carry_outside, out, places);
    for (std::int32_t& unit : out.units) unit = 99;
    throw DeviceError("fake:0: on fire");
  }

 private:
  [[noreturn]] static void spoil(BitBox& bits) {
    std::fill_n(bits.data(), bits.word_count(), 0x5a5a5a5a5a5a5a5au);
    throw DeviceError("fake:0: on fire");
  }
  int good_;
  int* living_;
  CpuBackend cpu_;
};

}  // namespace

TEST_CASE("once a device fails, the CPU does the call and all later ones to the same bits, with one warning",
          "[quick][backend]") {
  const int good_calls = GENERATE(range(0, 4));
  int living = 0;
  std::vector<std::string> warnings;
  FallbackBackend backend(std::make_unique<FailingBackend>(good_calls, &living),
                          [&](const DeviceError& e) { warnings.push_back(e.what()); });
  CHECK(backend.name() == "fake:0");
  CHECK(backend.pinned_bytes() == 8);
  CpuBackend cpu;
  reference::Random random{3};
  const VoxelBox interior{{0, 0, 0}, {64, 64, 64}};
  const Halo halo{4, 3};
  const ScaleLattice scale = reference::random_lattice(random, interior.grown(16), 40);
  const BitBox solid = reference::random_solid(random, voxels_of(bricks_of(interior.grown(halo.total_vox()))));
  test::MemoryShelf shelf;
  store_voxels(solid, shelf);
  for (int round = 0; round < 2; ++round) {  // 2 calls each
    CAPTURE(good_calls, round);
    BitBox want_closed, closed;
    cpu.close(solid, scale, halo, {StructuringElement::ball}, interior, want_closed);
    backend.close(solid, scale, halo, {StructuringElement::ball}, interior, closed);
    CHECK(closed == want_closed);
    closed.reset({});
    backend.close_from_shelf(shelf, bricks_of(solid.box()), scale, halo, {StructuringElement::ball}, interior, closed);
    CHECK(closed == want_closed);
  }
  CHECK(warnings == std::vector<std::string>{"fake:0: on fire"});
  CHECK(living == 0);
  CHECK(backend.name() == "fake:0, then cpu");
  CHECK(backend.pinned_bytes() == 0);
}

TEST_CASE("an error that is not the device's is not hidden", "[quick][backend]") {
  class Refusing final : public Backend {
   public:
    [[nodiscard]] std::string name() const override { return "fake:0"; }
    void close(const BitBox&, const ScaleLattice&, const Halo&, const ClosingParams&, const VoxelBox&,
               BitBox&) override {
      fail(ErrorCode::bad_input, "no");
    }
    void weigh(const CageCoordinates&, std::span<const Vec3d>, bool, WeightBlock&,
               std::span<CoordinateRows::Place>) override {}
  };
  bool warned = false;
  FallbackBackend backend(std::make_unique<Refusing>(), [&](const DeviceError&) { warned = true; });
  BitBox closed;
  CHECK_THROWS_AS(backend.close({}, {}, {}, {}, {}, closed), Error);
  CHECK_FALSE(warned);
}
