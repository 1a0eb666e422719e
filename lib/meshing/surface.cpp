#include "lib/meshing/surface.h"

#include <algorithm>
#include <bit>
#include <unordered_map>

#include "lib/core/error.h"
#include "lib/core/parallel.h"

namespace bp {

namespace {

constexpr int kCorners = kBrickEdge + 1;
constexpr std::uint32_t kNone = ~std::uint32_t(0);

class PieceBuilder {
 public:
  SurfacePiece build(const BrickShelf& shelf, BrickCoord brick) {
    first_ = first_voxel(brick);
    bits_.reset({{first_.x - 64, first_.y - 1, first_.z - 1}, {first_.x + 128, first_.y + 65, first_.z + 65}});
    load_voxels(shelf, bits_);
    index_.assign(std::size_t(kCorners) * kCorners * kCorners, kNone);
    for (std::int32_t z = 0; z < kBrickEdge; ++z) {
      for (std::int32_t y = 0; y < kBrickEdge; ++y) row(y, z);
    }
    return std::move(piece_);
  }

 private:
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
    std::uint32_t& slot = index_[std::size_t((c.z * kCorners + c.y) * kCorners + c.x)];
    if (slot == kNone) {
      slot = std::uint32_t(piece_.vertices.size());
      const auto lattice = [](std::int32_t a, std::int32_t b) { return (std::int64_t(a) + b) * kLatticePerVoxel; };
      piece_.vertices.push_back({lattice(first_.x, c.x), lattice(first_.y, c.y), lattice(first_.z, c.z)});
    }
    return slot;
  }

  VoxelCoord first_;
  BitBox bits_;
  std::vector<std::uint32_t> index_;
  SurfacePiece piece_;
};

struct LatticeHash {
  std::size_t operator()(const LatticeCoord& c) const {
    std::uint64_t h = std::uint64_t(c.x) * 0x9e3779b97f4a7c15u ^ std::uint64_t(c.y) * 0xc2b2ae3d27d4eb4fu ^
                      std::uint64_t(c.z) * 0x165667b19e3779f9u;
    return std::size_t(h ^ (h >> 29));
  }
};

bool on_seam(LatticeCoord p) {
  constexpr std::int64_t edge = std::int64_t(kBrickEdge) * kLatticePerVoxel;
  return p.x % edge == 0 || p.y % edge == 0 || p.z % edge == 0;
}

}  // namespace

SurfacePiece extract_piece(const BrickShelf& shelf, BrickCoord brick) {
  thread_local PieceBuilder builder;
  return builder.build(shelf, brick);
}

LatticeMesh dense_surface(const BrickShelf& shelf, const GridFrame& frame) {
  std::vector<BrickCoord> bricks = shelf.coords();
  std::sort(bricks.begin(), bricks.end(),
            [](BrickCoord a, BrickCoord b) { return std::tuple(a.z, a.y, a.x) < std::tuple(b.z, b.y, b.x); });
  std::vector<SurfacePiece> pieces(bricks.size());
  parallel_for(std::int64_t(bricks.size()),
               [&](std::int64_t i) { pieces[std::size_t(i)] = extract_piece(shelf, bricks[std::size_t(i)]); });

  LatticeMesh mesh;
  mesh.frame = frame;
  std::size_t vertices = 0, triangles = 0;
  for (const SurfacePiece& p : pieces) {
    vertices += p.vertices.size();
    triangles += p.triangles.size();
  }
  if (triangles >= (std::size_t(1) << 32) / 3) {
    fail(ErrorCode::out_of_resource,
         "the dense surface has {} triangles, more than one piece can index; use larger voxels", triangles);
  }
  mesh.vertices.reserve(vertices);
  mesh.triangles.reserve(triangles);
  std::unordered_map<LatticeCoord, std::uint32_t, LatticeHash> seam;
  std::vector<std::uint32_t> to_mesh;
  for (SurfacePiece& piece : pieces) {
    to_mesh.clear();
    for (const LatticeCoord& v : piece.vertices) {
      const auto fresh = std::uint32_t(mesh.vertices.size());
      const std::uint32_t id = on_seam(v) ? seam.try_emplace(v, fresh).first->second : fresh;
      if (id == fresh) mesh.vertices.push_back(v);
      to_mesh.push_back(id);
    }
    for (const auto& t : piece.triangles) mesh.triangles.push_back({to_mesh[t[0]], to_mesh[t[1]], to_mesh[t[2]]});
    piece = {};
  }
  return mesh;
}

}  // namespace bp
