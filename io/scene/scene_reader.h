#pragma once
#include <memory>
#include <string>
#include <vector>

#include "io/scene/scene_options.h"
#include "lib/core/indexed_mesh.h"
#include "lib/core/triangle_source.h"

/// Reads scenes and meshes from files. PLY, STL, OBJ, OFF and glTF/GLB are streamed by readers of this suite: their
/// memory is bounded by SceneOptions::memory_bytes, whatever the file holds. Every other format goes through Assimp, in
/// a child process, so that a crash in an importer is an Error here.
/// A file NAME.json is a tileset of 3D Tiles, and read as its contents are (open_tileset(), raw_source.h).
/// All readers share these rules:
///   - Coordinates are doubles from the file to the caller; node transforms are composed in double.
///   - A coordinate below 1e-90 in magnitude is read as 0: exact predicates need the range (keep_extremes). Every
///     finite coordinate stays, however large. -0 is read as 0.
///   - Polygons become triangles as PolygonCutter says: the fan from the first corner, unless that folds.
///   - A mesh used by many nodes is streamed through each transform; mirrored transforms keep the outside outside.
///   - Colours, if SceneOptions::colors asks for them: base colour factors times COLOR_0 of glTF, both linear; Kd of
///     MTL and the diffuse colour of Assimp's materials, vertex colours of OBJ, PLY and Assimp's formats, face colours
///     of PLY, all taken as sRGB. Textures: SceneOptions::textures. A missing material is white, and no error.
///   - Transparent, for SceneOptions::walls_only: materials of glTF whose alphaMode is not OPAQUE, whose base colour
///     has an alpha below 1, or that transmit light, and nodes that KHR_node_visibility hides; of MTL those with d
///     below 1, Tr strictly between 0 and 1, or map_d; of Assimp those with an opacity below 1.
///   - A glTF asset whose `extras.up` is "z" (io/mesh/mesh_writer.h) is delivered in its own z-up coordinates.
namespace bp {

/// Opens the triangles of one file; "-" is stdin, which is spooled to a scratch file. The reader is chosen by the
/// file's extension, else by its first bytes. Triangles that are not finite or have exactly no area, and faces that
/// name missing vertices, are skipped and counted (SceneOptions::keep_degenerate). A scene without triangles is an
/// empty source. Throws bad_input if the file is missing or broken (here, or while reading); out_of_resource if scratch
/// is full, or if the scene's description needs more than SceneOptions::document.
[[nodiscard]] std::unique_ptr<TriangleSource> open_scene(const std::string& path, const SceneOptions& options = {});

/// Throws bad_argument if two of `paths` are stdin: the second would be empty.
void check_stdin_once(const std::vector<std::string>& paths);

/// Opens all files, one after the other; one is open at a time. Missing files are reported at once. Throws as
/// check_stdin_once().
[[nodiscard]] std::unique_ptr<TriangleSource> open_scenes(std::vector<std::string> paths,
                                                          const SceneOptions& options = {});

/// Reads a whole mesh into memory; of a file with levels (MSFT_lod), the finest. Vertices with equal coordinates become
/// one, with no tolerance. Only bad faces are dropped: degenerate and non-finite triangles stay (non-finite coordinates
/// as infinities or NaN), in the order of the file, and `counts`, if given, tells how many there are. For proxies:
/// memory grows with the mesh. Throws as open_scene(), and out_of_resource beyond 2^32 - 1 vertices.
[[nodiscard]] IndexedMesh read_mesh(const std::string& path, const SceneOptions& options = {},
                                    SceneCounts* counts = nullptr);

/// Reads all levels of a file, finest first: glTF's MSFT_lod; every other file has one. Nodes with fewer levels than
/// others stay at their last.
[[nodiscard]] std::vector<IndexedMesh> read_levels(const std::string& path, const SceneOptions& options = {});

}  // namespace bp
