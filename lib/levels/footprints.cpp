#include "lib/levels/footprints.h"

#include <algorithm>

#include "lib/grid/brick_voxels.h"
#include "lib/pass/mesh/complement.h"

namespace bp {

namespace {

constexpr std::int32_t kHighest = std::int32_t(1) << 30;  // above all voxels

/// The columns of a scene, and the part that each belongs to.
class Columns {
 public:
  Columns(const VoxelBox& box, int up) : box_(box), up_(up) {
    box_.min[up] = 0, box_.max[up] = 1;
    part_.assign(std::size_t(box_.volume()), kEmpty);
  }
  void add(VoxelCoord p) { part_[index_of(p)] = kOpen; }

  /// Returns the parts, without their heights and what they hide.
  [[nodiscard]] std::vector<Footprint> parts() {
    std::vector<Footprint> all;
    for_each(box_, [&](VoxelCoord p) {
      if (part_[index_of(p)] != kOpen) return;
      all.push_back(flood(p, std::uint32_t(all.size())));
    });
    return all;
  }
  /// Returns the number of the part that holds a voxel, or of none if it is too large.
  [[nodiscard]] std::uint32_t part_of(VoxelCoord p) const { return part_[index_of(p)]; }

 private:
  static constexpr std::uint32_t kEmpty = ~std::uint32_t(0), kOpen = kEmpty - 1;

  Footprint flood(VoxelCoord first, std::uint32_t number) {
    Footprint part;
    std::vector<VoxelCoord> left{first};
    part_[index_of(first)] = number;
    while (!left.empty()) {
      const VoxelCoord p = left.back();
      left.pop_back();
      ++part.columns;
      const VoxelBox own{p, {p.x + 1, p.y + 1, p.z + 1}};
      part.box = hull(part.box, own);
      for_each(intersect(own.grown(1), box_), [&](VoxelCoord q) {
        if (part_[index_of(q)] != kOpen) return;
        part_[index_of(q)] = number;
        left.push_back(q);
      });
    }
    return part;
  }

  [[nodiscard]] std::size_t index_of(VoxelCoord p) const {
    const int u = up_ == 0 ? 1 : 0, v = up_ == 2 ? 1 : 2;
    return std::size_t(p[v] - box_.min[v]) * std::size_t(box_.max[u] - box_.min[u]) + std::size_t(p[u] - box_.min[u]);
  }

  VoxelBox box_;  // one voxel thick
  const int up_;
  std::vector<std::uint32_t> part_;
};

}  // namespace

std::vector<Footprint> footprints(const BrickShelf& touched, const BrickShelf& hidden, int up) {
  Columns columns(voxels_of(hull(box_of_bricks(touched), box_of_bricks(hidden))), up);
  for_each_voxel(touched, [&](VoxelCoord p) { columns.add(p); });
  std::vector<Footprint> all = columns.parts();
  for (Footprint& part : all) part.box.min[up] = kHighest, part.box.max[up] = -kHighest;
  for_each_voxel(touched, [&](VoxelCoord p) {
    VoxelBox& box = all[columns.part_of(p)].box;
    box.min[up] = std::min(box.min[up], p[up]);
    box.max[up] = std::max(box.max[up], p[up] + 1);
  });
  for_each_voxel(hidden, [&](VoxelCoord p) {
    const std::uint32_t part = columns.part_of(p);
    if (part < all.size()) ++all[part].hidden;
  });
  return all;
}

}  // namespace bp
