// Convex hulls of a proxy.
#include "lib/hulls/convex_parts.h"
#include "tools/api/call.h"
#include "tools/api/include/bp/bp_experimental.h"
#include "tools/api/mesh.h"
#include "tools/api/structs.h"

namespace bp::api {

namespace {

HullLimits limits_of(const bp_hulls_options& o) {
  constexpr std::uint32_t kFewestCorners = 8;
  constexpr std::uint64_t kFewestHullFaces = 4;
  HullLimits limits;
  limits.hulls = o.hulls;
  if (o.faces != 0 && o.faces < kFewestHullFaces)
    fail(ErrorCode::bad_argument, "faces: {} are fewer than the {} of one hull", o.faces, kFewestHullFaces);
  limits.faces = o.faces;
  if (o.corners == 0) return limits;
  if (o.corners < kFewestCorners || o.corners > kMostCorners)
    fail(ErrorCode::bad_argument, "corners: {} is not between {} and {}", o.corners, kFewestCorners, kMostCorners);
  limits.corners = o.corners;
  return limits;
}

Meshes hulls(const Mesh& mesh, const bp_hulls_options* given, Call& call) {
  const HullLimits limits = limits_of(take_struct(given, bp_hulls_options{}, "bp_hulls_options"));
  if (!mesh.lattice) fail(ErrorCode::bad_argument, "the mesh was loaded; hulls are of meshes that libbp makes");
  call.begin("hulls");
  Meshes out;
  for (LatticeMesh& hull : convex_parts(*mesh.lattice, limits).hulls) {
    const double volume = volume_of({{hull}, 1, false, false});
    out.push_back(mesh_of(std::move(hull)));
    out.back().write.contract = Contract::convex_part;
    out.back().info.volume = volume;
  }
  return out;
}

}  // namespace

}  // namespace bp::api

using namespace bp::api;

extern "C" {

void bp_hulls_defaults(bp_hulls_options* options, size_t size) {
  put_defaults(options, size, bp_hulls_options{});
}

bp_status bp_hulls(const bp_mesh* mesh, size_t index, const bp_hulls_options* options, const bp_run* run,
                   bp_mesh** out) {
  return guarded_result(run, out, [&](Call& call) { return bp_mesh{hulls(mesh_at(mesh, index), options, call), {}}; });
}

}  // extern "C"
