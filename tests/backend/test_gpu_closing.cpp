// Paths through gpu/ that the Backend chooses by itself, each forced here. Runs on a GPU, or emulated.
#include <algorithm>

#include "gpu/cuda_backend.h"
#include "gpu/kernels/device_error.h"
#include "lib/device/cpu/cpu_backend.h"
#include "tests/backend/available_backends.h"
#include "tests/backend/gpu_tile.h"
#include "tests/catch.h"
#include "tests/reference/closing.h"
#include "tests/reference/random_closing.h"
#include "tests/support/memory_shelf.h"

using namespace bp;

namespace {

struct Case {
  ScaleLattice scale;
  BitBox solid;
  VoxelBox interior;
  Halo halo;
  StructuringElement element;
};
Case random_case(int seed, int largest_vox) {
  reference::Random random{std::uint64_t(seed) + 1000};
  const Scale largest = Scale(random.between(8, largest_vox * kScaleOne));
  Case c;
  c.interior = reference::random_box(random, 40);
  c.halo = {largest / kScaleOne + 2, largest / kScaleOne + 1};
  const VoxelBox box = c.interior.grown(c.halo.total_vox());
  c.solid = reference::random_solid(random, box);
  c.scale = reference::random_lattice(random, box, largest);
  c.element = random.one_in(2) ? StructuringElement::cube : StructuringElement::ball;
  return c;
}

}  // namespace

#ifndef BP_EMULATED_CUDA  // there, tests/backend/test_emulated_gpu.cpp limits the memory
namespace {

std::size_t free_memory() {
  std::size_t free = 0, total = 0;
  BP_CUDA_CHECK(cudaMemGetInfo(&free, &total));
  return free;
}

/// Takes the device's memory but for about `left_bytes`, as other programs on it might.
class FullDevice {
 public:
  explicit FullDevice(std::size_t left_bytes) {
    for (std::size_t most = free_memory(); most >= kLeast && free_memory() > left_bytes + kLeast;) {
      most = std::min(most, free_memory() - left_bytes);
      void* p = nullptr;
      if (cudaMalloc(&p, most) == cudaSuccess) {
        taken_.push_back(p);
      } else {
        (void)cudaGetLastError();
        most /= 2;
      }
    }
  }
  ~FullDevice() {
    for (void* p : taken_) (void)cudaFree(p);
  }
  FullDevice(const FullDevice&) = delete;
  FullDevice& operator=(const FullDevice&) = delete;

 private:
  static constexpr std::size_t kLeast = std::size_t(4) << 20;
  std::vector<void*> taken_;
};

}  // namespace

TEST_CASE("on a device that is nearly full, tiles are closed in parts, to the same bits", "[quick][gpu]") {
  if (gpus_or_skip().empty()) return;
  constexpr std::size_t kLeft = std::size_t(48) << 20;
  reference::Random random{11};
  const VoxelBox interior{{0, 0, 0}, {512, 448, 448}};
  const Halo halo{8, 7};
  const ScaleLattice scale = reference::random_lattice(random, interior.grown(64), 6 * kScaleOne);
  BitBox solid(voxels_of(bricks_of(interior.grown(halo.total_vox()))));
  for (int i = 0; i < 3000; ++i) solid.set({random.between(0, 511), random.between(0, 447), random.between(0, 447)});
  test::MemoryShelf shelf;
  store_voxels(solid, shelf);
  const ClosingParams params{StructuringElement::ball};
  BitBox want;
  CpuBackend().close(solid, scale, halo, params, interior, want);
  {
    const std::size_t before = free_memory();
    const auto backend = make_cuda_backend(0);
    BitBox got;
    backend->close(solid, scale, halo, params, interior, got);  // loads the kernels, too
    CHECK(got == want);
    REQUIRE(before - free_memory() > 3 * kLeft);
  }
  const FullDevice full(kLeft);
  const auto backend = make_cuda_backend(0);
  for (int run = 0; run < 2; ++run) {
    BitBox got;
    backend->close(solid, scale, halo, params, interior, got);
    CHECK(got == want);
    backend->close_from_shelf(shelf, bricks_of(solid.box()), scale, halo, params, interior, got);
    CHECK(got == want);
  }
}
#endif

TEST_CASE("what fails on a device ends tools with the code of devices, and says where", "[quick][gpu]") {
  CHECK_THROWS_AS(check_cuda(cudaErrorMemoryAllocation, "x_kernel"), OutOfDeviceMemory);
  try {
    check_cuda(cudaErrorLaunchFailure, "x_kernel");
    FAIL("no error");
  } catch (const OutOfDeviceMemory&) {
    FAIL("a failed launch is not closed in parts");
  } catch (const Error& e) {
    CHECK(exit_code(e.code()) == 4);
    CHECK(std::string(e.what()).find("x_kernel") != std::string::npos);
  }
}

TEST_CASE("narrow slabs and 32-bit distances change no bit", "[quick][gpu]") {
  if (gpus_or_skip().empty()) return;
  const int seed = GENERATE(range(0, 12));
  const Case c = random_case(seed, 7);
  const BitBox want = reference::close(c.solid, c.scale, c.element, c.interior);
  GpuTile tile(c.solid, c.scale, c.halo, c.interior);
  for (const bool wide : {false, true}) {
    for (const std::size_t slab_bytes : {std::size_t(1), std::size_t(1) << 28}) {
      CAPTURE(seed, wide, slab_bytes);
      DeviceClosing closing({4, slab_bytes, wide});
      tile.poison(nullptr);
      tile.close(closing, c.element, nullptr);
      CHECK(tile.result(nullptr) == want);
    }
  }
}

TEST_CASE("the paper's hierarchical collision gives the same voxels", "[quick][gpu]") {
  if (gpus_or_skip().empty()) return;
  const int seed = GENERATE(range(0, 24));
  const Case c = random_case(seed, 6);
  const BitBox want = reference::close(c.solid, c.scale, c.element, c.interior);
  GpuTile tile(c.solid, c.scale, c.halo, c.interior);
  for (const auto variant : {HierarchicalVariant::plain, HierarchicalVariant::half_resolution}) {
    CAPTURE(seed, int(variant), c.scale.constant(), c.element == StructuringElement::cube);
    HierarchicalClosing closing(4);
    tile.poison(nullptr);
    tile.close(closing, c.element, variant, nullptr);
    CHECK(tile.result(nullptr) == want);
  }
}

TEST_CASE("turned cubes close as their definition says, by rows and by the paper's walk", "[quick][gpu][oriented]") {
  if (gpus_or_skip().empty()) return;
  const int seed = GENERATE(range(0, 24));
  reference::Random random{std::uint64_t(seed) + 5000};
  const Scale largest = Scale(random.between(8, 5 * kScaleOne));
  const VoxelBox interior = reference::random_box(random, 32);
  const Halo halo{largest / kScaleOne + 2, oriented_reach(largest) + 1};
  const VoxelBox box = interior.grown(halo.total_vox()), seen = interior.grown(halo.erosion_vox);
  const BitBox solid = reference::random_solid(random, box);
  const ScaleLattice scale = reference::random_lattice(random, box, largest);
  const OrientationField field = reference::random_orientation(random, seen);
  const BitBox want = reference::close_oriented(solid, scale, sample(field, seen), interior);
  GpuTile tile(solid, scale, halo, interior);
  tile.orient(field, seen);
  CAPTURE(seed, scale.constant());
  DeviceClosing rows({4, std::size_t(1) << 28, false});
  tile.poison(nullptr);
  tile.close(rows, StructuringElement::cube, nullptr);
  CHECK(tile.result(nullptr) == want);
  for (const auto variant : {HierarchicalVariant::plain, HierarchicalVariant::half_resolution}) {
    HierarchicalClosing closing(4);
    tile.poison(nullptr);
    tile.close(closing, StructuringElement::cube, variant, nullptr);
    CHECK(tile.result(nullptr) == want);
  }
}

TEST_CASE("large turned cubes close on a GPU as on the CPU, whole and in two parts", "[quick][gpu][oriented]") {
  const std::vector<int> gpus = gpus_or_skip();
  const int seed = GENERATE(range(0, 4));
  reference::Random random{std::uint64_t(seed) + 6000};
  const Scale largest = Scale(random.between(10 * kScaleOne, 36 * kScaleOne));
  const VoxelBox interior{{-20, 5, -9}, {44, 17 + seed, 4}};
  const Halo halo{largest / kScaleOne + 2, oriented_reach(largest) + 1};
  const VoxelBox box = interior.grown(halo.total_vox());
  BitBox solid(box);
  for (int i = 0; i < 12; ++i)
    solid.set({random.between(box.min.x, box.max.x - 1), random.between(box.min.y, box.max.y - 1),
               random.between(box.min.z, box.max.z - 1)});
  ScaleLattice scale = reference::random_lattice(random, box, largest);
  for (Scale& s : scale.samples) s = Scale(seed % 2 == 0 ? largest : random.between(largest * 7 / 8, largest));
  scale.min = *std::min_element(scale.samples.begin(), scale.samples.end());
  scale.max = *std::max_element(scale.samples.begin(), scale.samples.end());
  const OrientationField field = reference::random_orientation(random, interior.grown(halo.erosion_vox));
  const ClosingParams params{StructuringElement::cube, &field};
  BitBox want;
  CpuBackend().close(solid, scale, halo, params, interior, want);
  for (const int device : gpus) {
    const auto gpu = make_cuda_backend(device);
    CAPTURE(seed, largest, scale.constant(), field.rotations.size());
    BitBox got;
    gpu->close(solid, scale, halo, params, interior, got);
    CHECK(got == want);
    VoxelBox lower = interior, upper = interior;
    lower.max.x = upper.min.x = 0;
    for (const VoxelBox& part : {lower, upper}) {
      gpu->close(solid, scale, halo, params, part, got);
      BitBox same(part);
      copy_voxels(want, same);
      CHECK(got == same);
    }
  }
}

TEST_CASE("cubes that are not turned close like cubes", "[quick][gpu]") {
  if (gpus_or_skip().empty()) return;
  Case c = random_case(3, 6);
  c.element = StructuringElement::cube;
  const BitBox want = reference::close(c.solid, c.scale, c.element, c.interior);
  const VoxelBox box = c.solid.box();
  reference::Random random{1};
  RotationLattice rotations = reference::random_rotations(random, box);
  for (Rotation& r : rotations.cells) r = Rotation{};
  GpuTile tile(c.solid, c.scale, c.halo, c.interior);
  tile.orient(rotations);
  HierarchicalClosing closing(4);
  tile.close(closing, c.element, HierarchicalVariant::half_resolution, nullptr);
  CHECK(tile.result(nullptr) == want);
}
