#include "lib/core/memory_share.h"
#include "tests/catch.h"
#include "tools/cli/advice.h"

using namespace bp;

TEST_CASE("the advice on an error names the options that would help", "[quick][tools]") {
  CHECK(advised(Error(ErrorCode::failed, "a: b")) == "a: b");
  CHECK(advised(Error(ErrorCode::bad_argument, "x.glb: exists", {Remedy::overwrite})) ==
        "x.glb: exists; add --overwrite to replace it");
  CHECK(advised(Error(ErrorCode::bad_argument, "a; repair it", {Remedy::use_cpu})) ==
        "a; repair it, or use --device cpu");
  CHECK(advised(Error(ErrorCode::bad_argument, "a; b.bpv: exists", {Remedy::overwrite})) ==
        "a; b.bpv: exists; add --overwrite to replace it");
  const Error tiles(ErrorCode::bad_argument, "too many", {Remedy::larger_voxels, Remedy::larger_tiles});
  CHECK(advised(tiles, "bpclose") == "too many; use larger voxels");  // it has no --tile
  CHECK(advised(tiles, "bplod") == "too many; use larger voxels, or a larger --tile");
  const std::uint64_t mib = std::uint64_t(1) << 20;
  CHECK(advised(NeedsMemory("closing a tile", 7 * mib, 3 * mib, 0)) ==
        "closing a tile takes 8 MiB, and the limit on memory leaves 3 MiB for it; raise --memory");
  CHECK(
      advised(
          NeedsMemory("closing a tile", 7 * mib, 3 * mib, 20 * mib, {Remedy::larger_voxels, Remedy::fewer_faces})) ==
      "closing a tile takes 8 MiB, and the limit on memory leaves 3 MiB for it; raise --memory to at least 21 MiB, use "
      "larger voxels, or fewer faces");
}

TEST_CASE("a limit on memory is known from what one share of it lacks", "[quick][tools]") {
  const std::uint64_t mib = std::uint64_t(1) << 20;
  for (const std::uint64_t limit : {64 * mib, 150 * mib, 500 * mib}) {
    const MemoryLimit now{limit, 100 * mib};
    for (const std::uint64_t missing : {mib, 40 * mib, 1000 * mib}) {
      const MemoryLimit raised{now.with(missing, 0.25), now.fixed_bytes};
      CHECK(raised.rest_bytes() / 4 >= now.rest_bytes() / 4 + missing);
      CHECK(raised.rest_bytes() / 4 <= now.rest_bytes() / 4 + missing + 2);
    }
  }
  CHECK(MemoryLimit{}.with(1, 0.5) == 0);
}
