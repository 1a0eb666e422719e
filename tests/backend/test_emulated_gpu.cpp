// Tests that need an emulated device: another order of its threads, a memory that is too small, and failures.
#include <cuda_runtime.h>

#include "gpu/cuda_backend.h"
#include "gpu/kernels/device_error.h"
#include "lib/closing/rotation.h"
#include "lib/device/cpu/cpu_backend.h"
#include "lib/device/cpu/fallback_backend.h"
#include "tests/catch.h"
#include "tests/reference/closing.h"
#include "tests/reference/random_closing.h"
#include "tests/support/cages.h"

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

TEST_CASE("a tile that does not fit in device memory is closed in parts, to the same bits", "[quick][emulated]") {
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

TEST_CASE("turned cubes that do not fit in device memory close in parts, in any order of threads",
          "[quick][emulated]") {
  const Tile tile;
  reference::Random random{17};
  const OrientationField field = reference::random_orientation(random, tile.interior.grown(tile.halo.erosion_vox));
  const Halo halo{tile.halo.erosion_vox, oriented_reach(field, tile.scale.max)};
  const ClosingParams params{StructuringElement::cube, &field};
  BitBox want, got;
  CpuBackend().close(tile.solid, tile.scale, halo, params, tile.interior, want);
  std::size_t whole = 0;
  for (const unsigned order : {0u, 1u, 77u}) {
    CAPTURE(order);
    emulator::set_thread_order(order);
    const auto backend = make_cuda_backend(0);
    backend->close(tile.solid, tile.scale, halo, params, tile.interior, got);
    whole = emulator::memory_in_use();
    CHECK(got == want);
  }
  emulator::set_thread_order(0);
  emulator::set_memory_limit(whole / 3);
  make_cuda_backend(0)->close(tile.solid, tile.scale, halo, params, tile.interior, got);
  emulator::set_memory_limit(std::size_t(-1));
  CHECK(got == want);
}

namespace {

/// Returns the message of a call that fails as a device does; empty if it does not fail.
template <class Call>
std::string device_error(const Call& call) {
  std::string text;
  try {
    call();
  } catch (const OutOfDeviceMemory&) {
    text = "out of device memory";
  } catch (const DeviceError& e) {
    CHECK(exit_code(e.code()) == 4);
    text = e.what();
  }
  emulator::faults = {};
  return text;
}

}  // namespace

TEST_CASE("a GPU that the build has no code for is refused at once, with its name", "[quick][emulated]") {
  emulator::faults.code = cudaErrorNoKernelImageForDevice;
  const std::string said = device_error([] { (void)make_cuda_backend(0); });
  CHECK(said.find("cuda:0 emulated (compute capability 9.0)") == 0);
}

TEST_CASE("no driver and no device mean no GPU; a driver that is too old or broken is told", "[quick][emulated]") {
  emulator::faults.device_count = cudaErrorNoDevice;
  CHECK(cuda_devices().empty());
  emulator::faults.device_count = cudaErrorInsufficientDriver;
  emulator::faults.driver_version = 0;
  CHECK(cuda_devices().empty());
  emulator::faults.driver_version = 11040;
  CHECK(device_error([] { (void)cuda_devices(); }).find("CUDA 11.4") != std::string::npos);
  emulator::faults.device_count = cudaErrorLaunchFailure;
  CHECK(device_error([] { (void)cuda_devices(); }).find("cudaErrorLaunchFailure") != std::string::npos);
  CHECK(cuda_devices().size() == 1);
}

TEST_CASE("too little page-locked memory is not out of device memory", "[quick][emulated]") {
  const Tile tile;
  const auto backend = make_cuda_backend(0);
  BitBox got;
  emulator::faults.page_locked = cudaErrorMemoryAllocation;
  const std::string said = device_error(
      [&] { backend->close(tile.solid, tile.scale, tile.halo, {StructuringElement::ball}, tile.interior, got); });
  CHECK(said.find("cuda:0: 4 MiB of page-locked host memory") == 0);
}

TEST_CASE("a GPU whose launches fail says which it is, and the CPU takes over where it may", "[quick][emulated]") {
  const Tile tile;
  BitBox got;
  const auto backend = make_cuda_backend(0);
  emulator::faults.launch = cudaErrorLaunchFailure;
  const std::string said = device_error(
      [&] { backend->close(tile.solid, tile.scale, tile.halo, {StructuringElement::ball}, tile.interior, got); });
  CHECK(said.find("cuda:0: ") == 0);
  std::string warning;
  FallbackBackend either(make_cuda_backend(0), [&](const DeviceError& e) { warning = e.what(); });
  emulator::faults.launch = cudaErrorLaunchFailure;
  either.close(tile.solid, tile.scale, tile.halo, {StructuringElement::ball}, tile.interior, got);
  emulator::faults = {};
  CHECK(warning == said);
  CHECK(got == tile.want);
}

TEST_CASE("points whose numbers do not fit in device memory are weighed in parts, to the same bits",
          "[quick][emulated]") {
  const CageCoordinates coordinates(make_cage(test::sphere_cage(6, 7, 0.2), "sphere"));
  std::vector<Vec3d> points;
  for (int i = 0; i < 301; ++i) points.push_back({0.001 * i, 0.002 * i - 0.3, 0.1});
  const auto weigh = [&](Backend& backend) {
    WeightBlock block(points.size(), coordinates.columns());
    std::vector<CoordinateRows::Place> places(points.size());
    backend.weigh(coordinates, points, true, block, places);
    return block.units;
  };
  CpuBackend cpu;
  const auto gpu = make_cuda_backend(0);
  emulator::set_memory_limit(std::size_t(600) << 10);
  const std::vector<std::int32_t> got = weigh(*gpu);
  CHECK(emulator::memory_in_use() > std::size_t(100) << 10);
  emulator::set_memory_limit(std::size_t(-1));
  CHECK(got == weigh(cpu));
}

TEST_CASE("a device that fails at coordinates leaves them to the CPU, with a warning", "[quick][emulated]") {
  const CageCoordinates coordinates(make_cage(test::sphere_cage(5, 6), "sphere"));
  int warnings = 0;
  FallbackBackend backend(make_cuda_backend(0), [&](const DeviceError&) { ++warnings; });
  emulator::faults.launch = cudaErrorLaunchFailure;
  const std::vector<Vec3d> points{{0.1, 0.2, 0.3}};
  WeightBlock got(1, coordinates.columns()), want = got;
  std::vector<CoordinateRows::Place> places(1);
  backend.weigh(coordinates, points, true, got, places);
  emulator::faults = {};
  CpuBackend().weigh(coordinates, points, true, want, places);
  CHECK(got.units == want.units);
  CHECK(warnings == 1);
}
