#include "lib/pass/mesh/detail/make_level.h"

#include <algorithm>

#include "lib/pass/mesh/detail/convex_proxy.h"
#include "lib/tighten/few_faces.h"

namespace bp {

namespace {

/// Uses the room below the limits that tightening has made: collapses and tightens in turn, as long as a round leaves
/// clearly fewer faces.
LatticeMesh use_room(LatticeMesh proxy, const Enclosed& enclosed, SimplifyParams params, LevelCounts& counts) {
  constexpr int kRounds = 8;
  params.dense = false;
  params.enclosed = &enclosed;
  TightenParams tightening;
  static_cast<ShapeLimits&>(tightening) = params;
  for (int round = 0; round < kRounds && counts.simplify.stop == StopReason::limits; ++round) {
    const std::size_t before = proxy.triangles.size();
    SimplifyCounts more;
    proxy = simplify(proxy, params, more);
    counts.simplify.add(more);
    if (double(proxy.triangles.size()) > kClearlyLess * double(before)) break;
    proxy = tighten(proxy, enclosed, tightening, counts.tighten);
  }
  return proxy;
}

}  // namespace

SimplifyParams simplify_params(const StreamHeader& header, const GridFrame& frame, const MeshParams& params,
                               const PieceMemory& memory, std::uint64_t faces) {
  SimplifyParams out;
  out.memory = memory;
  // A mesh indexes fewer; the limit keeps products exact.
  out.faces = std::min<std::uint64_t>(faces, std::uint64_t(1) << 32);
  if (faces == 0 && params.error_world == 0 && params.volume_ratio == 0) {
    const bool cube = header.has_closing && header.element == StructuringElement::cube;
    const double share = cube ? MeshParams::kErrorShareCube : MeshParams::kErrorShareBall;
    out.error_vox = header.bounds.diagonal() * share / frame.voxel;
  }
  return out;
}

LatticeMesh take(TightProxy&& proxy, LevelCounts& counts) {
  counts.simplify = std::move(proxy.simplified);
  counts.tighten = proxy.tightened;
  return std::move(proxy.mesh);
}

LatticeMesh make_level(const SurfaceSource& dense, const CoarseStarts* starts, const Enclosed* enclosed,
                       const SimplifyParams& params, bool few, LatticeMesh* halfway, LevelCounts& counts) {
  if (enclosed == nullptr) return simplify(dense, params, counts.simplify);
  if (few) return take(tight_proxy_of_few(dense, *enclosed, params), counts);
  CoarseStart start;
  if (starts != nullptr) start = starts->first(params.faces);
  const SurfaceSource& from = start.surface ? *start.surface : dense;
  LatticeMesh proxy = take(tight_proxy(from, dense.frame(), *enclosed, params, halfway), counts);
  return params.limits == nullptr ? proxy : use_room(std::move(proxy), *enclosed, params, counts);
}

void take_convex(LatticeMesh& proxy, const Enclosed& enclosed, std::uint64_t faces, LevelCounts& counts) {
  LatticeMesh convex = convex_proxy(enclosed, proxy, faces);
  if (convex.triangles.empty()) return;
  proxy = std::move(convex);
  counts.simplify.faces_out = proxy.triangles.size();
  counts.simplify.stop = proxy.triangles.size() < faces ? StopReason::least_volume : StopReason::faces;
}

}  // namespace bp
