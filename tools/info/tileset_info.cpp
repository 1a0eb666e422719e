#include "tools/info/tileset_info.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>

#include "io/files/file.h"
#include "lib/check/counted.h"
#include "tools/info/mesh_info.h"
#include "tools/place/place.h"

namespace bp {

namespace {

void add_content(const std::string& folder, const std::string& uri, TileDepth& depth, TilesetInfo& info) {
  depth.contents += 1;
  struct stat file {};
  if (::stat((folder + "/" + uri).c_str(), &file) == 0 && S_ISREG(file.st_mode)) {
    depth.bytes += std::uint64_t(file.st_size);
  } else {
    info.missing.push_back(uri);
  }
}

void add_tile(const Tile& tile, std::size_t depth, const std::string& folder, TilesetInfo& info) {
  if (info.depths.size() == depth) info.depths.push_back({0, 0, 0, tile.geometric_error, tile.geometric_error});
  TileDepth& level = info.depths[depth];
  level.tiles += 1;
  level.error_min = std::min(level.error_min, tile.geometric_error);
  level.error_max = std::max(level.error_max, tile.geometric_error);
  if (!tile.uri.empty()) add_content(folder, tile.uri, level, info);
  for (const Tile& child : tile.children) add_tile(child, depth + 1, folder, info);
}

TileDepth total_of(const TilesetInfo& info) {
  TileDepth all;
  for (const TileDepth& d : info.depths) {
    all.tiles += d.tiles;
    all.contents += d.contents;
    all.bytes += d.bytes;
  }
  return all;
}

}  // namespace

TilesetInfo tileset_info(const Tileset& tileset, const std::string& path) {
  TilesetInfo info;
  info.version = tileset.version;
  info.up = name_of(tileset.up);
  info.geometric_error = tileset.geometric_error;
  add_tile(tileset.root, 0, folder_of(path), info);
  if (tileset.root.volume.box) {
    info.bounds.emplace();
    for (const Vec3d& corner : tileset.root.volume.box->corners())
      info.bounds->add(transformed(tileset.root.transform, corner));
  }
  info.placement = tileset.placement;
  info.provenance = mesh_extras(path).provenance;
  return info;
}

std::string tileset_text(const TilesetInfo& info, const std::string& name) {
  const TileDepth all = total_of(info);
  std::string s = fmt::format("{}: tileset of 3D Tiles {}\n", name, info.version);
  s += fmt::format("tiles       {}, {} with a content, {}\n", all.tiles, all.contents, size_text(all.bytes));
  if (!info.missing.empty())
    s += fmt::format("missing     {}, the first is {}\n", counted(info.missing.size(), "content"), info.missing[0]);
  s += fmt::format("error       {:.4g} if nothing is drawn\n", info.geometric_error);
  for (std::size_t i = 0; i < info.depths.size(); ++i) {
    const TileDepth& d = info.depths[i];
    const std::string errors = d.error_min == d.error_max ? fmt::format("{:.4g}", d.error_max)
                                                          : fmt::format("{:.4g} to {:.4g}", d.error_min, d.error_max);
    s += fmt::format("depth {:<5} {}, {} with a content, {}, error {}\n", i, counted(d.tiles, "tile"), d.contents,
                     size_text(d.bytes), errors);
  }
  if (info.bounds) {
    const Vec3d &lo = info.bounds->min, &hi = info.bounds->max;
    s += fmt::format("bounds      {} {} {} to {} {} {}, diagonal {:.6g}, z up (the scene's up is {})\n", lo[0], lo[1],
                     lo[2], hi[0], hi[1], hi[2], info.bounds->diagonal(), info.up);
  }
  if (info.placement) {
    const std::string& crs = info.placement->crs;
    s += fmt::format("place       {}{}\n", place_text(info.placement->place), crs.empty() ? "" : ", of " + crs);
  }
  for (const std::string& step : info.provenance) s += fmt::format("made by     {}\n", step);
  return s;
}

Json tileset_json(const TilesetInfo& info) {
  const TileDepth all = total_of(info);
  Json json{{"kind", "tileset"},
            {"version", info.version},
            {"tiles", all.tiles},
            {"contents", all.contents},
            {"bytes", all.bytes},
            {"missing", info.missing},
            {"geometric_error", info.geometric_error},
            {"depths", Json::array()}};
  for (const TileDepth& d : info.depths)
    json["depths"].push_back({{"tiles", d.tiles},
                              {"contents", d.contents},
                              {"bytes", d.bytes},
                              {"geometric_error", {{"min", d.error_min}, {"max", d.error_max}}}});
  json["bounds"] = info.bounds ? Json{{"min", info.bounds->min}, {"max", info.bounds->max}} : Json(nullptr);
  json["up"] = info.up;
  json["placement"] = nullptr;
  if (info.placement) {
    const GlobePlace& place = info.placement->place;
    json["placement"] = {{"place", {place.lon, place.lat, place.height}}, {"crs", info.placement->crs}};
  }
  json["provenance"] = info.provenance;
  return json;
}

}  // namespace bp
