#include "lib/meshing/surface.h"

#include <algorithm>
#include <bit>
#include <tuple>

#include "lib/core/parallel.h"

namespace bp {

namespace {

constexpr int kCorners = kBrickEdge + 1;
constexpr std::uint32_t kNone = ~std::uint32_t(0);

class PieceBuilder {
 public:
  Piece build(const BrickShelf& shelf, BrickCoord brick) {
    first_ = first_voxel(brick);
    bits_.reset({{first_.x - 64, first_.y - 1, first_.z - 1}, {first_.x + 128, first_.y + 65, first_.z + 65}});
    load_voxels(shelf, bits_);
    index_.resize(std::size_t(kCorners) * kCorners * kCorners, kNone);
    piece_.cell = {lattice({0, 0, 0}), lattice({kBrickEdge, kBrickEdge, kBrickEdge})};
    for (std::int32_t z = 0; z < kBrickEdge; ++z) {
      for (std::int32_t y = 0; y < kBrickEdge; ++y) row(y, z);
    }
    for (const std::size_t slot : used_) index_[slot] = kNone;
    used_.clear();
    return std::move(piece_);
  }

 private:
  /// Lattice point of a corner of the brick's voxels, (0, 0, 0) to (64, 64, 64).
  [[nodiscard]] LatticeCoord lattice(VoxelCoord c) const {
    const auto at = [](std::int32_t a, std::int32_t b) { return (std::int64_t(a) + b) * kLatticePerVoxel; };
    return {at(first_.x, c.x), at(first_.y, c.y), at(first_.z, c.z)};
  }

  /// Faces of the 64 voxels (0..63, y, z).
  void row(std::int32_t y, std::int32_t z) {
    const std::uint64_t* r = bits_.row(first_.y + y, first_.z + z);
    const std::uint64_t in = r[1];
    if (in == 0) return;
    const auto beside = [&](int dy, int dz) { return bits_.row(first_.y + y + dy, first_.z + z + dz)[1]; };
    faces(in & ~((in >> 1) | (r[2] << 63)), y, z, 0, true);
    faces(in & ~((in << 1) | (r[0] >> 63)), y, z, 0, false);
    faces(in & ~beside(1, 0), y, z, 1, true);
    faces(in & ~beside(-1, 0), y, z, 1, false);
    faces(in & ~beside(0, 1), y, z, 2, true);
    faces(in & ~beside(0, -1), y, z, 2, false);
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
    for (int i = 0; i < 4; ++i) {
      VoxelCoord corner = c;
      corner[u] += i == 1 || i == 2;
      corner[w] += i >= 2;
      q[i] = vertex(corner);
    }
    if (!high) std::swap(q[1], q[3]);
    piece_.triangles.push_back({q[0], q[1], q[2]});
    piece_.triangles.push_back({q[0], q[2], q[3]});
  }

  std::uint32_t vertex(VoxelCoord c) {
    const auto slot = std::size_t((c.z * kCorners + c.y) * kCorners + c.x);
    if (index_[slot] == kNone) {
      index_[slot] = std::uint32_t(piece_.vertices.size());
      used_.push_back(slot);
      piece_.vertices.push_back(lattice(c));
    }
    return index_[slot];
  }

  VoxelCoord first_;
  BitBox bits_;
  std::vector<std::uint32_t> index_;  // of the vertex at each corner
  std::vector<std::size_t> used_;     // corners that have one
  Piece piece_;
};

}  // namespace

Piece extract_piece(const BrickShelf& shelf, BrickCoord brick) {
  thread_local PieceBuilder builder;
  return builder.build(shelf, brick);
}

LatticeMesh dense_surface(const BrickShelf& shelf, const GridFrame& frame) {
  std::vector<BrickCoord> bricks = shelf.coords();
  std::sort(bricks.begin(), bricks.end(),
            [](BrickCoord a, BrickCoord b) { return std::tuple(a.z, a.y, a.x) < std::tuple(b.z, b.y, b.x); });
  std::vector<Piece> pieces(bricks.size());
  parallel_for(std::int64_t(bricks.size()),
               [&](std::int64_t i) { pieces[std::size_t(i)] = extract_piece(shelf, bricks[std::size_t(i)]); });
  Piece whole = weld(pieces);
  LatticeMesh mesh;
  mesh.frame = frame;
  mesh.vertices = std::move(whole.vertices);
  mesh.triangles = std::move(whole.triangles);
  return mesh;
}

}  // namespace bp
