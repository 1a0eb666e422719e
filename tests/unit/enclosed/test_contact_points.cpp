#include <algorithm>

#include "lib/core/vec3.h"
#include "lib/enclosed/contact_points.h"
#include "tests/catch.h"

using namespace bp;

namespace {

constexpr std::int64_t kEdge = 4096;

/// A cube of 12 faces.
LatticeMesh cube() {
  LatticeMesh mesh;
  mesh.frame.voxel = 1;
  for (int i = 0; i < 8; ++i) mesh.vertices.push_back({(i & 1) * kEdge, (i >> 1 & 1) * kEdge, (i >> 2) * kEdge});
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// An enclosed set of points only.
class PointsInside final : public Enclosed {
 public:
  explicit PointsInside(std::vector<Vec3d> points) : points_(std::move(points)) {}
  [[nodiscard]] bool allows(std::span<const NewFace>, std::span<const Tetrahedron>, Blocker*) const override {
    return true;
  }
  [[nodiscard]] std::vector<Vec3d> contact_points(const LatticeCoord& origin, const LatticeBox&) const override {
    std::vector<Vec3d> moved = points_;
    for (Vec3d& p : moved) p = p - to_double(origin);
    return moved;
  }
  [[nodiscard]] std::uint64_t bytes() const override { return 0; }

 private:
  std::vector<Vec3d> points_;
};

/// A square of points at each depth below the top, and one just under it.
std::vector<Vec3d> layers(int edge, std::initializer_list<double> depths, const Vec3d& highest) {
  std::vector<Vec3d> points{highest};
  for (const double depth : depths) {
    for (int y = 1; y < edge; ++y) {
      for (int x = 1; x < edge; ++x)
        points.push_back({double(x * kEdge) / edge, double(y * kEdge) / edge, double(kEdge) - depth});
    }
  }
  return points;
}

}  // namespace

TEST_CASE("of many contact points with a face those are kept that it meets first", "[quick][meshing]") {
  const HalfEdgeMesh mesh(cube());
  const Vec3d highest{1501, 2203, double(kEdge) - 1};
  const PointsInside enclosed(layers(100, {90, 200, 300}, highest));
  const ContactPoints contacts(enclosed, mesh, FaceTree(mesh));
  const Vec3d origin = to_double(contacts.origin());
  std::size_t kept = 0, deep = 0, found = 0;
  for (FaceId f = 0; f < mesh.face_capacity(); ++f) {
    CHECK(contacts.of(f).size() <= 720);
    if (mesh.corner(f, 0).z + mesh.corner(f, 1).z + mesh.corner(f, 2).z < 3 * kEdge) continue;  // not of the top
    for (const std::uint32_t i : contacts.of(f)) {
      const Vec3d p = contacts[i] + origin;
      deep += p[2] < double(kEdge) - 91;
      found += length(p - highest) < 0.5;
      ++kept;
    }
  }
  CHECK(found == 1);
  CHECK(deep == 0);
  CHECK(kept > 2 * 144);  // one for each part of both faces of the top
}

TEST_CASE("after many changes at once each contact point is with the nearest face", "[quick][meshing]") {
  HalfEdgeMesh mesh(cube());
  const PointsInside enclosed(layers(20, {90, 400}, {1501, 2203, double(kEdge) - 1}));
  ContactPoints contacts(enclosed, mesh, FaceTree(mesh));
  std::vector<FaceId> faces;
  for (FaceId f = 0; f < mesh.face_capacity(); ++f) faces.push_back(f);
  const auto corners = [&](FaceId f) {
    return std::array<Vec3d, 3>{to_double(mesh.corner(f, 0) - contacts.origin()),
                                to_double(mesh.corner(f, 1) - contacts.origin()),
                                to_double(mesh.corner(f, 2) - contacts.origin())};
  };
  const auto wrong = [&] {
    std::size_t sum = 0;
    for (const FaceId f : faces) {
      for (const std::uint32_t i : contacts.of(f)) {
        const double own = squared_distance(contacts[i], corners(f));
        sum += std::any_of(faces.begin(), faces.end(), [&](FaceId other) {
          return squared_distance(contacts[i], corners(other)) < 0.999 * own - 1e-6;
        });
      }
    }
    return sum;
  };
  const auto count = [&] {
    std::size_t sum = 0;
    for (const FaceId f : faces) sum += contacts.of(f).size();
    return sum;
  };
  const std::size_t before = count();
  CHECK(wrong() == 0);
  for (VertexId v = 0; v < mesh.vertex_capacity(); ++v) {  // turned, and no face folds over another
    const LatticeCoord p = mesh.position(v);
    mesh.move(v, {p.x, (24 * p.y - 7 * p.z) / 25, (7 * p.y + 24 * p.z) / 25});
  }
  CHECK(wrong() > 20);
  contacts.hand_over_around(faces);
  CHECK(wrong() == 0);
  CHECK(count() == before);
}

TEST_CASE("few contact points are all kept", "[quick][meshing]") {
  const HalfEdgeMesh mesh(cube());
  const PointsInside enclosed(layers(6, {90, 100}, {1501, 2203, double(kEdge) - 1}));
  const ContactPoints contacts(enclosed, mesh, FaceTree(mesh));
  std::size_t kept = 0;
  for (FaceId f = 0; f < mesh.face_capacity(); ++f) kept += contacts.of(f).size();
  CHECK(kept == 51);
}
