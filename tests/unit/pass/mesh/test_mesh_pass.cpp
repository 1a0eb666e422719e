#include <cmath>

#include "lib/check/check_proxy.h"
#include "lib/core/error.h"
#include "lib/pass/mesh/detail/proxy_limits.h"
#include "lib/pass/mesh/mesh_pass.h"
#include "lib/pass/mesh/surface_around.h"
#include "lib/surface/surface.h"
#include "tests/catch.h"
#include "tests/support/memory_scene.h"
#include "tests/support/memory_store.h"
#include "tests/support/proxy_checks.h"
#include "tests/support/voxel_source.h"

using namespace bp;
using namespace bp::test;

namespace {

const VoxelBox kBox{{0, 0, 0}, {48, 48, 48}};

double length_of(double x, double y, double z) {
  return std::sqrt(x * x + y * y + z * z);
}

/// Two balls that a rod joins, and a crumb beside them.
bool dumbbell(VoxelCoord p) {
  return length_of(p.x - 14, p.y - 24, p.z - 24) < 10 || length_of(p.x - 36, p.y - 24, p.z - 24) < 7 ||
         (p.x > 10 && p.x < 40 && length_of(0, p.y - 24, p.z - 24) < 3) || length_of(p.x - 40, p.y - 6, p.z - 8) < 3;
}

std::vector<LatticeMesh> mesh(const MeshParams& params, MeshCounts& counts, const Solid& solid = dumbbell,
                              const PassContext& context = memory_context()) {
  VoxelSource source(kBox, solid);
  return mesh_stream(source, context, params, counts);
}

/// A sound proxy that strictly encloses `inner`, if given.
void check(const LatticeMesh& proxy, const std::vector<TriangleD>* inner) {
  const IndexedMesh mesh = indexed(proxy);
  std::unique_ptr<MemorySource> scene;
  if (inner != nullptr) scene = std::make_unique<MemorySource>(*inner);
  CheckOptions options;
  options.distances = false;
  const CheckReport report = check_proxy(mesh, scene.get(), options);
  CHECK(report.holds());
}

/// Triangles of the voxels' cubes, moved inwards so little that they stay in the open solid.
std::vector<TriangleD> points_inside() {
  std::vector<TriangleD> all;
  for (VoxelCoord p = kBox.min; p.z < kBox.max.z; ++p.z) {
    for (p.y = 0; p.y < 48; ++p.y) {
      for (p.x = 0; p.x < 48; ++p.x) {
        if (!dumbbell(p)) continue;
        const double l = 1.0 / 128, h = 1 - l, x = p.x, y = p.y, z = p.z;
        all.push_back({Vec3d{x + l, y + l, z + l}, Vec3d{x + h, y + h, z + l}, Vec3d{x + l, y + h, z + h}});
        all.push_back({Vec3d{x + h, y + l, z + h}, Vec3d{x + h, y + l, z + l}, Vec3d{x + l, y + l, z + h}});
      }
    }
  }
  return all;
}

}  // namespace

TEST_CASE("levels have their faces, enclose what is meshed, and each encloses the level before", "[quick][pass]") {
  const bool tighten = GENERATE(true, false);
  MeshParams params;
  params.faces = {1500, 400, 100, 40};
  params.tighten = tighten;
  MeshCounts counts;
  const std::vector<LatticeMesh> levels = mesh(params, counts);
  REQUIRE(levels.size() == 4);
  REQUIRE(counts.levels.size() == 4);
  std::vector<TriangleD> inner = points_inside();
  for (std::size_t i = 0; i < levels.size(); ++i) {
    CAPTURE(i, counts.levels[i].stopped_by);
    CHECK(levels[i].triangles.size() <= params.faces[i]);
    CHECK(levels[i].triangles.size() >= params.faces[i] - 2);
    CHECK(counts.levels[i].stopped_by == "faces");
    check(levels[i], &inner);
    inner = world_triangles(levels[i]);
  }
}

TEST_CASE("levels whose numbers do not fall are refused", "[quick][pass]") {
  MeshParams params;
  params.faces = GENERATE(std::vector<std::uint64_t>{100, 100}, std::vector<std::uint64_t>{100, 50, 60});
  MeshCounts counts;
  CHECK_THROWS_AS(mesh(params, counts), Error);
}

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

TEST_CASE("numbers below zero are refused", "[quick][pass]") {
  VoxelSource source(kBox, dumbbell);
  MeshParams params;
  if (GENERATE(false, true)) {
    params.mode = MeshMode::inside;
    source.header().fill = FillMode::inside;
  }
  const int which = GENERATE(0, 1, 2);
  (which == 0 ? params.error_world : which == 1 ? params.volume_ratio : params.edge_factor) = -1;
  MeshCounts counts;
  CHECK_THROWS_AS(mesh_stream(source, memory_context(), params, counts), Error);
}

TEST_CASE("edges stay below --edge-length times the scale", "[quick][pass]") {
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
  scale.boxes.push_back({{28, 0, 0}, {36, 64, 16}, 1.5});  // a slab between the ends of the plate
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

TEST_CASE("a fit keeps --edge-length", "[quick][pass]") {
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

TEST_CASE("the surface around a mesh strictly encloses it, whatever the voxels", "[quick][pass]") {
  MeshParams params;
  params.faces = {120};
  MeshCounts counts;
  const LatticeMesh inner = mesh(params, counts)[0];
  const auto shelf = memory_shelves()();
  const GridFrame frame = voxels_around(inner, GENERATE(0.7, 1.0, 3.3), memory_shelves(), {}, *shelf);
  const LatticeMesh around = dense_surface(*shelf, frame);
  const std::vector<TriangleD> triangles = world_triangles(inner);
  check(around, &triangles);
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
    } catch (const NeedsMemory& e) {
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

TEST_CASE("a chain of levels is the same for every memory, and what waits goes to the store", "[quick][pass]") {
  MeshParams params;
  params.faces = {400, 200, 60};
  MeshCounts counts;
  const std::vector<LatticeMesh> roomy = mesh(params, counts);
  std::uint64_t put = 0, held = 0;
  PassContext context = memory_context();
  context.pieces.waiting_bytes = 0;
  context.pieces.work_bytes = std::uint64_t(32) << 20;
  context.pieces.make_scratch = [&] { return std::make_unique<MemoryStore>(put, held); };
  const std::vector<LatticeMesh> tight = mesh(params, counts, dumbbell, context);
  CHECK(put > 0);
  REQUIRE(tight.size() == roomy.size());
  for (std::size_t i = 0; i < roomy.size(); ++i) {
    CHECK(tight[i].vertices == roomy[i].vertices);
    CHECK(tight[i].triangles == roomy[i].triangles);
  }
}

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
    MemorySource scene(outer);
    CheckOptions options;
    options.inside = true;
    const CheckReport report = check_proxy(indexed(levels[i]), &scene, options);
    CHECK(report.holds());
    CHECK(report.volume > 0);
    outer = world_triangles(levels[i]);
  }
  CHECK(counts.levels[0].measures.volume <= counts.solid_volume_world);
  CHECK(counts.levels[0].measures.volume > 0.5 * counts.solid_volume_world);
}

TEST_CASE("a stream that does not hold what the mode needs is refused", "[quick][pass]") {
  VoxelSource source(kBox, dumbbell);
  MeshParams params;
  params.mode = GENERATE(MeshMode::inside, MeshMode::bounding);
  if (params.mode == MeshMode::bounding) source.header().fill = FillMode::inside;
  MeshCounts counts;
  CHECK_THROWS_AS(mesh_stream(source, memory_context(), params, counts), Error);
}

TEST_CASE("a closing without the voxels that must stay inside is refused", "[quick][pass]") {
  VoxelSource source(
      kBox, [](VoxelCoord) { return false; }, dumbbell);
  MeshParams params;
  params.enclose = Enclose::input;
  params.faces = {40};
  params.error_world = GENERATE(0.0, 3.0);
  MeshCounts counts;
  CHECK_THROWS_AS(mesh_stream(source, memory_context(), params, counts), Error);
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
  MemorySource scene(world_triangles(levels[0]));
  CheckOptions options;
  options.inside = true;
  CHECK(check_proxy(indexed(levels[1]), &scene, options).holds());
  CHECK(counts.levels[1].measures.volume < counts.levels[0].measures.volume);
}
