#include "lib/check/check_tileset.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/vec3.h"

namespace bp {

namespace {

constexpr double kSlack = 1e-9;         // of the size of a box
constexpr double kLeafError = 0x1p-22;  // of the edge of a cell; float32 rounds by a quarter of that

/// How far p lies outside of the box along one of its axes, in half-lengths of that axis beyond 1; 0 inside. A flat box
/// has a thickness of nothing.
double beyond(const TileBox& box, const Vec3d& p) {
  double worst = 0;
  const Vec3d d{p[0] - box.centre[0], p[1] - box.centre[1], p[2] - box.centre[2]};
  for (std::size_t i = 0; i < 3; ++i) {
    // Coordinates along half-axes that need not be orthogonal: Cramer's rule.
    const Vec3d n = cross(box.axes[(i + 1) % 3], box.axes[(i + 2) % 3]);
    const double height = dot(box.axes[i], n);
    const double along = height != 0 ? std::abs(dot(d, n) / height) : std::abs(dot(d, n)) > 0 ? HUGE_VAL : 0;
    worst = std::max(worst, along - 1);
  }
  return worst;
}

class Checker {
 public:
  Checker(const Tileset& tileset, const TileContents& content_of) : tileset_(tileset), content_of_(content_of) {}

  std::vector<std::string> run() {
    if (tileset_.version != "1.1") say("asset.version is \"{}\"; this checks 1.1", tileset_.version);
    if (!usable(tileset_.geometric_error)) say("tileset: geometricError {} is no length", tileset_.geometric_error);
    if (tileset_.root.refine.empty()) say("root: has no 'refine', and nothing to inherit it from");
    if (tileset_.geometric_error < tileset_.root.geometric_error)
      say("tileset: geometricError {} is below the root's {}", tileset_.geometric_error, tileset_.root.geometric_error);
    check(tileset_.root, "root", nullptr);
    return std::move(findings_);
  }

 private:
  template <class... Args>
  void say(fmt::format_string<Args...> format, Args&&... args) {
    findings_.push_back(fmt::format(format, std::forward<Args>(args)...));
  }
  static bool usable(double error) { return std::isfinite(error) && error >= 0; }

  /// `above`: the nearest tile above with content.
  void check(const Tile& tile, const std::string& path, const Tile* above) {
    if (!usable(tile.geometric_error)) say("{}: geometricError {} is no length", path, tile.geometric_error);
    if (!tile.refine.empty() && tile.refine != "ADD" && tile.refine != "REPLACE")
      say("{}: refine is \"{}\", neither ADD nor REPLACE", path, tile.refine);
    if (const std::string fault = tile.is_leaf ? leaf_fault(tile, above) : ""; !fault.empty())
      say("{}: extras.leaf is true, but {}", path, fault);
    if (!tile.uri.empty()) {
      check_content(tile, path);
      above = &tile;
    }
    for (std::size_t i = 0; i < tile.children.size(); ++i)
      check_child(tile, tile.children[i], path + ".children[" + std::to_string(i) + "]", above);
  }

  void check_content(const Tile& tile, const std::string& path) {
    const TileContent content = content_of_(tile);
    if (!content.found) return say("{}: content {}: {}", path, tile.uri, content.complaint);
    if (!tile.box) return;
    std::uint64_t outside = 0;
    double worst = 0;
    for (const Vec3d& p : content.vertices) {
      const double by = beyond(*tile.box, p);
      outside += by > kSlack;
      worst = std::max(worst, by);
    }
    if (outside > 0)
      say("{}: {} of {} vertices of {} lie outside the tile's box, by up to {:.3g} of its half-length", path, outside,
          content.vertices.size(), tile.uri, worst);
  }

  void check_child(const Tile& parent, const Tile& child, const std::string& path, const Tile* above) {
    if (child.geometric_error > parent.geometric_error)
      say("{}: geometricError {} is above its parent's {}", path, child.geometric_error, parent.geometric_error);
    if (parent.box && child.box) {
      double worst = 0;
      for (const Vec3d& corner : child.box->corners())
        worst = std::max(worst, beyond(*parent.box, transformed(child.transform, corner)));
      if (worst > kSlack)
        say("{}: its box reaches out of its parent's, by {:.3g} of the half-length of that", path, worst);
    }
    check(child, path, above);
  }

  const Tileset& tileset_;
  const TileContents& content_of_;
  std::vector<std::string> findings_;
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

std::vector<std::string> check_tileset(const Tileset& tileset, const TileContents& content_of) {
  return Checker(tileset, content_of).run();
}

}  // namespace bp
