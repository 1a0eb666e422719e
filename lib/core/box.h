#pragma once
#include <algorithm>
#include <limits>
#include <utility>

#include "lib/core/coords.h"

/// Half-open boxes [min, max) of integer coordinates, and bounds of points in scene units.
namespace bp {

template <class C>
struct Box {
  C min{}, max{};

  [[nodiscard]] constexpr bool empty() const { return min.x >= max.x || min.y >= max.y || min.z >= max.z; }
  [[nodiscard]] constexpr C size() const { return max - min; }
  [[nodiscard]] constexpr std::int64_t volume() const {
    return empty() ? 0 : std::int64_t(max.x - min.x) * (max.y - min.y) * (max.z - min.z);
  }
  [[nodiscard]] constexpr bool contains(C c) const {
    return c.x >= min.x && c.y >= min.y && c.z >= min.z && c.x < max.x && c.y < max.y && c.z < max.z;
  }
  [[nodiscard]] constexpr bool contains(const Box& b) const {
    return b.empty() || (b.min.x >= min.x && b.min.y >= min.y && b.min.z >= min.z && b.max.x <= max.x &&
                         b.max.y <= max.y && b.max.z <= max.z);
  }
  [[nodiscard]] constexpr Box grown(typename C::value_type by) const {
    return {{min.x - by, min.y - by, min.z - by}, {max.x + by, max.y + by, max.z + by}};
  }
  friend constexpr bool operator==(const Box&, const Box&) = default;
};

/// Calls f(c) for each c of the box, in the order of memory: x is the fastest.
template <class C, class F>
constexpr void for_each(const Box<C>& box, const F& f) {
  for (C c = box.min; c.z < box.max.z; ++c.z) {
    for (c.y = box.min.y; c.y < box.max.y; ++c.y) {
      for (c.x = box.min.x; c.x < box.max.x; ++c.x) f(std::as_const(c));
    }
  }
}

using VoxelBox = Box<VoxelCoord>;
using BrickBox = Box<BrickCoord>;

template <class C>
[[nodiscard]] constexpr Box<C> intersect(const Box<C>& a, const Box<C>& b) {
  return {{std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y), std::max(a.min.z, b.min.z)},
          {std::min(a.max.x, b.max.x), std::min(a.max.y, b.max.y), std::min(a.max.z, b.max.z)}};
}
/// Returns the smallest box that holds both. An empty box counts as nothing.
template <class C>
[[nodiscard]] constexpr Box<C> hull(const Box<C>& a, const Box<C>& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {{std::min(a.min.x, b.min.x), std::min(a.min.y, b.min.y), std::min(a.min.z, b.min.z)},
          {std::max(a.max.x, b.max.x), std::max(a.max.y, b.max.y), std::max(a.max.z, b.max.z)}};
}
[[nodiscard]] constexpr VoxelBox voxels_of(const BrickBox& b) {
  return {first_voxel(b.min), first_voxel(b.max)};
}
[[nodiscard]] constexpr VoxelBox voxels_of(BrickCoord c) {
  return voxels_of(BrickBox{c, c + BrickCoord{1, 1, 1}});
}
/// Returns the bricks that hold at least one voxel of `v`.
[[nodiscard]] constexpr BrickBox bricks_of(const VoxelBox& v) {
  if (v.empty()) return {};
  const BrickCoord last = brick_of({v.max.x - 1, v.max.y - 1, v.max.z - 1});
  return {brick_of(v.min), {last.x + 1, last.y + 1, last.z + 1}};
}

/// Closed bounds in scene units. Starts empty.
struct Bounds3d {
  Vec3d min{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
            std::numeric_limits<double>::infinity()};
  Vec3d max{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
            -std::numeric_limits<double>::infinity()};

  [[nodiscard]] bool empty() const { return !(min[0] <= max[0]); }
  void add(const Vec3d& p) {
    for (std::size_t i = 0; i < 3; ++i) {
      min[i] = std::min(min[i], p[i]);
      max[i] = std::max(max[i], p[i]);
    }
  }
  void merge(const Bounds3d& b) {
    for (std::size_t i = 0; i < 3; ++i) {
      min[i] = std::min(min[i], b.min[i]);
      max[i] = std::max(max[i], b.max[i]);
    }
  }
  [[nodiscard]] bool contains(const Bounds3d& b) const {
    bool inside = true;
    for (std::size_t i = 0; i < 3; ++i) inside &= b.min[i] >= min[i] && b.max[i] <= max[i];
    return inside;
  }
  friend bool operator==(const Bounds3d&, const Bounds3d&) = default;
  [[nodiscard]] double diagonal() const;      ///< length of the diagonal, 0 when empty
  [[nodiscard]] double longest_side() const;  ///< 0 when empty
};

}  // namespace bp
