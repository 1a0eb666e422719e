#include "lib/core/error.h"
#include "lib/pass/mesh/detail/proxy_limits.h"
#include "lib/pass/mesh/surface_around.h"
#include "lib/surface/surface.h"
#include "tests/unit/pass/mesh/dumbbell.h"

using namespace bp;
using namespace bp::test;

TEST_CASE("a volume below that of the voxels is refused", "[quick][pass]") {
  MeshParams params;
  params.volume_ratio = 0.9;
  MeshCounts counts;
  CHECK_THROWS_AS(mesh(params, counts), Error);
}

TEST_CASE("no point of the proxy is farther from the closing than --error", "[quick][pass]") {
  MeshParams params;
  params.error_world = GENERATE(1.0, 2.0, 4.0);
  params.distances = true;
  params.tighten = GENERATE(true, false);
  MeshCounts counts;
  const std::vector<LatticeMesh> levels = mesh(params, counts);
  CAPTURE(params.error_world, levels[0].triangles.size());
  const std::vector<TriangleD> inner = points_inside();
  check(levels[0], &inner);
  CHECK(counts.levels[0].stopped_by == "error");
  CHECK(counts.levels[0].measures.proxy_to_enclosed->at_least <= params.error_world * (1 + 1e-9));
  CHECK(counts.levels[0].measures.proxy_to_enclosed->at_most > params.error_world / 2);  // the room is used
  CHECK(counts.levels[0].simplify.faces_out < counts.levels[0].simplify.faces_flat / 2);
}

TEST_CASE("the error holds against the input too, where the closing is near it", "[quick][pass]") {
  VoxelSource source(kBox, dumbbell, [](VoxelCoord p) {  // the closing: one voxel thicker in x
    return dumbbell(p) || dumbbell({p.x + 1, p.y, p.z}) || dumbbell({p.x - 1, p.y, p.z});
  });
  MeshParams params;
  params.enclose = Enclose::input;
  params.error_world = 1.5;
  params.distances = true;
  MeshCounts counts;
  const std::vector<LatticeMesh> levels = mesh_stream(source, memory_context(), params, counts);
  const std::vector<TriangleD> inner = points_inside();
  check(levels[0], &inner);
  CHECK(counts.levels[0].measures.proxy_to_enclosed->at_least <= 1.5 * (1 + 1e-9));
}

TEST_CASE("the volume stays below --volume, and the first target that is reached is named", "[quick][pass]") {
  MeshParams params;
  params.volume_ratio = GENERATE(1.02, 1.1, 1.4);
  params.faces = {300};
  MeshCounts counts;
  const std::vector<LatticeMesh> levels = mesh(params, counts);
  const LevelCounts& level = counts.levels[0];
  CAPTURE(level.stopped_by, level.simplify.faces_out);
  const std::vector<TriangleD> inner = points_inside();
  check(levels[0], &inner);
  CHECK(level.measures.volume <= params.volume_ratio * counts.solid_volume_world);
  CHECK(level.measures.volume == volume_world(levels[0]));
  CHECK((level.stopped_by == "volume") == (levels[0].triangles.size() > 300));
  CHECK((level.stopped_by == "faces") == (levels[0].triangles.size() <= 300));
  if (params.volume_ratio < 1.05) CHECK(level.stopped_by == "volume");
  if (params.volume_ratio > 1.3) CHECK(level.stopped_by == "faces");
}

TEST_CASE("a stage counts volume from the surface that it begins with", "[quick][pass]") {
  ProxyLimits limits({.volume_world = 10}, GridFrame{}, nullptr);
  const int128 unit6 = int128(6) * kLatticePerVoxel * kLatticePerVoxel * kLatticePerVoxel;
  const std::int64_t l = 3 * kLatticePerVoxel;
  const LatticeCoord a{0, 0, 0}, b{l, 0, 0}, c{0, l, 0}, up{0, 0, 2 * kLatticePerVoxel};
  const std::vector<LatticeTriangle> flat = {{a, b, c}}, peak = {{up, a, b}, {up, b, c}, {up, c, a}};  // 3 more
  limits.begin(5 * unit6);
  CHECK(limits.take(flat, peak));        // 8
  CHECK_FALSE(limits.take(flat, peak));  // would be 11
  limits.begin(5 * unit6);               // the first was undone
  CHECK(limits.take(flat, peak));
}

TEST_CASE("levels share --error: none is farther from what level 0 encloses than its share", "[quick][pass]") {
  MeshParams params;
  params.faces = {400, 120, 40};
  params.error_world = 15;
  params.distances = true;
  if (GENERATE(false, true)) params.quads = true;
  MeshCounts counts;
  const std::vector<LatticeMesh> levels = mesh(params, counts);
  std::vector<TriangleD> inner = points_inside();
  for (std::size_t i = 0; i < levels.size(); ++i) {
    CAPTURE(i, counts.levels[i].stopped_by, levels[i].triangles.size());
    CHECK(counts.levels[i].error_world == 5.0 * double(i + 1));
    CHECK(counts.levels[i].measures.proxy_to_enclosed->at_least <= 5.0 * double(i + 1) * (1 + 1e-9));
    check(levels[i], &inner);
    inner = world_triangles(levels[i]);
  }
}

TEST_CASE("fits each may use all of --error", "[quick][pass]") {
  MeshParams params;
  params.mode = MeshMode::fit;
  params.faces = {400, 120};
  params.error_world = 6;
  MeshCounts counts;
  (void)mesh(params, counts);
  for (const LevelCounts& level : counts.levels) CHECK(level.error_world == 6);
}

TEST_CASE("error and volume hold for every choice of diagonals", "[quick][pass]") {
  MeshParams params;
  params.quads = true;
  params.faces = {60};
  params.volume_ratio = 1.15;
  if (GENERATE(false, true)) {
    params.volume_ratio = 0;
    params.error_world = 1.5;
  }
  MeshCounts counts;
  const LatticeMesh proxy = mesh(params, counts)[0];
  const MeshMeasures& m = counts.levels[0].measures;
  REQUIRE(m.quads);
  if (params.volume_ratio > 0) {
    CHECK(counts.levels[0].stopped_by == "volume");
    CHECK(m.quads->volume_most <= params.volume_ratio * counts.solid_volume_world * (1 + 1e-12));
  } else {
    CHECK(counts.levels[0].stopped_by == "error");
    VoxelSource source(kBox, dumbbell);
    MemoryShelf shelf;
    fill_shelf(shelf, kBox, dumbbell);
    const TriangleBvh tree(world_triangles(dense_surface(shelf, source.header().frame)));
    CHECK(surface_distance(drawable_world_triangles(proxy), tree).at_least <= 1.5 * (1 + 1e-9));
  }
}

TEST_CASE("a volume ratio of one is that of the voxels with those that repair adds", "[quick][pass]") {
  MeshParams params;
  params.volume_ratio = 1;
  MeshCounts counts;
  (void)mesh(params, counts, [](VoxelCoord p) {  // two cubes that touch along an edge
    return p.z >= 4 && p.z < 14 &&
           ((p.x < 9 && p.y < 9 && p.x > 2 && p.y > 2) || (p.x >= 9 && p.y >= 9 && p.x < 15 && p.y < 15));
  });
  CHECK(counts.repaired > 0);
  CHECK(counts.solid_volume_world == double(counts.voxels + counts.repaired));
  CHECK(counts.levels[0].measures.volume == counts.solid_volume_world);
}

TEST_CASE("the target that ended merging is named, not one that refused a step later", "[quick][pass]") {
  MeshParams params;
  params.error_world = 1;
  params.volume_ratio = 1.5;  // out of reach within the error
  params.quads = GENERATE(false, true);
  MeshCounts counts;
  (void)mesh(params, counts);
  CHECK(counts.levels[0].stopped_by == "error");
  CHECK(counts.levels[0].simplify.limit == "error");
}

TEST_CASE("edges stay below edge_factor times the scale", "[quick][pass]") {
  VoxelSource source(kBox, dumbbell);
  source.header().scale.base = 3;
  MeshParams params;
  params.edge_factor = 2;
  params.faces = {50};
  MeshCounts counts;
  const std::vector<LatticeMesh> levels = mesh_stream(source, memory_context(), params, counts);
  CHECK(counts.levels[0].stopped_by == "edge-length");
  CHECK(counts.levels[0].measures.edge_max <= 6 * std::sqrt(1.0) + 1e-9);
  check(levels[0], nullptr);
}

TEST_CASE("edges across a finer region stay below what the scale is there", "[quick][pass]") {
  const VoxelBox box{{0, 0, 0}, {64, 64, 16}};
  VoxelSource source(box,
                     [](VoxelCoord p) { return p.x >= 2 && p.x < 62 && p.y >= 2 && p.y < 62 && p.z >= 4 && p.z < 12; });
  ScaleField& scale = source.header().scale;
  scale.base = 20;
  scale.rules.push_back(box_rule({28, 0, 0}, {36, 64, 16}, 1.5));  // a slab between the ends of the plate
  MeshParams params;
  params.edge_factor = 2;
  params.faces = {50};
  params.tighten = GENERATE(true, false);
  params.mode = GENERATE(MeshMode::bounding, MeshMode::fit);
  if (params.mode == MeshMode::fit && !params.tighten) return;
  MeshCounts counts;
  const LatticeMesh level = mesh_stream(source, memory_context(), params, counts)[0];
  CHECK(counts.levels[0].stopped_by == "edge-length");
  CHECK(counts.levels[0].measures.edge_max > 10);  // where it may
  const auto at = [](const Vec3d& a, const Vec3d& b, double t) {
    return Vec3d{a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
  };
  for (const auto& t : level.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d a = level.frame.world(level.vertices[t[k]]), b = level.frame.world(level.vertices[t[(k + 1) % 3]]);
      double least = scale.base;
      for (int i = 0; i <= 200; ++i) least = std::min(least, scale.evaluate(at(a, b, i / 200.0)));
      const double edge = std::sqrt(std::pow(a[0] - b[0], 2) + std::pow(a[1] - b[1], 2) + std::pow(a[2] - b[2], 2));
      REQUIRE(edge <= 2 * least + 1e-9);
    }
  }
}

TEST_CASE("a flat side in a fine place takes few faces where edges follow the shape, and many where they do not",
          "[quick][pass]") {
  constexpr double kFactor = 2, kScale = 1.5;
  const VoxelBox box{{0, 0, 0}, {64, 64, 16}};
  const auto plate = [](VoxelCoord p) { return VoxelBox{{2, 2, 4}, {62, 62, 12}}.contains(p); };
  ScaleField scale;
  scale.base = 20;
  scale.rules.push_back(box_rule({0, 0, 0}, {64, 64, 16}, kScale));
  MeshParams params;
  params.edge_factor = kFactor;
  params.faces = {50};
  const auto level_of = [&](MeshCounts& counts) {
    VoxelSource source(box, plate);
    source.header().scale = scale;
    return mesh_stream(source, memory_context(), params, counts)[0];
  };
  MeshCounts counts;
  (void)level_of(counts);
  CHECK(counts.levels[0].stopped_by == "edge-length");
  CHECK(counts.levels[0].measures.edge_max <= kFactor * kScale + 1e-9);
  params.edges_by_shape = true;
  const LatticeMesh level = level_of(counts);
  CHECK(level.triangles.size() <= 50);
  CHECK(counts.levels[0].measures.edge_max > 10 * kFactor * kScale);
  check(level, nullptr);
}

TEST_CASE("edges that yield are as short as so few faces allow", "[quick][pass]") {
  VoxelSource source(kBox, dumbbell);
  ScaleField& scale = source.header().scale;
  scale.base = 4;
  ScaleRule small;
  small.points = {{36, 24, 24}};
  small.radius = 8;
  small.scale = 1;
  scale.rules.push_back(small);
  MeshParams params;
  params.edge_factor = 1;
  params.edges_yield = true;
  params.faces = {500, 120};
  params.mode = GENERATE(MeshMode::bounding, MeshMode::fit);
  MeshCounts counts;
  const std::vector<LatticeMesh> levels = mesh_stream(source, memory_context(), params, counts);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(levels[i].triangles.size() <= params.faces[i]);
    const double factor = counts.levels[i].edge_factor;
    CHECK(factor > 0);
    for (const auto& t : levels[i].triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3d a = levels[i].frame.world(levels[i].vertices[t[k]]);
        const Vec3d b = levels[i].frame.world(levels[i].vertices[t[(k + 1) % 3]]);
        const double edge = std::sqrt(std::pow(a[0] - b[0], 2) + std::pow(a[1] - b[1], 2) + std::pow(a[2] - b[2], 2));
        REQUIRE(edge <= std::max(factor * std::min(scale.evaluate(a), scale.evaluate(b)), 4.0) + 1e-9);
      }
    }
  }
  CHECK(counts.levels[0].edge_factor < counts.levels[1].edge_factor);
}

TEST_CASE("a fit keeps edge_factor", "[quick][pass]") {
  VoxelSource source(kBox, dumbbell);
  source.header().scale.base = 1;
  MeshParams params;
  params.mode = MeshMode::fit;
  params.edge_factor = 3;
  params.faces = {100};
  MeshCounts counts;
  const std::vector<LatticeMesh> levels = mesh_stream(source, memory_context(), params, counts);
  CHECK(counts.levels[0].stopped_by == "edge-length");
  CHECK(counts.levels[0].measures.edge_max <= 3 + 1e-9);
  CHECK(levels[0].triangles.size() > 100);
}

TEST_CASE("what a bound on distances takes is refused where it does not fit", "[quick][pass]") {
  const auto refusal = [](double error_world, std::uint64_t work_bytes) -> std::string {
    VoxelSource source(kBox, [](VoxelCoord p) { return length_of(p.x - 9, p.y - 9, p.z - 9) < 5; });
    MeshParams params;
    params.faces = {40};
    params.error_world = error_world;
    params.tighten = false;
    PassContext context = memory_context();
    context.pieces.waiting_bytes = 0;
    context.pieces.work_bytes = work_bytes;
    MeshCounts counts;
    try {
      (void)mesh_stream(source, context, params, counts);
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  };
  const TriangleBvh small({{Vec3d{0, 0, 0}, Vec3d{1, 0, 0}, Vec3d{0, 1, 0}}});
  const std::uint64_t taken = ProxyLimits::bytes_needed({.error_world = 1}, {}, &small);
  CHECK(taken == std::uint64_t(1) << 20);
  CHECK(ProxyLimits::bytes_needed({.volume_world = 1}, {}, nullptr) == 0);
  const TriangleBvh large({{Vec3d{0, 0, 0}, Vec3d{1000, 0, 0}, Vec3d{0, 1000, 0}}});
  CHECK(ProxyLimits::bytes_needed({.error_world = 1}, {}, &large) == std::uint64_t(32) << 20);
  CHECK(refusal(0, taken).empty());
  CHECK(refusal(1, 2 * taken).empty());
  // The surface that distances are measured from takes its part, too.
  CHECK(refusal(1, taken).find("within a distance takes 2 MiB, and the limit on memory leaves 0 MiB") !=
        std::string::npos);
}

TEST_CASE("the volume of a proxy inside stays above --volume", "[quick][pass]") {
  VoxelSource source(kBox, dumbbell);
  source.header().fill = FillMode::inside;
  MeshParams params;
  params.mode = MeshMode::inside;
  params.volume_ratio = 0.9;
  MeshCounts counts;
  (void)mesh_stream(source, memory_context(), params, counts);
  CHECK(counts.levels[0].stopped_by == "volume");
  CHECK(counts.levels[0].measures.volume >= 0.9 * counts.solid_volume_world * (1 - 1e-12));
}
