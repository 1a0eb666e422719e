#include "tools/check/tileset_verdict.h"

#include <fmt/format.h>

#include <map>

#include "io/tileset_file.h"
#include "lib/check/check_proxy.h"
#include "lib/check/tile_cover.h"
#include "lib/check/tileset.h"
#include "lib/core/error.h"
#include "tools/common/report.h"

namespace bp {

namespace {

/// glTF to 3D Tiles: y up to z up. Exact.
Vec3d z_up(const Vec3d& p) {
  return {p[0], 0.0 - p[2], p[1]};
}

Vec3d y_up(const Vec3d& p) {
  return {p[0], p[2], 0.0 - p[1]};
}

struct Content {
  TileContent known;
  IndexedMesh mesh;  // z up
};

Content read_content(const std::string& path, const SceneOptions& options) {
  Content content;
  try {
    content.mesh = read_mesh(path, options);
    for (Vec3d& p : content.mesh.vertices) p = z_up(p);
    content.known.vertices = content.mesh.vertices;
    content.known.found = true;
  } catch (const Error& e) {
    if (e.code() != ErrorCode::bad_input) throw;
    content.known.complaint = e.what();
  }
  return content;
}

/// What is wrong with a proxy, in a few words.
std::string complaint_of(const CheckReport& r) {
  std::string text;
  const auto add = [&](bool wrong, const std::string& what) {
    if (wrong) text += (text.empty() ? "" : ", ") + what;
  };
  add(!r.closed(), "is not closed");
  add(!r.oriented() || !r.outward(), "is not oriented outwards");
  add(!r.manifold(), "is not 2-manifold");
  add(!r.sound(), "has degenerate or repeated triangles");
  add(!r.embedded(), fmt::format("meets itself in {} places", r.self_intersections.count));
  add(r.touching.count > 0, fmt::format("is touched by {} triangles of the scene", r.touching.count));
  add(r.outside.count > 0, fmt::format("leaves {} triangles of the scene outside", r.outside.count));
  add(r.undecidable_scene.count > 0, "cannot be decided: coordinates are too large");
  return text.empty() ? "does not hold" : text;
}

bool has_cells(const Tileset& tileset) {
  bool any = false;
  for_each_tile(tileset, [&](const Tile& tile, const std::string&, const Transform&) { any = any || tile.cell; });
  return any;
}

/// The tileset as check_cover() wants it, filled depth first.
class CoverTiles {
 public:
  explicit CoverTiles(const Tileset& tileset) : up_(tileset.up) {}

  void add(const Tile& tile, const std::string& place, const Transform& transform, IndexedMesh* content) {
    CoverTile& out = tiles_.emplace_back();
    out.place = place;
    out.uri = tile.uri;
    if (content != nullptr) out.content = std::move(*content);
    if (tile.cell) out.cell = moved(*tile.cell, transform);
    places_[place] = tiles_.size() - 1;
    const std::size_t end = place.rfind(".children[");
    if (end != std::string::npos) tiles_[places_.at(place.substr(0, end))].children.push_back(tiles_.size() - 1);
  }
  [[nodiscard]] const std::vector<CoverTile>& tiles() const { return tiles_; }
  [[nodiscard]] Vec3d to_scene(const Transform& transform, const Vec3d& p) const {
    const Vec3d q = transformed(transform, p);
    return up_ == "y" ? y_up(q) : q;
  }

 private:
  [[nodiscard]] Bounds3d moved(const Bounds3d& cell, const Transform& transform) const {
    Transform turn = transform;
    for (std::size_t i = 12; i < 15; ++i) turn[i] = 0;
    if (turn != kNoTransform) fail(ErrorCode::bad_input, "a tile with a cell is turned or scaled, which is not read");
    Bounds3d out;
    for (const Vec3d& p : {cell.min, cell.max}) out.add(to_scene(transform, p));
    return out;
  }
  std::string up_;
  std::vector<CoverTile> tiles_;
  std::map<std::string, std::size_t> places_;
};

/// Each content must enclose the whole scene by itself.
void check_whole(const CoverTiles& cover, TriangleSource& scene, std::vector<std::string>& findings) {
  for (const CoverTile& tile : cover.tiles()) {
    if (!tile.content) continue;
    CheckOptions check;
    check.distances = false;
    scene.rewind();
    const CheckReport report = check_proxy(*tile.content, &scene, check);
    if (!report.holds()) findings.push_back(fmt::format("{}: {} {}", tile.place, tile.uri, complaint_of(report)));
  }
}

}  // namespace

bool is_tileset(const std::string& path) {
  return path.size() > 5 && path.compare(path.size() - 5, 5, ".json") == 0;
}

std::string TilesetVerdict::text(const std::string& name) const {
  std::string lines;
  for (const std::string& finding : findings) lines += finding + "\n";
  return lines + fmt::format("{}: {} tiles, {} contents, {} triangles{}: {}\n", name, tiles, contents, triangles,
                             scene ? ", checked against the scene" : "",
                             holds() ? "holds" : fmt::format("{} findings", findings.size()));
}

std::string TilesetVerdict::json(const std::string& name) const {
  const Json all = {{"holds", holds()},
                    {"tileset", {{"name", name}, {"tiles", tiles}, {"contents", contents}, {"triangles", triangles}}},
                    {"scene", scene},
                    {"findings", findings}};
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

TilesetVerdict check_tileset_file(const std::string& path, const std::vector<std::string>& scenes,
                                  const SceneOptions& options) {
  const Tileset tileset = read_tileset(path);
  const std::string folder = path.find('/') == std::string::npos ? "" : path.substr(0, path.rfind('/') + 1);
  TilesetVerdict verdict;
  verdict.scene = !scenes.empty();
  std::unique_ptr<TriangleSource> scene;
  if (verdict.scene) scene = open_scenes(scenes, options);
  std::vector<TileContent> contents;
  CoverTiles cover(tileset);
  for_each_tile(tileset, [&](const Tile& tile, const std::string& place, const Transform& transform) {
    ++verdict.tiles;
    if (tile.uri.empty()) return cover.add(tile, place, transform, nullptr);
    ++verdict.contents;
    Content content = read_content(folder + tile.uri, options);
    verdict.triangles += content.mesh.triangles.size();
    for (Vec3d& p : content.mesh.vertices) p = cover.to_scene(transform, p);
    cover.add(tile, place, transform, scene && content.known.found ? &content.mesh : nullptr);
    contents.push_back(std::move(content.known));
  });
  verdict.findings = check_tileset(tileset, contents);
  if (!scene) return verdict;
  if (has_cells(tileset)) {
    const std::vector<std::string> findings = check_cover(cover.tiles(), *scene);
    verdict.findings.insert(verdict.findings.end(), findings.begin(), findings.end());
  } else {
    check_whole(cover, *scene, verdict.findings);
  }
  return verdict;
}

}  // namespace bp
