#include "lib/meshing/simplify.h"

#include <algorithm>

#include "lib/meshing/collapse_order.h"
#include "lib/meshing/flatten.h"
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

namespace {

std::uint64_t end_of_bulk(const SimplifyParams& params) {
  return params.strict_from > 0 ? std::max(params.strict_from, params.faces) : kBulkFactor * params.faces;
}

/// All of the surface, with quadrics or not, to the end.
LatticeMesh simplify_whole(Piece whole, const GridFrame& frame, const SimplifyParams& params, SimplifyCounts& counts) {
  HalfEdgeMesh mesh(std::move(whole.vertices), whole.triangles, kEverywhere);
  const bool inwards = faces_inwards(mesh);
  if (params.limits != nullptr) params.limits->begin(mesh.volume6());
  whole.triangles = {};
  // Where quadrics are given, edges have been collapsed, and faces are no longer axis-aligned.
  if (params.dense && whole.quadrics.empty()) merge_flat_regions(mesh, params.edge_limit);
  if (counts.faces_flat == 0) counts.faces_flat = mesh.face_count();
  Collapser collapser(mesh, std::move(whole.quadrics), params, counts);
  if (params.faces > 0 && params.dense) collapse_bulk(collapser, {kFirstBound, kLastBound}, end_of_bulk(params));
  counts.stop = collapse_strict(collapser, counts);
  if (counts.stop == StopReason::limits) counts.limit = params.limits->last_refusal();
  erase_inner_shells(mesh, inwards, collapser.sense());
  counts.faces_out = mesh.face_count();
  return mesh.compact(frame);
}

}  // namespace

LatticeMesh simplify(const SurfaceSource& dense, const SimplifyParams& params, SimplifyCounts& counts) {
  constexpr std::uint64_t kFew = std::uint64_t(1)
                                 << 18;  // as a whole at once: no vertex along a brick's side is locked
  counts = {};
  const std::uint64_t faces = params.limits != nullptr ? count_faces(dense) : 0;
  if (faces > 0 && faces <= kFew) {
    Piece whole = whole_piece(dense);
    counts.faces_in = whole.triangles.size();
    return simplify_whole(std::move(whole), dense.frame(), params, counts);
  }
  const bool bulk = params.limits == nullptr;  // limits are of the whole, step by step
  Piece whole = simplified_surface(dense, params, bulk ? end_of_bulk(params) : 0, counts);
  if (whole.triangles.empty()) {
    LatticeMesh none;
    none.frame = dense.frame();
    return none;
  }
  return simplify_whole(std::move(whole), dense.frame(), params, counts);
}

LatticeMesh simplify(const LatticeMesh& mesh, const SimplifyParams& params, SimplifyCounts& counts) {
  counts = {};
  if (mesh.triangles.empty()) return mesh;
  LatticeMesh out;
  if (params.dense) {
    out = simplify(MeshSurface(mesh), params, counts);
  } else {
    counts.faces_in = counts.faces_flat = mesh.triangles.size();
    out = simplify_whole({kEverywhere, mesh.vertices, mesh.triangles, {}}, mesh.frame, params, counts);
  }
  out.provenance = mesh.provenance;
  return out;
}

}  // namespace bp
