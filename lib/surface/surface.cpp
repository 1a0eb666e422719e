#include "lib/surface/surface.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <map>
#include <tuple>
#include <utility>

#include "lib/core/parallel.h"
#include "lib/mesh/half_edge_mesh.h"
#include "lib/volume/boundary_runs.h"

namespace bp {

namespace {

constexpr int kCorners = kBrickEdge + 1;
constexpr std::uint32_t kNone = ~std::uint32_t(0);
constexpr std::int64_t kBrickLattice = std::int64_t(kBrickEdge) * kLatticePerVoxel;

bool by_zyx(BrickCoord a, BrickCoord b) {
  return std::tuple(a.z, a.y, a.x) < std::tuple(b.z, b.y, b.x);
}

/// A piece whose vertices are corners of a brick's voxels.
class PieceBuilder {
 public:
  PieceBuilder() : index_(std::size_t(kCorners) * kCorners * kCorners, kNone) {}

  void begin(BrickCoord brick) {
    first_ = first_voxel(brick);
    piece_.cell = {lattice({0, 0, 0}), lattice({kBrickEdge, kBrickEdge, kBrickEdge})};
  }
  Piece take() {
    for (const std::size_t slot : used_) index_[slot] = kNone;
    used_.clear();
    return std::exchange(piece_, {});
  }

  /// Returns the number of the vertex at a corner of the brick's voxels, counted from the brick's first corner: (0, 0,
  /// 0) to (64, 64, 64). Adds the vertex if it is new.
  std::uint32_t vertex(VoxelCoord c) {
    const auto slot = std::size_t((c.z * kCorners + c.y) * kCorners + c.x);
    if (index_[slot] == kNone) {
      index_[slot] = std::uint32_t(piece_.vertices.size());
      used_.push_back(slot);
      piece_.vertices.push_back(lattice(c));
    }
    return index_[slot];
  }
  std::uint32_t vertex(const LatticeCoord& p) {
    VoxelCoord c;
    for (int i = 0; i < 3; ++i) c[i] = std::int32_t((p[i] - piece_.cell.min[i]) / kLatticePerVoxel);
    return vertex(c);
  }
  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) { piece_.triangles.push_back({a, b, c}); }

 private:
  [[nodiscard]] LatticeCoord lattice(VoxelCoord c) const {
    const auto at = [](std::int32_t a, std::int32_t b) { return (std::int64_t(a) + b) * kLatticePerVoxel; };
    return {at(first_.x, c.x), at(first_.y, c.y), at(first_.z, c.z)};
  }

  VoxelCoord first_;
  std::vector<std::uint32_t> index_;  // the vertex at each corner
  std::vector<std::size_t> used_;     // corners that have a vertex
  Piece piece_;
};

/// Finds the faces of a brick from its voxels and the voxels around it.
class FaceFinder {
 public:
  Piece run(const BrickShelf& shelf, BrickCoord brick) {
    first_ = first_voxel(brick);
    bits_.reset({{first_.x - 64, first_.y - 1, first_.z - 1}, {first_.x + 128, first_.y + 65, first_.z + 65}});
    load_voxels(shelf, bits_);
    builder_.begin(brick);
    faces_of_neighbours();
    for (std::int32_t z = 0; z < kBrickEdge; ++z) {
      for (std::int32_t y = 0; y < kBrickEdge; ++y) faces_of_row(y, z);
    }
    return builder_.take();
  }

 private:
  static constexpr std::uint64_t kLastBit = std::uint64_t(1) << 63;

  [[nodiscard]] const std::uint64_t* row(std::int32_t y, std::int32_t z) const {
    return bits_.row(first_.y + y, first_.z + z);
  }

  /// Adds the high sides of the voxels just before the brick's first ones: a face belongs to the brick of its least
  /// corner.
  void faces_of_neighbours() {
    for (std::int32_t y = 0; y < kBrickEdge; ++y) faces(row(y, -1)[1] & ~row(y, 0)[1], y, -1, 2, true);
    for (std::int32_t z = 0; z < kBrickEdge; ++z) faces(row(-1, z)[1] & ~row(0, z)[1], -1, z, 1, true);
    for (std::int32_t z = 0; z < kBrickEdge; ++z) {
      for (std::int32_t y = 0; y < kBrickEdge; ++y) {
        if ((row(y, z)[0] & kLastBit) != 0 && (row(y, z)[1] & 1) == 0) face({-1, y, z}, 0, true);
      }
    }
  }

  /// Adds the faces of the voxels (0 .. 63, y, z), except for high sides that belong to the next brick.
  void faces_of_row(std::int32_t y, std::int32_t z) {
    const std::uint64_t* r = row(y, z);
    const std::uint64_t in = r[1];
    if (in == 0) return;
    faces(in & ~((in >> 1) | kLastBit), y, z, 0, true);
    faces(in & ~((in << 1) | (r[0] >> 63)), y, z, 0, false);
    if (y + 1 < kBrickEdge) faces(in & ~row(y + 1, z)[1], y, z, 1, true);
    faces(in & ~row(y - 1, z)[1], y, z, 1, false);
    if (z + 1 < kBrickEdge) faces(in & ~row(y, z + 1)[1], y, z, 2, true);
    faces(in & ~row(y, z - 1)[1], y, z, 2, false);
  }

  void faces(std::uint64_t exposed, std::int32_t y, std::int32_t z, int axis, bool high) {
    for (; exposed != 0; exposed &= exposed - 1) face({std::countr_zero(exposed), y, z}, axis, high);
  }

  /// Corners in the order (0,0) (1,0) (1,1) (0,1) of the two axes after `axis`: counter-clockwise seen from +axis.
  void face(VoxelCoord v, int axis, bool high) {
    const int u = (axis + 1) % 3, w = (axis + 2) % 3;
    VoxelCoord c = v;
    if (high) c[axis] += 1;
    std::uint32_t q[4];
    for (int k = 0; k < 4; ++k) {  // vertices in the order of their first use
      const int i = high ? k : (4 - k) % 4;
      VoxelCoord corner = c;
      corner[u] += i == 1 || i == 2;
      corner[w] += i >= 2;
      q[k] = builder_.vertex(corner);
    }
    builder_.add(q[0], q[1], q[2]);
    builder_.add(q[0], q[2], q[3]);
  }

  VoxelCoord first_;
  BitBox bits_;
  PieceBuilder builder_;
};

BrickCoord brick_of(const LatticeMesh& dense, const std::array<std::uint32_t, 3>& t) {
  BrickCoord brick;
  for (int i = 0; i < 3; ++i) {
    const std::int64_t least = std::min({dense.vertices[t[0]][i], dense.vertices[t[1]][i], dense.vertices[t[2]][i]});
    brick[i] = std::int32_t(floor_div(least, kBrickLattice));
  }
  return brick;
}

}  // namespace

std::vector<BrickCoord> ShelfSurface::bricks() const {
  std::vector<BrickCoord> all;
  for (const BrickCoord b : shelf_.coords()) {
    all.insert(all.end(), {b, {b.x + 1, b.y, b.z}, {b.x, b.y + 1, b.z}, {b.x, b.y, b.z + 1}});
  }
  std::sort(all.begin(), all.end(), by_zyx);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

LatticeBox ShelfSurface::box() const {
  const VoxelBox voxels = boundary_size(shelf_).box;
  LatticeBox box;
  for (int i = 0; i < 3; ++i) {
    box.min[i] = std::int64_t(voxels.min[i]) * kLatticePerVoxel;
    box.max[i] = std::int64_t(voxels.max[i]) * kLatticePerVoxel;
  }
  return box;
}

Piece ShelfSurface::piece(BrickCoord brick) const {
  thread_local FaceFinder finder;
  return finder.run(shelf_, brick);
}

MeshSurface::MeshSurface(const LatticeMesh& dense) : SurfaceSource(dense.frame), dense_(dense) {
  const auto order = [](BrickCoord a, BrickCoord b) { return by_zyx(a, b); };
  std::map<BrickCoord, std::uint32_t, decltype(order)> counts(order);
  for (const auto& t : dense.triangles) ++counts[brick_of(dense, t)];
  std::uint32_t sum = 0;
  for (auto& [brick, count] : counts) {
    bricks_.push_back(brick);
    begin_.push_back(sum);
    sum += std::exchange(count, sum);  // from now on, where its next face goes
  }
  begin_.push_back(sum);
  faces_.resize(sum);
  for (std::uint32_t f = 0; f < sum; ++f) faces_[counts[brick_of(dense, dense.triangles[f])]++] = f;
}

Piece MeshSurface::piece(BrickCoord brick) const {
  thread_local PieceBuilder builder;
  builder.begin(brick);
  const auto found = std::lower_bound(bricks_.begin(), bricks_.end(), brick, by_zyx);
  if (found == bricks_.end() || *found != brick) return builder.take();
  const auto i = std::size_t(found - bricks_.begin());
  for (std::uint32_t k = begin_[i]; k < begin_[i + 1]; ++k) {
    const auto& t = dense_.triangles[faces_[k]];
    const std::uint32_t a = builder.vertex(dense_.vertices[t[0]]), b = builder.vertex(dense_.vertices[t[1]]);
    builder.add(a, b, builder.vertex(dense_.vertices[t[2]]));
  }
  return builder.take();
}

std::uint64_t count_faces(const SurfaceSource& surface) {
  const std::vector<BrickCoord> bricks = surface.bricks();
  std::atomic<std::uint64_t> faces = 0;
  parallel_for(std::int64_t(bricks.size()),
               [&](std::int64_t i) { faces += surface.piece(bricks[std::size_t(i)]).triangles.size(); });
  return faces;
}

Piece whole_piece(const SurfaceSource& surface) {
  const std::vector<BrickCoord> bricks = surface.bricks();
  std::vector<Piece> pieces(bricks.size());
  parallel_for(std::int64_t(bricks.size()),
               [&](std::int64_t i) { pieces[std::size_t(i)] = surface.piece(bricks[std::size_t(i)]); });
  Piece whole = weld(pieces);
  whole.cell = kEverywhere;
  return whole;
}

LatticeMesh dense_surface(const BrickShelf& shelf, const GridFrame& frame) {
  Piece whole = whole_piece(ShelfSurface(shelf, frame));
  LatticeMesh mesh;
  mesh.frame = frame;
  mesh.vertices = std::move(whole.vertices);
  mesh.triangles = std::move(whole.triangles);
  return mesh;
}

}  // namespace bp
