#include "io/tiles/tileset_rules.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/files/file.h"
#include "io/files/lower.h"
#include "io/files/uri.h"
#include "io/gltf/gltf_nodes.h"
#include "lib/core/vec3.h"

namespace bp {

void check_tile(const GltfObject& tile, int depth) {
  constexpr int kMostDeep = 64;  // a deeper tree is a mistake or an attack on the stack
  if (depth > kMostDeep) tile.broken(fmt::format("lies below {} tiles", kMostDeep));
  if (tile.has("implicitTiling") || tile.has_extension("3DTILES_implicit_tiling"))
    tile.unfit("is tiled implicitly, which is not read");
  if (tile.has_extension("3DTILES_multiple_contents")) tile.unfit("has contents in an extension, which are not read");
}

Transform tile_transform(const GltfObject& tile) {
  const Transform m = tile.numbers<16>("transform", kNoTransform);
  if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
    tile.broken("has a 'transform' whose last row is not 0 0 0 1");
  return m;
}

namespace {

/// Returns asset.extras.placement, if a tileset has one of the form that this suite writes.
std::optional<GltfObject> told_placement(const GltfObject& root) {
  if (!has_record(root)) return {};
  const GltfObject extras = root.object("asset").object("extras");
  if (!extras.has("placement") || !extras.json()["placement"].is_object()) return {};
  const GltfObject told = extras.object("placement");
  return told.has("place") && told.has("origin") ? std::optional(told) : std::nullopt;
}

Transform moved_by(const Vec3d& v) {
  Transform m = kNoTransform;
  std::copy(v.begin(), v.end(), m.begin() + 12);
  return m;
}

/// Returns how far apart two transforms take a point of the volume, at most.
double difference(const Transform& a, const Transform& b, const GltfObject& volume) {
  if (!volume.has("box")) return HUGE_VAL;  // all tilesets of this suite have boxes
  const auto n = volume.numbers<12>("box", {});
  double most = 0;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    Vec3d p{n[0], n[1], n[2]};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t k = 0; k < 3; ++k)
        p[k] += (corner >> axis & 1) != 0 ? n[3 + 3 * axis + k] : -n[3 + 3 * axis + k];
    }
    const double off = length(transformed(a, p) - transformed(b, p));
    most = off <= most ? most : off;  // NaN counts
  }
  return most;
}

}  // namespace

std::optional<Placement> placement_of(const GltfObject& root) {
  const std::optional<GltfObject> told = told_placement(root);
  if (!told) return {};
  const auto [lon, lat, height] = told->numbers<3>("place", {});
  Placement placement;
  placement.place = {lon, lat, height};
  placement.at = told->numbers<3>("at", {});
  if (told->has("crs")) placement.crs = told->text("crs");
  if (told->has("operation")) placement.operation = told->text("operation");
  if (told->has("scene_up")) placement.scene_up = up_axis_named(told->text("scene_up"));
  const GltfObject tile = root.object("root");
  placement.off = difference(tile_transform(tile), product(to_ecef(placement), root_transform(root)),
                             tile.object("boundingVolume"));
  return placement;
}

Transform root_transform(const GltfObject& root) {
  const std::optional<GltfObject> told = told_placement(root);
  return told ? moved_by(told->numbers<3>("origin", {})) : tile_transform(root.object("root"));
}

UpAxis content_up(const GltfObject& root) {
  if (!root.has("asset") || !root.object("asset").has("gltfUpAxis")) return UpAxis::y;
  const GltfObject asset = root.object("asset");
  const std::string named = lower(asset.text("gltfUpAxis"));
  if (named != "x" && named != "y" && named != "z")
    asset.broken(fmt::format("has the gltfUpAxis \"{}\", which is neither X nor Y nor Z", asset.text("gltfUpAxis")));
  return *up_axis_named(named);
}

std::string content_uri(const GltfObject& content) {
  if (content.has("uri") && content.has("url") && content.text("uri") != content.text("url"))
    content.unfit("has a uri and a url, and viewers take either");
  const UriFile file = file_of_uri(content.text(content.has("uri") ? "uri" : "url"), "");
  if (!file.fault.empty()) content.unfit(file.fault);
  return file.path;
}

std::string content_path(const std::string& folder, const std::string& uri) {
  return folder.empty() ? uri : folder + "/" + uri;
}

bool names_tileset(const std::string& uri) {
  return lower(uri).ends_with(".json");
}

bool adds(const std::string& refine) {
  return lower(refine) == "add";
}

bool is_leaf(const GltfObject& tile) {
  return tile.has("extras") && tile.object("extras").has("leaf") && tile.object("extras").flag("leaf");
}

Affine affine_of_transform(const Transform& transform) {
  Affine a;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) a.m[i][j] = transform[4 * j + i];
  }
  return a;
}

Affine scene_place(const Transform& to_tileset, UpAxis up) {
  return affine_of(to_y_up(up).inverse()) * affine_of(to_y_up(UpAxis::z)) * affine_of_transform(to_tileset);
}

// --- UnreadKeys
// --------------------------------------------------------------------------------------------------------

namespace {

// Keys that OGC 22-025r4 lists, and their names in older versions. Keys that move, hide or cull are left out:
// viewerRequestVolume, expire, region.
constexpr std::array kRoot = {
    "asset",  "geometricError", "root",           "properties",        "schema", "schemaUri", "statistics",
    "groups", "metadata",       "extensionsUsed", "extensionsRequired"};
constexpr std::array kAsset = {"version", "tilesetVersion", "generator", "copyright", "gltfUpAxis"};
constexpr std::array kTile = {"boundingVolume", "geometricError", "refine",  "transform",
                              "content",        "metadata",       "children"};
constexpr std::array kContent = {"uri", "url", "boundingVolume", "metadata", "group"};
constexpr std::array kVolume = {"box", "sphere"};
constexpr std::array kHarmless = {"3DTILES_content_gltf"};

bool is_among(std::span<const char* const> names, const std::string& name) {
  return std::any_of(names.begin(), names.end(), [&](const char* known) { return name == known; });
}

/// Returns whether metadata replace properties of tiles by their semantics: TILE_BOUNDING_BOX,
/// CONTENT_HORIZON_OCCLUSION ...
bool has_semantics_of_tiles(const GltfJson& schema) {
  std::vector<const GltfJson*> open{&schema};  // no recursion: a file may be as deep as it is long
  while (!open.empty()) {
    const GltfJson& json = *open.back();
    open.pop_back();
    if (json.is_string()) {
      const auto& text = json.get_ref<const std::string&>();
      if (text.starts_with("TILE_") || text.starts_with("CONTENT_")) return true;
    }
    for (const GltfJson& below : json) {
      if (&below != &json) open.push_back(&below);
    }
  }
  return false;
}

}  // namespace

UnreadKeys::UnreadKeys(const GltfObject& root) {
  metadata_matter_ = root.has("schemaUri") || root.has_extension("3DTILES_metadata") ||
                     (root.has("schema") && has_semantics_of_tiles(root.json()["schema"]));
}

void UnreadKeys::note(const GltfObject& object, const std::string& what) {
  const auto [found, is_new] = found_.try_emplace(what, Found{object.place()});
  if (!is_new) ++found->second.others;
}

void UnreadKeys::look(const GltfObject& object, std::span<const char* const> known) {
  for (const auto& [key, value] : object.json().items()) {
    if (key == "extensions" && value.is_object()) {
      for (const auto& [name, extension] : value.items()) {
        if (!is_among(kHarmless, name)) note(object, name);
      }
    } else if (key != "extras" && !is_among(known, key)) {
      note(object, key);
    } else if (key == "metadata" && metadata_matter_) {
      note(object, key);
    }
  }
}

void UnreadKeys::look_at_root(const GltfObject& root) {
  look(root, kRoot);
  for (const GltfJson& name : root.array("extensionsUsed")) {
    if (!name.is_string() || !is_among(kHarmless, name.get<std::string>())) note(root, "extensionsUsed " + name.dump());
  }
  const GltfObject asset = root.object("asset");
  look(asset, kAsset);
  if (!asset.has("gltfUpAxis")) return;
  const std::string up = asset.text("gltfUpAxis");  // viewers differ on lower case
  if (up != "X" && up != "Y" && up != "Z") note(asset, "gltfUpAxis \"" + up + "\"");
}

void UnreadKeys::look_at_tile(const GltfObject& tile) {
  look(tile, kTile);
}

void UnreadKeys::look_at_content(const GltfObject& content) {
  look(content, kContent);
}

void UnreadKeys::look_at_volume(const GltfObject& volume) {
  look(volume, kVolume);
}

std::vector<std::string> UnreadKeys::lines() const {
  std::vector<std::string> lines;
  for (const auto& [what, found] : found_) {
    const std::string more = found.others > 0 ? fmt::format(" and {} more", found.others) : "";
    lines.push_back(fmt::format("{}{}: {} is not followed here, and may move, hide or cull what is drawn",
                                found.place.empty() ? "tileset" : found.place, more, what));
  }
  return lines;
}

}  // namespace bp
