#pragma once
#include <optional>
#include <string>

#include "io/files/file.h"
#include "io/mesh/mesh_writer.h"
#include "lib/mesh/lattice_mesh.h"

/// Levels of detail as OBJ with materials.
namespace bp {

/// Of a material, beside what its texture says: names of files beside it; empty: none.
struct MtlImages {
  std::string color, alpha, normal, roughness, metal, emission;
};

/// The level as viewers show it: normals, split at creases, places in the texture, and colours of vertices (three more
/// numbers of v, sRGB), if it has them. Positions are exact, as write_mesh() has them, and in the axes of the scene.
///   materials  name of a file with the material `name`; empty: none
void write_obj_level(const LatticeMesh& mesh, const std::string& name, const std::string& materials, OutputFile& out,
                     const MeshWriteOptions& options);

/// The text of that file: matte, where no image says else.
[[nodiscard]] std::string mtl_text(const std::string& name, const MeshTexture& texture, const MtlImages& images);

}  // namespace bp
