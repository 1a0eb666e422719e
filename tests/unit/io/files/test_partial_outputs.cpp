#include "io/files/made_folders.h"
#include "io/files/partial_outputs.h"
#include "tests/catch.h"
#include "tests/unit/io/scene/scene_files.h"

using namespace bp;
using namespace bp::test;
namespace fs = std::filesystem;

TEST_CASE("what is being made goes when a signal comes: files, trees, folders with nothing else", "[quick][io]") {
  const TempDir dir;
  const MadeFolder a(dir.path("a")), b(dir.path("a/b")), c(dir.path("a/b/c"));
  const PartialOutput tree(dir.path("a/b/c/tree"), PartialOutput::Kind::tree);
  const PartialOutput file(dir.file("a/b/c/file", "x"));
  fs::create_directories(dir.path("a/b/c/tree/d/e"));
  fs::create_directory_symlink(dir.path("."), dir.path("a/b/c/tree/link"));
  for (int i = 0; i < 300; ++i) (void)dir.file("a/b/c/tree/d/" + std::string(20, 'x') + std::to_string(i), "x");
  const bool with_another = GENERATE(false, true);
  if (with_another) (void)dir.file("a/another", "x");
  remove_partial_outputs();
  CHECK(fs::exists(dir.path("a")) == with_another);
  CHECK_FALSE(fs::exists(dir.path("a/b")));
  CHECK(fs::exists(dir.path(".")));
}

TEST_CASE("a folder that was made goes again, unless kept or used", "[quick][io]") {
  const TempDir dir;
  { const MadeFolder made(dir.path("a/")); }
  CHECK_FALSE(fs::exists(dir.path("a")));
  fs::create_directory(dir.path("a"));
  { const MadeFolder made(dir.path("a")), inner(dir.path("a/b")); }
  CHECK(fs::exists(dir.path("a")));
  CHECK_FALSE(fs::exists(dir.path("a/b")));
  {
    MadeFolder made(dir.path("a/b"));
    made.keep();
  }
  CHECK(fs::exists(dir.path("a/b")));
  (void)dir.file("a/file", "x");
  CHECK_THROWS_AS(MadeFolder(dir.path("a/file")), Error);
  CHECK_THROWS_AS(MadeFolder(dir.path("a/file/x")), Error);
}

TEST_CASE("a folder is not made where the one above it is missing", "[quick][io]") {
  const TempDir dir;
  CHECK_THROWS_WITH(MadeFolder(dir.path("none/deep/")),
                    ContainsSubstring("there is no folder " + dir.path("none") + ";"));
  CHECK_FALSE(fs::exists(dir.path("none")));
}
