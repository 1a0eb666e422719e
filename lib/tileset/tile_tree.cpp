#include "lib/tileset/tile_tree.h"

#include <algorithm>

#include "lib/core/vec3.h"
#include "lib/volume/reduce.h"

namespace bp {

namespace {

/// Returns bounds relative to `origin`, in 3D Tiles' axes, where z is up. Exact, since both are points of a lattice.
Bounds3d local(const Bounds3d& bounds, const Vec3d& origin, UpAxis up) {
  Bounds3d out;
  for (const Vec3d& p : {bounds.min, bounds.max}) out.add(turned(p - origin, up, UpAxis::z));
  return out;
}

}  // namespace

Tile tile_at(const TreeTile& tile, const Vec3d& parent, UpAxis up) {
  Tile out;
  const Vec3d from = turned(parent, up, UpAxis::z), to = turned(tile.origin, up, UpAxis::z);
  for (std::size_t i = 0; i < 3; ++i) out.transform[12 + i] = to[i] - from[i];
  out.volume.box = box_of(local(tile.bounds, tile.origin, up));
  out.geometric_error = tile.error_world;
  out.uri = tile.uri;
  return out;
}

Tileset tileset_of(Tile root, double diameter, UpAxis up, const std::optional<Placement>& placement) {
  Tileset tileset;
  tileset.up = up;
  tileset.placement = placement;
  if (placement) tileset.placement->at = turned(placement->at, up, UpAxis::z);
  tileset.root = std::move(root);
  tileset.root.refine = "REPLACE";
  tileset.geometric_error = std::max(diameter, tileset.root.geometric_error);
  return tileset;
}

Vec3d middle_of(const Bounds3d& box) {
  Vec3d middle;
  for (std::size_t i = 0; i < 3; ++i) middle[i] = box.min[i] + (box.max[i] - box.min[i]) / 2;
  return middle;
}

Bounds3d cell_bounds(const Cells& cells, const GridFrame& frame, CellCoord cell) {
  const VoxelBox box = cells.box(cell);
  Bounds3d bounds;
  for (const VoxelCoord p : {box.min, box.max}) {
    bounds.add(frame.world({std::int64_t(p.x) * kLatticePerVoxel, std::int64_t(p.y) * kLatticePerVoxel,
                            std::int64_t(p.z) * kLatticePerVoxel}));
  }
  return bounds;
}

Bounds3d octant_of(const Bounds3d& box, int k) {
  Bounds3d out = box;
  const Vec3d middle = middle_of(box);
  for (std::size_t i = 0; i < 3; ++i) ((k >> i & 1) != 0 ? out.min[i] : out.max[i]) = middle[i];
  return out;
}

void TileTree::add(std::size_t level, const GridFrame& frame, CellCoord cell, TreeTile tile) {
  if (level != number_) {  // the level below is complete
    raise();
    number_ = level;
  }
  frame_ = frame;
  Node& node = level_[cell];  // its children may be there already
  node.cell = cell_bounds(cells_, frame, cell);
  for (const Node& child : node.children) {
    tile.error_world = std::max(tile.error_world, child.tile.error_world);
    tile.bounds.merge(child.tile.bounds);
  }
  node.tile = std::move(tile);
  errors_.resize(level + 1);
  errors_[level] = std::max(errors_[level], node.tile.error_world);
}

void TileTree::add_leaf(const GridFrame& frame, CellCoord cell, TileLeaf leaf) {
  frame_ = frame;
  Node* node = &level_[cell];
  if (!node->cell) {
    node->cell = cell_bounds(cells_, frame_, cell);
    node->tile.origin = leaf.tile.origin;
  }
  node->tile.bounds.merge(leaf.tile.bounds);
  for (const char digit : leaf.path) {
    const Bounds3d octant = octant_of(*node->cell, digit - '0');
    const auto found = std::find_if(node->children.begin(), node->children.end(),
                                    [&](const Node& child) { return child.cell == octant; });
    if (found == node->children.end()) {
      Node child;
      child.tile.origin = node->tile.origin;
      child.cell = octant;
      node->children.push_back(std::move(child));
      node = &node->children.back();
    } else {
      node = &*found;
    }
    node->tile.bounds.merge(leaf.tile.bounds);
  }
  Node end;
  end.tile = std::move(leaf.tile);
  end.cell = leaf.cell;
  end.is_leaf = true;
  leaf_error_ = std::max(leaf_error_.value_or(0), end.tile.error_world);
  if (leaf.path.empty()) {
    node->children.push_back(std::move(end));
  } else {
    *node = std::move(end);
  }
}

/// Adds the cells above those of the level, with their contents. A cell above that gets no tile of its own has a node
/// without content.
void TileTree::raise() {
  frame_ = reduced(frame_);
  Level above;
  for (auto& [cell, node] : level_) {
    Node& parent = above[parent_of(cell)];
    if (parent.children.empty()) {
      parent.cell = cell_bounds(cells_, frame_, parent_of(cell));
      parent.tile.origin = node.tile.origin;
    }
    parent.tile.bounds.merge(node.tile.bounds);
    parent.tile.error_world = std::max(parent.tile.error_world, node.tile.error_world);
    parent.children.push_back(std::move(node));
  }
  level_ = std::move(above);
}

void TileTree::add_whole(TreeTile tile) {
  Node node;
  if (root_) {
    node.cell = root_->cell;
    node.children.push_back(std::move(*root_));
  } else if (!level_.empty()) {
    do raise();  // up to the one cell that holds everything, if need be by nodes without content
    while (level_.size() > 1);
    node.cell = level_.begin()->second.cell;
    node.children = std::move(level_.begin()->second.children);
  }
  for (const Node& child : node.children) {
    tile.error_world = std::max(tile.error_world, child.tile.error_world);
    tile.bounds.merge(child.tile.bounds);
  }
  errors_.push_back(tile.error_world);
  node.tile = std::move(tile);
  root_ = std::move(node);
}

Tileset TileTree::finish(double diameter, const std::optional<Placement>& placement) {
  while (!root_) {  // without a level in one mesh, nodes without content are on top
    if (level_.size() == 1) {
      root_ = std::move(level_.begin()->second);
    } else {
      raise();
    }
  }
  return tileset_of(tile_of(*root_, Vec3d{}, diameter), diameter, up_, placement);
}

/// Makes the tile of a node. `above`: the error of the tile above. A node without content draws nothing, so a viewer
/// must not stop there. Above all contents its error is that of drawing nothing. Below a content there is no such node:
/// a viewer may be so far from it, and so near to the tile above, that it refines only that one.
Tile TileTree::tile_of(const Node& node, const Vec3d& parent, double above) const {
  Tile tile = tile_at(node.tile, parent, up_);
  if (node.cell) tile.cell = local(*node.cell, node.tile.origin, up_);
  if (node.tile.uri.empty()) tile.geometric_error = above;
  tile.is_leaf = node.is_leaf;
  for (const Node* child : nodes_below(node))
    tile.children.push_back(tile_of(*child, node.tile.origin, tile.geometric_error));
  if (leaf_error_ && node.children.empty() && !node.is_leaf) {
    Tile& nothing = tile.children.emplace_back();
    nothing.volume = tile.volume;
    nothing.cell = tile.cell;
    nothing.geometric_error = *leaf_error_;
    nothing.is_leaf = true;
  }
  return tile;
}

/// Returns the tiles below a node. Below a content they are the nearest ones that draw something, or end there.
std::vector<const TileTree::Node*> TileTree::nodes_below(const Node& node) {
  std::vector<const Node*> below;
  const auto add = [&](const Node& above, const auto& again) -> void {
    for (const Node& child : above.children) {
      const bool is_passed = !node.tile.uri.empty() && child.tile.uri.empty() && !child.children.empty();
      is_passed ? again(child, again) : below.push_back(&child);
    }
  };
  add(node, add);
  return below;
}

}  // namespace bp
