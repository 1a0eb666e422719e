// Computes from the solid how much memory the steps of a chain of levels take.
#include <algorithm>

#include "lib/grid/shelf_stream.h"
#include "lib/levels/detail/level_search.h"
#include "lib/pass/mesh/mesh_pass.h"
#include "lib/volume/topology.h"

namespace bp {

std::uint64_t chain_limit(const StreamHeader& header, BrickShelf& solid, const LodOptions& options,
                          const PassContext& context, std::uint64_t triangles) {
  if (!options.first) return 0;
  const bool has_triangles = triangles > 0 && (options.mode == MeshMode::fit || options.enclose == Enclose::scene);
  const std::uint64_t held = has_triangles ? triangles * sizeof(TriangleD) : 0;
  const RulerBytes ruler =
      Ruler::bytes_needed({solid, options.surface.get(), nullptr, header.frame, options.mode}, has_triangles);
  MeshParams params = params_of_level(options, *options.first, has_triangles);
  if (params.mode == MeshMode::bounding) params.near_world = 0;
  PassContext beside = context;
  beside.pieces = context.pieces.without(held + ruler.kept);
  ShelfSource source(header, solid, nullptr, ShelfSource::Keep::all);
  return std::max({context.memory.limit_for(held + ruler.needed), beside.pieces.limit_for(topology_bytes(solid)),
                   mesh_limit(source, beside, params, triangles)});
}

}  // namespace bp
