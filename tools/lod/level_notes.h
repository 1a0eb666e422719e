#pragma once
#include "io/scene/texture_table.h"
#include "lib/levels/level_chain.h"
#include "tools/lod/build_options.h"

/// What a person should know of what bplod made. Each is one line, or empty.
namespace bp {

/// A level that has not its faces: why. `asked`: faces were asked for. `triangles`: of the scene.
[[nodiscard]] std::string faces_note(const LevelFacts& level, bool asked, std::uint64_t triangles);

/// A level whose error exceeds the one asked for; scene units.
[[nodiscard]] std::string error_note(std::size_t level, double error_world, double asked_world);

/// Returns all notes on levels that are one mesh each. `first`: the number of the first one.
[[nodiscard]] std::vector<std::string> level_notes(const std::vector<LevelFacts>& levels, std::size_t first, bool asked,
                                                   const SceneSize& scene);

/// Returns a note that tells which level is not there, and why. diagonal: of the scene.
[[nodiscard]] std::string left_out_note(const LeftOut& level, double diagonal);

/// Returns the note of OriginOption for tilesets, which hold coordinates in double. Throws bad_argument if --origin
/// would round.
[[nodiscard]] std::string origin_note(const BuildOptions& options, const StreamHeader& header);

/// A tileset whose voxels follow from the scene, if the scene has more triangles than these are for.
[[nodiscard]] std::string voxel_note(const BuildOptions& options, const SceneSize& scene);

/// Returns a note if levels do not enclose the triangles of a scene although they could, and nobody asked for that.
[[nodiscard]] std::string enclose_note(const BuildOptions& options, std::uint64_t triangles);

/// Returns notes on what the options mean for this scene: a scale that is a large share of it, and the three notes
/// above.
[[nodiscard]] std::vector<std::string> option_notes(const BuildOptions& options, const SceneSize& scene,
                                                    const StreamHeader& header);

/// Returns a note if the finest level has more faces than the scene has triangles, else nothing. `asked`: somebody
/// asked for a number of faces.
[[nodiscard]] std::string heavier_note(const LevelFacts& finest, bool asked, std::uint64_t triangles);

/// What is connected in the voxels of a scene.
struct SceneParts {
  std::uint64_t count = 0;  ///< 0: not known
  double volume = 0;        ///< scene units cubed
  double named_scale = 0;   ///< scene units; 0: none
};
/// Not known of a scene whose parts take more memory to be counted, or if `options` ask for no number of faces.
[[nodiscard]] SceneParts parts_of(const VoxelizedScene& scene, const BuildOptions& options, std::uint64_t memory_bytes);

/// A level that was closed at more than its scale, since parts and holes took too many faces.
[[nodiscard]] std::string closed_note(const LevelFacts& level);

/// A finest level of so many parts that joins those of the scene and fills the room between them, at a scale that
/// nobody named, or beyond the one named.
[[nodiscard]] std::string joined_note(const LevelFacts& finest, std::uint64_t parts, const SceneParts& scene);

/// A scene with textures none of whose images can be read: the first file, and the reason.
[[nodiscard]] std::string no_image_note(const ImageFaults& faults);

/// The command that proves `file`, one of those in the folder of the levels: "bpcheck SCENE OUT/FILE". Empty of fits,
/// which enclose nothing, and of a scene from a pipe. hulls: the file holds convex hulls. margin: scene units; 0: none.
[[nodiscard]] std::string proof_command(const BuildOptions& options, const std::string& file, bool hulls,
                                        double margin = 0);

}  // namespace bp
