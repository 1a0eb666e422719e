#include "lib/simplify/simplify.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "lib/mesh/shells.h"
#include "lib/mesh/step_limits.h"
#include "lib/simplify/collapse_regions.h"
#include "lib/simplify/detail/bulk_order.h"
#include "lib/simplify/detail/collapse_order.h"
#include "lib/simplify/flatten.h"
#include "lib/simplify/surface_tree.h"

namespace bp {

namespace {

/// Without a wanted number of faces, sweeps take collapses up to the cost of the allowed distance over a square of that
/// edge.
BulkEnd end_of_bulk(const SimplifyParams& params) {
  if (params.faces == 0) return {0, params.limits != nullptr ? std::pow(params.limits->error_lattice(), 4) : 0};
  return {params.strict_from > 0 ? std::max(params.strict_from, params.faces) : kBulkFactor * params.faces, kLastBound};
}

LatticeMesh finished(HalfEdgeMesh& mesh, const GridFrame& frame, bool inwards, const ShellSense* sense,
                     SimplifyCounts& counts) {
  erase_inner_shells(mesh, inwards, sense);
  counts.faces_out = mesh.face_count();
  return mesh.compact(frame);
}

void collapse_strict(Collapser& collapser, SimplifyCounts& counts) {
  StrictOrder order(collapser);
  const bool enough = order.run(std::numeric_limits<double>::infinity(), collapser.params().faces);
  order.count(counts);
  counts.stop = enough ? StopReason::faces : counts.reason_left();
  if (counts.stop == StopReason::limits) counts.limit = collapser.params().limits->last_refusal();
}

/// Simplifies the rest: collapses that regions left are tried on the whole.
LatticeMesh simplify_regions(Piece whole, const GridFrame& frame, const SimplifyParams& params,
                             SimplifyCounts& counts) {
  const bool inwards = volume6_of(whole.vertices, whole.triangles) < 0;
  if (has_regions(whole.triangles.size(), params)) collapse_in_regions(whole, params, counts);
  HalfEdgeMesh mesh(std::move(whole.vertices), whole.triangles, kEverywhere);
  counts.stop = StopReason::faces;
  if (mesh.face_count() <= params.faces) return finished(mesh, frame, inwards, nullptr, counts);
  Collapser collapser(mesh, std::move(whole.quadrics), params, counts);
  collapse_strict(collapser, counts);
  return finished(mesh, frame, inwards, collapser.sense(), counts);
}

Piece piece_of(const Collapser& collapser) {
  Piece piece;
  piece.triangles = collapser.mesh().live_faces([&](VertexId v, VertexId) {
    piece.vertices.push_back(collapser.mesh().position(v));
    piece.quadrics.push_back(collapser.quadric(v));
  });
  return piece;
}

/// Simplifies a surface, with quadrics or not, to the end; or, if it is large enough, until regions begin, and returns
/// what is left then.
std::variant<LatticeMesh, Piece> simplify_mesh(Piece whole, const GridFrame& frame, const SimplifyParams& params,
                                               SimplifyCounts& counts) {
  HalfEdgeMesh mesh(std::move(whole.vertices), whole.triangles, kEverywhere);
  const bool inwards = faces_inwards(mesh);
  if (params.limits != nullptr) params.limits->begin(mesh.volume6());
  whole.triangles = {};
  // Where quadrics are given, edges have been collapsed, and faces are no longer axis-aligned.
  if (params.dense && whole.quadrics.empty()) merge_flat_regions(mesh, params.edge_limit);
  if (counts.faces_flat == 0) counts.faces_flat = mesh.face_count();
  Collapser collapser(mesh, std::move(whole.quadrics), params, counts);
  const BulkEnd end = end_of_bulk(params);
  if (params.dense && end.cost > 0) collapse_bulk(collapser, {kFirstBound, end.cost}, end.faces);
  if (params.faces > 0 && has_regions(mesh.face_count(), params)) {
    if (collapser.sense() != nullptr) erase_turned_shells(mesh, *collapser.sense());
    return piece_of(collapser);
  }
  collapse_strict(collapser, counts);
  return finished(mesh, frame, inwards, collapser.sense(), counts);
}

/// Simplifies a whole surface, with quadrics or not, to the end.
LatticeMesh simplify_whole(Piece whole, const GridFrame& frame, const SimplifyParams& params, SimplifyCounts& counts) {
  const auto has_bulk = [&] {
    return params.dense && has_bulk_regions(whole.triangles.size(), end_of_bulk(params), params);
  };
  // Bricks have merged their flat regions; this merges regions across their sides.
  if (whole.quadrics.empty() && has_bulk()) merge_flat_regions(whole, params.edge_limit);
  if (has_bulk()) {
    if (counts.faces_flat == 0) counts.faces_flat = whole.triangles.size();
    collapse_bulk_in_regions(whole, end_of_bulk(params), params, counts);
  } else if (params.dense || params.faces == 0 || !has_regions(whole.triangles.size(), params)) {
    auto result = simplify_mesh(std::move(whole), frame, params, counts);
    if (auto* mesh = std::get_if<LatticeMesh>(&result)) return std::move(*mesh);
    whole = std::get<Piece>(std::move(result));
  }
  return simplify_regions(std::move(whole), frame, params, counts);
}

}  // namespace

LatticeMesh simplify(const SurfaceSource& dense, const SimplifyParams& params, SimplifyCounts& counts) {
  constexpr std::uint64_t kFew = std::uint64_t(1)
                                 // Faces of a surface that is simplified as a whole at once, without locked vertices
                                 // along sides of bricks.
                                 << 18;
  counts = {};
  const std::uint64_t faces = params.limits != nullptr ? count_faces(dense) : 0;
  if (faces > 0 && faces <= kFew && !params.memory.count) {
    Piece whole = whole_piece(dense);
    counts.faces_in = whole.triangles.size();
    return simplify_whole(std::move(whole), dense.frame(), params, counts);
  }
  const bool bulk = params.limits == nullptr || params.limits->has_parts();
  Piece whole = simplified_surface(dense, params, bulk ? end_of_bulk(params) : BulkEnd{}, counts);
  if (whole.triangles.empty()) {
    LatticeMesh none;
    none.frame = dense.frame();
    return none;
  }
  return simplify_whole(std::move(whole), dense.frame(), params, counts);
}

LatticeMesh simplify(const LatticeMesh& mesh, const SimplifyParams& params, SimplifyCounts& counts) {
  if (!params.dense || mesh.triangles.empty()) return simplify(mesh, {}, params, counts);
  LatticeMesh out = simplify(MeshSurface(mesh), params, counts);
  out.provenance = mesh.provenance;
  return out;
}

LatticeMesh simplify(const LatticeMesh& mesh, const std::vector<Quadric>& quadrics, const SimplifyParams& params,
                     SimplifyCounts& counts) {
  counts = {};
  if (mesh.triangles.empty()) return mesh;
  counts.faces_in = counts.faces_flat = mesh.triangles.size();
  LatticeMesh out = simplify_whole({kEverywhere, mesh.vertices, mesh.triangles, quadrics}, mesh.frame, params, counts);
  out.provenance = mesh.provenance;
  return out;
}

}  // namespace bp
