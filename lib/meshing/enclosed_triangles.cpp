#include "lib/meshing/enclosed_triangles.h"

#include <algorithm>
#include <cmath>

#include "lib/core/triangle_intersection.h"
#include "lib/core/vec3.h"

namespace bp {

namespace {

/// Lattice box that surely holds a triangle: to_voxels errs by less than 2^-20 voxel.
LatticeBox box_around(const GridFrame& frame, const TriangleD& t) {
  LatticeBox box;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d v = frame.to_voxels(t[k]);
    LatticeCoord low, high;
    for (int i = 0; i < 3; ++i) {
      low[i] = std::int64_t(std::floor(v[std::size_t(i)] * kLatticePerVoxel)) - 1;
      high[i] = low[i] + 3;
    }
    if (k == 0) box = {low, high};
    box.add(low);
    box.add(high);
  }
  return box;
}

/// The plane of a face, to tell boxes that lie strictly on its inner side: nothing in them meets the face, nor a
/// tetrahedron that it closes towards the inside. Doubles with a margin for their rounding.
class InnerSide {
 public:
  InnerSide(const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& c)
      : a_(a), n_(to_double(normal_of(a, b, c))) {}
  [[nodiscard]] bool holds(const LatticeBox& box) const {
    double far = 0, size = 0;
    for (int i = 0; i < 3; ++i) {
      const double n = n_[std::size_t(i)];
      const double term = n * double((n > 0 ? box.max[i] : box.min[i]) - a_[i]);
      far += term;
      size += std::abs(term);
    }
    return far < -0x1p-50 * size;  // normal, product and sums: fewer than 8 roundings
  }

 private:
  LatticeCoord a_;
  Vec3d n_;
};

/// A closed tetrahedron in scene units, turned so that each of its four planes has the inside on its negative side.
struct Solid {
  std::array<Vec3d, 4> corners;
  LatticeBox box;

  /// Exact. The plane of the first three corners is asked first.
  [[nodiscard]] bool holds(const Vec3d& p) const {
    const auto& [a, b, c, d] = corners;
    return orient3d(a, b, c, p) <= 0 && orient3d(a, d, b, p) <= 0 && orient3d(b, d, c, p) <= 0 &&
           orient3d(c, d, a, p) <= 0;
  }
};

/// Interleaved bits of a corner's place in the bounds: what is near in space is near in memory.
std::uint64_t morton(const Vec3d& p, const Bounds3d& bounds) {
  std::uint64_t code = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double side = bounds.max[axis] - bounds.min[axis];
    auto bits = side > 0 ? std::uint64_t((p[axis] - bounds.min[axis]) / side * 0xffff) : 0;
    for (int i = 0; i < 16; ++i) code |= ((bits >> i) & 1) << (3 * i + int(axis));
  }
  return code;
}

void sort_in_space(std::vector<TriangleD>& triangles) {
  Bounds3d bounds;
  for (const TriangleD& t : triangles) bounds.add(t[0]);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) order[i] = {morton(triangles[i][0], bounds), std::uint32_t(i)};
  std::sort(order.begin(), order.end());
  std::vector<TriangleD> sorted;
  sorted.reserve(triangles.size());
  for (const auto& [code, i] : order) sorted.push_back(triangles[i]);
  triangles = std::move(sorted);
}

}  // namespace

EnclosedTriangles::EnclosedTriangles(std::vector<TriangleD> triangles, const GridFrame& frame)
    : triangles_(std::move(triangles)), frame_(frame) {
  sort_in_space(triangles_);
  std::vector<LatticeBox> boxes(triangles_.size());
  std::vector<std::uint32_t> items(triangles_.size());
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    boxes[i] = box_around(frame_, triangles_[i]);
    items[i] = std::uint32_t(i);
  }
  tree_.build(boxes, std::move(items));
}

// A triangle meets neither the old faces (it was enclosed) nor, once tested, the new ones. So it lies wholly in one
// part of space that they bound together, and one of its corners tells whether a tetrahedron that leaves the solid
// holds it. Nearly all triangles near a face lie wholly on its inner side: three orientations, and no more.
bool EnclosedTriangles::allows(std::span<const NewFace> star, std::span<const Tetrahedron> swept,
                               Blocker* blocker) const {
  for (const NewFace& f : star) {
    const std::array<Vec3d, 3> face = {frame_.world(f.corners[0]), frame_.world(f.corners[1]),
                                       frame_.world(f.corners[2])};
    const InnerSide inner(f.corners[0], f.corners[1], f.corners[2]);
    const bool free = tree_.query(
        box_of(f.corners[0], f.corners[1], f.corners[2]), [&](const LatticeBox& b) { return !inner.holds(b); },
        [&](std::uint32_t i) {
          return !triangles_intersect(triangles_[i].data(), face.data()) || !blocks(i, blocker);
        });
    if (!free) return false;
  }
  for (const Tetrahedron& t : swept) {
    // A swept tetrahedron (a, b, c, q) has q on the inner side of its old face; a flat one holds nothing.
    const int turn = orient3d(t[0], t[1], t[2], t[3]);
    if (turn == 0) continue;
    const std::size_t second = turn > 0 ? 1 : 2;
    Solid solid{{frame_.world(t[3]), frame_.world(t[second]), frame_.world(t[3 - second]), frame_.world(t[0])}, {}};
    LatticeBox box = box_of(t[0], t[1], t[2]);
    box.add(t[3]);
    const InnerSide inner(t[3], t[3 - second], t[second]);  // of the new face: the tetrahedron is beyond it
    const bool free = tree_.query(
        box, [&](const LatticeBox& b) { return !inner.holds(b); },
        [&](std::uint32_t i) { return !solid.holds(triangles_[i][0]) || !blocks(i, blocker); });
    if (!free) return false;
  }
  return true;
}

namespace {

/// The corners, and inside a large triangle a grid of points.
void add_samples(const TriangleD& t, double voxel, std::vector<Vec3d>& points) {
  constexpr double kSpacingVox = 8;
  constexpr int kMostPerEdge = 16;
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d e = t[(k + 1) % 3] - t[k];
    longest = std::max(longest, dot(e, e));
  }
  const int n = int(std::clamp(std::sqrt(longest) / (kSpacingVox * voxel), 1.0, double(kMostPerEdge)));
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; i + j <= n; ++j)
      points.push_back(t[0] + (double(i) / n) * (t[1] - t[0]) + (double(j) / n) * (t[2] - t[0]));
  }
}

}  // namespace

/// Always true.
bool EnclosedTriangles::blocks(std::uint32_t triangle, Blocker* blocker) const {
  if (blocker == nullptr) return true;
  blocker->count = 3;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d v = frame_.to_voxels(triangles_[triangle][k]);
    for (std::size_t i = 0; i < 3; ++i) blocker->points[k][i] = v[i] * kLatticePerVoxel;
  }
  return true;
}

std::uint64_t EnclosedTriangles::bytes() const {
  constexpr std::uint64_t kBytesInTree = 80;
  return triangles_.size() * (sizeof(TriangleD) + kBytesInTree + kBytesPerContactPoint);
}

std::vector<Vec3d> EnclosedTriangles::contact_points(const LatticeCoord& origin) const {
  std::vector<Vec3d> points;
  points.reserve(3 * triangles_.size());
  for (const TriangleD& t : triangles_) add_samples(t, frame_.voxel, points);
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  for (Vec3d& p : points) {
    const Vec3d v = frame_.to_voxels(p);
    for (std::size_t i = 0; i < 3; ++i) p[i] = v[i] * kLatticePerVoxel - double(origin[int(i)]);
  }
  return points;
}

}  // namespace bp
