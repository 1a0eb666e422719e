#include "tools/lod/collision/nearer_hulls.h"

#include <algorithm>
#include <utility>

#include "io/stream/brick_shelf.h"
#include "lib/grid/shelf_stream.h"
#include "lib/hulls/convex_budget.h"
#include "lib/hulls/convex_scene.h"
#include "lib/hulls/outward_hull.h"
#include "lib/levels/lod_chain.h"
#include "lib/pass/voxelize/triangle_list.h"
#include "tools/lod/choices.h"
#include "tools/lod/collision/collision_files.h"

namespace bp {

namespace {

// The least share of the body's volume: convex parts with less are not worth another body around the rest.
constexpr double kCounts = 0.05;

/// Moves the mesh from the frame of reduced voxels into the frame before `reductions` doublings.
LatticeMesh in_finer_frame(LatticeMesh mesh, int reductions) {
  const std::int64_t times = std::int64_t(1) << reductions;
  mesh.frame.voxel /= double(times);
  for (std::int64_t& x : mesh.frame.origin) x *= times;
  for (LatticeCoord& v : mesh.vertices) v = v * times;
  return mesh;
}

/// Makes a body around the scene's remaining triangles as the chain made the scene's: with the same voxels and the same
/// target.
LatticeMesh body_of_rest(Build& build, const MadeChain& chain, std::vector<TriangleD> rest, LodOptions lod) {
  TriangleList source("the rest of the scene", rest, lod.rounding);
  VoxelizeOptions v = voxelize_options(build, {});
  v.up = chain.scene.voxels.header.frame.up;
  v.voxel_size = [&](const Bounds3d&) { return chain.scene.voxels.header.frame.voxel; };
  std::unique_ptr<BrickShelf> solid = build.make_shelf();
  ShelfSink sink(solid.get());
  StreamHeader header;
  voxelize_stream(
      source,
      [&](const StreamHeader& h, const VoxelizeCounts&) -> BrickSink& {
        header = h;
        return sink;
      },
      v);
  lod.scene = std::move(rest);
  LodChain levels(header, std::move(solid), build.backends, std::move(lod));
  LodLevel level = levels.make(chain.made.facts.front().target);
  return in_finer_frame(std::move(level.mesh), level.reductions);
}

/// Returns the scene's convex parts unchanged, and the hulls of a body around the rest.
ConvexParts hulls_of_parts(Build& build, const MadeChain& chain, ConvexScene scene, HullLimits limits, LodOptions lod) {
  const Rounding rounding = lod.rounding;
  LatticeMesh rest;
  rest.frame = chain.scene.voxels.header.frame;
  if (!scene.rest.empty()) rest = body_of_rest(build, chain, std::move(scene.rest), std::move(lod));
  rest.provenance = chain.made.levels.front().mesh.provenance;
  const std::vector<ConvexHull> given = hulls_around(scene, rest.frame, limits.corners, rounding);
  if (build.options.levels.faces.empty()) limits.faces = std::max(limits.faces, face_count(given));
  return convex_parts(rest, limits, given);
}

/// Hulls overlap by a lattice unit where the body was cut, and the body keeps clear of the scene by what that may be
/// off by. So a point that is off by up to half a unit stays in a hull. `off`: scene units; more of them take larger
/// hulls.
ConvexParts grown(ConvexParts parts, double off) {
  constexpr double kOverlap = 0.25;  // lattice units, with room for the rounding of a check
  for (LatticeMesh& hull : parts.hulls) {
    const double by = off * kLatticePerVoxel / hull.frame.voxel;
    if (by <= kOverlap) continue;
    std::vector<Vec3d> corners;
    for (const LatticeCoord& v : hull.vertices) corners.push_back(to_double(v));
    ConvexHull around = outward_hull(corners, by);
    hull.vertices = std::move(around.vertices);
    hull.triangles = std::move(around.triangles);
  }
  return parts;
}

ConvexParts nearest_hulls(Build& build, const MadeChain& chain) {
  const LatticeMesh& body = chain.made.levels.front().mesh;
  HullLimits limits;
  limits.hulls = std::size_t(build.options.hulls), limits.corners = std::size_t(build.options.hull_corners);
  limits.faces = faces_of_hulls(build.options, body);
  if (!asks_for_faces(request_of(build.options))) limits.loose_faces = kMostCollisionFaces;
  ConvexParts of_body = convex_parts(body, limits);
  if (chain.scene.enclosed != Enclose::scene) return of_body;
  LodOptions lod = complete_options(build, chain.scene, chain.room);
  ConvexScene scene = convex_scene(lod.scene);
  const std::size_t most = most_hulls(limits, of_body.solids);
  const bool counts = scene.rest.empty() || scene.volume > kCounts * chain.made.facts.front().volume;
  if (scene.parts.empty() || !counts || scene.parts.size() > most_given(most)) return of_body;
  limits.hulls = std::max(most, of_body.hulls.size());
  ConvexParts of_parts = hulls_of_parts(build, chain, std::move(scene), limits, std::move(lod));
  return volume_of(of_parts) <= volume_of(of_body) ? std::move(of_parts) : std::move(of_body);
}

}  // namespace

ConvexParts nearer_hulls(Build& build, const MadeChain& chain) {
  const VoxelizedScene& voxels = chain.scene.voxels;
  return grown(nearest_hulls(build, chain), voxels.counts.scene.rounding.of(voxels.header.bounds));
}

}  // namespace bp
