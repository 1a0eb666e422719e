#include <cmath>

#include "lib/closing/rotation.h"
#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/pass/measure/detail/frame_tensor.h"
#include "lib/pass/measure/orientation.h"
#include "tests/catch.h"

using namespace bp;

namespace {

using detail::Frame;

/// Rows are the axes of a cube.
Frame frame_of(const FixedQuaternion& q) {
  const Rotation r = rotation_of(q);
  Frame f{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) f[i][j] = r.row[i][j] / double(1 << kRotationBits);
  }
  return f;
}

/// The 12 triangles of a box with its axes along `frame`.
std::vector<TriangleD> box(const Vec3d& centre, const Vec3d& half, const Frame& frame) {
  std::vector<TriangleD> out;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const auto corner = [&](double u, double v) {
        const std::size_t b = (axis + 1) % 3, c = (axis + 2) % 3;
        return centre + (side * half[axis]) * frame[axis] + (u * half[b]) * frame[b] + (v * half[c]) * frame[c];
      };
      out.push_back({corner(-1, -1), corner(1, -1), corner(1, 1)});
      out.push_back({corner(-1, -1), corner(1, 1), corner(-1, 1)});
    }
  }
  return out;
}

StreamHeader header_of(const std::vector<TriangleD>& triangles, double voxel) {
  StreamHeader h;
  for (const TriangleD& t : triangles) {
    for (const Vec3d& p : t) h.bounds.add(p);
  }
  h.frame = make_frame(h.bounds, voxel);
  return h;
}

OrientationField automatic(const std::vector<TriangleD>& triangles, double voxel, double scale) {
  OrientationMaker maker(header_of(triangles, voxel), scale);
  for (const TriangleD& t : triangles) maker.add(t);
  return maker.make();
}

constexpr double kDegree = 3.14159265358979323846 / 180;

FixedQuaternion turn(double degrees, const Vec3d& axis) {
  const double s = std::sin(degrees / 2 * kDegree) / length(axis), one = 1 << kRotationBits;
  return {std::int16_t(std::lround(one * std::cos(degrees / 2 * kDegree))),
          std::int16_t(std::lround(one * s * axis[0])), std::int16_t(std::lround(one * s * axis[1])),
          std::int16_t(std::lround(one * s * axis[2]))};
}

}  // namespace

TEST_CASE("a box of any direction is found, whole, as one rotation", "[quick][oriented]") {
  for (const FixedQuaternion q :
       {turn(30, {0, 0, 1}), turn(25, {1, 2, 3}), turn(45, {1, 0, 0}), turn(60, {1, -1, 1})}) {
    const OrientationField f = automatic(box({5, 3, 2}, {4, 2, 1}, frame_of(q)), 0.05, 0.3);
    REQUIRE(orientation_fault(f) == nullptr);
    CHECK(f.rotations.size() == 1);
    const Frame found = frame_of(f.rotations.back());
    CHECK(detail::likeness(found, frame_of(q)) > std::cos(0.6 * kDegree));
  }
}

TEST_CASE("a box along the axes is not turned", "[quick][oriented]") {
  const OrientationField f = automatic(box({5, 3, 2}, {4, 2, 1}, frame_of({})), 0.05, 0.3);
  CHECK(f.rotations == std::vector<FixedQuaternion>{{}});
}

TEST_CASE("two buildings keep an orientation each", "[quick][oriented]") {
  const FixedQuaternion a = turn(20, {0, 0, 1}), b = turn(-30, {0, 0, 1});
  std::vector<TriangleD> triangles = box({0, 0, 0}, {4, 3, 2}, frame_of(a));
  for (const TriangleD& t : box({30, 0, 0}, {4, 3, 2}, frame_of(b))) triangles.push_back(t);
  const StreamHeader h = header_of(triangles, 0.05);
  const OrientationField f = automatic(triangles, 0.05, 0.5);
  const auto at = [&](const Vec3d& p) {
    const Vec3d v = h.frame.to_voxels(p);
    return frame_of(f.rotations[f.index_at({std::int32_t(v[0]), std::int32_t(v[1]), std::int32_t(v[2])})]);
  };
  CHECK(detail::likeness(at({-3, 0, 0}), frame_of(a)) > std::cos(2 * kDegree));
  CHECK(detail::likeness(at({33, 0, 0}), frame_of(b)) > std::cos(2 * kDegree));
}

TEST_CASE("frames at places hold there, and turn smoothly between", "[quick][oriented]") {
  const Frame none = frame_of({}), turned = frame_of(turn(24, {0, 0, 1}));
  StreamHeader h;
  h.bounds = {{0, 0, 0}, {32, 8, 8}};
  h.frame = make_frame(h.bounds, 0.125);
  OrientationMaker maker(h, 1);
  maker.add({1, 4, 4}, none);
  maker.add({31, 4, 4}, turned);
  const OrientationField f = maker.make();
  const auto at = [&](double x) {
    const Vec3d v = h.frame.to_voxels({x, 4, 4});
    return frame_of(f.rotations[f.index_at({std::int32_t(v[0]), std::int32_t(v[1]), std::int32_t(v[2])})]);
  };
  CHECK(detail::likeness(at(1), none) > std::cos(2 * kDegree));
  CHECK(detail::likeness(at(31), turned) > std::cos(2 * kDegree));
  CHECK(detail::likeness(at(16), frame_of(turn(12, {0, 0, 1}))) > std::cos(3 * kDegree));
  for (double x = 2; x < 31; x += 1) CHECK(detail::likeness(at(x), at(x + 1)) > std::cos(4 * kDegree));
}

/// Returns a sphere of radius 1 around (0, 0, 0).
std::vector<TriangleD> sphere(int n) {
  const auto at = [&](int i, int j) {
    const double a = i * 180.0 / n * kDegree, b = j * 180.0 / n * kDegree;
    return Vec3d{std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)};
  };
  std::vector<TriangleD> out;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < 2 * n; ++j) {
      out.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      out.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return out;
}

TEST_CASE("an orientation has the same bits for any number of threads", "[quick][oriented]") {
  const std::vector<TriangleD> triangles = sphere(24);
  const OrientationField all = automatic(triangles, 0.02, 0.16);
  CHECK(all.rotations.size() > 30);
  const ThreadLimit limit(1);
  CHECK(automatic(triangles, 0.02, 0.16) == all);
}

TEST_CASE("no two rotations of an orientation are within 2 degrees", "[quick][oriented]") {
  const OrientationField f = automatic(sphere(24), 0.02, 0.08);
  REQUIRE(orientation_fault(f) == nullptr);
  std::vector<Frame> frames;
  for (const FixedQuaternion& q : f.rotations) frames.push_back(frame_of(q));
  double most = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) most = std::max(most, detail::likeness(frames[i], frames[j]));
  }
  CHECK(most < std::cos(1.9 * kDegree));  // rows are rounded
}

TEST_CASE("turns of a cube onto itself change no frame", "[quick][oriented]") {
  const Frame f = frame_of(turn(33, {1, 2, -1}));
  const Frame same{-1.0 * f[1], f[0], f[2]};
  CHECK(detail::likeness(f, same) > 0.999);
  const auto a = detail::least_turn(f), b = detail::least_turn(same);
  for (std::size_t i = 0; i < 4; ++i) CHECK(std::abs(a[i] - b[i]) < 1e-3);
}
