#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lib/core/indexed_mesh.h"
#include "lib/core/memory_share.h"
#include "lib/core/triangle_source.h"

namespace bp {
struct PartNames;
struct ScenePose;
class TextureTable;
}  // namespace bp

/// Scenes and meshes from files. PLY, STL, OBJ, OFF and glTF/GLB are streamed by readers of our own: their memory is
/// bounded by SceneOptions::memory_bytes, whatever the file holds. Every other format goes through Assimp, in a child
/// process, so that a crash in an importer is an Error here.
///
/// A file NAME.json is a tileset of 3D Tiles, and read as its contents are (open_tileset(), raw_source.h).
///
/// What all readers share:
///   - Coordinates are doubles from the file to the caller; node transforms are composed in double.
///   - Below 1e-90 in magnitude a coordinate is read as 0: exact predicates need the range (keep_extremes). A large one
///     stays, however large: what is finite is not left out. -0 is read as 0.
///   - Polygons become triangles as PolygonCutter says: the fan from the first corner, unless that folds.
///   - A mesh used by many nodes is streamed through each transform; mirrored transforms keep the outside outside.
///   - Colours, if SceneOptions::colors asks for them: base colour factors times COLOR_0 of glTF, both linear; Kd of
///   MTL
///     and the diffuse colour of Assimp's materials, vertex colours of OBJ, PLY and Assimp's formats, face colours of
///     PLY, all taken as sRGB.
///     Textures: SceneOptions::textures. A material that is not there is white, and no error.
///   - Can be seen through, for SceneOptions::walls_only: materials of glTF whose alphaMode is not OPAQUE or whose base
///     colour has an alpha below 1; of MTL those with d below 1, Tr strictly between 0 and 1, or map_d; Assimp's whose
///     opacity is below 1.
///   - A glTF asset whose `extras.up` is "z" (io/mesh/mesh_writer.h) is delivered in its own z-up coordinates.
namespace bp {

/// For meshes that are read as a whole.
struct MeshLimit {
  MemoryShare memory{0};  ///< 0: none
  std::uint64_t per_triangle = 0, per_vertex = 0;
  /// What is refused if it takes more, all levels so far together.
  const char* purpose = "reading";

  [[nodiscard]] std::uint64_t needed(std::uint64_t triangles, std::uint64_t vertices) const {
    return triangles * per_triangle + vertices * per_vertex;
  }
};

struct SceneOptions {
  std::string format;  ///< of "-", or of a file whose name says nothing: ply stl obj off gltf glb, or one of Assimp's
  std::uint64_t memory_bytes = std::uint64_t(256) << 20;  ///< for vertices; more of them go to a scratch file
  std::string temp_dir;                                   ///< of scratch files; empty: $TMPDIR, else /tmp
  bool colors = false;                                    ///< look for them; else all triangles are white
  std::shared_ptr<TextureTable> textures{};               ///< look for them, and name them here; null: there are none
  bool surface = false;                                   ///< with textures: normals, and how materials answer to light
  std::shared_ptr<const ScenePose> pose{};                ///< of glTF; null: as the file shows it
  std::size_t level = 0;                                  ///< of glTF's MSFT_lod; 0 is the finest
  /// Deliver triangles of no area, too: segments and points, which take no part in a surface but have a place. Whatever
  /// encloses a scene, or checks that, asks for them.
  bool keep_degenerate = false;
  /// Cut every polygon into its fan, whatever its shape: a cage that moves keeps its triangles.
  bool fans = false;
  bool walls_only = false;  ///< leave out what can be seen through, see below; not counted
  /// Coordinates below the range of the exact predicates stay as they are: for proofs, which must not move a vertex.
  bool keep_extremes = false;
  /// For what describes a scene while it is opened: the JSON of glTF, or an importer's process and what it sends. 0: no
  /// limit.
  MemoryShare document{0};
  MeshLimit mesh{};
  /// Deliver only parts whose name fits (* and ? as in file names); empty: all. Names of OBJ: o, g, usemtl; of glTF: of
  /// nodes, with all below them, of meshes, of materials. Other formats are refused.
  std::string parts{};
  std::shared_ptr<PartNames> part_names{};  ///< put such names here that are met, as it asks for; null: none
};

/// Triangles of one file; "-" is stdin, which is spooled to a scratch file. The reader is chosen by the file's
/// extension, else by its first bytes. Triangles that are non-finite or have exactly no area, and faces that name
/// vertices that do not exist, are skipped and counted (SceneOptions::keep_degenerate). A scene without triangles is an
/// empty source. Throws bad_input if the file is missing or broken (here, or while reading); out_of_resource if scratch
/// is full, or if the scene's description needs more than SceneOptions::document.
[[nodiscard]] std::unique_ptr<TriangleSource> open_scene(const std::string& path, const SceneOptions& options = {});

/// Throws bad_argument if two of `paths` are stdin: the second would be found empty.
void check_stdin_once(const std::vector<std::string>& paths);

/// All files, one after the other; one is open at a time. Missing files are reported at once. As check_stdin_once().
[[nodiscard]] std::unique_ptr<TriangleSource> open_scenes(std::vector<std::string> paths,
                                                          const SceneOptions& options = {});

/// A whole mesh in memory; of a file with levels (MSFT_lod), the finest. Vertices with equal coordinates become one,
/// with no tolerance. Nothing is dropped but bad faces: degenerate and non-finite triangles stay (non-finite
/// coordinates as infinities or NaN), in the order of the file, and `counts`, if given, says how many there are. For
/// proxies: memory grows with the mesh. Throws as open_scene(), and out_of_resource beyond 2^32 - 1 vertices.
[[nodiscard]] IndexedMesh read_mesh(const std::string& path, const SceneOptions& options = {},
                                    SceneCounts* counts = nullptr);

/// All levels of a file, finest first: glTF's MSFT_lod; every other file has one. Nodes that have fewer levels than
/// others stay at their last.
[[nodiscard]] std::vector<IndexedMesh> read_levels(const std::string& path, const SceneOptions& options = {});

}  // namespace bp
