#pragma once
#include "lib/enclosed/enclosed.h"
#include "lib/mesh/lattice_mesh.h"

namespace bp {

/// Returns a convex mesh around `enclosed` that is better than `proxy`: the convex hull, a hull with at most `faces`
/// faces, or the box. Returns no triangles if none is better, or if the proxy has more than `faces` faces, since its
/// parts and handles need them then. A convex mesh must have at most `faces` faces. It is better in one of two cases,
/// where volumes are measured bare and with a skin of 0.3 voxels:
///   - It holds at most 0.97 of the proxy's volume with the skin; and it holds less bare volume, or its box is 5 %
///     shorter.
///   - It holds less of both volumes with fewer faces.
/// Hulls of more than 512 faces are left out; proxies longer than 32,768 voxels are never replaced. Cost: a hull of
/// some 512 points if it already holds more than the proxy; else a hull of everything, and about 50 ms to reduce its
/// faces.
[[nodiscard]] LatticeMesh convex_proxy(const Enclosed& enclosed, const LatticeMesh& proxy, std::uint64_t faces);

}  // namespace bp
