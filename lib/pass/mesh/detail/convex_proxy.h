#pragma once
#include "lib/enclosed/enclosed.h"
#include "lib/mesh/lattice_mesh.h"

namespace bp {

/// The convex hull of `enclosed` as it is, or with at most `faces` faces, or its box: if that is better than `proxy`,
/// which it lies around. No triangles otherwise. Volumes are in a skin of 0.3 voxels. It is better if it has at most
/// `faces` faces and
///   holds at most 0.97 of the proxy's volume,
///   or less than it with fewer faces, without the skin, too,
///   or, if the proxy has more than `faces`, at most 1.1 of its volume.
/// Hulls of more than 512 faces are left out, and proxies longer than 32,768 voxels keep their place. Cost: a hull of
/// some 512 points where it holds more than the proxy; else of all, and some 50 ms for fewer faces.
[[nodiscard]] LatticeMesh convex_proxy(const Enclosed& enclosed, const LatticeMesh& proxy, std::uint64_t faces);

}  // namespace bp
