#pragma once
#include <string>
#include <vector>

#include "lib/core/indexed_mesh.h"
#include "lib/live/live_closing.h"

/// Geometry as bytes for the page (page/src/wire.ts reads them). Numbers are little-endian and aligned to four bytes.
namespace bp {

/// Returns the pieces of the closing's surface: generation (u32), number of pieces (u32); for each piece its brick (3
/// i32), vertices (u32), triangles (u32), vertices of 12 bytes, corners (u32).
[[nodiscard]] std::string surface_bytes(const std::vector<LiveClosing::Piece>& pieces, std::uint64_t generation);

/// Returns a mesh: vertices (u32), triangles (u32), positions less `middle` (3 f32 each), corners (u32). Triangles with
/// a corner that names no vertex are left out.
[[nodiscard]] std::string mesh_bytes(const IndexedMesh& mesh, const Vec3d& middle);

/// Returns a scene's triangles, each with corners of its own: vertices (u32), triangles (u32: 0), positions less
/// `middle` (3 f32 each), normals (4 i8 each, the last is 0). Normals are smooth across edges that are bent by less
/// than 40 degrees.
[[nodiscard]] std::string scene_bytes(const std::vector<TriangleD>& triangles, const Vec3d& middle);

}  // namespace bp
