#include "lib/pass/mesh/detail/convex_proxy.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "lib/hulls/convex_budget.h"
#include "lib/hulls/hull_sides.h"
#include "lib/mesh/lattice_geometry.h"
#include "lib/simplify/shape_limits.h"

namespace bp {

namespace {

constexpr double kLessInSkin = 0.97;     // share of the proxy's volume in the skin
constexpr std::size_t kMostFaces = 512;  // of a hull; a hull of more faces is round, and a proxy is as good there

struct Rating {
  std::size_t faces;
  double volume, in_skin;  // lattice units cubed
  double diagonal;         // of the mesh's box
};

template <class Mesh>
Rating rate(const Mesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles) area += area_of(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
  const double volume = double(volume6_of(mesh.vertices, mesh.triangles)) / 6;
  const LatticeBox box = box_of(mesh.vertices);
  return {mesh.triangles.size(), volume, volume + kSkin * area, length(to_double(box.max - box.min))};
}

/// Replaces `hull` by the hull of itself and the boxes.
void add_outer(std::span<const LatticeBox> boxes, ConvexHull& hull) {
  constexpr std::size_t kAtOnce = 32;
  const HullSides sides(hull);
  std::vector<LatticeCoord> points = hull.vertices;
  while (!boxes.empty()) {
    const auto some = boxes.first(std::min(kAtOnce, boxes.size()));
    boxes = boxes.subspan(some.size());
    LatticeBox around = some[0];
    for (const LatticeBox& box : some) around.add(box.min), around.add(box.max);
    if (sides.hold(around)) continue;
    for (const LatticeBox& box : some) {
      if (!sides.hold(box)) add_corners(box, points);
    }
  }
  if (points.size() > hull.vertices.size()) hull = *hull_of(points);
}

/// Returns whether the box is so long that the outlines of its voxels would take more than 17 MB.
bool is_too_long(const LatticeBox& box) {
  constexpr std::int64_t kMost = std::int64_t(1) << 21;
  const LatticeCoord size = box.max - box.min;
  return std::max({size.x, size.y, size.z}) > kMost;
}

/// Returns the hull of everything that is enclosed. Returns nothing if its volume in the skin reaches `most`, since any
/// larger hull would hold as much, or if it has many faces. outer_boxes() repeats the first boxes among the others, so
/// they are used twice.
std::optional<ConvexHull> hull_around(const Enclosed& enclosed, double most) {
  std::optional<ConvexHull> hull;
  bool first = true, fits = true;
  enclosed.outer_boxes([&](std::span<const LatticeBox> boxes) {
    if (hull) {
      add_outer(boxes, *hull);
    } else {
      std::vector<LatticeCoord> points;
      for (const LatticeBox& box : boxes) add_corners(box, points);
      hull = hull_of(points);
    }
    fits = !hull || (rate(*hull).in_skin < most && (first || hull->triangles.size() <= kMostFaces));
    first = false;
    return fits;
  });
  if (!fits) return {};
  return hull;
}

ConvexHull box_around(const ConvexHull& hull) {
  std::vector<LatticeCoord> corners;
  add_corners(box_of(hull.vertices), corners);
  return *hull_of(corners);
}

/// Returns whether one of two meshes is better; both have few enough faces. It has clearly less volume in the skin, and
/// also less volume or, with a clearly shorter box, no spikes; or it has fewer faces and less of both volumes.
bool is_better(const Rating& one, const Rating& other) {
  const bool less = one.volume < other.volume, nearer = one.diagonal < kClearlyLess * other.diagonal;
  if (one.in_skin < kLessInSkin * other.in_skin && (less || nearer)) return true;
  return less && one.faces < other.faces && one.in_skin < other.in_skin;
}

}  // namespace

LatticeMesh convex_proxy(const Enclosed& enclosed, const LatticeMesh& proxy, std::uint64_t faces) {
  LatticeMesh out;
  out.frame = proxy.frame;
  if (proxy.triangles.size() > faces || is_too_long(box_of(proxy.vertices))) return out;
  Rating best = rate(proxy);
  const std::optional<ConvexHull> hull = hull_around(enclosed, best.in_skin);
  if (!hull) return out;
  std::array found{box_around(*hull), with_fewer_faces(*hull, faces), *hull};
  for (ConvexHull& other : found) {
    const Rating rating = rate(other);
    if (rating.faces > faces || !is_better(rating, best)) continue;
    best = rating;
    out.vertices = std::move(other.vertices);
    out.triangles = std::move(other.triangles);
  }
  return out;
}

}  // namespace bp
