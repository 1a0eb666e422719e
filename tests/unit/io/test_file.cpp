#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>

#include "io/file.h"
#include "tests/catch.h"
#include "tests/unit/io/scene_files.h"

using namespace bp;
using namespace bp::test;

namespace {

std::vector<std::string> names_in(const TempDir& dir) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(dir.path("."))) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

void write_file(const std::string& path, const std::string& text) {
  OutputFile file(path, true);
  file.write(text);
  file.commit();
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("what a killed process left is taken over, and goes", "[quick][io]") {
  const TempDir dir;
  (void)dir.file("out.partial-1", "left by a process that was killed, and longer than what is written now");
  SECTION("when the file is complete") {
    write_file(dir.path("out"), "new");
    CHECK(bytes_of_file(dir.path("out")) == "new");
    CHECK(names_in(dir) == Names{"out"});
  }
  SECTION("when it is given up") {
    { const OutputFile given_up(dir.path("out"), true); }
    CHECK(names_in(dir).empty());
  }
}

TEST_CASE("what a living process writes is left alone", "[quick][io]") {
  const TempDir dir;
  const int other = ::open(dir.file("out.partial-1", "others").c_str(), O_WRONLY | O_CLOEXEC);
  REQUIRE(::flock(other, LOCK_EX) == 0);
  write_file(dir.path("out"), "mine");
  CHECK(bytes_of_file(dir.path("out")) == "mine");
  CHECK(bytes_of_file(dir.path("out.partial-1")) == "others");
  ::close(other);
  CHECK(names_in(dir) == Names{"out", "out.partial-1"});
}

TEST_CASE("two may write the same file: each is whole, the last one stays", "[quick][io]") {
  const TempDir dir;
  OutputFile a(dir.path("out"), true), b(dir.path("out"), true);
  a.write("first");
  b.write("second");
  a.commit();
  CHECK(bytes_of_file(dir.path("out")) == "first");
  b.commit();
  CHECK(bytes_of_file(dir.path("out")) == "second");
  CHECK(names_in(dir) == Names{"out"});
}

TEST_CASE("links and pipes in the place of an unfinished file are not followed", "[quick][io]") {
  const TempDir dir;
  (void)dir.file("victim", "kept");
  std::filesystem::create_symlink("victim", dir.path("out.partial-1"));
  std::filesystem::create_hard_link(dir.path("victim"), dir.path("out.partial-2"));
  REQUIRE(::mkfifo(dir.path("out.partial-3").c_str(), 0600) == 0);
  write_file(dir.path("out"), "new");
  CHECK(bytes_of_file(dir.path("victim")) == "kept");
  CHECK(bytes_of_file(dir.path("out")) == "new");
}

TEST_CASE("the folder of a path is what its name stands in", "[quick][io]") {
  CHECK(folder_of("file") == ".");
  CHECK(folder_of("/file") == "/");
  CHECK(folder_of("a/b/file") == "a/b");
  CHECK(folder_of("../file") == "..");
}
