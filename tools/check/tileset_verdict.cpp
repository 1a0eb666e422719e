#include "tools/check/tileset_verdict.h"

#include <fmt/format.h>

#include <map>

#include "io/tiles/tileset_file.h"
#include "lib/check/check_proxy.h"
#include "lib/check/check_tileset.h"
#include "lib/check/counted.h"
#include "lib/check/scene_words.h"
#include "lib/check/tile_cover.h"
#include "lib/core/error.h"
#include "lib/pass/voxelize/empty_scene.h"
#include "tools/cli/advice.h"
#include "tools/cli/report.h"

namespace bp {

namespace {

/// Vertices in the space of its tile.
IndexedMesh read_content(const std::string& path, const SceneOptions& options) {
  IndexedMesh mesh = read_mesh(path, options);
  for (Vec3d& p : mesh.vertices) p = turned(p, UpAxis::y, UpAxis::z);  // glTF to 3D Tiles
  return mesh;
}

/// What is wrong with a proxy, in a few words.
std::string complaint_of(const CheckReport& r) {
  std::string text;
  const auto add = [&](bool wrong, const std::string& what) {
    if (wrong) text += (text.empty() ? "" : ", ") + what;
  };
  add(r.bad_faces.count > 0, "has " + counted(r.bad_faces.count, "face") + " that cannot be read");
  add(!r.closed(), "is not closed");
  add(!r.oriented() || !r.outward(), "is not oriented outwards");
  add(!r.manifold(), "is not 2-manifold");
  add(!r.sound(), "has degenerate or repeated triangles");
  add(!r.embedded(), "meets itself in " + counted(r.self_intersections.count, "place"));
  add(r.touching.count > 0, "is touched by " + counted(r.touching.count, "triangle") + " of the scene");
  add(r.outside.count > 0, "leaves " + counted(r.outside.count, "triangle") + " of the scene outside");
  add(r.undecidable_scene.count > 0, "cannot be decided: coordinates are too large");
  add(r.differing > 0, "holds " + held_twice(r.differing));
  add(r.scene_counts.is_partial(), "cannot be decided: " + partial_scene(r.scene_counts));
  return text.empty() ? "does not hold" : text;
}

bool has_cells(const Tileset& tileset) {
  bool any = false;
  for_each_tile(tileset, [&](const Tile& tile, const std::string&, const Transform&) { any = any || tile.cell; });
  return any;
}

/// The tileset as check_cover() wants it, and where its contents lie.
class CoverTiles {
 public:
  CoverTiles(const Tileset& tileset, std::string folder, const SceneOptions& options, TilePart part)
      : up_(tileset.up), folder_(std::move(folder)), options_(options) {
    for_each_tile(tileset, [&](const Tile& tile, const std::string& place, const Transform& transform) {
      add(tile, place, transform);
    });
    mine_ = tiles_of(part, tiles_);
  }

  [[nodiscard]] const std::vector<CoverTile>& tiles() const { return tiles_; }
  [[nodiscard]] bool mine(std::size_t i) const { return mine_[i]; }
  /// For each tile with a uri, in their order: what is known of it. The number of triangles is noted, and counted. Of
  /// another part's tile, it is taken to be there: that part tells.
  [[nodiscard]] TileContent look_at(const Tile& tile, TilesetVerdict& verdict) {
    while (tiles_[next_].uri.empty()) ++next_;
    const bool mine = mine_[next_];
    CoverTile& noted = tiles_[next_++];
    if (!mine) {
      noted.triangles = 0;
      return {true, "", {}};
    }
    ++verdict.contents;
    verdict.leaves += noted.leaf_error.has_value();
    TileContent known;
    try {
      IndexedMesh mesh = read_content(folder_ + tile.uri, options_);
      noted.triangles = mesh.triangles.size();
      verdict.triangles += mesh.triangles.size();
      known.vertices = std::move(mesh.vertices);
      known.found = true;
    } catch (const Error& e) {
      if (e.code() != ErrorCode::bad_input) throw;
      known.complaint = advised(e);
    }
    return known;
  }
  /// In the coordinates of the scene.
  [[nodiscard]] IndexedMesh content(std::size_t i) const {
    IndexedMesh mesh = read_content(folder_ + tiles_[i].uri, options_);
    for (Vec3d& p : mesh.vertices) p = to_scene(transforms_[i], p);
    return mesh;
  }

 private:
  void add(const Tile& tile, const std::string& place, const Transform& transform) {
    CoverTile& out = tiles_.emplace_back();
    out.place = place;
    out.uri = tile.uri;
    if (tile.cell) out.cell = moved(*tile.cell, transform);
    transforms_.push_back(transform);
    const std::size_t number = tiles_.size() - 1, end = place.rfind(".children[");
    Place& here = places_[place] = {number, nullptr};
    if (end != std::string::npos) {
      const Place& parent = places_.at(place.substr(0, end));
      tiles_[parent.number].children.push_back(number);
      here.proven = parent.proven;
    }
    if (tile.cell && tile.is_leaf && leaf_fault(tile, here.proven).empty()) {
      tiles_[number].leaf_error = tile.geometric_error;
    } else if (!tile.uri.empty()) {
      here.proven = &tile;
    }
  }
  [[nodiscard]] Vec3d to_scene(const Transform& transform, const Vec3d& p) const {
    return turned(transformed(transform, p), UpAxis::z, up_);
  }
  [[nodiscard]] Bounds3d moved(const Bounds3d& cell, const Transform& transform) const {
    Transform turn = transform;
    for (std::size_t i = 12; i < 15; ++i) turn[i] = 0;
    if (turn != kNoTransform) fail(ErrorCode::bad_input, "a tile with a cell is turned or scaled, which is not read");
    Bounds3d out;
    for (const Vec3d& p : {cell.min, cell.max}) out.add(to_scene(transform, p));
    return out;
  }

  const UpAxis up_;
  const std::string folder_;
  const SceneOptions& options_;
  std::vector<CoverTile> tiles_;
  std::vector<bool> mine_;  ///< tiles of this part
  std::vector<Transform> transforms_;
  struct Place {
    std::size_t number = 0;
    const Tile* proven = nullptr;  ///< with content: itself, or the nearest above
  };
  std::map<std::string, Place> places_;
  std::size_t next_ = 0;  ///< tile to look for a uri at
};

/// Each content must enclose the whole scene by itself.
std::vector<CoverFinding> check_whole(const CoverTiles& cover, TriangleSource& scene) {
  std::vector<CoverFinding> findings;
  for (std::size_t i = 0; i < cover.tiles().size(); ++i) {
    const CoverTile& tile = cover.tiles()[i];
    if (!tile.triangles || !cover.mine(i)) continue;
    CheckOptions check;
    check.distances = false;
    scene.rewind();
    const CheckReport report = check_proxy(cover.content(i), &scene, check);
    if (report.holds()) continue;
    findings.push_back({fmt::format("{}: {} {}", tile.place, tile.uri, complaint_of(report)), report.answer()});
  }
  return findings;
}

/// Of a whole reading. Where nothing of the tileset is drawn, none was made.
SceneCounts counts_of(TriangleSource& scene) {
  if (!scene.counts().has_area()) {
    scene.rewind();
    for (std::vector<TriangleD> chunk; scene.read(chunk);) continue;
  }
  if (!scene.counts().has_area()) refuse_empty_scene(scene.name(), scene.counts());
  return scene.counts();
}

}  // namespace

bool is_tileset(const std::string& path) {
  return path.size() > 5 && path.compare(path.size() - 5, 5, ".json") == 0;
}

std::string TilesetVerdict::doubt() const {
  return undecided > 0 ? counted(undecided, "finding") : partial_scene(scene_counts);
}

Json TilesetVerdict::part_json() const {
  if (part.of == 1) return nullptr;
  return {{"number", part.number + 1}, {"of", part.of}};
}

std::string TilesetVerdict::text(const std::string& name) const {
  std::string lines;
  for (const std::string& finding : findings) lines += finding + "\n";
  if (scene && leaves > 0)
    lines += fmt::format("{}: {} of the contents enclose nothing: they must be the scene itself, to within {:.3g}\n",
                         name, leaves, tolerance);
  if (scene) lines += left_out_lines(scene_counts, name + ": of the scene, ");
  if (thin > 0)
    lines += fmt::format("{}: of {} thin parts of the scene only the corners were looked for\n", name, thin);
  if (flat > 0) lines += fmt::format("{}: {} parts of the scene that rounding flattens may be missing\n", name, flat);
  const std::string which = part.of == 1 ? "" : fmt::format("part {} of {}: ", part.number + 1, part.of);
  return lines + fmt::format("{}: {}{}, {}, {}{}: {}\n", name, which, counted(tiles, "tile"),
                             counted(contents, "content"), counted(triangles, "triangle"),
                             contents == 0 && part.of > 1 ? ", none of the contents is in this part"
                             : scene                      ? ", checked against the scene"
                                                          : "",
                             holds()                         ? "holds"
                             : answer() == Answer::undecided ? "not decided: " + doubt()
                                                             : counted(findings.size(), "finding"));
}

std::string TilesetVerdict::json(const std::string& name) const {
  const Json all = {
      {"holds", holds()},
      {"answer", to_string(answer())},
      {"tileset",
       {{"name", name}, {"tiles", tiles}, {"contents", contents}, {"leaves", leaves}, {"triangles", triangles}}},
      {"part", part_json()},
      {"scene", scene},
      {"skipped", {{"non_finite", scene_counts.non_finite}, {"bad_faces", scene_counts.bad_faces}}},
      {"differing", scene_counts.differing},
      {"tolerance", scene && leaves > 0 ? Json(tolerance) : Json(nullptr)},
      {"thin", thin},
      {"flat", flat},
      {"findings", findings}};
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

TilesetVerdict check_tileset_file(const std::string& path, const std::vector<std::string>& scenes,
                                  const SceneOptions& options, std::uint64_t memory_bytes, TilePart part) {
  const Tileset tileset = read_tileset(path);
  const std::string folder = path.find('/') == std::string::npos ? "" : path.substr(0, path.rfind('/') + 1);
  TilesetVerdict verdict;
  verdict.scene = !scenes.empty();
  std::unique_ptr<TriangleSource> scene;
  if (verdict.scene) scene = open_scenes(scenes, options);
  CoverTiles cover(tileset, folder, options, part);
  verdict.tiles = cover.tiles().size();
  verdict.part = part;
  verdict.findings = check_tileset(tileset, [&](const Tile& tile) { return cover.look_at(tile, verdict); });
  if (!scene) return verdict;
  const auto content = [&](std::size_t i) { return cover.content(i); };
  const CoverReport report = has_cells(tileset) ? check_cover(cover.tiles(), content, *scene, memory_bytes, part)
                                                : CoverReport{check_whole(cover, *scene)};
  verdict.scene_counts = counts_of(*scene);
  verdict.tolerance = 3 * report.leaf_error;
  verdict.thin = report.thin;
  verdict.flat = report.flat;
  for (const CoverFinding& found : report.findings) {
    verdict.findings.push_back(found.text);
    verdict.undecided += found.answer == Answer::undecided;
  }
  return verdict;
}

}  // namespace bp
