#include "lib/meshing/enclosed.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "lib/core/parallel.h"
#include "lib/core/triangle_intersection.h"
#include "lib/meshing/vec3.h"

namespace bp {

/// Separating axes of one tetrahedron against axis-aligned cubes: the cube's 3 face normals (its bounding box), the 4
/// face normals, and the 6 x 3 cross products of edges. Two convex bodies have disjoint interiors iff one of these axes
/// separates them weakly.
class Separator {
 public:
  explicit Separator(const Tetrahedron& t) : box_{t[0], t[0]} {
    for (const LatticeCoord& p : t) box_.add(p);
    for (std::size_t i = 0; i < 4; ++i) corners_[i] = t[i] - box_.min;
    const LatticeCoord side = box_.max - box_.min;
    size_ = double(side.x) + double(side.y) + double(side.z);
    for (std::size_t skip = 0; skip < 4; ++skip)
      add_axis(normal_of(t[(skip + 1) % 4], t[(skip + 2) % 4], t[(skip + 3) % 4]));
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) {
        const LatticeCoord e = t[j] - t[i];
        add_axis({0, e.z, -e.y});
        add_axis({-e.z, 0, e.x});
        add_axis({e.y, -e.x, 0});
      }
    }
  }

  [[nodiscard]] const LatticeBox& box() const { return box_; }

  /// True if the open cube [corner, corner + edge]^3 and the open tetrahedron are disjoint.
  [[nodiscard]] bool separates(const LatticeCoord& corner, std::int64_t edge) const {
    for (int i = 0; i < 3; ++i) {
      if (corner[i] >= box_.max[i] || corner[i] + edge <= box_.min[i]) return true;
    }
    const LatticeCoord c = corner - box_.min;
    const double x = double(c.x), y = double(c.y), z = double(c.z), e = double(edge);
    const double reach = std::abs(x) + std::abs(y) + std::abs(z) + e + size_;  // what an axis is multiplied with
    for (int a = 0; a < count_; ++a) {
      const Axis& axis = axes_[std::size_t(a)];
      const double at = axis.x * x + axis.y * y + axis.z * z;
      const double over = std::max(at + axis.negative * e - axis.max, axis.min - (at + axis.positive * e));
      const double slack = axis.slack * reach;
      if (over > slack || (over >= -slack && separates_exactly(axis.n, c, edge))) return true;
    }
    return false;
  }

 private:
  /// Coordinates are relative to the low corner of the tetrahedron's box. The doubles decide unless they are within
  /// rounding.
  struct Axis {
    LatticeCoord n;
    double x, y, z;
    double negative, positive;  // sums of the negative and of the positive components: extent of a unit cube
    double min, max;            // of the tetrahedron
    double slack;               // a dozen roundings of terms below |n|_1 * reach
  };

  [[nodiscard]] bool separates_exactly(const LatticeCoord& n, const LatticeCoord& c, std::int64_t edge) const {
    const auto along = [&](const LatticeCoord& p) { return int128(n.x) * p.x + int128(n.y) * p.y + int128(n.z) * p.z; };
    int128 min = along(corners_[0]), max = min, low = along(c), high = low;
    for (const LatticeCoord& p : corners_) {
      min = std::min(min, along(p));
      max = std::max(max, along(p));
    }
    for (int i = 0; i < 3; ++i) (n[i] < 0 ? low : high) += int128(n[i]) * edge;
    return low >= max || high <= min;
  }

  void add_axis(const LatticeCoord& n) {
    if (n == LatticeCoord{}) return;
    Axis axis{n, double(n.x), double(n.y), double(n.z), 0, 0, 0, 0, 0};
    for (int i = 0; i < 3; ++i) (n[i] < 0 ? axis.negative : axis.positive) += double(n[i]);
    for (std::size_t i = 0; i < 4; ++i) {
      const double at =
          axis.x * double(corners_[i].x) + axis.y * double(corners_[i].y) + axis.z * double(corners_[i].z);
      axis.min = i == 0 ? at : std::min(axis.min, at);
      axis.max = i == 0 ? at : std::max(axis.max, at);
    }
    axis.slack = 0x1p-49 * (axis.positive - axis.negative);
    axes_[std::size_t(count_++)] = axis;
  }

  Tetrahedron corners_;  // relative to box_.min
  double size_ = 0;      // sum of the sides of the box
  LatticeBox box_;
  std::array<Axis, 22> axes_;
  int count_ = 0;
};

namespace {

/// Occupied voxels of a brick with an empty one among their 26 neighbours.
BrickBits boundary_of(const BrickShelf& shelf, BrickCoord coord) {
  const VoxelCoord first = first_voxel(coord);
  BitBox bits({{first.x - 64, first.y - 1, first.z - 1}, {first.x + 128, first.y + 65, first.z + 65}});
  load_voxels(shelf, bits);
  BrickBits out;
  for (std::int32_t z = 0; z < kBrickEdge; ++z) {
    for (std::int32_t y = 0; y < kBrickEdge; ++y) {
      std::uint64_t inner = ~std::uint64_t(0);
      for (int i = 0; i < 9; ++i) {
        const std::uint64_t* r = bits.row(first.y + y + i % 3 - 1, first.z + z + i / 3 - 1);
        inner &= r[1] & ((r[1] << 1) | (r[0] >> 63)) & ((r[1] >> 1) | (r[2] << 63));
      }
      out[std::size_t(z * kBrickEdge + y)] = bits.row(first.y + y, first.z + z)[1] & ~inner;
    }
  }
  return out;
}

std::array<std::uint64_t, 8> blocks_of(const BrickBits& bits) {
  std::array<std::uint64_t, 8> blocks{};
  for (std::size_t i = 0; i < kBrickWords; ++i) {
    for (std::size_t bx = 0; bx < 8; ++bx) {
      if ((bits[i] >> (8 * bx)) & 0xff) blocks[i / 512] |= std::uint64_t(1) << (i % 64 / 8 * 8 + bx);
    }
  }
  return blocks;
}

/// Corners of voxels, those at the low sides of a brick's voxels, with one occupied voxel around them.
std::vector<VoxelCoord> tips_of(const BrickShelf& shelf, BrickCoord coord) {
  const VoxelCoord first = first_voxel(coord);
  BitBox bits({{first.x - 64, first.y - 1, first.z - 1}, {first.x + 64, first.y + 64, first.z + 64}});
  load_voxels(shelf, bits);
  std::vector<VoxelCoord> tips;
  for (std::int32_t z = 0; z < kBrickEdge; ++z) {
    for (std::int32_t y = 0; y < kBrickEdge; ++y) {
      std::uint64_t once = 0, twice = 0;
      for (int i = 0; i < 4; ++i) {
        const std::uint64_t* r = bits.row(first.y + y - i % 2, first.z + z - i / 2);
        for (const std::uint64_t w : {r[1], (r[1] << 1) | (r[0] >> 63)}) {
          twice |= once & w;
          once |= w;
        }
      }
      for (std::uint64_t row = once & ~twice; row != 0; row &= row - 1)
        tips.push_back({first.x + std::countr_zero(row), first.y + y, first.z + z});
    }
  }
  return tips;
}

Blocker cube(const LatticeCoord& low, std::int64_t edge) {
  Blocker b;
  b.count = 8;
  for (int i = 0; i < 8; ++i)
    b.points[std::size_t(i)] = to_double(low + LatticeCoord{i & 1, (i >> 1) & 1, i >> 2} * edge);
  return b;
}

}  // namespace

EnclosedVoxels::EnclosedVoxels(const BrickShelf& shelf) {
  const std::vector<BrickCoord> coords = shelf.coords();
  std::vector<BoundaryBrick> found(coords.size());
  std::vector<std::vector<VoxelCoord>> tips(coords.size());
  parallel_for(std::int64_t(coords.size()), [&](std::int64_t i) {
    BoundaryBrick& b = found[std::size_t(i)];
    b.bits = boundary_of(shelf, coords[std::size_t(i)]);
    b.blocks = blocks_of(b.bits);
    tips[std::size_t(i)] = tips_of(shelf, coords[std::size_t(i)]);
  });
  for (std::size_t i = 0; i < coords.size(); ++i) {
    if (classify(found[i].bits) != BrickFill::empty) bricks_.emplace(coords[i], found[i]);
    tips_.insert(tips_.end(), tips[i].begin(), tips[i].end());
  }
}

bool EnclosedVoxels::allows(std::span<const NewFace>, std::span<const Tetrahedron> swept, Blocker* blocker) const {
  return std::all_of(swept.begin(), swept.end(), [&](const Tetrahedron& t) { return clear(t, blocker); });
}

std::vector<Vec3d> EnclosedVoxels::contact_points(const LatticeCoord& origin) const {
  std::vector<Vec3d> points;
  points.reserve(tips_.size());
  for (const VoxelCoord& c : tips_)
    points.push_back(to_double(LatticeCoord{c.x, c.y, c.z} * kLatticePerVoxel - origin));
  return points;
}

bool EnclosedVoxels::clear(const Tetrahedron& t, Blocker* blocker) const {
  const Separator separator(t);
  constexpr std::int64_t edge = std::int64_t(kBrickEdge) * kLatticePerVoxel;
  const LatticeBox& box = separator.box();
  BrickCoord low, high;
  for (int i = 0; i < 3; ++i) {
    low[i] = std::int32_t(floor_div(box.min[i], edge));
    high[i] = std::int32_t(floor_div(box.max[i] - 1, edge));
  }
  for (std::int32_t z = low.z; z <= high.z; ++z) {
    for (std::int32_t y = low.y; y <= high.y; ++y) {
      for (std::int32_t x = low.x; x <= high.x; ++x) {
        const auto it = bricks_.find({x, y, z});
        if (it == bricks_.end() || separator.separates({x * edge, y * edge, z * edge}, edge)) continue;
        if (!brick_clear(separator, {x, y, z}, it->second, blocker)) return false;
      }
    }
  }
  return true;
}

bool EnclosedVoxels::brick_clear(const Separator& separator, BrickCoord coord, const BoundaryBrick& brick,
                                 Blocker* blocker) const {
  constexpr std::int64_t voxel = kLatticePerVoxel, block = 8 * voxel;
  const VoxelCoord first = first_voxel(coord);
  const LatticeCoord origin{first.x * voxel, first.y * voxel, first.z * voxel};
  for (std::int64_t bz = 0; bz < 8; ++bz) {
    for (std::uint64_t rest = brick.blocks[std::size_t(bz)]; rest != 0; rest &= rest - 1) {
      const int bit = std::countr_zero(rest);
      const std::int64_t bx = bit % 8, by = bit / 8;
      const LatticeCoord corner = origin + LatticeCoord{bx * block, by * block, bz * block};
      if (separator.separates(corner, block)) continue;
      for (std::int64_t z = 0; z < 8; ++z) {
        for (std::int64_t y = 0; y < 8; ++y) {
          std::uint64_t row = (brick.bits[std::size_t((bz * 8 + z) * kBrickEdge + by * 8 + y)] >> (8 * bx)) & 0xff;
          for (; row != 0; row &= row - 1) {
            const LatticeCoord low = corner + LatticeCoord{std::countr_zero(row) * voxel, y * voxel, z * voxel};
            if (separator.separates(low, voxel)) continue;
            if (blocker != nullptr) *blocker = cube(low, voxel);
            return false;
          }
        }
      }
    }
  }
  return true;
}

namespace {

/// Lattice box that surely holds a triangle: to_voxels errs by less than 2^-20 voxel.
LatticeBox box_around(const GridFrame& frame, const TriangleD& t) {
  LatticeBox box;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d v = frame.to_voxels(t[k]);
    LatticeCoord low, high;
    for (int i = 0; i < 3; ++i) {
      low[i] = std::int64_t(std::floor(v[std::size_t(i)] * kLatticePerVoxel)) - 1;
      high[i] = low[i] + 3;
    }
    if (k == 0) box = {low, high};
    box.add(low);
    box.add(high);
  }
  return box;
}

/// The plane of a face, to tell boxes that lie strictly on its inner side: nothing in them meets the face, nor a
/// tetrahedron that it closes towards the inside. Doubles with a margin for their rounding.
class InnerSide {
 public:
  InnerSide(const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& c)
      : a_(a), n_(to_double(normal_of(a, b, c))) {}
  [[nodiscard]] bool holds(const LatticeBox& box) const {
    double far = 0, size = 0;
    for (int i = 0; i < 3; ++i) {
      const double n = n_[std::size_t(i)];
      const double term = n * double((n > 0 ? box.max[i] : box.min[i]) - a_[i]);
      far += term;
      size += std::abs(term);
    }
    return far < -0x1p-50 * size;  // normal, product and sums: fewer than 8 roundings
  }

 private:
  LatticeCoord a_;
  Vec3d n_;
};

/// A closed tetrahedron in scene units, turned so that each of its four planes has the inside on its negative side.
struct Solid {
  std::array<Vec3d, 4> corners;
  LatticeBox box;

  /// Exact. The plane of the first three corners is asked first.
  [[nodiscard]] bool holds(const Vec3d& p) const {
    const auto& [a, b, c, d] = corners;
    return orient3d(a, b, c, p) <= 0 && orient3d(a, d, b, p) <= 0 && orient3d(b, d, c, p) <= 0 &&
           orient3d(c, d, a, p) <= 0;
  }
};

/// Interleaved bits of a corner's place in the bounds: what is near in space is near in memory.
std::uint64_t morton(const Vec3d& p, const Bounds3d& bounds) {
  std::uint64_t code = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double side = bounds.max[axis] - bounds.min[axis];
    auto bits = side > 0 ? std::uint64_t((p[axis] - bounds.min[axis]) / side * 0xffff) : 0;
    for (int i = 0; i < 16; ++i) code |= ((bits >> i) & 1) << (3 * i + int(axis));
  }
  return code;
}

void sort_in_space(std::vector<TriangleD>& triangles) {
  Bounds3d bounds;
  for (const TriangleD& t : triangles) bounds.add(t[0]);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) order[i] = {morton(triangles[i][0], bounds), std::uint32_t(i)};
  std::sort(order.begin(), order.end());
  std::vector<TriangleD> sorted;
  sorted.reserve(triangles.size());
  for (const auto& [code, i] : order) sorted.push_back(triangles[i]);
  triangles = std::move(sorted);
}

}  // namespace

EnclosedTriangles::EnclosedTriangles(std::vector<TriangleD> triangles, const GridFrame& frame)
    : triangles_(std::move(triangles)), frame_(frame) {
  sort_in_space(triangles_);
  std::vector<LatticeBox> boxes(triangles_.size());
  std::vector<std::uint32_t> items(triangles_.size());
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    boxes[i] = box_around(frame_, triangles_[i]);
    items[i] = std::uint32_t(i);
  }
  tree_.build(boxes, std::move(items));
}

// A triangle meets neither the old faces (it was enclosed) nor, once tested, the new ones. So it lies wholly in one
// part of space that they bound together, and one of its corners tells whether a tetrahedron that leaves the solid
// holds it. Nearly all triangles near a face lie wholly on its inner side: three orientations, and no more.
bool EnclosedTriangles::allows(std::span<const NewFace> star, std::span<const Tetrahedron> swept,
                               Blocker* blocker) const {
  for (const NewFace& f : star) {
    const std::array<Vec3d, 3> face = {frame_.world(f.corners[0]), frame_.world(f.corners[1]),
                                       frame_.world(f.corners[2])};
    const InnerSide inner(f.corners[0], f.corners[1], f.corners[2]);
    const bool free = tree_.query(
        box_of(f.corners[0], f.corners[1], f.corners[2]), [&](const LatticeBox& b) { return !inner.holds(b); },
        [&](std::uint32_t i) {
          return !triangles_intersect(triangles_[i].data(), face.data()) || !blocks(i, blocker);
        });
    if (!free) return false;
  }
  for (const Tetrahedron& t : swept) {
    // A swept tetrahedron (a, b, c, q) has q on the inner side of its old face; a flat one holds nothing.
    const int turn = orient3d(t[0], t[1], t[2], t[3]);
    if (turn == 0) continue;
    const std::size_t second = turn > 0 ? 1 : 2;
    Solid solid{{frame_.world(t[3]), frame_.world(t[second]), frame_.world(t[3 - second]), frame_.world(t[0])}, {}};
    LatticeBox box = box_of(t[0], t[1], t[2]);
    box.add(t[3]);
    const InnerSide inner(t[3], t[3 - second], t[second]);  // of the new face: the tetrahedron is beyond it
    const bool free = tree_.query(
        box, [&](const LatticeBox& b) { return !inner.holds(b); },
        [&](std::uint32_t i) { return !solid.holds(triangles_[i][0]) || !blocks(i, blocker); });
    if (!free) return false;
  }
  return true;
}

namespace {

/// The corners, and inside a large triangle a grid of points.
void add_samples(const TriangleD& t, double voxel, std::vector<Vec3d>& points) {
  constexpr double kSpacingVox = 8;
  constexpr int kMostPerEdge = 16;
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d e = t[(k + 1) % 3] - t[k];
    longest = std::max(longest, dot(e, e));
  }
  const int n = int(std::clamp(std::sqrt(longest) / (kSpacingVox * voxel), 1.0, double(kMostPerEdge)));
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; i + j <= n; ++j)
      points.push_back(t[0] + (double(i) / n) * (t[1] - t[0]) + (double(j) / n) * (t[2] - t[0]));
  }
}

}  // namespace

/// Always true.
bool EnclosedTriangles::blocks(std::uint32_t triangle, Blocker* blocker) const {
  if (blocker == nullptr) return true;
  blocker->count = 3;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d v = frame_.to_voxels(triangles_[triangle][k]);
    for (std::size_t i = 0; i < 3; ++i) blocker->points[k][i] = v[i] * kLatticePerVoxel;
  }
  return true;
}

std::vector<Vec3d> EnclosedTriangles::contact_points(const LatticeCoord& origin) const {
  std::vector<Vec3d> points;
  points.reserve(3 * triangles_.size());
  for (const TriangleD& t : triangles_) add_samples(t, frame_.voxel, points);
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  for (Vec3d& p : points) {
    const Vec3d v = frame_.to_voxels(p);
    for (std::size_t i = 0; i < 3; ++i) p[i] = v[i] * kLatticePerVoxel - double(origin[int(i)]);
  }
  return points;
}

}  // namespace bp
