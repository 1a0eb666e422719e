#include "lib/pass/mesh/outward_scene.h"

#include <algorithm>
#include <array>

#include "lib/core/disjoint_sets.h"
#include "lib/core/parallel.h"
#include "lib/geometry/triangle_bvh.h"
#include "lib/geometry/welded_triangles.h"
#include "lib/mesh/constrained_minimum.h"
#include "lib/mesh/lattice_geometry.h"
#include "lib/mesh/shells.h"
#include "lib/pass/mesh/detail/mend_around.h"

namespace bp {

namespace {

/// Least step from a vertex to the planes around it, in units of kUnits. Rounding before and after the step takes back
/// up to half of a cube's diagonal each, 0.87.
constexpr double kStep = 2;
/// Lattice units that are tried as the unit of a step. Folds of a scan are often smaller than the larger one, and
/// vanish when corners are rounded to it.
constexpr std::array<double, 2> kUnits{1, 4};
constexpr double kFarthest = 2 * kLatticePerVoxel;  // largest step of a vertex; sharp tips need far steps

/// A closed mesh on the lattice in which the faces at each vertex form one fan. If two fans touch in a place, there are
/// two vertices at that place.
struct Fans {
  std::vector<LatticeCoord> places;  // of each vertex
  std::vector<Triangle> triangles;   // turned outwards
};

/// Returns the triangles with three distinct corners.
std::vector<Triangle> with_edges(const std::vector<Triangle>& all) {
  std::vector<Triangle> triangles;
  for (const Triangle& t : all) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
  }
  return triangles;
}

/// Turns over the parts whose volume is negative: cavities, and parts that were read inside out.
void turn_outwards(Fans& fans, DisjointSets& parts) {
  std::vector<double> volume(fans.triangles.size());
  const auto corner = [&](std::uint32_t f, std::size_t k) {
    return to_double(fans.places[fans.triangles[f][k]] - fans.places[fans.triangles[parts.find(f)][0]]);
  };
  for (std::uint32_t f = 0; f < volume.size(); ++f)
    volume[parts.find(f)] += dot(corner(f, 0), cross(corner(f, 1), corner(f, 2)));
  for (std::uint32_t f = 0; f < volume.size(); ++f) {
    if (volume[parts.find(f)] < 0) std::swap(fans.triangles[f][1], fans.triangles[f][2]);
  }
}

/// Returns the scene with its corners rounded to every `unit`-th lattice point.
std::vector<TriangleD> on_lattice(std::span<const TriangleD> scene, const GridFrame& frame, double unit) {
  std::vector<TriangleD> rounded_scene(scene.begin(), scene.end());
  for (TriangleD& t : rounded_scene) {
    for (Vec3d& p : t) p = unit * to_double(rounded((1 / unit) * frame.to_lattice(p)));
  }
  return rounded_scene;
}

std::optional<Fans> fans_of(std::span<const TriangleD> scene, const GridFrame& frame, double unit) {
  const WeldedTriangles mesh = welded(on_lattice(scene, frame, unit));
  const std::vector<Triangle> triangles = with_edges(mesh.triangles);
  const std::vector<std::uint32_t> twins = twins_of(triangles);
  if (twins.empty() || std::find(twins.begin(), twins.end(), kNoTwin) != twins.end()) return {};
  DisjointSets corners(3 * triangles.size()), parts(triangles.size());
  for (std::uint32_t h = 0; h < twins.size(); ++h) {
    corners.unite(h, HalfEdgeMesh::next(twins[h]));  // h runs over both halves of each edge, so both ends are united
    parts.unite(HalfEdgeMesh::face(h), HalfEdgeMesh::face(twins[h]));
  }
  Fans fans;
  fans.triangles.resize(triangles.size());
  std::vector<std::uint32_t> vertex(twins.size());
  for (std::uint32_t h = 0; h < twins.size(); ++h) {
    const std::uint32_t first = corners.find(h);
    if (first == h) {
      vertex[h] = std::uint32_t(fans.places.size());
      fans.places.push_back(rounded(mesh.places[triangles[h / 3][h % 3]]));
    }
    fans.triangles[h / 3][h % 3] = vertex[first];
  }
  turn_outwards(fans, parts);
  return fans;
}

using Planes = std::vector<PlaneConstraint>;

/// Returns the shortest step beyond all planes; none if there is no step, or only a long one.
std::optional<Vec3d> least_step(const Planes& planes) {
  Quadric nearest;
  nearest.xx = nearest.yy = nearest.zz = 1;
  std::optional<Vec3d> by = constrained_minimum(nearest, {}, planes);
  if (by && !(length(*by) < kFarthest)) by.reset();
  return by;
}

/// Adds the plane of a face. A face without area has none, and its neighbours decide.
void add_plane(const HalfEdgeMesh& mesh, FaceId f, double distance, Planes& planes) {
  const Vec3d normal = to_double(normal_of(mesh.corner(f, 0), mesh.corner(f, 1), mesh.corner(f, 2)));
  const double twice_area = length(normal);
  if (!(twice_area > 0)) return;
  const Vec3d unit = (1 / twice_area) * normal;
  const auto is_same = [&](const PlaneConstraint& p) { return dot(p.n, unit) > 1 - 1e-12; };
  if (std::none_of(planes.begin(), planes.end(), is_same)) planes.push_back({unit, distance});
}

/// Moves each vertex beyond the planes around it by `distance`. A vertex for which there is no such step stays, as at a
/// saddle.
LatticeMesh moved_outwards(const Fans& fans, const GridFrame& frame, double distance) {
  const HalfEdgeMesh before(fans.places, fans.triangles, kEverywhere);
  LatticeMesh mesh;
  mesh.frame = frame;
  mesh.vertices = fans.places;
  mesh.triangles = fans.triangles;
  parallel_ranges(std::int64_t(mesh.vertices.size()), kItemsAtOnce, [&](std::int64_t begin, std::int64_t end) {
    for (auto v = VertexId(begin); v < VertexId(end); ++v) {
      Planes planes;
      before.for_each_outgoing(v, [&](HalfEdgeId h) { add_plane(before, HalfEdgeMesh::face(h), distance, planes); });
      if (const std::optional<Vec3d> by = least_step(planes)) mesh.vertices[v] = mesh.vertices[v] + rounded(*by);
    }
  });
  return mesh;
}

}  // namespace

std::optional<LatticeMesh> outward_scene(std::span<const TriangleD> scene, const Rounding& rounding,
                                         const GridFrame& frame) {
  const double off = rounding.of(bounds_of(scene)) * kLatticePerVoxel / frame.voxel;
  for (const double unit : kUnits) {
    const std::optional<Fans> fans = fans_of(scene, frame, unit);
    if (!fans) return {};
    LatticeMesh mesh = moved_outwards(*fans, frame, kStep * unit + off);
    if (!mend_around(mesh, scene, rounding)) continue;
    HalfEdgeMesh shells(mesh);
    erase_inner_shells(shells);
    return shells.compact(frame);
  }
  return {};
}

}  // namespace bp
