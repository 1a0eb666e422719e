// The closing of [CB17] §3.3 by distance transforms instead of the paper's walk down a tree per voxel: the same voxels,
// at a cost that does not depend on how far the walk would go. Dilation: windowed ORs for a cube, a threshold on a
// squared distance for a ball. Erosion: a threshold on a power transform of the contour. Both only over the band D
// minus G, and only around what is occupied.
#include "lib/closing/closing.h"

#include <algorithm>
#include <bit>

#include "lib/closing/detail/closing_parts.h"

namespace bp {

namespace {

using detail::BallRule;
using detail::BallScale;
using detail::ColumnBits;
using detail::ScaleRange;

VoxelBox whole_words(VoxelBox box) {
  box.min.x = floor_div(box.min.x, 64) * 64;
  box.max.x = ceil_div(box.max.x, 64) * 64;
  return box;
}

/// Bits of the word at `x` that lie in [min, max).
std::uint64_t bits_between(std::int32_t x, std::int32_t min, std::int32_t max) {
  const std::int32_t lo = std::max(min - x, 0), hi = std::min(max - x, 64);
  return lo >= hi ? 0 : (~std::uint64_t(0) << lo) & (~std::uint64_t(0) >> (64 - hi));
}

/// Bounds of the occupied voxels of `bits` inside `box`, in x to whole words.
VoxelBox occupied_bounds(const BitBox& bits, const VoxelBox& box) {
  const VoxelBox in = intersect(bits.box(), whole_words(box));
  VoxelBox found{in.max, in.min};
  for (std::int32_t z = in.min.z; z < in.max.z; ++z) {
    for (std::int32_t y = in.min.y; y < in.max.y; ++y) {
      const std::uint64_t* row = bits.row(y, z) + (in.min.x - bits.box().min.x) / 64;
      const std::int32_t words = (in.max.x - in.min.x) / 64;
      std::int32_t first = 0, last = words;
      while (first < last && row[first] == 0) ++first;
      if (first == last) continue;
      while (row[last - 1] == 0) --last;
      found.min = {std::min(found.min.x, in.min.x + 64 * first), std::min(found.min.y, y), std::min(found.min.z, z)};
      found.max = {std::max(found.max.x, in.min.x + 64 * last), std::max(found.max.y, y + 1), z + 1};
    }
  }
  return found.empty() ? VoxelBox{} : found;
}

bool full(const BitBox& bits) {
  return std::all_of(bits.data(), bits.data() + bits.word_count(),
                     [](std::uint64_t w) { return w == ~std::uint64_t(0); });
}

/// body(words of the row, words per row, y, z) for the rows of `bits` in `box`, from the word at box.min.x on.
template <class Body>
void for_each_row(const VoxelBox& box, const Body& body) {
  for (std::int32_t z = box.min.z; z < box.max.z; ++z) {
    for (std::int32_t y = box.min.y; y < box.max.y; ++y) body(y, z);
  }
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
      dilate_ball();
    } else if (params.turned() && s_.oriented.turns(*params.orientation, s_.dilation.box())) {
      s_.oriented.run(solid_, scale_, s_.dilation, params.cube_bytes);
    } else if (cube_radius(range_.min) == cube_radius(range_.max)) {
      s_.cube.run(solid_, cube_radius(range_.max), s_.dilation);
    } else {
      s_.varying.run(solid_, scale_, s_.dilation.box(), s_.dilation);
    }
  }

  /// Dc over `box`, by columns. False if it has no voxel.
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

  /// D minus G over `box`, by columns; `closed` holds G. False if it has no voxel.
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

  /// Keeps of the band what the erosion removes.
  void erode() { s_.ball.run(s_.contour, rule(BallScale::at_seed), s_.band); }

  /// closed |= D minus what the erosion removes (nothing unless `eroded`).
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

  /// The cube inscribed in the smallest ball is in D without any distance, what lies outside of the cube around the
  /// largest is not; between them, the distance to the solid decides.
  void dilate_ball() {
    const std::int32_t reach = detail::ball_reach(ball_bound(range_.max)),
                       inscribed = detail::ball_reach(std::max(1, (ball_bound(range_.min) + 2) / 3));
    s_.cube.run(solid_, reach, s_.dilation);
    s_.inner.reset(s_.dilation.box());
    s_.cube.run(solid_, inscribed, s_.inner);
    const VoxelBox& box = s_.dilation.box();
    s_.band.reset(box);
    for_each_row(box, [&](std::int32_t y, std::int32_t z) {
      const std::uint64_t *outer = s_.dilation.row(y, z), *inner = s_.inner.row(y, z);
      std::uint64_t* out = s_.band.slice(0, z) + (y - box.min.y);
      for (std::int32_t i = 0; i < s_.band.columns(); ++i)
        out[std::size_t(i) * s_.band.column_stride()] = outer[i] & ~inner[i];
    });
    s_.seeds.reset(intersect(occupied_, whole_words(box.grown(reach))));
    for_each_row(s_.seeds.box(), [&](std::int32_t y, std::int32_t z) {
      const std::uint64_t* g = solid_.row(y, z) + (s_.seeds.box().min.x - solid_.box().min.x) / 64;
      std::uint64_t* out = s_.seeds.slice(0, z) + (y - s_.seeds.box().min.y);
      for (std::int32_t i = 0; i < s_.seeds.columns(); ++i) out[std::size_t(i) * s_.seeds.column_stride()] = g[i];
    });
    s_.ball.run(s_.seeds, rule(BallScale::at_target), s_.band);
    for_each_row(box, [&](std::int32_t y, std::int32_t z) {
      std::uint64_t* d = s_.dilation.row(y, z);
      const std::uint64_t *inner = s_.inner.row(y, z), *reached = s_.band.slice(0, z) + (y - box.min.y);
      for (std::int32_t i = 0; i < s_.band.columns(); ++i)
        d[i] = inner[i] | reached[std::size_t(i) * s_.band.column_stride()];
    });
  }

  const BitBox& solid_;
  const ScaleLattice& scale_;
  const VoxelBox occupied_;
  const ScaleRange range_;
  ClosingScratch::Parts& s_;
};

/// Adds to `closed`, which holds G, what the closing adds.
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
