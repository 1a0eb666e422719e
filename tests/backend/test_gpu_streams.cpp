// Whole streams through the GPU backends of a tool: several on one device at the same time, and on several devices.
#include <cuda_runtime.h>

#include <tuple>

#include "gpu/cuda_backend.h"
#include "lib/core/parallel.h"
#include "lib/device/cpu/cpu_backend.h"
#include "lib/pass/close/close_pass.h"
#include "tests/backend/available_backends.h"
#include "tests/catch.h"
#include "tests/support/voxel_source.h"

using namespace bp;

namespace {

constexpr int kPerDevice = 8;  ///< as the tools make

class Bricks final : public BrickSink {
 public:
  using Entry = std::tuple<Layer, BrickCoord, BrickFill, BrickBits>;
  void write(const Brick& brick) override { all.emplace_back(brick.layer, brick.coord, brick.fill, brick.bits); }
  void finish() override {}
  std::vector<Entry> all;
};

/// Balls on a lattice, thinner and thicker, so that gaps of many widths close.
bool balls(VoxelCoord p) {
  const std::int32_t period = 23, r = 5 + (p.x / period + p.y / period * 2 + p.z / period * 3) % 6;
  const auto d = [&](std::int32_t v) { return v % period - period / 2; };
  return d(p.x) * d(p.x) + d(p.y) * d(p.y) + d(p.z) * d(p.z) < r * r;
}

std::vector<Bricks::Entry> close_all(const VoxelBox& box, Backends& backends, const ScaleField& field,
                                     StructuringElement element) {
  test::VoxelSource source(box, balls);
  Bricks sink;
  CloseOptions options;
  options.tile_vox = 64;
  options.context.make_shelf = test::memory_shelves();
  (void)close_stream(source, sink, backends, field, {element}, options);
  return sink.all;
}

}  // namespace

TEST_CASE("streams closed by eight backends at a time on each GPU have the CPU's bricks", "[quick][gpu]") {
  const std::vector<int> gpus = gpus_or_skip();
  if (gpus.empty()) return;
#ifdef BP_EMULATED_CUDA
  const VoxelBox box{{0, 0, 0}, {190, 120, 64}};
  const int rounds = 1;
#else
  const VoxelBox box{{0, 0, 0}, {500, 440, 380}};
  const int rounds = 3;
#endif
  const ThreadLimit threads(kPerDevice);
  ScaleField constant, varying;
  constant.base = varying.base = 3;
  varying.rules.push_back(box_rule({0, 0, 0}, {100, 50, 40}, 1.5));
  Backends cpu;
  for (int i = 0; i < kPerDevice; ++i) cpu.push_back(std::make_unique<CpuBackend>());
  Backends one, all;
  for (int i = 0; i < kPerDevice; ++i) one.push_back(make_cuda_backend(gpus.front()));
  if (gpus.size() > 1) {
    for (int i = 0; i < kPerDevice; ++i) {
      for (const int gpu : gpus) all.push_back(make_cuda_backend(gpu));
    }
  }
  for (const auto element : {StructuringElement::cube, StructuringElement::ball}) {
    for (const ScaleField& field : {constant, varying}) {
      const std::vector<Bricks::Entry> want = close_all(box, cpu, field, element);
      REQUIRE(want.size() > 6);
      for (int round = 0; round < rounds; ++round) {
        CAPTURE(round, int(element), field.constant());
        CHECK((close_all(box, one, field, element) == want));
        if (!all.empty()) CHECK((close_all(box, all, field, element) == want));
      }
    }
  }
}
