#include "lib/pass/mesh/scale_search.h"

#include "lib/pass/close/close_pass.h"
#include "lib/pass/mesh/detail/coarse_start.h"
#include "lib/simplify/simplify.h"
#include "lib/surface/repair.h"
#include "lib/volume/topology.h"

namespace bp {

namespace {

constexpr int kMostTimes = 64;
constexpr std::uint64_t kFacesOfTetrahedron = 4;  // the least of a part; a handle adds as many

StreamHeader closed_at(const StreamHeader& header, double scale) {
  StreamHeader closed = header;
  closed.scale = {};
  closed.has_field = false;
  closed.scale.base = scale;
  closed.bricks = closing_bricks(header, closed.scale);
  return closed;
}

std::unique_ptr<BrickShelf> closing_of(const StreamHeader& closed, BrickShelf& solid, Backends& backends,
                                       const ScaleSearch& search) {
  CloseOptions options;
  options.keep_cavities = search.keep_cavities;
  options.context = search.context;
  StreamHeader input = closed;
  input.has_closing = false;
  return close_shelf(input, solid, backends, closed.scale, {closed.element}, options);
}

/// False if parts and handles alone take more faces, whatever is merged.
bool may_have(const BrickShelf& closing, const ScaleSearch& search) {
  if (topology_bytes(closing) > search.context.pieces.bytes()) return true;  // not known
  const SolidTopology topology = topology_of(closing);
  return (topology.parts + topology.handles) * kFacesOfTetrahedron <= search.faces;
}

/// By growing alone, and from larger voxels as meshing does: what that gets to, tightening gets to as well.
bool has_faces(const StreamHeader& closed, const BrickShelf& closing, const ScaleSearch& search) {
  const CoarseStarts starts{closing, closed, search.context.make_shelf};
  const CoarseStart coarse = starts.first(search.faces);
  const ShelfSurface dense(closing, closed.frame);
  SimplifyParams params;
  params.faces = search.faces;
  params.memory = search.context.pieces;
  SimplifyCounts counts;
  const SurfaceSource& surface = coarse.surface ? *coarse.surface : static_cast<const SurfaceSource&>(dense);
  return simplify(surface, params, counts).triangles.size() <= search.faces;
}

}  // namespace

std::optional<int> enough_scales(const StreamHeader& header, BrickShelf& solid, Backends& backends,
                                 const ScaleSearch& search) {
  std::uint64_t tried = 0;
  for (int times = 2; times <= kMostTimes && times * header.scale.base <= header.bounds.diagonal() / 2; times *= 2) {
    const StreamHeader closed = closed_at(header, times * header.scale.base);
    const std::unique_ptr<BrickShelf> closing = closing_of(closed, solid, backends, search);
    if (search.context.progress) search.context.progress("mesh", "scales", tried++, 0);
    repair_contacts(*closing);  // as meshing does: it closes the tiniest holes
    if (may_have(*closing, search) && has_faces(closed, *closing, search)) return times;
  }
  return std::nullopt;
}

}  // namespace bp
