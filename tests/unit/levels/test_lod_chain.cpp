#include <random>

#include "lib/check/check_proxy.h"
#include "lib/core/vec3.h"
#include "lib/geometry/crossing.h"
#include "lib/levels/lod_chain.h"
#include "lib/pass/mesh/surface_around.h"
#include "lib/volume/reduce.h"
#include "tests/catch.h"
#include "tests/support/memory_store.h"
#include "tests/support/voxelized.h"

namespace bp::test {

namespace {

LodOptions lod_options() {
  LodOptions options;
  options.context.make_shelf = memory_shelves();
  return options;
}

/// 3 x 3 x 2 boxes that lie apart.
Triangles boxes() {
  Triangles scene;
  for (int i = 0; i < 18; ++i) {
    const Vec3d lo{10.0 * (i % 3), 11.0 * (i / 3 % 3), 9.0 * (i / 9)};
    add_box(scene, lo, {lo[0] + 6, lo[1] + 5, lo[2] + 4});
  }
  return scene;
}

bool encloses(const LatticeMesh& mesh, const Triangles& scene) {
  MemorySource source(scene);
  return check_proxy(indexed(mesh), &source).holds();
}

Vec3d point_on(const TriangleD& t, std::mt19937& random) {
  double u = double(random()) / 4294967296.0, v = double(random()) / 4294967296.0;
  if (u + v > 1) u = 1 - u, v = 1 - v;
  Vec3d p;
  for (std::size_t i = 0; i < 3; ++i) p[i] = t[0][i] + u * (t[1][i] - t[0][i]) + v * (t[2][i] - t[0][i]);
  return p;
}

/// Largest distance of sampled points and all corners of one to the other.
double sampled_distance(const std::vector<TriangleD>& from, const std::vector<TriangleD>& to, int per_triangle) {
  std::mt19937 random(7);
  const TriangleBvh tree(to);
  double largest = 0;
  const auto meet = [&](const Vec3d& p) { largest = std::max(largest, std::sqrt(tree.nearest(p).distance_squared)); };
  for (const TriangleD& t : from) {
    for (const Vec3d& corner : t) meet(corner);
    for (int i = 0; i < per_triangle; ++i) meet(point_on(t, random));
  }
  return largest;
}

/// A box with a room of 40 x 40 x 30 in it, which has a hole of 4 x 4 in its roof and a post in its middle.
Triangles hollow_box() {
  Triangles scene;
  add_box(scene, {0, 0, 0}, {50, 50, 5});
  add_box(scene, {0, 0, 0}, {5, 50, 40});
  add_box(scene, {45, 0, 0}, {50, 50, 40});
  add_box(scene, {0, 0, 0}, {50, 5, 40});
  add_box(scene, {0, 45, 0}, {50, 50, 40});
  add_box(scene, {0, 0, 35}, {23, 50, 40});
  add_box(scene, {27, 0, 35}, {50, 50, 40});
  add_box(scene, {0, 0, 35}, {50, 23, 40});
  add_box(scene, {0, 27, 35}, {50, 50, 40});
  add_box(scene, {23, 23, 0}, {27, 27, 20});
  return scene;
}

/// Largest distance of sampled points of `scene` outside `mesh`, which is closed, to it.
double sampled_distance_beyond(const std::vector<TriangleD>& scene, const std::vector<TriangleD>& mesh,
                               int per_triangle) {
  std::mt19937 random(7);
  const TriangleBvh tree(mesh);
  double largest = 0;
  for (const TriangleD& t : scene) {
    for (int i = 0; i < per_triangle; ++i) {
      const Vec3d p = point_on(t, random);
      int winding = 0;
      for (const TriangleD& face : mesh) winding += crossing_above(face, p);
      if (winding < 1) largest = std::max(largest, std::sqrt(tree.nearest(p).distance_squared));
    }
  }
  return largest;
}

}  // namespace

TEST_CASE("each level of a chain encloses the scene, on coarser voxels", "[quick][pass][lod]") {
  Triangles scene;
  add_sphere(scene, {3, 4, 5}, 40, 24);
  add_box(scene, {-30, 30, -10}, {-10, 70, 10});
  Backends backends = plain_backends(2);
  Voxelized solid = voxelized(scene, 1);
  LodChain chain(solid.header, std::move(solid.shelf), backends, lod_options());
  int reductions = -1;
  double volume = 0;
  for (const std::uint64_t faces : {2000, 400, 80}) {
    CAPTURE(faces);
    const LodLevel level = chain.make({faces, 0, {}});
    CHECK(level.reached);
    CHECK(level.mesh.triangles.size() <= faces);
    CHECK(encloses(level.mesh, scene));
    CHECK(level.reductions >= reductions);
    const double now = level.counts.levels.front().measures.volume;
    CHECK(now > volume);  // errors need not rise: the order is by volume
    volume = now;
    reductions = level.reductions;
  }
  CHECK(reductions == 0);  // so few voxels cost little
  const LodLevel coarse = chain.make({0, 24, {}});
  CHECK(coarse.reductions > 0);
  CHECK(encloses(coarse.mesh, scene));
}

TEST_CASE("a field closes a level less where its rules say so, and the level encloses", "[quick][pass][lod]") {
  Triangles scene;  // two combs, far apart
  for (int i = 0; i < 8; ++i) {
    add_box(scene, {6.0 * i, 0, 0}, {6.0 * i + 3, 20, 30});
    add_box(scene, {6.0 * i + 200, 0, 0}, {6.0 * i + 203, 20, 30});
  }
  Backends backends = plain_backends(2);
  const auto volumes = [&](std::optional<ScaleField> field) {
    Voxelized solid = voxelized(scene, 1);
    LodOptions options = lod_options();
    if (field) options.field = ScalePlan{*field, std::vector<RuleEntry>(field->rules.size())};
    LodChain chain(solid.header, std::move(solid.shelf), backends, std::move(options));
    const LodLevel level = chain.make({0, 0.5, 6});
    CHECK(encloses(level.mesh, scene));
    std::array<double, 2> volume{};
    for (const TriangleD& t : world_triangles(level.mesh))
      volume[t[0][0] > 120] +=
          (t[0][0] * (t[1][1] * t[2][2] - t[1][2] * t[2][1]) - t[0][1] * (t[1][0] * t[2][2] - t[1][2] * t[2][0]) +
           t[0][2] * (t[1][0] * t[2][1] - t[1][1] * t[2][0])) /
          6;
    return volume;
  };
  ScaleField field;
  field.base = 2;  // the level's scale is three times as large
  ScaleRule rule;
  rule.shape = ScaleShape::box;
  rule.points = {{195, -5, -5}, {250, 25, 35}};
  rule.scale = 0.1;
  field.rules = {rule};
  const auto plain = volumes({}), finer = volumes(field);
  CHECK(finer[0] == Approx(plain[0]).epsilon(0.02));
  CHECK(finer[1] < 0.9 * plain[1]);  // voxels around the teeth take half of the gaps
}

TEST_CASE("a gap keeps its width at every level's scale", "[quick][pass][lod]") {
  Triangles scene;  // four blocks, with gaps of 4, 14 and 14
  for (const double x : {0., 24., 58., 92.}) add_box(scene, {x, 0, 0}, {x + 20, 20, 20});
  Backends backends = plain_backends(2);
  ScalePlan plan;
  plan.field.base = 2;
  ShapeRule gap;
  gap.kind = ShapeRule::Kind::gap;
  gap.length = 9;
  plan.entries = {{0, gap}};
  Voxelized solid = voxelized(scene, 1);
  LodOptions options = lod_options();
  options.field = plan;
  LodChain chain(solid.header, std::move(solid.shelf), backends, std::move(options));
  for (const double scale : {1., 9., 12.}) {
    const LodLevel level = chain.make({0, 0.5, scale});
    CHECK(level.scale_world == scale);
    CHECK(encloses(level.mesh, scene));
    double volume = 0;
    for (const TriangleD& t : world_triangles(level.mesh)) volume += dot(t[0], cross(t[1], t[2])) / 6;
    // Voxels that blocks of 22 fill, with the narrow gap and without a wide one.
    CHECK(volume > 43100);
    CHECK(volume < 46000);
  }
}

TEST_CASE("a budget takes no voxels so large that few are left", "[quick][pass][lod]") {
  const LodGround ground{1, 2000, 33 * std::uint64_t(kLeastDenseFaces), 1000};
  CHECK(reductions_for(ground, {100, 0, {}}, 64, 0) == 2);
  CHECK(reductions_for(ground, {100000, 0, {}}, 64, 0) == 0);
  CHECK(reductions_for(ground, {0, 64, {}}, 64, 0) == 3);  // of an error, eight to it
  LodTarget named{100, 0, {}};
  named.keep_voxels = true;
  CHECK(reductions_for(ground, named, 64, 0) == 0);
  CHECK(reductions_for(ground, named, 64, 1) == 1);
}

TEST_CASE("a level is closed at the least scale that leaves each part and hole fifty faces", "[quick][pass][lod]") {
  const bool apart = GENERATE(false, true), fit = GENERATE(false, true);
  CAPTURE(apart, fit);
  Triangles scene = boxes();
  if (!apart) add_box(scene, {-1, -1, -1}, {27, 28, 14});
  Backends backends = plain_backends(2);
  Voxelized solid = voxelized(scene, 0.125);
  const double diagonal = solid.header.bounds.diagonal();
  LodOptions options = lod_options();
  if (fit) options.mode = MeshMode::fit;
  LodChain chain(solid.header, std::move(solid.shelf), backends, options);
  const LodTarget target{apart ? 850u : 200u, 0, {}};
  const double scale = first_scale({0.125, diagonal, chain.dense_faces()}, target, 0);
  CHECK(chain.make(target).scale_world == (apart ? scale : scale / (fit ? 2 : 8)));
}

TEST_CASE("a level of separate thin parts by faces is about as near as one by error", "[quick][pass][lod]") {
  Triangles scene;
  for (int i = 0; i < 9; ++i) {
    const double x = 9.0 * (i % 3), z = 10.0 * (i / 3);
    add_box(scene, {x, 0, z}, {x + 1, 30.0 + i, z + 1.5});
  }
  Backends backends = plain_backends(2);
  Voxelized by_error = voxelized(scene, 0.2), by_faces = voxelized(scene, 0.2);
  LodChain errors(by_error.header, std::move(by_error.shelf), backends, lod_options());
  const LodLevel near = errors.make({0, 2, {}});
  LodChain faces(by_faces.header, std::move(by_faces.shelf), backends, lod_options());
  const LodLevel level = faces.make({near.mesh.triangles.size(), 0, {}});
  CHECK(level.mesh.triangles.size() <= near.mesh.triangles.size());
  CHECK(level.error_world < 2 * near.error_world);
}

TEST_CASE("a budget below what the parts need is met by closing them together", "[quick][pass][lod]") {
  const Triangles scene = boxes();
  Backends backends = plain_backends(2);
  Voxelized solid = voxelized(scene, 0.5);
  LodChain chain(solid.header, std::move(solid.shelf), backends, lod_options());
  const LodLevel level = chain.make({40, 0, 0.5});  // 18 parts need 72
  CHECK(level.reached);
  CHECK(level.mesh.triangles.size() <= 40);
  CHECK(level.attempts > 1);
  CHECK(level.scale_world == std::ldexp(0.5, level.attempts - 1));
  CHECK(encloses(level.mesh, scene));
}

TEST_CASE("a budget that nothing meets is reported, and what there is encloses", "[quick][pass][lod]") {
  const Triangles scene = boxes();
  Backends backends = plain_backends(2);
  Voxelized solid = voxelized(scene, 1);
  LodChain chain(solid.header, std::move(solid.shelf), backends, lod_options());
  const LodLevel level = chain.make({3, 0, 1.0});
  CHECK_FALSE(level.reached);
  CHECK(level.attempts > 1);
  CHECK(encloses(level.mesh, scene));
}

TEST_CASE("the measured distance bounds that both ways, the error what can be seen, and not by far",
          "[quick][pass][lod]") {
  const Triangles scene = boxes();
  const double voxel = 0.5;
  Backends backends = plain_backends(2);
  Voxelized solid = voxelized(scene, voxel);
  LodChain chain(solid.header, std::move(solid.shelf), backends, lod_options());
  for (const LodTarget& target : {LodTarget{0, 5, {}}, LodTarget{300, 0, 1.5}, LodTarget{60, 0, 4.0}}) {
    const LodLevel level = chain.make(target);
    const std::vector<TriangleD> proxy = world_triangles(level.mesh);
    const double there = sampled_distance(proxy, scene, 200);
    CAPTURE(target.faces, there);
    CHECK(level.error_world >= there);
    CHECK(level.error_world <= 1.04 * there + 3 * voxel);
    if (target.error_world > 0) CHECK(there <= target.error_world);
  }
}

TEST_CASE("a room that a level closes is no error of it", "[quick][pass][lod]") {
  const Triangles scene = hollow_box();
  Backends backends = plain_backends(2);
  LodOptions options = lod_options();
  options.mode = GENERATE(MeshMode::bounding, MeshMode::fit);
  if (options.mode == MeshMode::fit) options.scene = scene;
  Voxelized solid = voxelized(scene, 1);
  LodChain chain(solid.header, std::move(solid.shelf), backends, options);
  const LodLevel level = chain.make({60, 0, 3.0});  // the hole is at most 4 wide
  CHECK(level.error_world < 8);
}

TEST_CASE("what sticks out of a fitted level is an error of it, what lies inside is none", "[quick][pass][lod]") {
  Triangles scene = hollow_box();
  add_box(scene, {20, 1, 20}, {22, 3, 52});  // a mast on the wall
  Backends backends = plain_backends(2);
  LodOptions options = lod_options();
  options.mode = MeshMode::fit;
  options.scene = scene;
  double largest = 0;
  for (const std::uint64_t faces : {40, 12, 4}) {
    Voxelized solid = voxelized(scene, 1);
    LodChain chain(solid.header, std::move(solid.shelf), backends, options);
    const LodLevel level = chain.make({faces, 0, 3.0});
    const std::vector<TriangleD> fit = world_triangles(level.mesh);
    const double there = sampled_distance(fit, scene, 500), beyond = sampled_distance_beyond(scene, fit, 200);
    CAPTURE(faces, level.mesh.triangles.size(), there, beyond);
    CHECK(level.error_world >= std::max(there, beyond));
    CHECK(level.error_world <= 1.01 * std::max(there, beyond) + 1);  // 3 without the triangles
    if (beyond > there) largest = std::max(largest, beyond);
  }
  CHECK(largest > 5);  // of the mast, somewhere
}

TEST_CASE("fitted levels keep their budgets and lie nearer to the scene than bounding ones", "[quick][pass][lod]") {
  Triangles scene;
  add_sphere(scene, {3, 4, 5}, 20, 24);
  Backends backends = plain_backends(2);
  LodOptions options = lod_options();
  double error[2] = {};
  for (const bool fit : {false, true}) {
    options.mode = fit ? MeshMode::fit : MeshMode::bounding;
    if (fit) options.scene = scene;
    Voxelized solid = voxelized(scene, 1);
    LodChain chain(solid.header, std::move(solid.shelf), backends, options);
    const LodLevel level = chain.make({200, 0, 1.5});  // of one closing
    CHECK(level.mesh.triangles.size() <= 200);
    CHECK(check_proxy(indexed(level.mesh), nullptr).holds());
    const std::vector<TriangleD> proxy = world_triangles(level.mesh);
    error[fit] = std::max(sampled_distance(proxy, scene, 50), sampled_distance(scene, proxy, 5));
    CHECK(error[fit] <= level.error_world);
  }
  CHECK(error[1] < error[0]);
}

TEST_CASE("a fit of too few faces for its houses has no spires, and loses no house", "[quick][pass][lod]") {
  constexpr double kGround = 96;
  Triangles scene{{Vec3d{0, 0, 0}, Vec3d{kGround, 0, 0}, Vec3d{kGround, kGround, 0}},
                  {Vec3d{0, 0, 0}, Vec3d{kGround, kGround, 0}, Vec3d{0, kGround, 0}}};
  for (int i = 0; i < 16; ++i) {
    const double x = 7.2 + 23.3 * (i % 4), y = 6.1 + 22.7 * (i / 4);
    add_box(scene, {x, y, 0}, {x + 9 + i % 3, y + 12 - i % 5, 6.3 + 1.3 * (i % 7)});
  }
  const std::uint64_t faces = GENERATE(240, 180, 120);
  Backends backends = plain_backends(2);
  LodOptions options = lod_options();
  options.closing.element = StructuringElement::ball;
  options.mode = MeshMode::fit;
  options.scene = scene;
  Voxelized solid = voxelized(scene, 0.7);
  LodChain chain(solid.header, std::move(solid.shelf), backends, options);
  const std::vector<TriangleD> fit = world_triangles(chain.make({faces, 0, {}}).mesh);
  CAPTURE(faces);
  CHECK(sampled_distance(fit, scene, 60) < 6);  // 6.3 and 12.2 without a reach
  // 6.1, 5.9 and 5.3 where collapses know one place
  CHECK(sampled_distance_beyond(scene, fit, 200) < 5.2);
}

TEST_CASE("levels keep to their memory, and are the same", "[quick][pass][lod]") {
  Triangles scene;
  add_sphere(scene, {3, 4, 5}, 20, 24);
  Backends backends = plain_backends(2);
  const auto make = [&](const LodOptions& options) {
    Voxelized solid = voxelized(scene, 0.5);
    LodChain chain(solid.header, std::move(solid.shelf), backends, options);
    return chain.make({200, 0, {}});
  };
  LodOptions options = lod_options();
  const LodLevel level = make(options);
  std::uint64_t put = 0, held = 0;
  options.context.pieces.waiting_bytes = 0;
  options.context.pieces.work_bytes = std::uint64_t(64) << 20;
  options.context.pieces.make_scratch = [&] { return std::make_unique<MemoryStore>(put, held); };
  const LodLevel spilled = make(options);
  CHECK(put > 0);
  CHECK(held == 0);
  CHECK(spilled.mesh.vertices == level.mesh.vertices);
  CHECK(spilled.mesh.triangles == level.mesh.triangles);

  options.context.pieces.work_bytes = std::uint64_t(1) << 20;
  CHECK_THROWS_AS(make(options), Error);
  options = lod_options();
  // The outside of the scene takes more than 1 MiB, a tile that is closed more than 6 MiB.
  for (const int mebibytes : {1, 6}) {
    const MemoryLimit limit{std::uint64_t(2 * mebibytes) << 20, 0};
    options.context.memory = {std::uint64_t(mebibytes) << 20, 0.5, limit};
    try {
      (void)make(options);
      FAIL("fits in " << mebibytes << " MiB");
    } catch (const Error& e) {
      CHECK(e.code() == ErrorCode::out_of_resource);
      CHECK(std::string(e.what()).find(mebibytes == 1 ? "measuring" : "closing") == 0);
      CHECK(e.memory_bytes() > limit.bytes);
    }
  }
}

TEST_CASE("an empty solid is refused", "[quick][pass][lod]") {
  Backends backends = plain_backends(2);
  StreamHeader header;
  CHECK_THROWS_AS(LodChain(header, std::make_unique<MemoryShelf>(), backends, lod_options()), Error);
}

}  // namespace bp::test
