#include <csignal>
#include <cstdlib>

#include "io/scene/detail/child_process.h"
#include "tests/catch.h"
#include "tests/unit/io/scene/scene_files.h"

using namespace bp;
using namespace bp::test;

namespace {

/// The sanitizers' allocator ends a process that gets no memory.
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
constexpr bool kOwnAllocator = true;
#else
constexpr bool kOwnAllocator = false;
#endif
#elif defined(__SANITIZE_ADDRESS__)
constexpr bool kOwnAllocator = true;
#else
constexpr bool kOwnAllocator = false;
#endif

// Two poles with the same box, one of them twice as far and mirrored; a concave polygon, a line, and an empty group.
const std::string kAc3d =
    "AC3Db\n"
    "MATERIAL \"m\" rgb 1 1 1 amb 0 0 0 emis 0 0 0 spec 0 0 0 shi 0 trans 0\n"
    "OBJECT world\nkids 2\n"
    "OBJECT group\nloc 10 0 0\nkids 1\n"
    "OBJECT poly\nloc 0 5 0\nnumvert 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
    "numsurf 2\nSURF 0x0\nmat 0\nrefs 4\n0 0 0\n1 0 0\n2 0 0\n3 0 0\nSURF 0x2\nmat 0\nrefs 2\n0 0 0\n1 0 0\nkids 0\n"
    "OBJECT group\nkids 0\n";

std::string child_complaint(const ChildLimits& limits, const std::function<std::string()>& work) {
  try {
    return "result: " + run_in_child("x.ifc", "the importer", "convert it", limits, work);
  } catch (const Error& e) {
    return (e.code() == ErrorCode::bad_input ? "" : "code: ") + std::string(e.what());
  } catch (const ChildOutOfMemory&) {
    return "no memory";
  }
}

}  // namespace

TEST_CASE("a format without a reader of its own goes through Assimp", "[quick][io]") {
  const TempDir dir;
  const std::vector<TriangleD> expected{{{{10, 5, 0}, {11, 5, 0}, {11, 6, 0}}}, {{{10, 5, 0}, {11, 6, 0}, {10, 6, 0}}}};
  for (const char* name : {"a.ac", "b.ACC", "no extension"}) {
    CAPTURE(name);
    const auto source = open_scene(dir.file(name, kAc3d));
    CHECK(read_all(*source) == expected);
    source->rewind();
    CHECK(read_all(*source) == expected);
    CHECK(source->counts().instances == 1);
    CHECK(source->counts().bad_faces == 0);
  }
  CHECK(read_mesh(dir.path("a.ac")).triangles.size() == 2);
}

TEST_CASE("files that Assimp refuses are named with its reason", "[quick][io]") {
  const TempDir dir;
  CHECK_THAT(complaint_of(dir.file("a.ac", "nonsense")), Contains("a.ac: cannot be read: ") && Contains("AC3D"));
  CHECK_THAT(complaint_of(dir.file("b.dae", "<COLLADA>")), Contains("b.dae") && Contains("convert it"));
  CHECK_THAT(complaint_of(dir.file("c.3ds", "")), Contains("c.3ds"));
}

TEST_CASE("an Error of a child process comes with all that it holds", "[quick][io]") {
  const Error thrown(ErrorCode::out_of_resource, "x: too little", {Remedy::more_memory, Remedy::split_scene}, 1 << 30);
  try {
    (void)run_in_child("x.ifc", "the importer", "convert it", {}, [&]() -> std::string { throw thrown; });
    FAIL("nothing was thrown");
  } catch (const Error& e) {
    CHECK(std::string(e.what()) == thrown.what());
    CHECK(e.code() == thrown.code());
    CHECK(e.remedies() == thrown.remedies());
    CHECK(e.memory_bytes() == thrown.memory_bytes());
  }
}

TEST_CASE("what goes wrong in a child process becomes an Error here", "[quick][io]") {
  ChildLimits limits;
  limits.memory_bytes = std::uint64_t(256) << 20;
  CHECK(child_complaint(limits, [] { return std::string("\0all\nwell", 9); }) ==
        "result: " + std::string("\0all\nwell", 9));
  CHECK(child_complaint(limits, [] { return std::string(3 << 20, 'x'); }).size() == (3 << 20) + 8);
  CHECK_THAT(child_complaint(limits, []() -> std::string { std::abort(); }),
             Contains("x.ifc: the importer crashed (signal 6); convert it"));
  CHECK_THAT(child_complaint(limits,
                             []() -> std::string {
                               std::raise(SIGSEGV);
                               return "";
                             }),
             Contains("signal 11"));
  CHECK_THAT(child_complaint(limits, []() -> std::string { std::_Exit(0); }), Contains("ended early"));
  CHECK_THAT(child_complaint(limits, []() -> std::string { throw std::runtime_error("why"); }),
             Contains("failed: why"));
  CHECK_THAT(child_complaint(limits, []() -> std::string { throw 7; }), Contains("failed"));
  CHECK(child_complaint(limits, []() -> std::string { fail(ErrorCode::out_of_resource, "full disk"); }) ==
        "code: full disk");
  if (!kOwnAllocator) {
    CHECK_THAT(child_complaint(limits,
                               []() -> std::string {
                                 std::vector<std::string> hoard;
                                 for (;;) hoard.emplace_back(1 << 20, 'x');
                               }),
               Contains("no memory"));
  }
  limits.answer_bytes = 1 << 20;
  CHECK(child_complaint(limits, [] { return std::string(3 << 20, 'x'); }) == "no memory");
}

TEST_CASE("a child process that hangs is stopped", "[io]") {
  ChildLimits limits;
  limits.cpu_seconds = 1;
  CHECK_THAT(child_complaint(limits,
                             []() -> std::string {
                               volatile int turns = 0;
                               while (turns == 0) {
                               }
                               return "";
                             }),
             Contains("still busy after 1 seconds"));
  limits.wall_seconds = 1;
  CHECK_THAT(child_complaint(limits,
                             []() -> std::string {
                               for (;;) ::pause();
                             }),
             Contains("took too long"));
}
