#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "lib/core/coords.h"
#include "lib/mesh/lanes.h"

/// Boxes of lattice points, one by one and eight side by side.
namespace bp {

/// A closed box of lattice points.
struct LatticeBox {
  LatticeCoord min{}, max{};
  [[nodiscard]] bool meets(const LatticeBox& b) const {
    return min.x <= b.max.x && b.min.x <= max.x && min.y <= b.max.y && b.min.y <= max.y && min.z <= b.max.z &&
           b.min.z <= max.z;
  }
  /// Returns whether `p` lies strictly inside, not on the boundary.
  [[nodiscard]] bool holds_inside(const LatticeCoord& p) const {
    return min.x < p.x && p.x < max.x && min.y < p.y && p.y < max.y && min.z < p.z && p.z < max.z;
  }
  [[nodiscard]] bool holds(const LatticeBox& b) const {
    return min.x <= b.min.x && b.max.x <= max.x && min.y <= b.min.y && b.max.y <= max.y && min.z <= b.min.z &&
           b.max.z <= max.z;
  }
  [[nodiscard]] LatticeBox grown(std::int64_t by) const {
    const LatticeCoord around{by, by, by};
    return {min - around, max + around};
  }
  void add(const LatticeCoord& p) {
    min = {std::min(min.x, p.x), std::min(min.y, p.y), std::min(min.z, p.z)};
    max = {std::max(max.x, p.x), std::max(max.y, p.y), std::max(max.z, p.z)};
  }
};
/// The box of all lattice points, the cell of a whole mesh. None lies on its boundary.
constexpr LatticeBox kEverywhere{{-(std::int64_t(1) << 40), -(std::int64_t(1) << 40), -(std::int64_t(1) << 40)},
                                 {std::int64_t(1) << 40, std::int64_t(1) << 40, std::int64_t(1) << 40}};
[[nodiscard]] inline LatticeBox box_of(const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& c) {
  LatticeBox box{a, a};
  box.add(b);
  box.add(c);
  return box;
}

/// Returns the box around one or more points.
[[nodiscard]] inline LatticeBox box_of(std::span<const LatticeCoord> points) {
  LatticeBox box{points.front(), points.front()};
  for (const LatticeCoord& p : points) box.add(p);
  return box;
}
[[nodiscard]] inline LatticeBox intersect(const LatticeBox& a, const LatticeBox& b) {
  return {{std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y), std::max(a.min.z, b.min.z)},
          {std::min(a.max.x, b.max.x), std::min(a.max.y, b.max.y), std::min(a.max.z, b.max.z)}};
}

/// A box relative to a point near it, clamped to 32 bits. Clamping keeps the order, so no meeting is missed.
struct SmallBox {
  std::array<std::int32_t, 3> min, max;
};
[[nodiscard]] inline SmallBox relative_to(const LatticeCoord& base, const LatticeBox& b) {
  const auto clamp = [](std::int64_t v) {
    return std::int32_t(std::clamp<std::int64_t>(v, INT32_MIN + 1, INT32_MAX - 1));
  };
  return {{clamp(b.min.x - base.x), clamp(b.min.y - base.y), clamp(b.min.z - base.z)},
          {clamp(b.max.x - base.x), clamp(b.max.y - base.y), clamp(b.max.z - base.z)}};
}

/// A box that groups are compared with; each coordinate is in all lanes.
struct BoxQuery {
  FourInts min[3], max[3];
  explicit BoxQuery(const SmallBox& b) {
    for (std::size_t i = 0; i < 3; ++i) {
      min[i] = FourInts{} + b.min[i];
      max[i] = FourInts{} + b.max[i];
    }
  }
};

/// Eight boxes side by side, all relative to the same point. A new group has none.
struct BoxGroup {
  static constexpr std::uint32_t kWidth = 8;
  /// A box that meets nothing: it lies beyond everything that relative_to() returns.
  static constexpr SmallBox kNothing{{INT32_MAX, INT32_MAX, INT32_MAX}, {INT32_MIN, INT32_MIN, INT32_MIN}};
  /// The inner side of a plane: n . p < limit holds only for points p strictly on it. p is relative to the group's
  /// point.
  struct InnerSide {
    std::array<float, 3> n;
    float limit;
  };

  FourInts min[3][2], max[3][2];

  BoxGroup() {
    for (std::uint32_t k = 0; k < kWidth; ++k) set(k, kNothing);
  }
  /// Returns a mask. Bit k says that box k meets `b`.
  [[nodiscard]] std::uint32_t meeting(const BoxQuery& b) const {
    // Instruction sets have "greater than" for integers, but not its opposite.
    const auto misses = [&](std::size_t half) {
      return (min[0][half] > b.max[0]) | (b.min[0] > max[0][half]) | (min[1][half] > b.max[1]) |
             (b.min[1] > max[1][half]) | (min[2][half] > b.max[2]) | (b.min[2] > max[2][half]);
    };
    return bits_of(misses(0), misses(1)) ^ 0xff;
  }
  /// Returns a mask. Bit k says that box k lies on the inner side; it is undefined if box k is not set.
  [[nodiscard]] std::uint32_t inside(const InnerSide& side) const {
    const auto below = [&](std::size_t half) {
      FourFloats far{};
      for (std::size_t i = 0; i < 3; ++i)
        far += side.n[i] * __builtin_convertvector(side.n[i] > 0 ? max[i][half] : min[i][half], FourFloats);
      return far < side.limit;
    };
    return bits_of(below(0), below(1));
  }
  [[nodiscard]] SmallBox box(std::uint32_t k) const {
    const std::uint32_t half = k / 4, lane = k % 4;
    return {{min[0][half][lane], min[1][half][lane], min[2][half][lane]},
            {max[0][half][lane], max[1][half][lane], max[2][half][lane]}};
  }
  void set(std::uint32_t k, const SmallBox& b) {
    for (std::size_t i = 0; i < 3; ++i) {
      min[i][k / 4][k % 4] = b.min[i];
      max[i][k / 4][k % 4] = b.max[i];
    }
  }
  bool grow(std::uint32_t k, const SmallBox& b);  ///< false if box k holds `b` already
  [[nodiscard]] SmallBox around() const;
};

}  // namespace bp
