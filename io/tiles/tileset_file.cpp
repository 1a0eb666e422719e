#include "io/tiles/tileset_file.h"

#include <nlohmann/json.hpp>

#include "io/files/uri.h"
#include "io/gltf/glb_file.h"
#include "io/gltf/gltf_nodes.h"
#include "io/gltf/json_fault.h"
#include "io/tiles/tileset_rules.h"
#include "lib/core/error.h"

namespace bp {

namespace {

using Json = GltfOutJson;

constexpr std::uint64_t kMostBytes = std::uint64_t(1) << 32;  // some millions of tiles

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
  explicit Reader(const std::string& path) : name_(path) {
    try {
      json_ = GltfJson::parse(read_text(path, kMostBytes));
    } catch (const GltfJson::exception& e) {
      fail(ErrorCode::bad_input, {Remedy::repair_file}, "{}: broken JSON: {}", path, detail::json_fault(e));
    }
  }

  Tileset run() {
    const GltfObject root(json_, name_, "");
    check_required_extensions(root);
    Tileset tileset;
    tileset.version = root.object("asset").text("version");
    tileset.up = gltf_up(root).value_or(UpAxis::z);
    tileset.geometric_error = number_of(json_, root, "geometricError");
    tileset.images = images(root.object("asset"));
    const GltfObject top = root.object("root");  // says if there is none
    tileset.root = tile(top, json_["root"], 0);
    return tileset;
  }

 private:
  Tile tile(const GltfObject& object, const GltfJson& json, int depth) const {
    check_tile(object, depth);
    if (object.has("contents")) object.unfit("has several contents, which are not read");
    Tile tile;
    const GltfObject volume = object.object("boundingVolume");
    if (volume.has("box")) {
      tile.box = box_from(volume.numbers<12>("box", {}));
    } else if (!volume.has("sphere") && !volume.has("region") && !volume.has_extension("3DTILES_bounding_volume_S2")) {
      volume.broken("has neither a box nor a sphere nor a region");
    }
    tile.transform = object.numbers<16>("transform", kNoTransform);
    tile.geometric_error = number_of(json, object, "geometricError");
    if (object.has("refine")) tile.refine = object.text("refine");
    if (object.has("content")) tile.uri = content(object.object("content"));
    if (object.has("extras") && object.object("extras").has("cell")) {
      const auto cell = object.object("extras").numbers<6>("cell", {});
      tile.cell = Bounds3d{{cell[0], cell[1], cell[2]}, {cell[3], cell[4], cell[5]}};
      tile.is_leaf = is_leaf(object);
    }
    if (object.has("children") && object.array("children").empty()) object.broken("has 'children', and none in it");
    for (std::size_t i = 0; i < object.array("children").size(); ++i)
      tile.children.push_back(this->tile(object.item("children", i), json["children"][i], depth + 1));
    return tile;
  }

  /// Of a tileset of ours; anything else there is someone else's business.
  static std::vector<std::string> images(const GltfObject& asset) {
    std::vector<std::string> images;
    if (!asset.has("extras") || !asset.object("extras").has("images")) return images;
    for (const GltfJson& name : asset.object("extras").array("images")) {
      if (name.is_string()) images.push_back(name.get<std::string>());
    }
    return images;
  }

  static std::string content(const GltfObject& object) {
    const std::string uri = content_uri(object);
    if (names_tileset(uri)) object.unfit("is a tileset of its own: check it by itself");
    return uri;
  }

  std::string name_;
  GltfJson json_;
};

Json json_of(const TileBox& box) {
  Json numbers = Json::array();
  for (const double c : box.centre) numbers.push_back(c);
  for (const Vec3d& axis : box.axes) {
    for (const double c : axis) numbers.push_back(c);
  }
  return numbers;
}

Json json_of(const Tile& tile) {
  Json json;
  if (tile.transform != kNoTransform) json["transform"] = tile.transform;
  json["boundingVolume"] = {{"box", json_of(*tile.box)}};
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

Tileset read_tileset(const std::string& path) {
  return Reader(path).run();
}

std::string tileset_text(const Tileset& tileset, const std::vector<Provenance>& provenance) {
  Json asset = gltf_asset("bplod", provenance, tileset.up, {});
  asset["version"] = tileset.version;
  asset.erase("generator");
  if (!tileset.images.empty()) asset["extras"]["images"] = tileset.images;
  const Json doc{{"asset", asset}, {"geometricError", tileset.geometric_error}, {"root", json_of(tileset.root)}};
  return doc.dump(1) + "\n";
}

}  // namespace bp
