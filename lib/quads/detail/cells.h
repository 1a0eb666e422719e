#pragma once
#include <array>
#include <optional>
#include <vector>

#include "lib/core/box.h"
#include "lib/grid/mirror_plane.h"

/// Grids of boxes between axis-aligned planes; some of the boxes are solid.
namespace bp {

/// A dense box of flags, with a rim of empty ones around it.
class Grid {
 public:
  Grid() = default;
  explicit Grid(const VoxelBox& inner) : box_(inner.grown(1)), size_(box_.size()), bits_(std::size_t(box_.volume())) {}
  [[nodiscard]] const VoxelBox& box() const { return box_; }
  [[nodiscard]] char& at(const VoxelCoord& p) { return bits_[index(p)]; }
  [[nodiscard]] char at(const VoxelCoord& p) const { return bits_[index(p)]; }

 private:
  [[nodiscard]] std::size_t index(const VoxelCoord& p) const {
    const VoxelCoord d = p - box_.min;
    return (std::size_t(d.z) * std::size_t(size_.y) + std::size_t(d.y)) * std::size_t(size_.x) + std::size_t(d.x);
  }
  VoxelBox box_;
  VoxelCoord size_;
  std::vector<char> bits_;
};

/// Calls visit(q, axis, high) for each of the six neighbours q of p.
template <class Visit>
void for_each_neighbour(const VoxelCoord& p, const Visit& visit) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const std::int32_t step : {-1, 1}) {
      VoxelCoord q = p;
      q[axis] += step;
      visit(q, axis, step > 0);
    }
  }
}

/// A grid of boxes between axis-aligned planes, with a flag for the solid ones. Box i of an axis lies between planes i
/// and i + 1; planes are given in units.
struct BoxGrid {
  std::array<std::vector<std::int32_t>, 3> planes;
  Grid solid;

  [[nodiscard]] std::int32_t thickness(int axis, std::int32_t i) const {
    const auto& p = planes[std::size_t(axis)];
    return p[std::size_t(i) + 1] - p[std::size_t(i)];
  }
  [[nodiscard]] VoxelBox box() const {
    const auto n = [&](std::size_t axis) { return std::int32_t(planes[axis].size()) - 1; };
    return {{0, 0, 0}, {n(0), n(1), n(2)}};
  }
};

/// The size of the solid part of a grid.
struct Size {
  double volume = 0, area = 0;  // in units
  std::uint64_t faces = 0;
};

[[nodiscard]] Size size_of(const BoxGrid& cells);

/// Makes every empty cell solid that the outside does not reach.
void fill(Grid& solid);

/// Repairs the solid (lib/surface/repair.h) and fills its hollows, until neither adds a box. With a mirror plane, which
/// lies in the middle of the grid, the solid stays its own mirror image.
void mend(BoxGrid& cells, const std::optional<MirrorPlane>& plane);

}  // namespace bp
