#include <algorithm>
#include <cmath>

#include "io/place/crs_map.h"
#include "io/scene/scene_reader.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "tests/catch.h"
#include "tests/unit/io/scene/scene_files.h"

using namespace bp;
using namespace bp::test;

namespace {

Placement placement_in(const std::string& crs, const GlobePlace& place) {
  Placement placement;
  placement.place = place;
  placement.crs = crs;
  return placement;
}

ErrorCode refusal(const std::string& crs, const Vec3d& sample) {
  try {
    (void)crs_operation(crs, sample);
  } catch (const Error& e) {
    return e.code();
  }
  return ErrorCode::closed_pipe;
}

}  // namespace

#ifndef BP_HAVE_PROJ

TEST_CASE("without PROJ systems are refused", "[quick][io][place]") {
  CHECK(refusal("EPSG:28992", {85000, 447000, 0}) == ErrorCode::failed);
}

#else

namespace {

/// A point, and its ECEF coordinates by `cs2cs -f %.9f CRS EPSG:4978` of PROJ 9.1.1.
struct KnownPoint {
  const char* crs;
  Vec3d point;  ///< x east, y north
  Vec3d ecef;
};
const KnownPoint kKnownPoints[] = {
    {"EPSG:28992", {85012.343, 447455.577, 0.88}, {3922567.221145040, 299605.612793304, 5003560.556692061}},
    {"EPSG:28992", {155000, 463000, 10}, {3904025.804142008, 368159.390888434, 5013422.717840361}},
    {"EPSG:25832", {500000, 5761038.5, 120.5}, {3886587.623594601, 615575.005535300, 5002898.477875876}},
    {"EPSG:25832", {561000, 5800000, -3}, {3846382.277865405, 670990.282375557, 5026473.152801722}},
    {"EPSG:2263", {980000, 200000, 100}, {1333204.927258358, -4654137.867219210, 4138603.630919282}},  // in feet
    {"EPSG:3035", {4001000, 3200000, 1}, {3933606.185403524, 368765.714585928, 4990346.794592606}},
    {"EPSG:4978",
     {3922725.032782061, 299082.595903866, 5003522.188860035},
     {3922725.032782061, 299082.595903866, 5003522.188860035}}};

}  // namespace

TEST_CASE("points of a system go where PROJ takes them", "[quick][io][place]") {
  const KnownPoint known = GENERATE(from_range(std::begin(kKnownPoints), std::end(kKnownPoints)));
  CAPTURE(known.crs);
  const GlobePlace at = crs_operation(known.crs, known.point).sample;
  CHECK(length(ecef_of(at) - known.ecef) < 1e-5);
  const Placement placement = placement_in(known.crs, {std::round(at.lon), std::round(at.lat), 7});
  const auto map = crs_map(placement, known.point);
  std::vector<TriangleD> triangles{{known.point, known.point + Vec3d{1, 0, 0}, known.point + Vec3d{0, 0, 1}}};
  map->move(triangles, {});
  const GlobeMatrix m = to_ecef(placement);
  Vec3d p{};
  for (std::size_t i = 0; i < 3; ++i)
    p[i] = m[i] * triangles[0][0][0] + m[4 + i] * triangles[0][0][1] + m[8 + i] * triangles[0][0][2] + m[12 + i];
  CHECK(length(p - known.ecef) < 1e-6);
  const double edge = std::max(length(triangles[0][1] - triangles[0][0]), length(triangles[0][2] - triangles[0][0]));
  CHECK((edge <= map->stretch() && edge > 0.8 * map->stretch()));
}

TEST_CASE("a scene with y up is turned before its system places it", "[quick][io][place]") {
  const Vec3d p{85012.343, 447455.577, 0.88};
  Placement placement = placement_in("EPSG:28992", {4, 52, 0});
  std::vector<TriangleD> upright{{p, p, p}}, lying;
  const Vec3d turned_p{p[0], p[2], -p[1]};
  lying.push_back({turned_p, turned_p, turned_p});
  std::vector<TriangleD> told = lying;
  crs_map(placement, p)->move(upright, UpAxis::z);
  crs_map(placement, p)->move(told, UpAxis::y);
  placement.scene_up = UpAxis::y;
  crs_map(placement, p)->move(lying, {});
  CHECK(upright == told);
  CHECK(upright == lying);
  const Vec3d up = crs_map(placement, p)->normal({0, 2, 0}, {});
  CHECK(up[2] / length(up) > 0.999);
}

TEST_CASE("a point goes to the same place, whatever comes with it, on every thread", "[quick][io][place]") {
  const Vec3d p{85012.343, 447455.577, 0.88};
  const auto map = crs_map(placement_in("EPSG:28992", {4.37, 52.01, 0}), p);
  std::vector<TriangleD> all;
  for (int i = 0; i < 3000; ++i) all.push_back({p, p + Vec3d{i * 0.37, 1, 0}, p + Vec3d{1, i * 0.11, i * 0.01}});
  std::vector<TriangleD> one_by_one = all;
  map->move(all, {});
  parallel_for(std::int64_t(one_by_one.size()), [&](std::int64_t i) {
    std::vector<TriangleD> one{one_by_one[std::size_t(i)]};
    map->move(one, {});
    one_by_one[std::size_t(i)] = one[0];
  });
  CHECK(all == one_by_one);
}

TEST_CASE("a scene is read in the coordinates of its map", "[quick][io][place]") {
  const TempDir dir;
  const std::string path = dir.file("a.obj",
                                    "v 85012.343 447455.577 0.88\nv 85013 447455 1\nv 85013 447456 nan\n"
                                    "v 85012 447456 2\nf 1 2 4\nf 1 2 3\n");
  SceneOptions options;
  const Placement placement = placement_in("EPSG:28992", {4.37, 52.01, 0});
  options.map = crs_map(placement, {85012, 447455, 0});
  const auto scene = open_scene(path, options);
  std::vector<TriangleD> triangles;
  REQUIRE(scene->read(triangles));
  REQUIRE(triangles.size() == 1);
  CHECK(length(triangles[0][0]) < 1000);
  CHECK(scene->up() == UpAxis::z);
  CHECK(scene->counts().non_finite == 1);
}

TEST_CASE("systems that are none, or are no lengths, and points elsewhere are refused", "[quick][io][place]") {
  CHECK(refusal("EPSG:1", {0, 0, 0}) == ErrorCode::bad_argument);
  CHECK(refusal("city", {0, 0, 0}) == ErrorCode::bad_argument);
  CHECK(refusal("EPSG:4326", {4, 52, 0}) == ErrorCode::bad_argument);
  CHECK(refusal("EPSG:4979", {4, 52, 0}) == ErrorCode::bad_argument);
  CHECK(refusal("EPSG:25832", {1e9, 1e9, 0}) == ErrorCode::bad_input);
  CHECK(refusal("EPSG:28992", {85000, 447000, 0}) == ErrorCode::closed_pipe);  // is not refused
}

TEST_CASE("a system tells whether it has heights, and whether the scene is in its area", "[quick][io][place]") {
  CHECK_FALSE(crs_operation("EPSG:28992", {85000, 447000, 0}).has_heights);
  CHECK(crs_operation("EPSG:7415", {85000, 447000, 0}).has_heights);
  CHECK(crs_operation("EPSG:4978", kKnownPoints[0].ecef).has_heights);
  CHECK(crs_operation("EPSG:28992", {85000, 447000, 0}).outside.empty());
  CHECK_FALSE(crs_operation("EPSG:28992", {447000, 85000, 0}).outside.empty());
}

#endif
