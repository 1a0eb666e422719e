#include "lib/quads/detail/cells.h"

#include "lib/surface/repair.h"

namespace bp {

namespace {

/// Does one round of repairs. The cells are their own mirror image before and after it.
bool repair_once(Grid& cells, int mirrored_axis, std::int32_t last) {
  std::vector<VoxelCoord> added;
  VoxelBox blocks = cells.box();
  blocks.max = blocks.max - VoxelCoord{1, 1, 1};
  const auto corner = [](const VoxelCoord& p, int i) { return p + VoxelCoord{i & 1, (i >> 1) & 1, i >> 2}; };
  for_each(blocks, [&](const VoxelCoord& p) {
    Corner block = 0;
    for (int i = 0; i < 8; ++i) block = Corner(block | (cells.at(corner(p, i)) ? 1 << i : 0));
    const Corner more = corner_repair(block);
    for (int i = 0; i < 8; ++i) {
      if (more >> i & 1) added.push_back(corner(p, i));
    }
  });
  for (VoxelCoord p : added) {
    cells.at(p) = 1;
    if (mirrored_axis < 0) continue;
    p[mirrored_axis] = last - p[mirrored_axis];
    cells.at(p) = 1;
  }
  return !added.empty();
}

std::uint64_t count(const Grid& cells) {
  std::uint64_t n = 0;
  for_each(cells.box(), [&](const VoxelCoord& p) { n += cells.at(p) != 0; });
  return n;
}

}  // namespace

void fill(Grid& cells) {
  constexpr char kOutside = 2;
  std::vector<VoxelCoord> stack{cells.box().min};
  cells.at(stack.back()) = kOutside;
  while (!stack.empty()) {
    const VoxelCoord p = stack.back();
    stack.pop_back();
    for_each_neighbour(p, [&](const VoxelCoord& q, int, bool) {
      if (!cells.box().contains(q) || cells.at(q)) return;
      cells.at(q) = kOutside;
      stack.push_back(q);
    });
  }
  for_each(cells.box(), [&](const VoxelCoord& p) { cells.at(p) = cells.at(p) != kOutside; });
}

Size size_of(const BoxGrid& cells) {
  Size size;
  for_each(cells.box(), [&](const VoxelCoord& p) {
    if (!cells.solid.at(p)) return;
    const Vec3d t{double(cells.thickness(0, p.x)), double(cells.thickness(1, p.y)), double(cells.thickness(2, p.z))};
    size.volume += t[0] * t[1] * t[2];
    for_each_neighbour(p, [&](const VoxelCoord& q, int axis, bool) {
      if (cells.solid.at(q)) return;
      size.faces += 2;
      size.area += t[std::size_t((axis + 1) % 3)] * t[std::size_t((axis + 2) % 3)];
    });
  });
  return size;
}

void mend(BoxGrid& cells, const std::optional<MirrorPlane>& plane) {
  for (std::uint64_t before = 0; before != count(cells.solid);) {
    before = count(cells.solid);
    const std::int32_t last = plane ? cells.box().max[plane->axis] - 1 : 0;
    while (repair_once(cells.solid, plane ? plane->axis : -1, last)) continue;
    fill(cells.solid);
  }
}

}  // namespace bp
