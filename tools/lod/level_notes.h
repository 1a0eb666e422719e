#pragma once
#include "io/scene/texture_table.h"
#include "lib/levels/level_chain.h"
#include "tools/lod/build_options.h"

/// Makes the notes that tell a user about the levels of bplod. Each is one line, or empty.
namespace bp {

/// Returns a note that tells why a level has fewer or more faces than its budget. `asked`: the user asked for faces.
/// `triangles`: the scene's.
[[nodiscard]] std::string faces_note(const LevelFacts& level, bool asked, std::uint64_t triangles);

/// Returns a note that names the limbs that grow together in a cage of at most `budget` triangles.
[[nodiscard]] std::string limbs_note(const LimbCounts& limbs, std::uint64_t budget);

/// Returns a note on a level whose error exceeds the one that was asked for; scene units.
[[nodiscard]] std::string error_note(std::size_t level, double error_world, double asked_world);

/// Returns all notes on levels that are one mesh each. `first`: the number of the first one.
[[nodiscard]] std::vector<std::string> level_notes(const std::vector<LevelFacts>& levels, std::size_t first, bool asked,
                                                   const SceneSize& scene);

/// Returns a note that tells which level was left out, and why. diagonal: the scene's.
[[nodiscard]] std::string left_out_note(const LeftOut& level, double diagonal);

/// Returns the note of OriginOption; empty for tilesets, whose coordinates are doubles. Throws bad_argument if --origin
/// would round.
[[nodiscard]] std::string origin_note(const BuildOptions& options, const StreamHeader& header);

/// Returns a note on a tileset whose voxels follow from the scene, if the scene has more triangles than such voxels can
/// show.
[[nodiscard]] std::string voxel_note(const BuildOptions& options, const SceneSize& scene);

/// Returns a note if levels enclose the scene's voxels only because the scene has too many triangles or comes from a
/// pipe. Empty if the user chose what is enclosed.
[[nodiscard]] std::string enclose_note(const BuildOptions& options, std::uint64_t triangles);

/// Returns notes on what the options mean for this scene: a scale that is a large share of it, and the three notes
/// above.
[[nodiscard]] std::vector<std::string> option_notes(const BuildOptions& options, const SceneSize& scene,
                                                    const StreamHeader& header);

/// Returns a note if the finest level has more faces than the scene has triangles, else nothing. `asked`: somebody
/// asked for a number of faces.
[[nodiscard]] std::string heavier_note(const LevelFacts& finest, bool asked, std::uint64_t triangles);

/// The connected parts of the voxels of a scene.
struct SceneParts {
  std::uint64_t count = 0;  ///< 0: not known
  double volume = 0;        ///< scene units cubed
  double named_scale = 0;   ///< the scale that the user named, scene units; 0: none
};
/// Counts the parts. Returns a count of 0 if counting would take too much memory, or if joined_note() is not needed for
/// these options.
[[nodiscard]] SceneParts parts_of(const VoxelizedScene& scene, const BuildOptions& options, std::uint64_t memory_bytes);

/// Returns a note on a level that was closed at a larger scale than the first one, since parts and holes took too many
/// faces.
[[nodiscard]] std::string closed_note(const LevelFacts& level);

/// Returns a note if the finest level has fewer parts than the scene and fills the room between them, at a scale that
/// is larger than the user named. `parts`: the level's.
[[nodiscard]] std::string joined_note(const LevelFacts& finest, std::uint64_t parts, const SceneParts& scene);

/// Returns a note on a scene with textures none of whose images can be read. It names the first file and the reason.
[[nodiscard]] std::string no_image_note(const ImageFaults& faults);

/// Returns the command that proves `file`, a file in the folder of the levels: "bpcheck SCENE OUT/FILE". Empty for
/// fits, which enclose nothing, and for a scene from a pipe. hulls: the file holds convex hulls. margin: scene units;
/// 0: none.
[[nodiscard]] std::string proof_command(const BuildOptions& options, const std::string& file, bool hulls,
                                        double margin = 0);

}  // namespace bp
