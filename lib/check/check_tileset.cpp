#include "lib/check/check_tileset.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/check/tile_volumes.h"

namespace bp {

namespace {

constexpr double kLeafError = 0x1p-22;  // of the edge of a cell; float32 rounds by a quarter of that

bool has_content(const Tile& tile) {
  return !tile.uri.empty() || std::any_of(tile.children.begin(), tile.children.end(), has_content);
}

/// A tile and its place in the tileset.
struct TilePlace {
  std::string path;
  Transform transform;          ///< to the tileset's space
  const Tile* above = nullptr;  ///< the nearest tile above that has content

  [[nodiscard]] double error_of(const Tile& tile) const { return tile.geometric_error * largest_scale(transform); }
};

class Checker {
 public:
  Checker(const Tileset& tileset, const TileContents& content_of) : tileset_(tileset), content_of_(content_of) {}

  std::vector<TileFinding> run() {
    for (const std::string& line : tileset_.not_understood) doubt("{}", line);
    if (tileset_.version != "1.0" && tileset_.version != "1.1")
      doubt("asset.version is \"{}\"; this checks 1.0 and 1.1", tileset_.version);
    if (!usable(tileset_.geometric_error)) say("tileset: geometricError {} is no length", tileset_.geometric_error);
    if (tileset_.root.refine.empty()) say("root: has no 'refine', and nothing to inherit it from");
    if (!has_content(tileset_.root)) say("tileset: has no content, so nothing is drawn");
    if (const auto& placement = tileset_.placement; placement && !(placement->off <= kPlacedToWithin))
      say("root: its transform is {:.3g} m off the place where the tileset says that it stands", placement->off);
    const TilePlace root{"root", tileset_.root.transform};
    if (tileset_.geometric_error < root.error_of(tileset_.root))
      say("tileset: geometricError {} is below the root's {}", tileset_.geometric_error, root.error_of(tileset_.root));
    check(tileset_.root, root);
    return std::move(findings_);
  }

 private:
  template <class... Args>
  void say(fmt::format_string<Args...> format, Args&&... args) {
    findings_.push_back({fmt::format(format, std::forward<Args>(args)...)});
  }
  template <class... Args>
  void doubt(fmt::format_string<Args...> format, Args&&... args) {
    findings_.push_back({fmt::format(format, std::forward<Args>(args)...), Answer::undecided});
  }
  static bool usable(double error) { return std::isfinite(error) && error >= 0; }

  void check(const Tile& tile, const TilePlace& place) {
    const std::string& path = place.path;
    if (!usable(tile.geometric_error)) say("{}: geometricError {} is no length", path, tile.geometric_error);
    if (!tile.refine.empty() && tile.refine != "ADD" && tile.refine != "REPLACE")
      say("{}: refine is \"{}\", neither ADD nor REPLACE", path, tile.refine);
    if (tile.uri.empty() && !tile.children.empty() && tile.geometric_error == 0)
      say("{}: draws nothing, and geometricError 0 keeps viewers from the tiles below it", path);
    const bool is_round = tile.volume.sphere || (tile.content_volume && tile.content_volume->sphere);
    if (is_round && !keeps_spheres(place.transform))
      doubt("{}: has a sphere, and transforms that do not keep it one", path);
    if (const std::string fault = tile.is_leaf ? leaf_fault(tile, place.above) : ""; !fault.empty())
      say("{}: extras.leaf is true, but {}", path, fault);
    if (!tile.uri.empty()) check_content(tile, path);
    for (std::size_t i = 0; i < tile.children.size(); ++i)
      check_child(tile, place, tile.children[i], path + ".children[" + std::to_string(i) + "]");
  }

  void check_content(const Tile& tile, const std::string& path) {
    const TileContent content = content_of_(tile);
    for (const std::string& what : content.not_understood) doubt("{}: {}: {}", path, tile.uri, what);
    if (!content.found)
      return findings_.push_back(
          {fmt::format("{}: content {}: {}", path, tile.uri, content.complaint), content.answer});
    check_volume(tile.volume, "volume", tile, content, path);
    if (tile.content_volume) check_volume(*tile.content_volume, "content.boundingVolume", tile, content, path);
  }

  void check_volume(const TileVolume& volume, const char* name, const Tile& tile, const TileContent& content,
                    const std::string& path) {
    const VolumeProof proof(volume);
    std::uint64_t outside = 0;
    double worst = 0;
    for (const Vec3d& p : content.vertices) {
      if (proof.holds(p)) continue;
      ++outside;
      worst = std::max(worst, beyond(volume, p));
    }
    if (outside > 0)
      say("{}: {} of {} vertices of {} lie outside the tile's {}, by up to {:.3g} of its half-length", path, outside,
          content.vertices.size(), tile.uri, name, worst);
  }

  void check_child(const Tile& parent, const TilePlace& place, const Tile& child, const std::string& path) {
    const TilePlace below{path, product(place.transform, child.transform), parent.uri.empty() ? place.above : &parent};
    if (below.error_of(child) > place.error_of(parent))
      say("{}: geometricError {} is above its parent's {}", path, below.error_of(child), place.error_of(parent));
    if (!VolumeProof(parent.volume).holds(child.volume, child.transform)) {
      double worst = 0;
      if (child.volume.box) {
        for (const Vec3d& corner : child.volume.box->corners())
          worst = std::max(worst, beyond(parent.volume, transformed(child.transform, corner)));
      }
      say("{}: its volume reaches out of its parent's, by {:.3g} of the half-length of that", path, worst);
    }
    check(child, below);
  }

  const Tileset& tileset_;
  const TileContents& content_of_;
  std::vector<TileFinding> findings_;
};

}  // namespace

std::string leaf_fault(const Tile& leaf, const Tile* above) {
  if (!leaf.children.empty()) return "it has children";
  if (above == nullptr || above->is_leaf || !above->cell) return "no proven tile lies above it";
  if (!(leaf.geometric_error < above->geometric_error))
    return fmt::format("its geometricError {} is not below the {} of the proven tile above it", leaf.geometric_error,
                       above->geometric_error);
  const double most = kLeafError * above->cell->longest_side();
  if (leaf.geometric_error > most)
    return fmt::format("its geometricError {} is more than rounding, {:.3g}", leaf.geometric_error, most);
  return "";
}

std::vector<TileFinding> check_tileset(const Tileset& tileset, const TileContents& content_of) {
  return Checker(tileset, content_of).run();
}

}  // namespace bp
