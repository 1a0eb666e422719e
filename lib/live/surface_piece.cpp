#include "lib/live/surface_piece.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "lib/core/pool.h"
#include "lib/live/detail/blurred_box.h"
#include "lib/volume/boundary_runs.h"

namespace bp {

namespace {

constexpr int kCorners = kBrickEdge + 1;
constexpr std::uint32_t kNone = ~std::uint32_t(0);
/// Per voxel. At a corner of a box it is 0.08, at a sheet of two voxels 0.065, at one of one voxel 0.02.
constexpr float kThinGradient = 0.06F;

/// The corners of a face across `axis`, counter-clockwise seen from its greater side, as steps from its least corner.
constexpr std::array<std::array<std::array<int, 3>, 4>, 3> kFace{{
    {{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}},
    {{{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}},
    {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}},
}};

/// Makes pieces, one after the other.
class PieceMaker {
 public:
  SurfacePiece make(const BrickShelf& shelf, BrickCoord brick, const ScaleLattice& scale) {
    begin(brick, &scale);
    if (shelf.fill(brick) == BrickFill::empty || is_buried(shelf, brick)) return std::move(piece_);
    load_voxels(shelf, solid_);
    return finish();
  }
  SurfacePiece make(const BitBox& cells, BrickCoord brick) {
    begin(brick, nullptr);
    copy_voxels(cells, solid_);
    return finish();
  }

 private:
  void begin(BrickCoord brick, const ScaleLattice* scale) {
    piece_ = {};
    piece_.brick = brick;
    first_ = first_voxel(brick);
    scale_ = scale;
    solid_.reset(voxels_of(brick).grown(BlurredBox::kApron));
  }
  SurfacePiece finish() {
    numbers_.assign(std::size_t(kCorners) * kCorners * kCorners, kNone);
    blurred_ = false;
    for (int z = 0; z < kBrickEdge; ++z) {
      for (int y = 0; y < kBrickEdge; ++y) add_faces(y, z);
    }
    return std::move(piece_);
  }
  /// Returns the 64 voxels of a row of the brick, moved by one voxel along x.
  [[nodiscard]] std::uint64_t word(int y, int z, int moved = 0) const {
    const std::uint64_t* const row = solid_.row(first_.y + y, first_.z + z);
    const int i = (first_.x - solid_.box().min.x) >> 6;
    if (moved == 0) return row[i];
    return moved > 0 ? (row[i] >> 1) | (row[i + 1] << 63) : (row[i] << 1) | (row[i - 1] >> 63);
  }

  void add_faces(int y, int z) {
    const std::uint64_t here = word(y, z);
    if (here == 0) return;
    const std::array<std::uint64_t, 6> there{word(y, z, -1), word(y, z, 1),  word(y - 1, z),
                                             word(y + 1, z), word(y, z - 1), word(y, z + 1)};
    for (int side = 0; side < 6; ++side) {
      for (std::uint64_t open = here & ~there[std::size_t(side)]; open != 0; open &= open - 1)
        add_face({std::countr_zero(open), y, z}, side / 2, side % 2 == 1);
    }
  }

  void add_face(std::array<int, 3> at, int axis, bool greater) {
    if (greater) ++at[std::size_t(axis)];
    std::array<std::uint32_t, 4> v{};
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& step = kFace[std::size_t(axis)][greater ? i : 3 - i];
      v[i] = vertex(at[0] + step[0], at[1] + step[1], at[2] + step[2]);
    }
    piece_.faces.push_back(v);
  }

  std::uint32_t vertex(int x, int y, int z) {
    std::uint32_t& number = numbers_[std::size_t((z * kCorners + y) * kCorners + x)];
    if (number != kNone) return number;
    if (!blurred_) field_.reset(solid_, first_);
    blurred_ = true;
    number = std::uint32_t(piece_.vertices.size());
    piece_.vertices.push_back(smooth(x, y, z));
    piece_.corners.push_back({first_.x + x, first_.y + y, first_.z + z});
    return number;
  }

  [[nodiscard]] SurfacePiece::Vertex smooth(int x, int y, int z) const {
    const BlurredBox::Level level = field_.at(x, y, z);
    const auto& g = level.gradient;
    const float square = g[0] * g[0] + g[1] * g[1] + g[2] * g[2], length = std::sqrt(square);
    SurfacePiece::Vertex out{};
    const float most = SurfacePiece::kMostMoved * std::min(1.0F, length / kThinGradient);
    for (std::size_t i = 0; i < 3; ++i) {
      const float step = square > 1e-8F ? (0.5F - level.value) * g[i] / square : 0;
      // The move is rounded before the corner is added, so that a corner on the side of two bricks moves alike in both.
      const long moved = std::lround(std::clamp(step, -most, most) * float(SurfacePiece::kPerVoxel));
      out.position[i] =
          std::uint16_t((std::array{x, y, z}[i] + SurfacePiece::kOrigin) * SurfacePiece::kPerVoxel + int(moved));
      out.normal[i] = std::int8_t(length > 0 ? std::lround(-127 * g[i] / length) : 0);
    }
    if (scale_ != nullptr) out.scale = scale_->at({first_.x + x, first_.y + y, first_.z + z});
    return out;
  }

  SurfacePiece piece_;
  VoxelCoord first_;
  BitBox solid_;
  BlurredBox field_;
  std::vector<std::uint32_t> numbers_;   ///< number of the vertex at each corner
  const ScaleLattice* scale_ = nullptr;  ///< null: the piece has no scales
  bool blurred_ = false;
};

/// Calls make(maker). There are as many makers as threads have made pieces at once.
template <class Make>
SurfacePiece with_maker(const Make& make) {
  static Spares<PieceMaker> makers;
  PieceMaker maker = makers.take();
  SurfacePiece piece = make(maker);
  makers.give(std::move(maker));
  return piece;
}

}  // namespace

std::int32_t piece_apron() {
  return BlurredBox::kApron;
}

SurfacePiece piece_of(const BrickShelf& shelf, BrickCoord brick, const ScaleLattice& scale) {
  return with_maker([&](PieceMaker& maker) { return maker.make(shelf, brick, scale); });
}

SurfacePiece piece_of(const BitBox& cells, BrickCoord brick) {
  return with_maker([&](PieceMaker& maker) { return maker.make(cells, brick); });
}

}  // namespace bp
