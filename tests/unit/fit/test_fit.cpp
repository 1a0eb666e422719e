#include <cmath>

#include "lib/check/check_proxy.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/fit/detail/face_points.h"
#include "lib/fit/detail/settle.h"
#include "lib/fit/detail/vertex_mover.h"
#include "lib/fit/fit.h"
#include "lib/geometry/surface_distance.h"
#include "lib/pass/mesh/detail/fit_target.h"
#include "lib/pass/mesh/mesh_pass.h"
#include "lib/pass/mesh/surface_around.h"
#include "tests/catch.h"
#include "tests/support/lattice_boxes.h"
#include "tests/support/memory_scene.h"
#include "tests/support/voxel_source.h"

using namespace bp;
using namespace bp::test;

namespace {

const VoxelBox kBox{{0, 0, 0}, {48, 48, 48}};
const Vec3d kCentre{24.3, 23.9, 24.1};
constexpr double kRadius = 17;

/// Voxels that the closed ball's surface, or the ball, touches: as bpvox would find them.
bool ball(VoxelCoord p) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const double lo = p[i] - kCentre[std::size_t(i)], hi = lo + 1;
    const double d = lo > 0 ? lo : hi < 0 ? hi : 0;
    sum += d * d;
  }
  return sum <= kRadius * kRadius;
}

double mean_distance_to_sphere(const LatticeMesh& mesh) {
  double sum = 0;
  for (const LatticeCoord& v : mesh.vertices) {
    const Vec3d p = mesh.frame.world(v);
    sum += std::sqrt(std::pow(p[0] - kCentre[0], 2) + std::pow(p[1] - kCentre[1], 2) + std::pow(p[2] - kCentre[2], 2)) -
           kRadius;
  }
  return sum / double(mesh.vertices.size());
}

}  // namespace

TEST_CASE("a fit loses the half voxel that voxels stand out, and stays sound", "[quick][meshing]") {
  VoxelSource source(kBox, ball);
  MeshParams params;
  params.mode = MeshMode::fit;
  params.faces = {1200, 300};
  const bool to_scene = GENERATE(false, true);
  if (to_scene) {
    add_sphere(params.scene, kCentre, kRadius, 40);
    params.enclose = Enclose::scene;
  }
  MeshCounts counts;
  const std::vector<LatticeMesh> levels = mesh_stream(source, memory_context(), params, counts);
  REQUIRE(levels.size() == 2);
  const double volume = 4 * M_PI / 3 * std::pow(kRadius, 3);
  for (std::size_t i = 0; i < 2; ++i) {
    CAPTURE(i, to_scene);
    CHECK(levels[i].triangles.size() <= params.faces[i]);
    CHECK(check_proxy(indexed(levels[i]), nullptr).holds());
    CHECK(std::abs(mean_distance_to_sphere(levels[i])) < (i == 0 ? 0.15 : 0.4));
    CHECK(std::abs(counts.levels[i].measures.volume - volume) < (i == 0 ? 0.02 : 0.05) * volume);
  }
  CHECK(counts.solid_volume_world > 1.1 * volume);  // what was lost
}

TEST_CASE("a fit of few faces is near its scene, though regions begin it", "[quick][meshing]") {
  constexpr double kLarge = 60;  // whose surface has several times the faces at which regions begin
  const auto touches = [](VoxelCoord p) {
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
      const double lo = p[i] - 64.0, hi = lo + 1;
      const double d = lo > 0 ? lo : hi < 0 ? hi : 0;
      sum += d * d;
    }
    return sum <= kLarge * kLarge;
  };
  VoxelSource source({{0, 0, 0}, {128, 128, 128}}, touches);
  MeshParams params;
  params.mode = MeshMode::fit;
  params.faces = {500};
  MeshCounts counts;
  const LatticeMesh level = mesh_stream(source, memory_context(), params, counts).front();
  CHECK(level.triangles.size() == 500);
  double farthest = 0;
  for (const LatticeCoord& v : level.vertices)
    farthest = std::max(farthest, std::abs(length(level.frame.world(v) - Vec3d{64, 64, 64}) - kLarge));
  CHECK(farthest < 3);
}

TEST_CASE("a fit lies inside the voxels' surface", "[quick][meshing]") {
  VoxelSource source(kBox, ball);
  MeshParams params;
  params.mode = MeshMode::fit;
  params.faces = {300};
  MeshCounts counts;
  (void)mesh_stream(source, memory_context(), params, counts);
  CHECK(counts.levels[0].measures.volume < 0.95 * counts.solid_volume_world);
}

TEST_CASE("vertices settle where the surface is nearest to given points, on any number of threads",
          "[quick][meshing]") {
  VoxelSource source(kBox, ball);
  MeshParams params;
  params.tighten = false;
  params.faces = {120};  // far out, and coarse
  MeshCounts counts;
  const LatticeMesh start = mesh_stream(source, memory_context(), params, counts)[0];
  std::vector<TriangleD> sphere;
  add_sphere(sphere, kCentre, kRadius, 24);
  std::vector<FitPlace> points;
  for (const TriangleD& t : sphere) points.push_back({kLatticePerVoxel * (1.0 / 3 * (t[0] + t[1] + t[2]))});
  const TriangleBvh tree(sphere);
  const auto distance = [&](const LatticeMesh& mesh) { return surface_distance(world_triangles(mesh), tree).mean; };
  HalfEdgeMesh mesh(start);
  CHECK(settle(mesh, points, {}, 8) > 60);
  const LatticeMesh settled = mesh.compact(start.frame);
  CHECK(check_proxy(indexed(settled), nullptr).holds());
  CHECK(distance(start) > 0.7);
  CHECK(distance(settled) < 0.35);
  const ThreadLimit one(1);
  HalfEdgeMesh twin(start);
  settle(twin, points, {}, 8);
  CHECK(twin.compact(start.frame).vertices == settled.vertices);
}

TEST_CASE("faces settle on the planes of the scene, and edges run where these meet", "[quick][meshing]") {
  const VoxelBox box{{0, 0, 0}, {64, 64, 64}};
  const Vec3d low{9.3, 10.4, 11.2}, high{53.6, 51.3, 40.7}, middle = 0.5 * (low + high);
  const double tilt = 0.3;  // about the vertical
  const auto turned = [&](const Vec3d& p, double by) {
    const Vec3d d = p - middle;
    return middle + Vec3d{std::cos(by) * d[0] - std::sin(by) * d[1], std::sin(by) * d[0] + std::cos(by) * d[1], d[2]};
  };
  VoxelSource source(box, [&](VoxelCoord p) {  // about as if its triangles were voxelized
    const Vec3d q = turned({double(p.x) + 0.5, double(p.y) + 0.5, double(p.z) + 0.5}, -tilt);
    bool in = true;
    for (std::size_t i = 0; i < 3; ++i) in = in && q[i] > low[i] - 0.5 && q[i] < high[i] + 0.5;
    return in;
  });
  MeshParams params;
  params.mode = MeshMode::fit;
  params.enclose = Enclose::scene;
  params.faces = {400};
  std::vector<Vec3d> normals;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double side : {low[axis], high[axis]}) {
      std::array<Vec3d, 4> c{low, low, low, low};
      for (std::size_t k = 0; k < 4; ++k) {
        c[k][axis] = side;
        if (k == 1 || k == 2) c[k][(axis + 1) % 3] = high[(axis + 1) % 3];
        if (k >= 2) c[k][(axis + 2) % 3] = high[(axis + 2) % 3];
        c[k] = turned(c[k], tilt);
      }
      params.scene.push_back({c[0], c[1], c[2]});
      params.scene.push_back({c[0], c[2], c[3]});
      const Vec3d n = cross(c[1] - c[0], c[2] - c[0]);
      normals.push_back(1 / length(n) * n);
    }
  }
  MeshCounts counts;
  const LatticeMesh level = mesh_stream(source, memory_context(), params, counts)[0];
  CHECK(check_proxy(indexed(level), nullptr).holds());
  double flat = 0, area = 0;
  for (const TriangleD& t : world_triangles(level)) {
    const Vec3d n = cross(t[1] - t[0], t[2] - t[0]);
    double along = 0;
    for (const Vec3d& m : normals) along = std::max(along, std::abs(dot(m, n)));
    area += length(n);
    if (along > std::cos(0.0349) * length(n)) flat += length(n);
  }
  CHECK(flat > 0.999 * area);
}

TEST_CASE("where a scene ends, a fit knows which way, and leaving the end costs", "[quick][meshing]") {
  const std::vector<TriangleD> plate{{Vec3d{0, 0, 0}, Vec3d{8, 0, 0}, Vec3d{8, 8, 0}},
                                     {Vec3d{0, 0, 0}, Vec3d{8, 8, 0}, Vec3d{0, 8, 0}}};
  const TriangleBvh tree(plate);
  const FitTarget target = scene_target(tree, GridFrame{1, {}}, 0.5);
  const FitPlace rim = target({8.5 * kLatticePerVoxel, 4 * kLatticePerVoxel, 0}, {1, 0, 0});
  CHECK(rim.at == Vec3d{8 * kLatticePerVoxel, 4 * kLatticePerVoxel, 0});
  CHECK(rim.normal == Vec3d{});
  CHECK(rim.end == Vec3d{1, 0, 0});
  CHECK(target({4 * kLatticePerVoxel, 4 * kLatticePerVoxel, 20}, {0, 0, 1}).end == Vec3d{});

  LatticeMesh thin;  // as plates are once their sides are drawn to the scene: the rim has no area to speak of
  add_box(thin, {{0, 0, -1}, {8 * kLatticePerVoxel, 8 * kLatticePerVoxel, 1}});
  const std::vector<FitPlace> points{rim};
  constexpr double kArea = 5000, kBack = 100;
  double cost = 0;
  for (const double area : {0.0, kArea}) {
    const std::vector<Quadric> quadrics = quadrics_of_points(HalfEdgeMesh(thin), points, area);
    double sum = 0;
    for (const Quadric& q : quadrics) sum += q.value({-kBack, 0, 0});
    cost = sum - cost;
  }
  CHECK(cost > 0.99 * kArea * kBack * kBack);
}

TEST_CASE("vertices are drawn to their targets only as far as the surface stays embedded", "[quick][meshing]") {
  VoxelSource source(kBox, [](VoxelCoord p) {  // two plates, two voxels apart, joined at one end
    const bool plates = (p.z >= 10 && p.z < 12) || (p.z >= 14 && p.z < 16);
    return p.x > 4 && p.x < 30 && p.y > 4 && p.y < 20 && (plates || (p.x < 8 && p.z >= 10 && p.z < 16));
  });
  MeshParams params;
  params.tighten = false;
  params.faces = {400};
  MeshCounts counts;
  const LatticeMesh start = mesh_stream(source, memory_context(), params, counts)[0];
  HalfEdgeMesh mesh(start);
  const Vec3d point{17 * 64, 12 * 64, 13 * 64};  // all to one point: most cannot get there
  const std::uint64_t moves = draw_to_targets(
      mesh, [&](const Vec3d&, const Vec3d&) { return FitPlace{point}; }, {}, 6);
  CHECK(moves > 10);
  CHECK(check_proxy(indexed(mesh.compact(start.frame)), nullptr).holds());
}

TEST_CASE("fits of many thin plates face outwards, however few faces are left", "[quick][meshing]") {
  const int thick = GENERATE(1, 3);
  VoxelSource source({{0, 0, 0}, {64, 64, 64}},
                     [&](VoxelCoord p) { return p.x % 16 < 6 && p.y % 16 < 7 && p.z % 8 < thick; });
  MeshParams params;
  params.mode = MeshMode::fit;
  params.faces = {1500, 500};  // 128 plates: the last are tetrahedra
  MeshCounts counts;
  for (const LatticeMesh& level : mesh_stream(source, memory_context(), params, counts)) {
    CAPTURE(thick, level.triangles.size());
    CHECK(check_proxy(indexed(level), nullptr).holds());
  }
}

TEST_CASE("a vertex moves neither through its own shell nor beyond exact products", "[quick][meshing]") {
  LatticeMesh tetrahedron;
  const VertexId apex = add_tetrahedron(tetrahedron, {0, 0, 100}, 0, 300);
  HalfEdgeMesh mesh(tetrahedron);
  VertexMover mover(mesh, {}, nullptr);
  CHECK_FALSE(mover.draw(apex, {0, 0, -300}));  // half and a quarter of the way are through, or flat
  CHECK_FALSE(mover.draw(apex, {0, 0, std::int64_t(1) << 39}));
  CHECK(mover.draw(apex, {0, 0, 60}));
  CHECK(mesh.position(apex).z == 60);
}

TEST_CASE("the nearest point of a triangle is nearer than any other", "[quick][meshing]") {
  const TriangleD t{Vec3d{0, 0, 0}, Vec3d{4, 1, 0}, Vec3d{1, 3, 2}};
  for (const Vec3d& p : {Vec3d{1, 1, 5}, Vec3d{-3, -2, 1}, Vec3d{9, 0, 0}, Vec3d{0, 6, 1}, Vec3d{2, -4, 2}}) {
    const Vec3d q = nearest_point(p, t);
    CHECK(std::abs(distance_squared(p, t) -
                   (std::pow(p[0] - q[0], 2) + std::pow(p[1] - q[1], 2) + std::pow(p[2] - q[2], 2))) < 1e-12);
    CHECK(distance_squared(q, t) < 1e-24);
  }
}

TEST_CASE("targets without a meaning for a fit are refused", "[quick][meshing]") {
  VoxelSource source(kBox, ball);
  MeshParams params;
  params.mode = MeshMode::fit;
  if (GENERATE(true, false)) {
    params.volume_ratio = 1.1;
  } else {
    params.enclose = Enclose::input;
  }
  MeshCounts counts;
  CHECK_THROWS_AS(mesh_stream(source, memory_context(), params, counts), Error);
}
