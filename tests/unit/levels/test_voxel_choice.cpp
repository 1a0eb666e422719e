#include "lib/levels/voxel_choice.h"
#include "tests/catch.h"

using namespace bp;

namespace {

const SceneSize kCube{Bounds3d{{0, 0, 0}, {1, 1, 1}}, 100000};

}  // namespace

TEST_CASE("voxels that are asked for are taken, then an eighth of the error, then what the faces need",
          "[quick][levels]") {
  LevelRequest levels;
  levels.errors_world = {0.08};
  CHECK(chosen_voxel({0.25}, levels, kCube) == 0.25);
  CHECK(chosen_voxel({0, 100}, levels, kCube) == Approx(0.01).epsilon(0.01));
  CHECK(chosen_voxel({}, levels, kCube) == Approx(0.01));
  levels = {};
  levels.faces = {20000};
  const double voxel = chosen_voxel({}, levels, kCube);
  CHECK(voxel < 1.0 / kDefaultResolution);
  levels.faces = {12};
  CHECK(chosen_voxel({}, levels, kCube) == chosen_voxel({0, kDefaultResolution}, levels, kCube));
}

TEST_CASE("a scene of few triangles has no voxels for more faces than it can use", "[quick][levels]") {
  LevelRequest levels;
  levels.faces = {20000};
  SceneSize few = kCube;
  few.triangles = 20000;  // at four faces each, enough
  const double voxel = chosen_voxel({}, levels, few);
  CHECK(voxel == chosen_voxel({}, levels, kCube));
  few.triangles = 1000;
  LevelRequest fewer;
  fewer.faces = {4000};
  CHECK(chosen_voxel({}, levels, few) == chosen_voxel({}, fewer, kCube));
  CHECK(chosen_voxel({}, levels, few) > voxel);
}

TEST_CASE("voxels of a tileset follow from the triangles, up to a number", "[quick][levels]") {
  const VoxelRequest tiles{0, 0, VoxelUse::tiles};
  SceneSize more = kCube;
  more.triangles *= 100;
  CHECK(chosen_voxel(tiles, {}, kCube) == chosen_voxel(tiles, {}, more));
  SceneSize fewer = kCube;
  fewer.triangles = kTilesetFaces / 2;
  CHECK(chosen_voxel(tiles, {}, fewer) > chosen_voxel(tiles, {}, kCube));
}
