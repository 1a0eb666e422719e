#include "lib/pass/mesh/detail/level_inputs.h"

#include <algorithm>

#include "lib/enclosed/enclosed_triangles.h"
#include "lib/pass/mesh/detail/coarse_start.h"
#include "lib/pass/mesh/detail/fit_target.h"
#include "lib/pass/mesh/detail/make_level.h"
#include "lib/pass/mesh/detail/proxy_limits.h"
#include "lib/pass/mesh/detail/scaled_edges.h"
#include "lib/pass/mesh/surface_around.h"
#include "lib/simplify/surface_tree.h"
#include "lib/tighten/tight_proxy.h"

namespace bp {

bool LevelInputs::is_by_faces(std::uint64_t faces) const {
  return !inside() && params.tighten && faces >= kFewFaces && params.error_world == 0 && params.volume_ratio == 0 &&
         params.edge_factor == 0;
}

EdgeLimit LevelInputs::edges_for(const GridFrame& frame) const {
  return params.edge_factor > 0 ? scaled_edges(header.scale, frame, params.edge_factor) : EdgeLimit{};
}

std::uint64_t LevelInputs::edge_bytes(const GridFrame& frame, const BrickShelf* near) const {
  return near != nullptr && params.edge_factor > 0 ? bytes_of_near_edges(header.scale, frame, *near) : 0;
}

namespace {

/// Returns the work of the first level, without limits on its error and volume.
SurfaceWork first_work(const LevelInputs& in, const PieceMemory& pieces, const BrickShelf& meshed,
                       const ShelfSurface& dense) {
  const std::uint64_t faces = in.params.faces.empty() ? 0 : in.params.faces[0];
  const EdgeLimit edges = in.edges_for(dense.frame());
  return counted_work(pieces, [&](const PieceMemory& memory) {
    if (in.params.mode == MeshMode::fit) return void(fine_fit(dense, faces, inset_target(kFitInset), edges, memory));
    SimplifyParams params = simplify_params(in.header, dense.frame(), in.params, memory, faces);
    params.edge_limit = edges;
    const EnclosedTriangles nothing({}, dense.frame());
    const CoarseStarts starts{meshed, in.header, in.make_shelf};
    LevelCounts ignored;
    (void)make_level(dense, in.is_by_faces(faces) ? &starts : nullptr, in.params.tighten ? &nothing : nullptr, params,
                     false, nullptr, ignored);
  });
}

}  // namespace

std::uint64_t least_limit(const LevelInputs& in, const PieceMemory& pieces, const Shelves& shelves,
                          std::uint64_t triangles) {
  if (in.params.cage || in.params.start != nullptr) return 0;
  std::unique_ptr<BrickShelf> within;
  if (in.inside()) within = repaired_within(*shelves.meshed, in.make_shelf, *in.make_shelf());
  const BrickShelf& meshed = within ? *within : *shelves.meshed;
  const ShelfSurface dense(meshed, in.header.frame);
  const SurfaceWork flat = counted_work(pieces, [&](const PieceMemory& memory) {
    SimplifyParams params;
    params.memory = memory;
    SimplifyCounts ignored;
    (void)simplified_surface(dense, params, {}, ignored);
  });
  const bool is_limited = in.params.error_world > 0 || in.params.volume_ratio > 0;
  const SurfaceWork work = is_limited ? flat : first_work(in, pieces, meshed, dense);
  std::uint64_t held = ground_bytes(shelves, in.params, triangles, flat.flat_faces);
  if (in.params.error_world > 0) held += ProxyLimits::most_bytes();
  held += in.edge_bytes(dense.frame(), in.near_of(*shelves.meshed));
  const std::uint64_t faces = in.inside() ? count_faces(dense) : 0;
  return std::max(pieces.without(held + faces * kBytesPerKeptFace).limit_for(work.whole_bytes, work.cell_bytes),
                  pieces.limit_for(faces * kBytesPerMeshedFace));
}

}  // namespace bp
