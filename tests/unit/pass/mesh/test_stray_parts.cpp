// Tests of parts of the closing that hold nothing of the enclosed set: nothing stops them as they shrink.
#include <random>

#include "lib/check/check_proxy.h"
#include "lib/pass/mesh/mesh_pass.h"
#include "tests/catch.h"
#include "tests/support/memory_scene.h"
#include "tests/support/voxel_source.h"

using namespace bp;
using namespace bp::test;

namespace {

const VoxelBox kSpace{{0, 0, 0}, {40, 40, 40}}, kBlock{{12, 14, 16}, {25, 26, 27}};

/// Boxes of a few voxels, some joined, away from the block.
std::vector<VoxelBox> strays(unsigned seed) {
  std::mt19937 random{seed};
  const auto below = [&](std::uint32_t n) { return std::int32_t(random() % n); };
  std::vector<VoxelBox> boxes;
  while (boxes.size() < 30) {
    const VoxelCoord at{below(34), below(34), below(34)}, side{1 + below(6), 1 + below(6), 1 + below(6)};
    const VoxelBox box{at, at + side};
    if (intersect(box.grown(2), kBlock).empty()) boxes.push_back(box);
  }
  return boxes;
}

}  // namespace

TEST_CASE("parts that hold nothing may vanish, but never come out inside out", "[quick][pass]") {
  const unsigned seed = GENERATE(range(0u, 12u));
  const std::vector<VoxelBox> boxes = strays(seed);
  const auto solid = [](VoxelCoord p) { return kBlock.contains(p); };
  const auto closing = [&](VoxelCoord p) {
    return solid(p) || std::any_of(boxes.begin(), boxes.end(), [&](const VoxelBox& b) { return b.contains(p); });
  };
  VoxelSource source(kSpace, solid, closing);
  MeshParams params;
  params.enclose = Enclose::input;
  params.faces = {GENERATE(600u, 150u, 60u)};
  params.error_world = GENERATE(0.0, 4.0);
  MeshCounts counts;
  const LatticeMesh proxy = mesh_stream(source, memory_context(), params, counts)[0];
  CAPTURE(seed, params.faces[0], params.error_world, proxy.triangles.size(), counts.levels[0].measures.volume);
  std::vector<TriangleD> scene;
  const double l = 1.0 / 128;
  add_box(scene, {kBlock.min.x + l, kBlock.min.y + l, kBlock.min.z + l},
          {kBlock.max.x - l, kBlock.max.y - l, kBlock.max.z - l});
  MemorySource block(scene);
  CheckOptions options;
  options.distances = false;
  CHECK(check_proxy(indexed(proxy), &block, options).holds());
}

TEST_CASE("pockets that a proxy inside may fill never come out inside out", "[quick][pass]") {
  const unsigned seed = GENERATE(range(0u, 12u));
  const std::vector<VoxelBox> boxes = strays(seed);
  const auto solid = [](VoxelCoord p) { return !kBlock.contains(p); };
  const auto opening = [&](VoxelCoord p) {
    return solid(p) && std::none_of(boxes.begin(), boxes.end(), [&](const VoxelBox& b) { return b.contains(p); });
  };
  VoxelSource source(kSpace, solid, opening);
  source.header().fill = FillMode::inside;
  MeshParams params;
  params.mode = MeshMode::inside;
  params.enclose = Enclose::input;
  params.faces = {8};
  MeshCounts counts;
  const LatticeMesh proxy = mesh_stream(source, memory_context(), params, counts)[0];
  CAPTURE(seed, proxy.triangles.size());
  const CheckReport report = check_proxy(indexed(proxy), nullptr);
  CHECK(report.holds());
  CHECK(report.sides_decided);
}
