#include "tools/check/tileset_verdict.h"

#include <fmt/format.h>

#include "lib/check/check_proxy.h"
#include "lib/check/counted.h"
#include "lib/check/scene_words.h"
#include "lib/check/tile_drawn.h"
#include "lib/core/error.h"
#include "lib/geometry/triangle_totals.h"
#include "lib/pass/voxelize/empty_scene.h"
#include "tools/check/cover_tiles.h"
#include "tools/place/place.h"

namespace bp {

namespace {

/// Returns the faults of a proxy in a few words.
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
  add(r.pairs_open(), "cannot be decided: too many triangles lie side by side");
  add(r.self_intersections.count > 0, std::string("meets itself in ") +
                                          (r.self_intersections.at_least ? "at least " : "") +
                                          counted(r.self_intersections.count, "place"));
  add(r.touching.count > 0, "is touched by " + counted(r.touching.count, "triangle") + " of the scene");
  add(r.outside.count > 0, "leaves " + counted(r.outside.count, "triangle") + " of the scene outside");
  add(r.within_rounding.count > 0, "cannot be decided: it is as near to " +
                                       counted(r.within_rounding.count, "triangle") +
                                       " of the scene as coordinates may be off");
  add(r.undecidable_scene.count > 0, "cannot be decided: coordinates are too large");
  add(r.differing > 0, "holds " + held_twice(r.differing));
  add(r.scene_counts.is_partial(), "cannot be decided: " + partial_scene(r.scene_counts));
  return text.empty() ? "does not hold" : text;
}

/// Checks that each content encloses the whole scene by itself.
std::vector<TileFinding> check_whole(const CoverTiles& cover, TriangleSource& scene) {
  std::vector<TileFinding> findings;
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

/// Checks what the contents enclose, and whether a viewer draws them.
CoverReport check_scene(const CoverTiles& cover, const Tileset& tileset, TriangleSource& scene, const Bounds3d& bounds,
                        std::uint64_t memory_bytes, TilePart part) {
  // Some viewers scale the tileset's own error by the root, others do not.
  const double error = tileset.geometric_error * std::min(1.0, largest_scale(tileset.root.transform));
  std::vector<TileFinding> findings = check_drawn(cover.tiles(), error, bounds);
  const auto content = [&](std::size_t i) { return cover.content(i); };
  CoverReport report = cover.has_cells() ? check_cover(cover.tiles(), content, scene, memory_bytes, part)
                                         : CoverReport{check_whole(cover, scene)};
  report.findings.insert(report.findings.begin(), findings.begin(), findings.end());
  return report;
}

/// Sets options.map as the tileset's placement asks. Returns false, with a finding, if that cannot be done here.
bool can_be_placed(const Tileset& tileset, const std::vector<std::string>& scenes, SceneOptions& options,
                   TilesetVerdict& verdict) {
  if (!tileset.placement) return true;
  try {
    options.map = map_of(*tileset.placement, scenes, options);
    return true;
  } catch (const Error& e) {
    if (e.code() != ErrorCode::failed && e.code() != ErrorCode::bad_argument) throw;
    verdict.add({{std::string("placement: the scene was not compared: ") + e.what(), Answer::undecided}});
    return false;
  }
}

Json json_of(const Placement& placement) {
  const GlobePlace& place = placement.place;
  return {{"place", {place.lon, place.lat, place.height}},
          {"crs", placement.crs.empty() ? Json(nullptr) : Json(placement.crs)},
          {"off", placement.off}};
}

/// Returns where a tileset stands.
std::string placement_line(const Placement& placement) {
  const Vec3d& p = placement.at;
  return fmt::format("its {} stands at {}{}{}",
                     p == Vec3d{} ? "origin" : fmt::format("point {},{},{}", p[0], p[1], p[2]),
                     place_text(placement.place), placement.off <= kPlacedToWithin ? ", to a millimetre" : "",
                     placement.crs.empty() ? "" : "; its scene is in " + placement.crs);
}

}  // namespace

bool is_tileset(const std::string& path) {
  return path.size() > 5 && path.compare(path.size() - 5, 5, ".json") == 0;
}

std::string TilesetVerdict::doubt() const {
  return undecided > 0 ? counted(undecided, "finding") : partial_scene(scene_counts);
}

void TilesetVerdict::add(const std::vector<TileFinding>& found) {
  for (const TileFinding& finding : found) {
    findings.push_back(finding.text);
    undecided += finding.answer == Answer::undecided;
  }
}

Json TilesetVerdict::part_json() const {
  if (part.of == 1) return nullptr;
  return {{"number", part.number + 1}, {"of", part.of}};
}

std::string TilesetVerdict::text(const std::string& file) const {
  const std::string name = one_line(file);
  std::string lines;
  for (const std::string& finding : findings) lines += one_line(finding) + "\n";
  if (scene && up != UpAxis::z)
    lines += fmt::format("{}: says that {} is up in the scene, and is compared so\n", name, name_of(up));
  if (scene && leaves > 0)
    lines += fmt::format("{}: {} of the contents enclose nothing: they must be the scene itself, to within {:.3g}\n",
                         name, leaves, tolerance);
  if (scene) lines += left_out_lines(scene_counts, name + ": of the scene, ");
  if (thin > 0)
    lines += fmt::format("{}: of {} thin parts of the scene only the corners were looked for\n", name, thin);
  if (holes > 0)
    lines += fmt::format("{}: images of {} may cut holes, which are not looked at\n", name, counted(holes, "content"));
  if (flat > 0) lines += fmt::format("{}: {} parts of the scene that rounding flattens may be missing\n", name, flat);
  if (placement) lines += fmt::format("{}: {}\n", name, one_line(placement_line(*placement)));
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
      {"up", name_of(up)},
      {"tolerance", scene && leaves > 0 ? Json(tolerance) : Json(nullptr)},
      {"thin", thin},
      {"flat", flat},
      {"holes", holes},
      {"placement", placement ? json_of(*placement) : Json(nullptr)},
      {"findings", findings}};
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

TilesetVerdict check_tileset_file(const Tileset& tileset, const std::string& path,
                                  const std::vector<std::string>& scenes, SceneOptions& options,
                                  std::uint64_t memory_bytes, TilePart part) {
  const std::string folder = path.find('/') == std::string::npos ? "" : path.substr(0, path.rfind('/'));
  TilesetVerdict verdict;
  verdict.placement = tileset.placement;
  verdict.scene = !scenes.empty() && can_be_placed(tileset, scenes, options, verdict);
  std::unique_ptr<TriangleSource> scene;
  if (verdict.scene) scene = open_scenes(scenes, options);
  CoverTiles cover(tileset, folder, options, part);
  verdict.tiles = cover.tiles_of_file();
  verdict.part = part;
  verdict.up = tileset.up;
  ContentCounts counts;
  verdict.add(check_tileset(tileset, [&](const Tile& tile) { return cover.look_at(tile, counts); }));
  verdict.contents = counts.contents, verdict.leaves = counts.leaves;
  verdict.triangles = counts.triangles, verdict.holes = counts.holes;
  if (!scene) return verdict;
  const Bounds3d bounds = bounds_of(*scene);
  verdict.scene_counts = scene->counts().of_enclosed();
  if (!verdict.scene_counts.has_area()) refuse_empty_scene(scene->name(), verdict.scene_counts);
  const CoverReport report = check_scene(cover, tileset, *scene, bounds, memory_bytes, part);
  verdict.tolerance = 3 * report.leaf_error;
  verdict.thin = report.thin;
  verdict.flat = report.flat;
  verdict.add(report.findings);
  return verdict;
}

}  // namespace bp
