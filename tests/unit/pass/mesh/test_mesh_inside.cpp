#include "lib/core/error.h"
#include "lib/pass/mesh/surface_around.h"
#include "tests/unit/pass/mesh/dumbbell.h"

using namespace bp;
using namespace bp::test;

namespace {

/// It is sound, and lies strictly inside `outer`.
void check_inside(const LatticeMesh& proxy, const std::vector<TriangleD>& outer) {
  MemorySource scene(outer);
  CheckOptions options;
  options.inside = true;
  const CheckReport report = check_proxy(indexed(proxy), &scene, options);
  CHECK(report.holds());
  CHECK(report.volume > 0);
}

}  // namespace

TEST_CASE("a proxy inside lies in the voxels that are meshed, and each level in the one before", "[quick][pass]") {
  VoxelSource source(kBox, dumbbell);
  source.header().fill = FillMode::inside;
  MeshParams params;
  params.mode = MeshMode::inside;
  params.faces = {600, 150, 50};
  params.tighten = GENERATE(true, false);
  MeshCounts counts;
  const std::vector<LatticeMesh> levels = mesh_stream(source, memory_context(), params, counts);
  REQUIRE(levels.size() == 3);
  std::vector<TriangleD> outer;  // what is not meshed, as the scene; closed
  for (VoxelCoord p = kBox.min; p.z < kBox.max.z; ++p.z) {
    for (p.y = 0; p.y < 48; ++p.y) {
      for (p.x = 0; p.x < 48; ++p.x) {
        const double l = 1.0 / 128, h = 1 - l, x = p.x, y = p.y, z = p.z;
        if (!dumbbell(p)) add_box(outer, {x + l, y + l, z + l}, {x + h, y + h, z + h});
      }
    }
  }
  add_box(outer, {-9, -9, -9}, {99, 99, 99});
  for (std::size_t i = 0; i < levels.size(); ++i) {
    CAPTURE(i, counts.levels[i].stopped_by, levels[i].triangles.size());
    CHECK(levels[i].triangles.size() <= params.faces[i]);
    check_inside(levels[i], outer);
    outer = world_triangles(levels[i]);
  }
  CHECK(counts.levels[0].measures.volume <= counts.solid_volume_world);
  CHECK(counts.levels[0].measures.volume > 0.5 * counts.solid_volume_world);
}

TEST_CASE("a proxy inside leaves out small parts, and says how much that is", "[quick][pass]") {
  const auto with_crumbs = [](VoxelCoord p) {
    const bool block = p.x >= 4 && p.x < 24 && p.y >= 4 && p.y < 24 && p.z >= 4 && p.z < 24;
    const bool crumb = p.x >= 30 && p.x < 32 && p.y >= 30 && p.y < 32 && (p.z == 8 || p.z == 20);
    return block || crumb;
  };
  VoxelSource source(kBox, with_crumbs);
  source.header().fill = FillMode::inside;
  MeshParams params;
  params.mode = MeshMode::inside;
  params.faces = {200};
  params.least_part = GENERATE(0.0, 4.0 / 8000, 0.001);  // 4 voxels are not less than 4 of 8000
  MeshCounts counts;
  const LatticeMesh proxy = mesh_stream(source, memory_context(), params, counts)[0];
  const std::uint64_t parts = params.least_part == 0.001 ? 2 : 0;
  CHECK(counts.dropped_parts == parts);
  CHECK(counts.dropped_voxels == 4 * parts);
  CHECK(counts.solid_volume_world == 8008 - 4 * double(parts));
  CHECK(check_proxy(indexed(proxy), nullptr).components == 3 - parts);
}

TEST_CASE("more faces of a proxy inside hold no less, also where they are few", "[quick][pass]") {
  const auto house = [](VoxelCoord p) {
    const bool walls = VoxelBox{{6, 4, 10}, {42, 24, 38}}.contains(p);
    const bool roof = VoxelBox{{4, 24, 6}, {44, 44, 42}}.contains(p) && p.y - 24 < 18 - std::abs(p.z - 24);
    return walls || roof;
  };
  double last = 0;
  for (const std::uint64_t faces : {8, 12, 16, 24, 40, 60}) {
    VoxelSource source(kBox, house);
    source.header().fill = FillMode::inside;
    MeshParams params;
    params.mode = MeshMode::inside;
    params.faces = {faces};
    MeshCounts counts;
    const LatticeMesh proxy = mesh_stream(source, memory_context(), params, counts)[0];
    CAPTURE(faces);
    CHECK(proxy.triangles.size() <= faces);
    check(proxy, nullptr);
    const double volume = counts.levels[0].measures.volume;
    CHECK(volume >= last);
    CHECK(volume <= counts.solid_volume_world);
    last = volume;
  }
  CHECK(last > 0.85 * 33120);  // of the voxels
}

TEST_CASE("a level goes on inside one that no voxel fits in", "[quick][pass]") {
  VoxelSource source(
      kBox, [](VoxelCoord p) { return p.y == 8 && (p.x == 8 || p.x == 20 || p.x == 30) && p.z >= 4 && p.z < 4 + p.x; });
  source.header().fill = FillMode::inside;
  MeshParams params;
  params.mode = MeshMode::inside;
  params.faces = {100, 20};
  MeshCounts counts;
  const std::vector<LatticeMesh> levels = mesh_stream(source, memory_context(), params, counts);
  check_inside(levels[1], world_triangles(levels[0]));
}

TEST_CASE("a least part without a meaning is refused", "[quick][pass]") {
  VoxelSource source(kBox, dumbbell);
  MeshParams params;
  params.least_part = 0.1;
  if (GENERATE(true, false)) {
    source.header().fill = FillMode::inside;
    params.mode = MeshMode::inside;
    params.least_part = GENERATE(-0.1, 1.5);
  }
  MeshCounts counts;
  CHECK_THROWS_AS(mesh_stream(source, memory_context(), params, counts), Error);
}

TEST_CASE("levels inside a wall stay in it, and out of what it encloses", "[quick][pass]") {
  const bool neck = GENERATE(false, true);  // the outside comes in, by less than a voxel of the next level
  VoxelSource source(kBox, [neck](VoxelCoord p) {
    const double r = length_of(p.x - 24, p.y - 24, p.z - 24);
    return r < 21 && r > 12 && !(neck && p.x == 24 && p.y == 24 && p.z > 24);
  });
  source.header().fill = FillMode::inside;
  MeshParams params;
  params.mode = MeshMode::inside;
  params.faces = {600, 200};
  MeshCounts counts;
  const std::vector<LatticeMesh> levels = mesh_stream(source, memory_context(), params, counts);
  check_inside(levels[1], world_triangles(levels[0]));
  CHECK(counts.levels[1].measures.volume < counts.levels[0].measures.volume);
}
