#pragma once
#include <optional>
#include <string>

#include "io/files/file.h"
#include "io/mesh/mesh_write_options.h"
#include "lib/mesh/lattice_mesh.h"

/// Writes meshes to files, without loss: read back, each vertex is exactly frame.world(v) - origin, or the write is
/// refused.
///   .glb .gltf  POSITION is in scene units, and the node has no transform, if float32 holds each vertex. If not,
///               the node has a translation, or, for meshes of very many voxels, a scale, too: exact in double
///               (detail/gltf_place.h). A frame that is not y-up is turned, in the positions (lib/core/up_axis.h);
///               asset.extras.up tells which axis was up.
///   .ply        binary little endian, doubles
///   .obj        decimals that read back to the same double
///   .stl        binary, float32: only if each coordinate is a float
/// .obj and .ply hold the quads of mesh.quads as quads, after the other triangles; the other formats hold triangles.
namespace bp {

/// Returns the format of an extension without its dot, case ignored; nothing for any other.
[[nodiscard]] std::optional<MeshFormat> mesh_format_named(const std::string& extension);
/// Returns the format of a file name's extension. Throws bad_argument for any other.
[[nodiscard]] MeshFormat mesh_format_of(const std::string& path);

/// Throws bad_argument, with an origin that fits, if subtracting `origin` from lattice points of `box` would round. To
/// be called before there is a mesh.
void check_origin(const GridFrame& frame, const VoxelBox& box, const Vec3d& origin);

/// Writes `mesh`; the caller commits `out`. Same mesh, same bytes.
/// Throws bad_argument if the mesh has no triangle, or if the format cannot hold its coordinates exactly; the message
/// names another format or a fitting origin. Nothing is written then.
void write_mesh(const LatticeMesh& mesh, OutputFile& out, MeshFormat format, const MeshWriteOptions& options = {});

}  // namespace bp
