#pragma once
#include "lib/enclosed/enclosed.h"
#include "lib/mesh/lattice_mesh.h"

namespace bp {

/// The convex hull of `enclosed` as it is, or with at most `faces` faces, or its box: if that is better than `proxy`,
/// which it lies around. No triangles otherwise, or if the proxy has more than `faces`: its parts and handles take
/// them. Volumes are bare, and in a skin of 0.3 voxels. It is better if it has at most `faces` faces and
///   holds at most 0.97 of the proxy's volume in the skin, and less of the bare one, or its box is 5 % shorter;
///   or it holds less of both with fewer faces.
/// Hulls of more than 512 faces are left out, and proxies longer than 32,768 voxels keep their place. Cost: a hull of
/// some 512 points where it holds more than the proxy; else of all, and some 50 ms for fewer faces.
[[nodiscard]] LatticeMesh convex_proxy(const Enclosed& enclosed, const LatticeMesh& proxy, std::uint64_t faces);

}  // namespace bp
