#pragma once
#include "io/files/file.h"
#include "io/mesh/mesh_write_options.h"
#include "lib/mesh/lattice_mesh.h"

/// The writers behind write_mesh(), one for each format. write_mesh() has checked the mesh and found its positions
/// exact.
namespace bp {

/// frame.world(v) - origin for each vertex, in order.
using WorldVertices = std::vector<Vec3d>;

/// Returns the unit normal of each vertex: the mean of its faces' normals, weighted by their angles there; (0, 0, 1) if
/// they cancel.
[[nodiscard]] std::vector<std::array<float, 3>> vertex_normals(const LatticeMesh& mesh);

/// Returns lines, without line ends, that tell how the mesh was made.
[[nodiscard]] std::vector<std::string> provenance_lines(const LatticeMesh& mesh, const MeshWriteOptions& options);

/// Returns `p` - `origin`, which must be exact; throws bad_argument, with an origin that fits the frame.
[[nodiscard]] Vec3d moved_exactly(const GridFrame& frame, const Vec3d& p, const Vec3d& origin);

void write_gltf(const LatticeMesh& mesh, OutputFile& out, bool binary, const MeshWriteOptions& options);
void write_ply(const LatticeMesh& mesh, const WorldVertices& vertices, OutputFile& out,
               const MeshWriteOptions& options);
void write_obj(const LatticeMesh& mesh, const WorldVertices& vertices, OutputFile& out,
               const MeshWriteOptions& options);
void write_stl(const LatticeMesh& mesh, const WorldVertices& vertices, OutputFile& out);

}  // namespace bp
