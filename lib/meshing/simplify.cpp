#include "lib/meshing/simplify.h"

#include "lib/meshing/collapse_order.h"
#include "lib/meshing/shells.h"
#include "lib/meshing/surface_tree.h"

namespace bp {

std::string to_string(StopReason reason) {
  switch (reason) {
    case StopReason::faces:
      return "faces";
    case StopReason::error:
      return "error";
    case StopReason::limits:
      return "limits";
    case StopReason::edge_length:
      return "edge-length";
    case StopReason::nothing_left:
      return "no collapse left that keeps the guarantee";
  }
  return "";
}

void SimplifyCounts::add(const SimplifyCounts& next) {
  const SimplifyCounts before = *this;
  *this = next;
  faces_in = before.faces_in;
  faces_flat = before.faces_flat;
  collapses += before.collapses;
  solved += before.solved;
}

LatticeMesh simplify(const LatticeMesh& dense, const SimplifyParams& params, SimplifyCounts& counts) {
  counts = {};
  counts.faces_in = dense.triangles.size();
  if (dense.triangles.empty()) return dense;
  const bool by_cells = params.dense && params.limits == nullptr;  // limits are of the whole, step by step
  Piece whole = by_cells ? simplified_surface(dense, params, kBulkFactor * params.faces, counts)
                         : Piece{kEverywhere, dense.vertices, dense.triangles, {}};
  HalfEdgeMesh mesh(std::move(whole.vertices), whole.triangles, kEverywhere);
  whole.triangles = {};
  // Where quadrics are given, edges have been collapsed, and faces are no longer axis-aligned.
  if (params.dense && whole.quadrics.empty()) merge_flat_regions(mesh, params.edge_limit);
  if (!by_cells) counts.faces_flat = mesh.face_count();
  Collapser collapser(mesh, std::move(whole.quadrics), params, counts);
  if (params.faces > 0 && params.dense) collapse_bulk(collapser, {kFirstBound, kLastBound}, kBulkFactor * params.faces);
  counts.stop = collapse_strict(collapser, counts);
  if (!params.free) erase_inner_shells(mesh);
  counts.faces_out = mesh.face_count();
  LatticeMesh out = mesh.compact(dense.frame);
  out.provenance = dense.provenance;
  return out;
}

}  // namespace bp
