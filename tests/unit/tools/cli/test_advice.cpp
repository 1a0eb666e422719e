#include "lib/core/memory_share.h"
#include "tests/catch.h"
#include "tools/cli/advice.h"

using namespace bp;

namespace {

/// Where an error with this remedy and no other ends, told by a tool with all options or with none.
std::string advice_on(Remedy remedy, bool has_options) {
  return advised(Error(ErrorCode::failed, "a fact", {remedy}), [=](const std::string&) { return has_options; })
      .substr(6);
}

}  // namespace

TEST_CASE("the advice on an error names the options that would help", "[quick][tools]") {
  CHECK(advised(Error(ErrorCode::failed, "a: b")) == "a: b");
  CHECK(advised(Error(ErrorCode::bad_argument, "x.glb: exists", {Remedy::overwrite})) ==
        "x.glb: exists; add --overwrite to replace it");
  CHECK(advised(Error(ErrorCode::bad_argument, "a; repair it", {Remedy::use_cpu})) ==
        "a; repair it, or use --device cpu");
  CHECK(advised(Error(ErrorCode::bad_argument, "a; b.bpv: exists", {Remedy::overwrite})) ==
        "a; b.bpv: exists; add --overwrite to replace it");
  const Error tiles(ErrorCode::bad_argument, "too many", {Remedy::larger_voxels, Remedy::larger_tiles});
  CHECK(advised(tiles, [](const std::string& name) { return name != "--tile"; }) == "too many; use larger voxels");
  CHECK(advised(tiles, [](const std::string& name) { return name == "--tile"; }) ==
        "too many; use larger voxels, or a larger --tile");
  const std::uint64_t mib = std::uint64_t(1) << 20;
  CHECK(advised(NeedsMemory("closing a tile", 7 * mib, 3 * mib, 0)) ==
        "closing a tile takes 8 MiB, and the limit on memory leaves 3 MiB for it; raise --memory");
  CHECK(
      advised(
          NeedsMemory("closing a tile", 7 * mib, 3 * mib, 20 * mib, {Remedy::larger_voxels, Remedy::fewer_faces})) ==
      "closing a tile takes 8 MiB, and the limit on memory leaves 3 MiB for it; raise --memory to at least 20 MiB, use "
      "larger voxels, or fewer faces");
}

TEST_CASE("every remedy has its words, and is told only by tools that have the option", "[quick][tools]") {
  const struct {
    Remedy remedy;
    const char* words;
    bool needs_option;  ///< of the tool that tells it
  } table[] = {{Remedy::more_memory, "raise --memory", true},
               {Remedy::larger_voxels, "use larger voxels", false},
               {Remedy::smaller_voxels, "use smaller voxels", false},
               {Remedy::coarser_grid, "use a larger --voxel or a smaller --resolution", true},
               {Remedy::units_of_scene, "give --voxel in the units of the scene", true},
               {Remedy::other_units, "convert the scene to another unit of length", false},
               {Remedy::smaller_scale, "use a smaller --scale", true},
               {Remedy::smaller_tiles, "use a smaller --tile", true},
               {Remedy::larger_tiles, "use a larger --tile", true},
               {Remedy::fewer_faces, "use fewer faces", false},
               {Remedy::split_scene, "split it", false},
               {Remedy::move_scene, "move the scene near to its origin", false},
               {Remedy::repair_file, "repair or re-export the file", false},
               {Remedy::flood_fill, "use --fill flood", true},
               {Remedy::fill_inside, "voxelize with bpvox --fill inside", false},
               {Remedy::mode_inside, "use --mode inside", true},
               {Remedy::enclose_closing, "use --enclose closing", true},
               {Remedy::enclose_input, "use --enclose input", true},
               {Remedy::enclose_own_scene, "name with --enclose the scene that bpvox read", false},
               {Remedy::no_volume, "leave out --volume", true},
               {Remedy::fewer_users_of_device, "run fewer tools on this GPU", false},
               {Remedy::use_cpu, "use --device cpu", true},
               {Remedy::other_scratch_folder, "choose another --temp", true},
               {Remedy::other_output, "name another output", false},
               {Remedy::overwrite, "add --overwrite to replace it", true},
               {Remedy::name_format, "name it with --format", true},
               {Remedy::set_origin, "set --origin", true},
               {Remedy::double_format, "write GLB, PLY or OBJ", false},
               {Remedy::ply_format, "write PLY", false},
               {Remedy::free_space, "free some space", false}};
  for (const auto& row : table) {
    CAPTURE(row.words);
    const std::string told = std::string("; ") + row.words;
    CHECK(advice_on(row.remedy, true) == told);
    CHECK(advice_on(row.remedy, false) == (row.needs_option ? "" : told));
  }
}

TEST_CASE("an error told again in another place keeps all but its message", "[quick][tools]") {
  const Error first(ErrorCode::out_of_resource, "it takes 8 MiB", {Remedy::more_memory}, std::uint64_t(20) << 20);
  try {
    fail_as(first, "x.glb: {}", first.what());
  } catch (const Error& e) {
    CHECK(e.code() == first.code());
    CHECK(advised(e) == "x.glb: it takes 8 MiB; raise --memory to at least 20 MiB");
  }
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
