#include "tools/check/tileset_verdict.h"

#include <fmt/format.h>

#include "io/tileset_file.h"
#include "lib/check/check_proxy.h"
#include "lib/check/tileset.h"
#include "lib/core/error.h"

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

TilesetVerdict check_tileset_file(const std::string& path, const std::vector<std::string>& scenes,
                                  const SceneOptions& options) {
  const Tileset tileset = read_tileset(path);
  const std::string folder = path.find('/') == std::string::npos ? "" : path.substr(0, path.rfind('/') + 1);
  TilesetVerdict verdict;
  verdict.scene = !scenes.empty();
  std::unique_ptr<TriangleSource> scene;
  if (verdict.scene) scene = open_scenes(scenes, options);
  std::vector<TileContent> contents;
  std::vector<std::string> proxies;  // findings of them
  for_each_tile(tileset, [&](const Tile& tile, const std::string& place, const Transform& transform) {
    ++verdict.tiles;
    if (tile.uri.empty()) return;
    ++verdict.contents;
    Content content = read_content(folder + tile.uri, options);
    verdict.triangles += content.mesh.triangles.size();
    if (scene && content.known.found) {
      for (Vec3d& p : content.mesh.vertices) {
        p = transformed(transform, p);
        if (tileset.up == "y") p = y_up(p);
      }
      CheckOptions check;
      check.distances = false;
      scene->rewind();
      const CheckReport report = check_proxy(content.mesh, scene.get(), check);
      if (!report.holds()) proxies.push_back(fmt::format("{}: {} {}", place, tile.uri, complaint_of(report)));
    }
    contents.push_back(std::move(content.known));
  });
  verdict.findings = check_tileset(tileset, contents);
  verdict.findings.insert(verdict.findings.end(), proxies.begin(), proxies.end());
  return verdict;
}

}  // namespace bp
