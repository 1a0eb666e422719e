#pragma once
#include <map>
#include <span>
#include <string>
#include <vector>

#include "io/gltf/gltf_document.h"
#include "io/scene/raw_source.h"
#include "lib/tileset/tileset.h"

/// Rules for the JSON of a tileset that every reader checks. Fields of version 1.0 are accepted, too.
namespace bp {

/// Throws bad_input for a tile that lies too deep, or that draws more than its tileset lists: implicit tiling, and
/// contents in an extension.
void check_tile(const GltfObject& tile, int depth);
/// Returns the transform from a tile to the one above. Throws bad_input if points could go to infinity.
[[nodiscard]] Transform tile_transform(const GltfObject& tile);
/// Returns the axis that is up in the glTF of contents, as older tilesets tell (asset.gltfUpAxis): x, y or z. The
/// outermost tileset decides for all within it, as in viewers. Throws bad_input for anything else.
[[nodiscard]] UpAxis content_up(const GltfObject& root);
/// Returns the path of a content, seen from its tileset's folder (file_of_uri()). Throws Unfit if viewers may take
/// another file.
[[nodiscard]] std::string content_uri(const GltfObject& content);
/// Returns the file of a content's path in the folder of its tileset.
[[nodiscard]] std::string content_path(const std::string& folder, const std::string& uri);
/// Returns true if a content is a tileset of its own.
[[nodiscard]] bool names_tileset(const std::string& uri);
/// Returns whether `refine` means that a tile's content is drawn in addition to those below.
[[nodiscard]] bool adds(const std::string& refine);
/// Returns where a tileset of this suite stands, if it says so; `root` is its document. Placement::off compares the
/// transform of the root tile with that.
[[nodiscard]] std::optional<Placement> placement_of(const GltfObject& root);
/// Returns the transform of the root tile, without the placement if the tileset has one.
[[nodiscard]] Transform root_transform(const GltfObject& root);
/// Returns whether a tile's content is a piece of the scene itself; only in tilesets of this suite (extras.leaf).
[[nodiscard]] bool is_leaf(const GltfObject& tile);

[[nodiscard]] Affine affine_of_transform(const Transform& transform);
/// Returns the transform from the space of a tile to the axes of the scene from which a tileset of `up` was made.
[[nodiscard]] Affine scene_place(const Transform& to_tileset, UpAxis up);

/// Notes keys of a tileset that no reader here follows, as they may move, hide or cull. Only listed keys are known.
class UnreadKeys {
 public:
  explicit UnreadKeys(const GltfObject& root);

  void look_at_root(const GltfObject& root);
  void look_at_tile(const GltfObject& tile);
  void look_at_content(const GltfObject& content);
  void look_at_volume(const GltfObject& volume);

  /// Returns the notes, a line for each key, with the first place that has it.
  [[nodiscard]] std::vector<std::string> lines() const;

 private:
  void look(const GltfObject& object, std::span<const char* const> known);
  void note(const GltfObject& object, const std::string& what);

  struct Found {
    std::string place;
    std::uint64_t others = 0;
  };
  std::map<std::string, Found> found_;
  bool metadata_matter_ = false;  ///< their schema has properties for volumes and errors of tiles
};

}  // namespace bp
