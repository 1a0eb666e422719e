#include "tools/check/cover_tiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "io/tiles/tile_content.h"
#include "io/tiles/tileset_rules.h"
#include "lib/check/counted.h"
#include "lib/check/scene_words.h"
#include "lib/core/error.h"
#include "lib/tileset/tile_tree.h"
#include "tools/cli/advice.h"

namespace bp {

namespace {

bool lies_within(const Bounds3d& inner, const Bounds3d& outer) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(inner.min[k] >= outer.min[k] && inner.max[k] <= outer.max[k])) return false;
  }
  return true;
}

}  // namespace

CoverTiles::CoverTiles(const Tileset& tileset, std::string folder, const SceneOptions& options, TilePart part)
    : tileset_(tileset), folder_(std::move(folder)), options_(options) {
  add(tileset.root, "root", nullptr);
  mine_ = tiles_of(part, tiles_);
}

bool CoverTiles::has_cells() const {
  return std::any_of(tiles_.begin(), tiles_.end(), [](const CoverTile& tile) { return tile.cell.has_value(); });
}

void CoverTiles::add(const Tile& tile, const std::string& place, const Above* above) {
  Above here;
  here.transform = above == nullptr ? tile.transform : product(above->transform, tile.transform);
  here.adds = tile.refine.empty() ? above != nullptr && above->adds : adds(tile.refine);
  here.proven = !tile.uri.empty() ? &tile : above != nullptr ? above->proven : nullptr;
  const std::optional<Bounds3d> cell = tile.cell ? std::optional(moved(*tile.cell, here.transform)) : std::nullopt;
  if (above != nullptr) {
    const std::size_t parent = cell ? joined(above->number, *cell) : above->number;
    here.number = tiles_.size();
    tiles_[parent].children.push_back(here.number);
  }
  CoverTile& out = tiles_.emplace_back();
  out.place = place;
  out.uri = tile.uri;
  out.cell = cell;
  out.error = tile.geometric_error * largest_scale(here.transform);
  out.adds = here.adds;
  if (tile.cell && tile.is_leaf && leaf_fault(tile, above == nullptr ? nullptr : above->proven).empty()) {
    out.leaf_error = tile.geometric_error;
    here.proven = above->proven;
  }
  transforms_.push_back(here.transform);
  for (std::size_t i = 0; i < tile.children.size(); ++i)
    add(tile.children[i], place + ".children[" + std::to_string(i) + "]", &here);
}

/// Returns the tile whose octant `cell` is, or that already has this octant: `parent`, or a joint below it.
std::size_t CoverTiles::joined(std::size_t parent, const Bounds3d& cell) {
  constexpr int kMostDeep = 64;
  for (int depth = 0; depth < kMostDeep && tiles_[parent].cell && tiles_[parent].cell != cell; ++depth) {
    int k = 0;
    while (k < 8 && !lies_within(cell, octant_of(*tiles_[parent].cell, k))) ++k;
    if (k == 8) break;  // check_cover() reports it
    const Bounds3d octant = octant_of(*tiles_[parent].cell, k);
    if (octant == cell) break;
    const auto [known, is_new] = joints_.try_emplace({parent, k}, tiles_.size());
    if (is_new) {
      tiles_[parent].children.push_back(tiles_.size());
      CoverTile joint;
      joint.place = tiles_[parent].place;
      joint.cell = octant;
      joint.is_joint = true;
      tiles_.push_back(std::move(joint));
      transforms_.push_back(kNoTransform);
    }
    parent = known->second;
  }
  return parent;
}

TileContent CoverTiles::look_at(const Tile& tile, ContentCounts& counts) {
  while (tiles_[next_].uri.empty()) ++next_;
  const bool mine = mine_[next_];
  CoverTile& noted = tiles_[next_++];
  TileContent known;
  known.found = !mine;
  if (!mine) {
    noted.triangles = 0;
    return known;
  }
  ++counts.contents;
  counts.leaves += noted.leaf_error.has_value();
  known.answer = Answer::undecided;
  read(content_path(folder_, tile.uri), noted, known, counts);
  return known;
}

void CoverTiles::read(const std::string& path, CoverTile& noted, TileContent& known, ContentCounts& counts) const {
  try {
    std::error_code none;  // a pipe would not end
    if (std::filesystem::exists(path, none) && !is_regular_file(path))
      fail(ErrorCode::bad_input, "{}: is no file", path);
    TileMesh content = read_tile_content(path, options_, {Affine{}, tileset_.content_up});
    noted.triangles = content.mesh.triangles.size();
    counts.triangles += content.mesh.triangles.size();
    counts.holes += content.unread.has_holes && !noted.leaf_error;
    if (content.mesh.bad_faces > 0)
      fail(ErrorCode::bad_input, "{}: {} name no three vertices", path, counted(content.mesh.bad_faces, "face"));
    known.found = true;
    known.vertices = std::move(content.mesh.vertices);
    known.not_understood = std::move(content.unread.moves);
    if (content.mesh.differing > 0) known.not_understood.push_back("it holds " + held_twice(content.mesh.differing));
    if (content.mesh.unfollowed.any())
      known.not_understood.push_back(drawn_elsewhere("content", content.mesh.unfollowed));
    if (noted.leaf_error) return;  // a leaf shows the scene itself, so its looks are not compared
    for (std::string& line : content.unread.see_through) known.not_understood.push_back(std::move(line));
  } catch (const Unfit& e) {
    known.complaint = advised(e);
  } catch (const Error& e) {
    if (e.code() != ErrorCode::bad_input) throw;
    known.complaint = advised(e);
    known.answer = Answer::refuted;
  }
}

IndexedMesh CoverTiles::content(std::size_t i) const {
  const ContentPlace place{scene_place(transforms_[i], tileset_.up), tileset_.content_up};
  return read_tile_content(content_path(folder_, tiles_[i].uri), options_, place).mesh;
}

Vec3d CoverTiles::to_scene(const Transform& transform, const Vec3d& p) const {
  return turned(transformed(transform, p), UpAxis::z, tileset_.up);
}

Bounds3d CoverTiles::moved(const Bounds3d& cell, const Transform& transform) const {
  Transform turn = transform;
  for (std::size_t i = 12; i < 15; ++i) turn[i] = 0;
  if (turn != kNoTransform) fail(ErrorCode::bad_input, "a tile with a cell is turned or scaled, which is not read");
  Bounds3d out;
  for (const Vec3d& p : {cell.min, cell.max}) out.add(to_scene(transform, p));
  return out;
}

}  // namespace bp
