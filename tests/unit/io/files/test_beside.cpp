#include <sys/stat.h>

#include <filesystem>

#include "io/files/beside.h"
#include "tests/catch.h"
#include "tests/unit/io/scene/scene_files.h"

using namespace bp;
using namespace bp::test;

TEST_CASE("a file beside another is found by the names that other programs give it", "[quick][io]") {
  const TempDir dir;
  std::filesystem::create_directory(dir.path("Tex"));
  const std::string wall = dir.file("brick wall.png", "w"), roof = dir.file("Tex/Roof.png", "r");
  const std::string folder = std::filesystem::path(wall).parent_path().string();
  for (const char* const name : {"brick wall.png", "\"brick wall.png\"", "'brick wall.png'", "Brick Wall.PNG",
                                 "\"BRICK WALL.PNG\"", "C:\\tex\\brick wall.png", "C:/tex/Brick Wall.png",
                                 "/no/such/folder/brick wall.png", "..\\other\\brick wall.png", "./brick wall.png"}) {
    CAPTURE(name);
    CHECK(std::filesystem::equivalent(find_beside(folder, name), wall));
  }
  for (const char* const name : {"Tex/Roof.png", "Tex\\Roof.png", "tex\\roof.PNG", "TEX/Roof.png"}) {
    CAPTURE(name);
    CHECK(find_beside(folder, name) == roof);
  }
  CHECK(find_beside("", wall) == wall);
}

TEST_CASE("of a file that is not there, the path is the one that its name says", "[quick][io]") {
  const TempDir dir;
  const std::string folder = std::filesystem::path(dir.file("a.png", "")).parent_path().string();
  CHECK(find_beside(folder, "\"gone.png\"") == folder + "/gone.png");
  CHECK(find_beside(folder, "tex\\gone.png") == folder + "/tex/gone.png");
  CHECK(find_beside(folder, "C:\\tex\\gone.png") == folder + "/gone.png");
  CHECK(find_beside(folder, "/tex/gone.png") == "/tex/gone.png");
  CHECK(find_beside(folder, "") == folder + "/");
}

TEST_CASE("what a file names is found among regular files only", "[quick][io]") {
  const TempDir dir;
  const std::string pipe = dir.path("A.png");
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  const std::string there = dir.file("sub", "");
  const std::string folder = std::filesystem::path(there).parent_path().string();
  CHECK(find_beside(folder, "a.png") == folder + "/a.png");
  CHECK(find_beside(folder, "sub/a.png") == folder + "/sub/a.png");
}

TEST_CASE("of several names that differ in case alone, the exact one is taken, else the first", "[quick][io]") {
  const TempDir dir;
  const std::string lower = dir.file("a.png", ""), upper = dir.file("A.png", "");
  const std::string folder = std::filesystem::path(lower).parent_path().string();
  if (std::filesystem::equivalent(lower, upper)) return;  // a file system that does not tell them apart
  CHECK(find_beside(folder, "a.png") == lower);
  CHECK(find_beside(folder, "A.png") == upper);
  CHECK(find_beside(folder, "A.PNG") == upper);
}
