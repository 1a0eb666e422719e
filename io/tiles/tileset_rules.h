#pragma once
#include <map>
#include <span>
#include <string>
#include <vector>

#include "io/gltf/gltf_document.h"
#include "io/scene/raw_source.h"
#include "lib/tileset/tileset.h"

/// What every reader of a tileset's JSON asks of it. Fields of version 1.0 are taken, too.
namespace bp {

/// Throws bad_input for a tile that lies too deep, and for one that draws more than its tileset lists: implicit tiling,
/// and contents in an extension.
void check_tile(const GltfObject& tile, int depth);
/// From a tile to the one above. Throws bad_input if points could go to infinity.
[[nodiscard]] Transform tile_transform(const GltfObject& tile);
/// Which axis of the glTF in contents is up, as older tilesets tell (asset.gltfUpAxis): x, y or z. That of the
/// outermost tileset counts for all within it, as viewers have it. Throws bad_input for anything else.
[[nodiscard]] UpAxis content_up(const GltfObject& root);
/// Of a content: decoded.
[[nodiscard]] std::string content_uri(const GltfObject& content);
/// The file of a content's uri in the folder of its tileset; a query is left out if no file has it in its name.
[[nodiscard]] std::string content_path(const std::string& folder, const std::string& uri);
/// True if a content is a tileset of its own.
[[nodiscard]] bool names_tileset(const std::string& uri);
/// How a tile is refined that says `refine`: its content stays beside those below.
[[nodiscard]] bool adds(const std::string& refine);
/// Its content is a piece of the scene itself; ours only (extras.leaf).
[[nodiscard]] bool is_leaf(const GltfObject& tile);

[[nodiscard]] Affine affine_of_transform(const Transform& transform);
/// From the space of a tile to the axes of the scene that a tileset of `up` was made from.
[[nodiscard]] Affine scene_place(const Transform& to_tileset, UpAxis up);

/// Notes what a tileset says that no reader here follows: it may move, hide or cull. Only what is listed is known.
class UnreadKeys {
 public:
  explicit UnreadKeys(const GltfObject& root);

  void look_at_root(const GltfObject& root);
  void look_at_tile(const GltfObject& tile);
  void look_at_content(const GltfObject& content);
  void look_at_volume(const GltfObject& volume);

  /// Line for line, each key once, with the first place that has it.
  [[nodiscard]] std::vector<std::string> lines() const;

 private:
  void look(const GltfObject& object, std::span<const char* const> known);
  void note(const GltfObject& object, const std::string& what);

  struct Found {
    std::string place;
    std::uint64_t others = 0;
  };
  std::map<std::string, Found> found_;
  bool metadata_matter_ = false;  ///< their schema has properties that stand for volumes and errors
};

}  // namespace bp
