#pragma once
#include "io/mesh/mesh_writer.h"

/// One function per format behind write_mesh(), which has checked the mesh and found its positions exact.
namespace bp {

/// frame.world(v) - origin for each vertex, in order.
using WorldVertices = std::vector<Vec3d>;

/// Unit normal of each vertex, its faces weighted by their angle there; (0, 0, 1) where they cancel.
[[nodiscard]] std::vector<std::array<float, 3>> vertex_normals(const LatticeMesh& mesh);

/// Lines without line ends that say what made the mesh.
[[nodiscard]] std::vector<std::string> provenance_lines(const LatticeMesh& mesh, const MeshWriteOptions& options);

/// `p` - `origin`, which must be exact; throws bad_argument naming an origin that fits the frame.
[[nodiscard]] Vec3d moved_exactly(const GridFrame& frame, const Vec3d& p, const Vec3d& origin);

void write_gltf(const LatticeMesh& mesh, OutputFile& out, bool binary, const MeshWriteOptions& options);
void write_ply(const LatticeMesh& mesh, const WorldVertices& vertices, OutputFile& out,
               const MeshWriteOptions& options);
void write_obj(const LatticeMesh& mesh, const WorldVertices& vertices, OutputFile& out,
               const MeshWriteOptions& options);
void write_stl(const LatticeMesh& mesh, const WorldVertices& vertices, OutputFile& out);

}  // namespace bp
