#include "lib/hulls/convex_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "lib/core/box.h"
#include "lib/core/disjoint_sets.h"
#include "lib/core/parallel.h"
#include "lib/geometry/welded_triangles.h"
#include "lib/hulls/detail/convex_shape.h"
#include "lib/hulls/detail/convex_simplify.h"
#include "lib/hulls/detail/convex_tighten.h"
#include "lib/hulls/outward_hull.h"
#include "lib/mesh/lattice_geometry.h"
#include "lib/mesh/lattice_mesh.h"

namespace bp {

namespace {

using PartFace = std::array<std::uint32_t, 3>;

constexpr std::size_t kMostCornersOfPart = 4096;
constexpr double kAsWhole = 1e-6;    // of the volume: a part that has more than its hull winds around itself
constexpr double kFlatSides = 5e-4;  // of the volume, for fewer corners: flat sides are flat only up to rounding

/// Unites faces across edges that exactly two have, in opposite directions. So walls that touch along an edge stay
/// apart.
DisjointSets joined_faces(const WeldedTriangles& mesh) {
  const std::vector<std::uint32_t> twins = twins_of(mesh.triangles);
  DisjointSets joined(mesh.triangles.size());
  for (std::uint32_t h = 0; h < twins.size(); ++h) {
    if (twins[h] != kNoTwin) joined.unite(h / 3, twins[h] / 3);
  }
  return joined;
}

/// Returns the triangles of each connected part; parts are in the order of their first triangles.
std::vector<std::vector<std::uint32_t>> scene_parts(const WeldedTriangles& mesh) {
  constexpr std::uint32_t kNone = ~std::uint32_t(0);
  DisjointSets joined = joined_faces(mesh);
  std::vector<std::uint32_t> number(mesh.triangles.size(), kNone);
  std::vector<std::vector<std::uint32_t>> parts;
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    std::uint32_t& n = number[joined.find(f)];
    if (n == kNone) {
      n = std::uint32_t(parts.size());
      parts.emplace_back();
    }
    parts[n].push_back(f);
  }
  return parts;
}

/// Returns whether each edge is there once in either direction. Triangles with two corners at one place count no edge.
bool is_closed(const WeldedTriangles& mesh, const std::vector<std::uint32_t>& part) {
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (const std::uint32_t f : part) {
    const PartFace& t = mesh.triangles[f];
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    for (std::size_t k = 0; k < 3; ++k) edges.push_back({t[k], t[(k + 1) % 3]});
  }
  std::sort(edges.begin(), edges.end());
  if (std::adjacent_find(edges.begin(), edges.end()) != edges.end()) return false;
  return !edges.empty() && std::all_of(edges.begin(), edges.end(), [&](const std::array<std::uint32_t, 2>& e) {
    return std::binary_search(edges.begin(), edges.end(), std::array{e[1], e[0]});
  });
}

/// A part on a lattice of its own, which is far finer than any frame's.
struct FinePart {
  std::vector<std::uint32_t> places;   // places of the part
  std::vector<LatticeCoord> vertices;  // the same places on the lattice
  std::vector<PartFace> triangles;
  double unit = 0;  // scene units

  FinePart(const WeldedTriangles& mesh, const std::vector<std::uint32_t>& part) {
    constexpr double kSteps = double(std::int64_t(1) << 27);
    for (const std::uint32_t f : part) places.insert(places.end(), mesh.triangles[f].begin(), mesh.triangles[f].end());
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    Bounds3d bounds;
    for (const std::uint32_t p : places) bounds.add(mesh.places[p]);
    unit = bounds.longest_side() / kSteps;
    if (!(unit > 0) || !std::isfinite(1 / unit)) return;
    for (const std::uint32_t p : places) vertices.push_back(rounded((1 / unit) * (mesh.places[p] - bounds.min)));
    for (const std::uint32_t f : part) {
      PartFace t = mesh.triangles[f];
      for (std::uint32_t& v : t) v = std::uint32_t(std::lower_bound(places.begin(), places.end(), v) - places.begin());
      triangles.push_back(t);
    }
  }
};

/// The corners and the volume of a convex part. Without corners, the part is not convex.
struct Found {
  std::vector<Vec3d> corners;
  double volume = 0;
};

Found convex_part(const WeldedTriangles& mesh, const std::vector<std::uint32_t>& part) {
  if (part.size() < 4 || !is_closed(mesh, part)) return {};
  const FinePart fine(mesh, part);
  if (fine.vertices.empty()) return {};
  const std::optional<ConvexHull> hull = hull_of(fine.vertices);
  if (!hull || hull->vertices.size() > kMostCornersOfPart) return {};
  const double hull6 = volume6_of(*hull), own6 = std::abs(double(volume6_of(fine.vertices, fine.triangles)));
  if (hull6 > (1 + kNearlyConvex) * own6 || own6 > (1 + kAsWhole) * hull6) return {};
  std::vector<LatticeCoord> corners = hull->vertices;
  std::sort(corners.begin(), corners.end());
  Found found{{}, own6 / 6 * fine.unit * fine.unit * fine.unit};
  for (std::size_t i = 0; i < fine.vertices.size(); ++i) {
    if (std::binary_search(corners.begin(), corners.end(), fine.vertices[i]))
      found.corners.push_back(mesh.places[fine.places[i]]);
  }
  return found;
}

/// Leaves out hulls that lie in others.
std::vector<ConvexHull> outer_hulls(std::vector<ConvexHull> hulls) {
  std::vector<LatticeBox> boxes;
  for (const ConvexHull& hull : hulls) boxes.push_back(box_of(hull.vertices));
  std::vector<char> inner(hulls.size(), 0);
  for (std::size_t i = 0; i < hulls.size(); ++i) {
    for (std::size_t j = 0; j < hulls.size() && !inner[i]; ++j)
      inner[i] = char(i != j && !inner[j] && boxes[j].holds(boxes[i]) && holds_all(hulls[j], hulls[i].vertices));
  }
  std::vector<ConvexHull> outer;
  for (std::size_t i = 0; i < hulls.size(); ++i) {
    if (!inner[i]) outer.push_back(std::move(hulls[i]));
  }
  return outer;
}

}  // namespace

ConvexScene convex_scene(std::span<const TriangleD> scene) {
  const WeldedTriangles mesh = welded(scene);
  const std::vector<std::vector<std::uint32_t>> parts = scene_parts(mesh);
  std::vector<Found> found(parts.size());
  parallel_for(std::int64_t(parts.size()),
               [&](std::int64_t i) { found[std::size_t(i)] = convex_part(mesh, parts[std::size_t(i)]); });
  ConvexScene out;
  std::vector<char> taken(scene.size(), 0);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (found[i].corners.empty()) continue;
    for (const std::uint32_t f : parts[i]) taken[f] = 1;
    out.parts.push_back(std::move(found[i].corners));
    out.volume += found[i].volume;
  }
  for (std::size_t f = 0; f < scene.size(); ++f) {
    if (!taken[f]) out.rest.push_back(scene[f]);
  }
  return out;
}

std::vector<ConvexHull> hulls_around(const ConvexScene& scene, const GridFrame& frame, std::size_t corners,
                                     const Rounding& rounding) {
  std::vector<ConvexHull> hulls(scene.parts.size());
  parallel_for(std::int64_t(hulls.size()), [&](std::int64_t i) {
    std::vector<Vec3d> points;
    Bounds3d bounds;
    for (const Vec3d& p : scene.parts[std::size_t(i)]) points.push_back(frame.to_lattice(p)), bounds.add(p);
    const double off = rounding.of(bounds) * kLatticePerVoxel / frame.voxel;
    ConvexHull& hull = hulls[std::size_t(i)];
    hull = with_fewer_corners(outward_hull(points, off), corners, kFlatSides);
    draw_diagonals(hull);
  });
  return outer_hulls(std::move(hulls));
}

}  // namespace bp
