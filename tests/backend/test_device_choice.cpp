// Tests what --device auto, cuda and cuda:N do with a GPU that works, one that does not, and one that fails during the
// run. Emulated.
#include <cuda_runtime.h>

#include <cstdlib>

#include "lib/device/device_error.h"
#include "tests/catch.h"
#include "tests/reference/random_closing.h"
#include "tools/run/make_backend.h"

using namespace bp;

namespace {

constexpr double kLong = 1e6;  ///< seconds: worth any start

struct Choice {
  CommonOptions common;
  Report report{"bptest"};
  explicit Choice(const char* device) {
    ::unsetenv("BP_BACKEND");
    common.device = parse_device(device);
    common.progress = ProgressMode::quiet;
    common.threads = 1;
  }
  std::vector<std::string> names(double core_seconds = kLong) {
    const auto names = names_of(make_backends(common, core_seconds, &report));
    emulator::faults = {};
    return names;
  }
  std::string error() {
    try {
      (void)make_backends(common, kLong, &report);
    } catch (const Error& e) {
      CHECK(exit_code(e.code()) == 4);
      emulator::faults = {};
      return e.what();
    }
    return "no error";
  }
};

const std::vector<std::string> kCpu{"cpu"}, kGpu{"cuda:0 emulated"};

}  // namespace

TEST_CASE("auto takes a GPU where the work is worth its start", "[quick][emulated]") {
  Choice choice("auto");
  CHECK(choice.names() == kGpu);
  CHECK(choice.names(0) == kCpu);
  CHECK(pinned_bytes(make_backends(choice.common, kLong, &choice.report)) == std::uint64_t(64) << 20);
  CHECK(choice.report.notes.empty());
}

TEST_CASE("auto without a GPU is the CPU, silently; with one that cannot be used it says so", "[quick][emulated]") {
  Choice choice("auto");
  emulator::faults.device_count = cudaErrorNoDevice;
  CHECK(choice.names() == kCpu);
  CHECK(choice.report.notes.empty());
  emulator::faults.device_count = cudaErrorInsufficientDriver;
  emulator::faults.driver_version = 11000;
  CHECK(choice.names() == kCpu);
  CHECK(choice.report.notes.size() == 1);
  emulator::faults.code = cudaErrorNoKernelImageForDevice;
  CHECK(choice.names() == kCpu);
  REQUIRE(choice.report.notes.size() == 2);
  CHECK(choice.report.notes[1].get<std::string>().find("the CPU is used") != std::string::npos);
}

TEST_CASE("a GPU that fails under auto is replaced by the CPU, which is said once", "[quick][emulated]") {
  Choice choice("auto");
  const Backends backends = make_backends(choice.common, kLong, &choice.report);
  REQUIRE(backends.size() > 1);
  emulator::faults.launch = cudaErrorLaunchFailure;
  reference::Random random{9};
  const VoxelBox interior{{0, 0, 0}, {64, 20, 20}};
  const Halo halo{3, 2};
  const ScaleLattice scale = reference::random_lattice(random, interior.grown(16), 2 * kScaleOne);
  const BitBox solid = reference::random_solid(random, interior.grown(halo.total_vox()));
  for (const auto& backend : backends) {
    BitBox closed;
    CHECK_NOTHROW(backend->close(solid, scale, halo, {StructuringElement::ball}, interior, closed));
  }
  emulator::faults = {};
  REQUIRE(choice.report.notes.size() == 1);
  CHECK(choice.report.notes[0].get<std::string>().find("cuda:0: ") == 0);
  CHECK(names_of(backends) == std::vector<std::string>{"cuda:0 emulated, then cpu"});
}

TEST_CASE("a GPU that was asked for and cannot be used is an error that names it", "[quick][emulated]") {
  CHECK(Choice("cuda").names(0) == kGpu);
  CHECK(Choice("cuda:0").names(0) == kGpu);
  CHECK(Choice("cuda:5").error() == "--device cuda:5: no such GPU; here are cuda:0 (emulated)");
  emulator::faults.device_count = cudaErrorNoDevice;
  CHECK(Choice("cuda").error().find("no GPU was found") != std::string::npos);
  emulator::faults.code = cudaErrorNoKernelImageForDevice;
  CHECK(Choice("cuda:0").error().find("cuda:0 emulated (compute capability 9.0)") == 0);
}
