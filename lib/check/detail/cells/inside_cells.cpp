// A cell that no triangle of the surface meets lies on one side of it as a whole, and so do all such cells that share
// sides. So one point tells the side of many cells.
//
// A triangle meets a cell if none of 13 directions separates them: across the sides of the cell, across the plane of
// the triangle, and across each axis and each edge. The products of a direction with points are computed in doubles,
// relative to a corner of the block. Each is off by at most 8 roundings of its terms' absolute values, 2^-53 each; the
// comparison leaves room for twice as many on both sides. So a cell that is met is never missed, and one that is listed
// without need costs time only.
#include "lib/check/detail/cells/inside_cells.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "lib/core/clones.h"
#include "lib/core/vec3.h"

namespace bp {

namespace {

constexpr std::uint32_t kSide = 8;    // cells along a side of a block
constexpr std::uint32_t kVisits = 3;  // number of boxes that must meet a block before its cells are computed
// The states of a block. Below kVisits: the number of boxes that met it. kVisits: a thread is computing it.
constexpr std::uint32_t kNowhere = kVisits + 1;  // no cell is inside, or none is known to be
constexpr std::uint32_t kWholeSpace = kNowhere + 1;
constexpr std::uint32_t kFirstKept = kWholeSpace + 1;  // this and higher states: the number of the block's kept cells

constexpr std::uint64_t kLeastBlocks = 1 << 12, kMostBlocks = 1 << 21, kBlocksPerFace = 64;
constexpr std::uint64_t kBlocksPerKept = 8;    // a surface meets few of the blocks
constexpr std::uint64_t kMostInBox = 1 << 12;  // cells; the answer for a larger box is "not known"
constexpr std::size_t kMostFaces = 1 << 9;     // faces near a block; with more, its cells are not computed

using Layers = std::array<std::uint64_t, kSide>;
constexpr std::uint64_t kFirstX = 0x0101010101010101u,
                        kLastX = kFirstX << (kSide - 1);  // cells at the sides of a layer
constexpr std::uint64_t kAll = ~std::uint64_t(0);
constexpr Layers kFull{kAll, kAll, kAll, kAll, kAll, kAll, kAll, kAll};

typedef double Row __attribute__((vector_size(64)));            // one double for each cell of a row
typedef std::int64_t RowMask __attribute__((vector_size(64)));  // -1 or 0 for each cell

/// The centres of cells that a direction does not separate from a triangle: those whose product with it is between
/// `low` and `high`.
struct Slab {
  Vec3d direction;
  double low, high;

  /// `size`: bounds of the absolute values from which the components of the direction were computed.
  Slab(const Vec3d& d, const Vec3d& size, const TriangleD& t, double edge) : direction(d) {
    constexpr double kRounding = 32 * 0x1p-53, kUnderflow = 1e-290;
    double off = kUnderflow, radius = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double far = std::max({std::abs(t[0][i]), std::abs(t[1][i]), std::abs(t[2][i])});
      off += kRounding * size[i] * (far + (kSide + 1) * edge);
      radius += edge / 2 * std::abs(d[i]);
    }
    const double a = dot(d, t[0]), b = dot(d, t[1]), c = dot(d, t[2]);
    low = std::min({a, b, c}) - radius - off;
    high = std::max({a, b, c}) + radius + off;
  }
};

Vec3d magnitudes_of(const Vec3d& v) {
  return {std::abs(v[0]), std::abs(v[1]), std::abs(v[2])};
}

/// The slabs of a triangle in 13 directions: across its plane, along each axis, and across each axis and each edge.
/// `t`: the triangle relative to a corner of the block, rounded once.
struct FaceSlabs {
  Slab plane;
  std::array<Slab, 3> sides;                 // along the axes
  std::array<std::array<Slab, 3>, 3> edges;  // across axis i and edge k

  FaceSlabs(const TriangleD& triangle, const TriangleD& t, double edge)
      : plane(plane_of(triangle, t, edge)),
        sides{side(0, t, edge), side(1, t, edge), side(2, t, edge)},
        edges{across(0, triangle, t, edge), across(1, triangle, t, edge), across(2, triangle, t, edge)} {}

 private:
  static Slab plane_of(const TriangleD& triangle, const TriangleD& t, double edge) {
    const Vec3d u = triangle[1] - triangle[0], v = triangle[2] - triangle[0], a = magnitudes_of(u),
                b = magnitudes_of(v);
    return {cross(u, v), {a[1] * b[2] + a[2] * b[1], a[2] * b[0] + a[0] * b[2], a[0] * b[1] + a[1] * b[0]}, t, edge};
  }
  static Slab side(std::size_t i, const TriangleD& t, double edge) {
    Vec3d axis{};
    axis[i] = 1;
    return {axis, axis, t, edge};
  }
  static Slab across(std::size_t i, const Vec3d& along, const TriangleD& t, double edge) {
    Vec3d d{};
    d[(i + 1) % 3] = -along[(i + 2) % 3], d[(i + 2) % 3] = along[(i + 1) % 3];
    return {d, magnitudes_of(d), t, edge};
  }
  static std::array<Slab, 3> across(std::size_t i, const TriangleD& triangle, const TriangleD& t, double edge) {
    return {across(i, triangle[1] - triangle[0], t, edge), across(i, triangle[2] - triangle[1], t, edge),
            across(i, triangle[0] - triangle[2], t, edge)};
  }
};

BP_INLINE std::uint64_t bits_of(const RowMask& met) {
  const RowMask each = met & RowMask{1, 2, 4, 8, 16, 32, 64, 128};
  std::int64_t bits = 0;
  for (std::uint32_t x = 0; x < kSide; ++x) bits |= each[x];
  return std::uint64_t(bits);
}

/// Takes the cells of a row out of `met` that do not lie within the slab. `at`: the products of their centres with its
/// direction.
BP_INLINE void keep_between(const Row& at, const Slab& slab, RowMask& met) {
  met &= (at >= slab.low) & (at <= slab.high);
}

/// Returns which columns of cells along the third axis no slab separates, as bits in rows along axis i.
BP_INLINE std::uint64_t projected(const std::array<Slab, 3>& edges, const Slab& side_i, const Slab& side_j,
                                  std::size_t i, std::size_t j, const Row& centres, double edge) {
  RowMask in_i = RowMask{} - 1;
  keep_between(centres, side_i, in_i);
  std::uint64_t met = 0;
  for (std::uint32_t r = 0; r < kSide; ++r) {
    const double row = (r + 0.5) * edge;
    if (row < side_j.low || row > side_j.high) continue;
    RowMask here = in_i;
    for (const Slab& slab : edges) keep_between(centres * slab.direction[i] + row * slab.direction[j], slab, here);
    met |= bits_of(here) << (kSide * r);
  }
  return met;
}

/// Sets the cells of a block that no slab separates.
BP_CLONES void add_cells(const FaceSlabs& face, double edge, std::uint64_t* layers) {
  const Row centres = (Row{0, 1, 2, 3, 4, 5, 6, 7} + 0.5) * edge;
  const std::uint64_t xy = projected(face.edges[2], face.sides[0], face.sides[1], 0, 1, centres, edge);
  if (xy == 0) return;
  const std::uint64_t xz = projected(face.edges[1], face.sides[0], face.sides[2], 0, 2, centres, edge);
  if (xz == 0) return;
  const std::uint64_t yz = projected(face.edges[0], face.sides[1], face.sides[2], 1, 2, centres, edge);
  for (std::uint32_t z = 0; z < kSide; ++z) {
    const std::uint64_t here = xy & (xz >> (kSide * z) & 0xFF) * kFirstX;
    std::uint64_t met = 0;
    for (std::uint32_t y = 0; y < kSide; ++y) {
      if ((yz >> (kSide * z + y) & 1) == 0 || (here >> (kSide * y) & 0xFF) == 0) continue;
      const Vec3d& n = face.plane.direction;
      RowMask row = RowMask{} - 1;
      keep_between(centres * n[0] + ((y + 0.5) * edge * n[1] + (z + 0.5) * edge * n[2]), face.plane, row);
      met |= bits_of(row) << (kSide * y);
    }
    layers[z] |= here & met;
  }
}

/// Returns the cells of `free` that are connected to `part` by sides.
Layers connected(Layers part, const Layers& free) {
  for (bool grew = true; grew;) {
    grew = false;
    for (std::size_t z = 0; z < kSide; ++z) {
      const std::uint64_t at = part[z];
      std::uint64_t near = at | (at & ~kLastX) << 1 | (at & ~kFirstX) >> 1 | at << kSide | at >> kSide;
      if (z > 0) near |= part[z - 1];
      if (z + 1 < kSide) near |= part[z + 1];
      near &= free[z];
      grew |= near != at;
      part[z] = near;
    }
  }
  return part;
}

}  // namespace

InsideCells::InsideCells(const Surface& surface, std::uint64_t memory_bytes) : surface_(surface) {
  const Bounds3d bounds = surface.bounds();
  const std::uint64_t fit = memory_bytes / (sizeof(states_[0]) + sizeof(Layers) / kBlocksPerKept);
  const std::uint64_t most =
      std::min(fit, std::clamp(kBlocksPerFace * surface.bvh().size(), kLeastBlocks, kMostBlocks));
  const double side = bounds.longest_side();
  if (bounds.empty() || most < kLeastBlocks || !(side >= 0x1p-200 && side <= 0x1p200)) return;
  constexpr double kMostCell = 0x1p50;  // so that planes are exact
  std::uint64_t blocks = 0;
  for (double edge = std::exp2(std::floor(std::log2(side)) - 13);; edge *= 2) {
    blocks = 1;
    for (std::size_t i = 0; i < 3; ++i) {
      const double first = std::floor(bounds.min[i] / edge), last = std::floor(bounds.max[i] / edge);
      if (!(std::abs(first) < kMostCell && std::abs(last) < kMostCell)) return;
      first_[i] = first;
      blocks_[i] = std::uint32_t((last - first) / kSide) + 1;
      cells_[i] = kSide * blocks_[i];
      blocks *= blocks_[i];
    }
    edge_ = edge, per_edge_ = 1 / edge;
    if (blocks <= most) break;
  }
  most_kept_ = std::uint32_t(blocks / kBlocksPerKept) + 1;
  states_ = std::make_unique<std::atomic<std::uint32_t>[]>(std::size_t(blocks));
  kept_.reset(new Layers[most_kept_]);  // not zeroed: most are never used
}

bool InsideCells::hold(const Bounds3d& box) const {
  Place low, high;
  for (std::size_t i = 0; i < 3; ++i) {
    const double from = box.min[i] * per_edge_ - first_[i], to = box.max[i] * per_edge_ - first_[i];
    if (!(from >= 0 && from <= to && to < double(cells_[i]))) return false;
    low[i] = std::uint32_t(from), high[i] = std::uint32_t(to);
    // This holds for any rounding: the cells hold the box.
    if (!(plane(i, low[i]) <= box.min[i] && box.max[i] <= plane(i, high[i] + 1))) return false;
  }
  if (std::uint64_t(high[0] - low[0] + 1) * (high[1] - low[1] + 1) * (high[2] - low[2] + 1) > kMostInBox) return false;
  for (std::uint32_t bz = low[2] / kSide; bz <= high[2] / kSide; ++bz) {
    for (std::uint32_t by = low[1] / kSide; by <= high[1] / kSide; ++by) {
      for (std::uint32_t bx = low[0] / kSide; bx <= high[0] / kSide; ++bx) {
        const std::uint32_t state = state_of({bx, by, bz});
        if (state == kWholeSpace) continue;
        if (state < kFirstKept) return false;
        const Layers& inside = kept_[state - kFirstKept];
        const auto first = [](std::uint32_t from, std::uint32_t block) {
          return from > block * kSide ? from % kSide : 0;
        };
        const auto last = [](std::uint32_t to, std::uint32_t block) {
          return to / kSide > block ? kSide - 1 : to % kSide;
        };
        const std::uint32_t x = first(low[0], bx), to_x = last(high[0], bx), y = first(low[1], by),
                            to_y = last(high[1], by);
        const std::uint64_t row = (std::uint64_t(0xFF) >> (kSide - 1 - (to_x - x))) << x;
        const std::uint64_t rows = (row * kFirstX) >> (kSide * (kSide - 1 - (to_y - y))) << (kSide * y);
        for (std::uint32_t z = first(low[2], bz); z <= last(high[2], bz); ++z) {
          if ((inside[z] & rows) != rows) return false;
        }
      }
    }
  }
  return true;
}

std::uint32_t InsideCells::state_of(const Place& block) const {
  std::atomic<std::uint32_t>& state = states_[number_of(block)];
  std::uint32_t known = state.load(std::memory_order_acquire);
  if (known >= kVisits) return known;
  // Another thread may count the same visit or compute the block at this moment; then this box gets no answer.
  if (!state.compare_exchange_strong(known, known + 1) || known + 1 < kVisits) return kNowhere;
  known = look_at(block);
  state.store(known, std::memory_order_release);
  return known;
}

std::uint32_t InsideCells::look_at(const Place& block) const {
  const Place from{kSide * block[0], kSide * block[1], kSide * block[2]};
  Bounds3d box;
  for (std::size_t i = 0; i < 3; ++i) box.min[i] = plane(i, from[i]), box.max[i] = plane(i, from[i] + kSide);
  Layers met{};
  std::size_t faces = 0;
  surface_.bvh().visit(box, [&](const TriangleBvh::Item& item) {
    if (++faces > kMostFaces) return true;
    const TriangleD& t = item.corners;
    add_cells(FaceSlabs(t, {t[0] - box.min, t[1] - box.min, t[2] - box.min}, edge_), edge_, met.data());
    return false;
  });
  if (faces > kMostFaces) return kNowhere;
  Layers free, inside{};
  for (std::size_t z = 0; z < kSide; ++z) free[z] = ~met[z];
  for (std::uint32_t z = 0; z < kSide; ++z) {
    while (free[z] != 0) {
      const auto bit = std::uint32_t(std::countr_zero(free[z]));
      Layers part{};
      part[z] = std::uint64_t(1) << bit;
      part = connected(part, free);
      const bool holds =
          continues(part, block) || winds_around({from[0] + bit % kSide, from[1] + bit / kSide, from[2] + z});
      for (std::size_t k = 0; k < kSide; ++k) {
        free[k] &= ~part[k];
        if (holds) inside[k] |= part[k];
      }
    }
  }
  return keep(inside);
}

/// Returns true if a cell of the part shares a side with one of another block that is known to be inside.
bool InsideCells::continues(const Layers& part, const Place& block) const {
  constexpr int kLast = kSide - 1;
  const auto any = [&](std::size_t axis, std::uint32_t to, const auto& beside) {
    Place other = block;
    other[axis] += to;
    if (other[axis] >= blocks_[axis]) return false;
    const std::uint32_t state = states_[number_of(other)].load(std::memory_order_acquire);
    if (state < kWholeSpace) return false;
    const Layers& inside = state == kWholeSpace ? kFull : kept_[state - kFirstKept];
    std::uint64_t shared = 0;
    for (std::size_t z = 0; z < kSide; ++z) shared |= part[z] & beside(inside, z);
    return shared != 0;
  };
  constexpr std::uint32_t kBack = ~std::uint32_t(0);  // wraps around below 0
  return any(0, kBack, [](const Layers& in, std::size_t z) { return in[z] >> kLast & kFirstX; }) ||
         any(0, 1, [](const Layers& in, std::size_t z) { return in[z] << kLast & kLastX; }) ||
         any(1, kBack, [](const Layers& in, std::size_t z) { return in[z] >> kLast * kSide; }) ||
         any(1, 1, [](const Layers& in, std::size_t z) { return in[z] << kLast * kSide; }) ||
         any(2, kBack, [](const Layers& in, std::size_t z) { return z == 0 ? in[kLast] : 0; }) ||
         any(2, 1, [](const Layers& in, std::size_t z) { return z == kLast ? in[0] : 0; });
}

std::uint32_t InsideCells::keep(const Layers& inside) const {
  std::uint64_t any = 0, all = kAll;
  for (const std::uint64_t layer : inside) any |= layer, all &= layer;
  if (any == 0) return kNowhere;
  if (~all == 0) return kWholeSpace;
  const std::uint32_t number = kept_count_.fetch_add(1);
  if (number >= most_kept_) return kNowhere;
  kept_[number] = inside;
  return kFirstKept + number;
}

/// Returns whether the surface winds around a cell that no triangle meets. Its middle decides.
bool InsideCells::winds_around(const Place& cell) const {
  Vec3d middle;
  for (std::size_t i = 0; i < 3; ++i) middle[i] = plane(i, cell[i]) + edge_ / 2;
  return surface_.winding(middle) >= 1;
}

}  // namespace bp
