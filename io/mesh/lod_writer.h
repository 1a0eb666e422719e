#pragma once
#include <span>
#include <string>

#include "io/files/file.h"
#include "io/mesh/compression.h"
#include "io/mesh/contract.h"
#include "io/mesh/leaf_looks.h"
#include "io/mesh/mesh_writer.h"
#include "lib/mesh/lattice_mesh.h"
#include "lib/pass/leaf/scene_leaf.h"

/// Levels of detail as GLB, without loss: a reader that works in double finds frame.world(v) exactly, in scene units,
/// and mostly without a transform of the node (mesh_writer.h). Same meshes, same bytes; the caller commits. Vertices
/// have normals and are split at creases (shaded_mesh.h), and there is one matte material, so that viewers show the
/// form at once. The colours of a mesh become COLOR_0: 8 bits a channel, normalized, linear light as glTF wants it. The
/// options' origin is subtracted from every vertex and noted in asset.extras.origin; normals are always written. All
/// functions throw bad_argument if a mesh has no triangle or spans more than float32 holds exactly (at least 2^19
/// voxels), or if a difference to the origin is no exact double.
namespace bp {

struct NamedMesh {
  std::string name;  ///< name of its node and mesh
  const LatticeMesh* mesh = nullptr;
  const SceneLeaf* scene = nullptr;  ///< shown in place of the mesh: triangles of the scene, rounded to float32
};

/// Writes all levels, finest first, to one file. The node of the finest level is the only one of the scene; it has
/// MSFT_lod (Microsoft, glTF extension registry) with the others and their screen coverages. Readers without that
/// extension show the finest level, if they read only the nodes of the scene (Blender imports every node).
///   coverage  one for each level: the least share of the screen's area, covered by the level's bounding sphere, at
///             which it is drawn; falling
///   looks     images of the levels that are triangles of the scene, and the storage of all levels. Compressed,
///             positions are the same float32, normals are octahedral with 8 bits, and places in baked images have 16.
void write_lod_glb(std::span<const NamedMesh> levels, std::span<const double> coverage, OutputFile& out,
                   const MeshWriteOptions& options = {}, const LeafLooks& looks = {});

/// Writes all meshes as nodes of one scene.
void write_parts_glb(std::span<const NamedMesh> parts, OutputFile& out, const MeshWriteOptions& options = {});

/// Returns the content of a tile, as the bytes of a GLB. Compressed, positions are 16-bit integers if these hold the
/// mesh, else float32, and normals are octahedral, 8 bits. The node has a scale and no offset: vertices are relative to
/// `origin` (asset.extras.tile_origin), which the tile's transform adds again, in double. A z-up mesh is turned to
/// glTF's y up, which 3D Tiles turns back; unlike in other files of this suite, extras.up does not ask a reader to.
/// `contract`: what the file claims.
[[nodiscard]] std::string tile_glb(const NamedMesh& tile, LatticeCoord origin,
                                   Compression compression = Compression::meshopt, Contract contract = Contract::tile);

/// Returns the lattice point of `frame` that lies at `p`. Throws `failed` if there is none.
[[nodiscard]] LatticeCoord lattice_point(const GridFrame& frame, const Vec3d& p);

/// Returns the share of a 1920 x 1080 screen that a sphere covers when a length of `error` in it spans one pixel;
/// `diameter`: the sphere's. At most 1.
[[nodiscard]] double coverage_at_one_pixel(double diameter, double error);

}  // namespace bp
