#include "io/tiles/tileset_file.h"

#include <nlohmann/json.hpp>

#include "io/files/uri.h"
#include "io/gltf/glb_file.h"
#include "io/gltf/gltf_nodes.h"
#include "io/gltf/json_fault.h"
#include "io/gltf/json_text.h"
#include "io/tiles/tileset_rules.h"
#include "lib/core/error.h"

namespace bp {

namespace {

using Json = GltfOutJson;

double number_of(const GltfJson& json, const GltfObject& object, const char* key) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_number()) object.broken(fmt::format("has no number '{}'", key));
  return found->get<double>();
}

TileBox box_from(const std::array<double, 12>& n) {
  TileBox box;
  for (std::size_t i = 0; i < 3; ++i) {
    box.centre[i] = n[i];
    for (std::size_t k = 0; k < 3; ++k) box.axes[k][i] = n[3 + 3 * k + i];
  }
  return box;
}

class Reader {
 public:
  Reader(const GltfJson& json, const std::string& path) : json_(json), root_(json, path, ""), unread_(root_) {}

  Tileset run() {
    check_required_extensions(root_);
    unread_.look_at_root(root_);
    Tileset tileset;
    tileset.version = root_.object("asset").text("version");
    tileset.up = gltf_up(root_).value_or(UpAxis::z);
    tileset.content_up = content_up(root_);
    tileset.geometric_error = number_of(json_, root_, "geometricError");
    tileset.images = images(root_.object("asset"));
    const GltfObject top = root_.object("root");  // throws if there is none
    tileset.root = tile(top, json_["root"], 0);
    tileset.placement = placement_of(root_);
    tileset.root.transform = root_transform(root_);
    tileset.not_understood = unread_.lines();
    return tileset;
  }

 private:
  TileVolume volume(const GltfObject& object) {
    unread_.look_at_volume(object);
    TileVolume volume;
    if (object.has("box")) volume.box = box_from(object.numbers<12>("box", {}));
    if (object.has("sphere")) {
      const auto n = object.numbers<4>("sphere", {});
      volume.sphere = TileSphere{{n[0], n[1], n[2]}, n[3]};
    }
    if (!volume.box && !volume.sphere && !object.has("region") && !object.has("extensions"))
      object.broken("has neither a box nor a sphere nor a region");
    return volume;
  }

  Tile tile(const GltfObject& object, const GltfJson& json, int depth) {
    check_tile(object, depth);
    if (object.has("contents")) object.unfit("has several contents, which are not read");
    unread_.look_at_tile(object);
    Tile tile;
    tile.volume = volume(object.object("boundingVolume"));
    tile.transform = tile_transform(object);
    tile.geometric_error = number_of(json, object, "geometricError");
    if (object.has("refine")) tile.refine = object.text("refine");
    if (object.has("content")) add_content(object.object("content"), tile);
    if (object.has("extras") && object.object("extras").has("cell")) {
      const auto cell = object.object("extras").numbers<6>("cell", {});
      tile.cell = Bounds3d{{cell[0], cell[1], cell[2]}, {cell[3], cell[4], cell[5]}};
      tile.is_leaf = is_leaf(object);
    }
    if (object.has("children") && object.array("children").empty()) object.broken("has 'children', and none in it");
    tile.children.reserve(object.array("children").size());
    for (std::size_t i = 0; i < object.array("children").size(); ++i)
      tile.children.push_back(this->tile(object.item("children", i), json["children"][i], depth + 1));
    return tile;
  }

  /// Returns the images that a tileset of this suite names; anything else there is ignored.
  static std::vector<std::string> images(const GltfObject& asset) {
    std::vector<std::string> images;
    if (!asset.has("extras") || !asset.object("extras").has("images")) return images;
    for (const GltfJson& name : asset.object("extras").array("images")) {
      if (name.is_string()) images.push_back(name.get<std::string>());
    }
    return images;
  }

  void add_content(const GltfObject& content, Tile& tile) {
    unread_.look_at_content(content);
    tile.uri = content_uri(content);
    if (names_tileset(tile.uri)) content.unfit("is a tileset of its own: check it by itself");
    if (content.has("boundingVolume"))
      tile.content_volume = std::make_shared<const TileVolume>(volume(content.object("boundingVolume")));
  }

  const GltfJson& json_;
  const GltfObject root_;
  UnreadKeys unread_;
};

Json json_of(const TileBox& box) {
  Json numbers = Json::array();
  for (const double c : box.centre) numbers.push_back(c);
  for (const Vec3d& axis : box.axes) {
    for (const double c : axis) numbers.push_back(c);
  }
  return numbers;
}

/// `root`: a translation.
Json json_of(const Placement& placement, const Transform& root) {
  const GlobePlace& place = placement.place;
  Json json{{"place", {place.lon, place.lat, place.height}}, {"origin", {root[12], root[13], root[14]}}};
  if (placement.at != Vec3d{}) json["at"] = placement.at;
  if (placement.crs.empty()) return json;
  json["crs"] = placement.crs;
  json["operation"] = placement.operation;
  if (placement.scene_up) json["scene_up"] = name_of(*placement.scene_up);
  return json;
}

Json json_of(const Tile& tile) {
  Json json;
  if (tile.transform != kNoTransform) json["transform"] = tile.transform;
  json["boundingVolume"] = {{"box", json_of(*tile.volume.box)}};
  json["geometricError"] = tile.geometric_error;
  if (!tile.refine.empty()) json["refine"] = tile.refine;
  if (!tile.uri.empty()) json["content"] = {{"uri", detail::percent_encoded(tile.uri)}};
  if (tile.cell) {
    const auto& [min, max] = *tile.cell;
    json["extras"] = {{"cell", {min[0], min[1], min[2], max[0], max[1], max[2]}}};
    if (tile.is_leaf) json["extras"]["leaf"] = true;
  }
  for (const Tile& child : tile.children) json["children"].push_back(json_of(child));
  return json;
}

}  // namespace

Tileset read_tileset(const std::string& path, const SceneOptions& options) {
  const MadeOfJson tiles{"\"boundingVolume\"", kTileBytes};  // each tile has one
  const CountedJson counted = read_json(open_scene_file(path, temp_dir_of(options)), options, 0, tiles);
  return Reader(counted.json, path).run();
}

Tileset read_old_tileset(const std::string& path) {
  constexpr std::uint64_t kMostBytes = std::uint64_t(1) << 32;  // some millions of tiles
  try {
    return Reader(parse_json(read_text(path, kMostBytes), path), path).run();
  } catch (const GltfJson::exception& e) {
    fail(ErrorCode::bad_input, {Remedy::repair_file}, "{}: broken JSON: {}", path, detail::json_fault(e));
  }
}

std::string tileset_text(const Tileset& tileset, const std::vector<Provenance>& provenance) {
  Json asset = gltf_asset("bplod", provenance, tileset.up, {});
  asset["version"] = tileset.version;
  asset.erase("generator");
  if (!tileset.images.empty()) asset["extras"]["images"] = tileset.images;
  Json root = json_of(tileset.root);
  if (tileset.placement) {
    asset["extras"]["placement"] = json_of(*tileset.placement, tileset.root.transform);
    root["transform"] = product(to_ecef(*tileset.placement), tileset.root.transform);
  }
  const Json doc{{"asset", asset}, {"geometricError", tileset.geometric_error}, {"root", root}};
  return doc.dump(1) + "\n";
}

}  // namespace bp
