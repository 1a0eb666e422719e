#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "lib/core/memory_share.h"

/// How a scene is read.
namespace bp {

struct PartNames;
class SceneMap;
struct ScenePose;
class TextureTable;

/// Limit for meshes that are read as a whole.
struct MeshLimit {
  MemoryShare memory{0};  ///< 0: no limit
  std::uint64_t per_triangle = 0, per_vertex = 0;
  /// The use named in the error if it takes more; all levels so far count together.
  const char* purpose = "reading";

  [[nodiscard]] std::uint64_t needed(std::uint64_t triangles, std::uint64_t vertices) const {
    return triangles * per_triangle + vertices * per_vertex;
  }
};

struct SceneOptions {
  /// Format of "-", or of a file whose name does not tell: ply stl obj off gltf glb, or one of Assimp's.
  std::string format;
  std::uint64_t memory_bytes = std::uint64_t(256) << 20;  ///< for vertices; others go to a scratch file
  std::string temp_dir;                                   ///< for scratch files; empty: $TMPDIR, else /tmp
  bool colors = false;                                    ///< colours are read; else all triangles are white
  std::shared_ptr<TextureTable> textures{};               ///< images are read, and noted here; null: none
  bool surface = false;                     ///< with textures: normals, and how materials respond to light, are read
  bool details = false;                     ///< with `surface`: names, sidedness and second places are read, too
  std::shared_ptr<const ScenePose> pose{};  ///< glTF only; null: as the file shows it
  std::size_t level = 0;                    ///< level of glTF's MSFT_lod; 0 is the finest
  /// Delivers triangles without area, too: segments and points, which are no part of a surface but have a place. Code
  /// that encloses a scene, or checks that, asks for them.
  bool keep_degenerate = false;
  /// Cuts every polygon into its fan, whatever its shape: a cage that moves keeps its triangles.
  bool fans = false;
  bool walls_only = false;  ///< transparent triangles are left out (scene_reader.h); not counted
  /// Coordinates below the range of the exact predicates stay as they are: for proofs, which must not move a vertex.
  bool keep_extremes = false;
  /// Memory for the description of a scene while it is opened: the JSON of glTF, or an importer's process and its
  /// answer. 0: no limit.
  MemoryShare document{0};
  MeshLimit mesh{};
  /// Delivers only parts whose name fits (* and ? as in file names); empty: all. Names of OBJ: o, g, usemtl; of glTF:
  /// nodes, with all below them, meshes, materials. Other formats are refused.
  std::string parts{};
  std::shared_ptr<PartNames> part_names{};  ///< gets the names that it asks for; null: none
  std::shared_ptr<const SceneMap> map{};    ///< moves the scene while open_scene() reads it; null: nothing moves
};

}  // namespace bp
