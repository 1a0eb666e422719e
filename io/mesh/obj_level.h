#pragma once
#include <optional>
#include <string>

#include "io/files/file.h"
#include "io/mesh/mesh_writer.h"
#include "lib/mesh/lattice_mesh.h"

/// Levels of detail as OBJ with materials.
namespace bp {

/// Names of image files in the folder of a material, one for each property; empty: none.
struct MtlImages {
  std::string color, alpha, normal, roughness, metal, emission;
};

/// Writes a level as viewers show it: normals, split at creases, texture coordinates, and colours of vertices (three
/// more numbers of v, sRGB), if it has them. Positions are exact, as in write_mesh(), and in the axes of the scene.
///   materials  name of a file with the material `name`; empty: none
void write_obj_level(const LatticeMesh& mesh, const std::string& name, const std::string& materials, OutputFile& out,
                     const MeshWriteOptions& options);

/// Returns the text of that file: a matte material, except for properties with an image.
[[nodiscard]] std::string mtl_text(const std::string& name, const MeshTexture& texture, const MtlImages& images);

}  // namespace bp
