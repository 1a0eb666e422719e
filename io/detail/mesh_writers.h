#pragma once
#include "io/mesh_writer.h"

/// One function per format behind write_mesh(), which has checked the mesh and found its positions exact.
namespace bp {

/// frame.world(v) - origin for each vertex, in order.
using WorldVertices = std::vector<Vec3d>;

/// Lines without line ends that say what made the mesh.
[[nodiscard]] std::vector<std::string> provenance_lines(const LatticeMesh& mesh, const MeshWriteOptions& options);

void write_gltf(const LatticeMesh& mesh, OutputFile& out, bool binary, const MeshWriteOptions& options);
void write_ply(const LatticeMesh& mesh, const WorldVertices& vertices, OutputFile& out,
               const MeshWriteOptions& options);
void write_obj(const LatticeMesh& mesh, const WorldVertices& vertices, OutputFile& out,
               const MeshWriteOptions& options);
void write_stl(const LatticeMesh& mesh, const WorldVertices& vertices, OutputFile& out);

}  // namespace bp
