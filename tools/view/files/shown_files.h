#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "io/scene/scene_options.h"
#include "tools/run/mesh_extras.h"
#include "tools/view/geometry/shown_mesh.h"

/// Files that --show names: what the suite made of a scene, to be looked at beside it.
namespace bp {

struct ShownFile {
  enum class Kind { mesh, tileset, voxels };
  std::string path;
  std::string name;  ///< file name, with its folder where --show names the folder
  Kind kind = Kind::mesh;
  std::size_t levels = 1;
  /// Statements of the file about itself: of a mesh provenance, contract and origin; of others only the provenance.
  MeshExtras extras;
};

/// Returns the files, in order. A folder stands for its tileset, or else for all meshes and streams in it, by name.
/// Throws bad_input if a path is missing, or a folder has neither.
[[nodiscard]] std::vector<ShownFile> shown_files(const std::vector<std::string>& paths);

/// Returns a level as the page draws it; 0 is the finest. Voxels are smooth as the page's closing is. `middle` is
/// subtracted from positions; the origin that a file names is added. Throws bad_argument if there is no such level,
/// out_of_resource if it has more triangles than `most`.
[[nodiscard]] ShownMesh read_level(const ShownFile& file, std::size_t level, const Vec3d& middle, std::uint64_t most,
                                   const SceneOptions& options);

}  // namespace bp
