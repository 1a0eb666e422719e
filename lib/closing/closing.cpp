// The closing of [CB17] §3.3 by distance transforms. The paper walks down a tree for each voxel; the voxels are the
// same, at a cost that does not depend on the length of that walk. The dilation is a windowed OR for a cube, and a
// threshold on a squared distance for a ball. The erosion is a threshold on a power transform of the contour. Both are
// computed only in the band D minus G, and only around occupied voxels.
#include "lib/closing/closing.h"

#include <algorithm>
#include <bit>

#include "lib/closing/detail/ball_dilation.h"
#include "lib/closing/detail/rows.h"

namespace bp {

namespace {

using detail::BallRule;
using detail::BallScale;
using detail::ColumnBits;
using detail::for_each_row;
using detail::occupied_bounds;
using detail::ScaleRange;
using detail::whole_words;

/// Returns the bits of the word at `x` that lie in [min, max).
std::uint64_t bits_between(std::int32_t x, std::int32_t min, std::int32_t max) {
  const std::int32_t lo = std::max(min - x, 0), hi = std::min(max - x, 64);
  return lo >= hi ? 0 : (~std::uint64_t(0) << lo) & (~std::uint64_t(0) >> (64 - hi));
}

bool full(const BitBox& bits) {
  return std::all_of(bits.data(), bits.data() + bits.word_count(),
                     [](std::uint64_t w) { return w == ~std::uint64_t(0); });
}

/// One closing of one tile.
class TileClosing {
 public:
  TileClosing(const BitBox& solid, const ScaleLattice& scale, const VoxelBox& occupied, const VoxelBox& dilated,
              ScaleRange range, ClosingScratch& scratch)
      : solid_(solid), scale_(scale), occupied_(occupied), range_(range), s_(scratch.parts()) {
    s_.dilation.reset(dilated);
  }

  void dilate(const ClosingParams& params) {
    if (params.element == StructuringElement::ball) {
      detail::dilate_by_balls(solid_, occupied_, rule(BallScale::at_target), ball_bound(range_.min), s_, s_.dilation);
    } else if (params.turned() && s_.oriented.turns(*params.orientation, s_.dilation.box())) {
      s_.oriented.run(solid_, scale_, s_.dilation, params.cube_bytes);
    } else if (cube_radius(range_.min) == cube_radius(range_.max)) {
      s_.cube.run(solid_, cube_radius(range_.max), s_.dilation);
    } else {
      s_.varying.run(solid_, scale_, s_.dilation.box(), s_.dilation);
    }
  }

  /// Finds Dc over `box`, by columns. Returns false if it has no voxel.
  bool find_contour(const VoxelBox& box) {
    s_.contour.reset(whole_words(box));
    const VoxelBox& d = s_.dilation.box();
    const std::int32_t words = s_.contour.columns(), first = (s_.contour.box().min.x - d.min.x) / 64;
    const std::vector<std::uint64_t> nothing(std::size_t(s_.dilation.words_per_row()), 0);
    const auto row = [&](std::int32_t y, std::int32_t z) {
      return y >= d.min.y && y < d.max.y && z >= d.min.z && z < d.max.z ? s_.dilation.row(y, z) : nothing.data();
    };
    std::uint64_t any = 0;
    for_each_row(s_.contour.box(), [&](std::int32_t y, std::int32_t z) {
      const std::uint64_t *here = row(y, z), *south = row(y - 1, z), *north = row(y + 1, z), *below = row(y, z - 1),
                          *above = row(y, z + 1);
      std::uint64_t* out = s_.contour.slice(0, z) + (y - s_.contour.box().min.y);
      for (std::int32_t i = 0; i < words; ++i) {
        const std::int32_t w = first + i;
        const std::uint64_t before = w > 0 ? here[w - 1] : 0,
                            after = w + 1 < s_.dilation.words_per_row() ? here[w + 1] : 0;
        const std::uint64_t sides = (here[w] << 1) | (before >> 63) | (here[w] >> 1) | (after << 63);
        const std::uint64_t q = ~here[w] & (sides | south[w] | north[w] | below[w] | above[w]) &
                                bits_between(s_.contour.box().min.x + 64 * i, box.min.x, box.max.x);
        out[std::size_t(i) * s_.contour.column_stride()] = q;
        any |= q;
      }
    });
    return any != 0;
  }

  /// Finds D minus G over `box`, by columns; `closed` holds G. Returns false if it has no voxel.
  bool find_band(const BitBox& closed) {
    s_.band.reset(intersect(closed.box(), s_.dilation.box()));
    const VoxelBox& box = s_.band.box();
    std::uint64_t any = 0;
    for_each_row(box, [&](std::int32_t y, std::int32_t z) {
      const std::uint64_t* d = s_.dilation.row(y, z) + (box.min.x - s_.dilation.box().min.x) / 64;
      const std::uint64_t* g = closed.row(y, z) + (box.min.x - closed.box().min.x) / 64;
      std::uint64_t* out = s_.band.slice(0, z) + (y - box.min.y);
      for (std::int32_t i = 0; i < s_.band.columns(); ++i) {
        out[std::size_t(i) * s_.band.column_stride()] = d[i] & ~g[i];
        any |= d[i] & ~g[i];
      }
    });
    return any != 0;
  }

  /// Keeps the part of the band that the erosion removes.
  void erode() { s_.ball.run(s_.contour, rule(BallScale::at_seed), s_.band); }

  /// Adds D to `closed`, without the voxels that the erosion removes. If `eroded` is false, it removes nothing.
  void finish(bool eroded, BitBox& closed) const {
    const VoxelBox& box = s_.band.box();
    for_each_row(box, [&](std::int32_t y, std::int32_t z) {
      const std::uint64_t* d = s_.dilation.row(y, z) + (box.min.x - s_.dilation.box().min.x) / 64;
      std::uint64_t* g = closed.row(y, z) + (box.min.x - closed.box().min.x) / 64;
      const std::uint64_t* removed = s_.band.slice(0, z) + (y - box.min.y);
      for (std::int32_t i = 0; i < s_.band.columns(); ++i)
        g[i] |= d[i] & ~(eroded ? removed[std::size_t(i) * s_.band.column_stride()] : 0);
    });
  }

 private:
  [[nodiscard]] BallRule rule(BallScale varying) const {
    const std::int32_t bound = ball_bound(range_.max);
    return ball_bound(range_.min) == bound ? BallRule{BallScale::uniform, bound, nullptr}
                                           : BallRule{varying, bound, &scale_};
  }

  const BitBox& solid_;
  const ScaleLattice& scale_;
  const VoxelBox occupied_;
  const ScaleRange range_;
  ClosingScratch::Parts& s_;
};

/// Adds the voxels of the closing to `closed`, which holds G.
void add_closing(const BitBox& solid, const ScaleLattice& scale, const Halo& halo, const ClosingParams& params,
                 const VoxelBox& interior, BitBox& closed, ClosingScratch& scratch) {
  if (full(closed)) return;
  const VoxelBox needed = interior.grown(halo.erosion_vox);
  const VoxelBox occupied = occupied_bounds(solid, needed.grown(halo.dilation_vox));
  if (occupied.empty()) return;
  const ScaleRange range = detail::scale_range(scale, needed);
  const std::int32_t reach = element_reach(range.max, params);
  if (reach == 0) return;                              // D = G
  const VoxelBox touched = occupied.grown(reach + 1);  // D and Dc lie in it
  const VoxelBox dilated = intersect(needed, touched);
  if (intersect(dilated, interior).empty()) return;

  TileClosing work(solid, scale, occupied, dilated, range, scratch);
  work.dilate(params);
  if (!work.find_band(closed)) return;
  const bool eroded = work.find_contour(intersect(interior.grown(std::max(halo.erosion_vox - 1, 0)), touched));
  if (eroded) work.erode();
  work.finish(eroded, closed);
}

}  // namespace

std::size_t turned_cubes_bytes(std::int32_t reach) {
  return detail::OrientedDilation::least_bytes(reach);
}

ClosingScratch::ClosingScratch() : parts_(std::make_unique<Parts>()) {}

ClosingScratch::~ClosingScratch() = default;

void close_tile(const BitBox& solid, const ScaleLattice& scale, const Halo& halo, const ClosingParams& params,
                const VoxelBox& interior, BitBox& closed, ClosingScratch& scratch) {
  closed.reset(interior);
  if (interior.empty()) return;
  copy_voxels(solid, closed);
  add_closing(solid, scale, halo, params, interior, closed, scratch);
  if (closed.box() == interior) return;
  for_each_row(interior, [&](std::int32_t y, std::int32_t z) {  // words reach beyond a tile that is not whole words
    std::uint64_t* row = closed.row(y, z);
    row[0] &= bits_between(closed.box().min.x, interior.min.x, interior.max.x);
    row[closed.words_per_row() - 1] &= bits_between(closed.box().max.x - 64, interior.min.x, interior.max.x);
  });
}

}  // namespace bp
