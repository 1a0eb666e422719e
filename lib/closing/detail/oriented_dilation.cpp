#include "lib/closing/detail/oriented_dilation.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "lib/closing/detail/halves.h"
#include "lib/closing/detail/rows.h"

namespace bp::detail {

namespace {

/// Scales that differ in a cell are rounded to this step, so that cells share cubes.
constexpr std::int32_t kStep = kScaleOne / 2;
constexpr std::int32_t kMostScale = std::numeric_limits<Scale>::max();
/// voxels; the least radius of a cube of large voxels, because smaller ones decide too little
constexpr std::int32_t kLeastRadius = 8;

/// Calls test() for the bits [first, last] of a row of `bits` bits that are set, until one is true. Returns whether one
/// was.
template <class Test>
bool any_bit(const std::uint64_t* row, std::int32_t bits, std::int32_t first, std::int32_t last, const Test& test) {
  first = std::max(first, 0);
  last = std::min(last, bits - 1);
  if (first > last) return false;
  for (std::int32_t w = first / 64; w <= last / 64; ++w) {
    std::uint64_t word = row[w];
    if (w == first / 64) word &= ~std::uint64_t(0) << (first & 63);
    if (w == last / 64) word &= ~std::uint64_t(0) >> (63 - (last & 63));
    for (; word != 0; word &= word - 1) {
      if (test(64 * w + std::countr_zero(word))) return true;
    }
  }
  return false;
}

/// Sets `out` to the voxels of `box`, grown by `r` along y or z, that lie within r of a voxel of `solid` along that
/// axis. `box` must lie in the box of `solid`.
void dilate_along(const BitBox& solid, int axis, std::int32_t r, VoxelBox box, BitBox& out) {
  box.min[axis] -= r;
  box.max[axis] += r;
  out.reset(box);
  copy_voxels(solid, out);
  const VoxelBox& all = out.box();
  const std::int32_t rows = all.max[axis] - all.min[axis], others = all.max[3 - axis] - all.min[3 - axis];
  const auto words = std::size_t(out.words_per_row());
  // Row t takes the `width` rows that end with it, or begin with it.
  const auto widen = [&](std::int32_t step, std::int32_t width) {
    const auto row = [&](std::int32_t t, std::int32_t k) {
      const std::int32_t at = all.min[axis] + (step > 0 ? rows - 1 - t : t), other = all.min[3 - axis] + k;
      return axis == 2 ? out.row(other, at) : out.row(at, other);
    };
    for (std::int32_t has = 1; has < width;) {
      const std::int32_t shift = std::min(has, width - has);
      for (std::int32_t t = 0; t + shift < rows; ++t) {
        for (std::int32_t k = 0; k < others; ++k) {
          std::uint64_t *to = row(t, k), *from = row(t + shift, k);
          for (std::size_t i = 0; i < words; ++i) to[i] |= from[i];
        }
      }
      has += shift;
    }
  };
  widen(1, r + 1);
  widen(-1, r + 1);
}

}  // namespace

bool OrientedDilation::turns(const OrientationField& field, const VoxelBox& region) {
  cubes_ = cubes_over(field, region);
  row_sums_.clear();
  for (const Rotation& r : cubes_.rotations) row_sums_.push_back(cube_bounds(r).row_sum);
  return cubes_.widest.turned;
}

std::size_t OrientedDilation::least_bytes(std::int32_t reach) {
  constexpr std::size_t kEnough = 4 << 20;
  return std::max(kEnough, 2 * CubeRows::most_bytes(reach));
}

void OrientedDilation::run(const BitBox& solid, const ScaleLattice& scale, BitBox& out, std::size_t most_bytes) {
  const ScaleRange range = scale_range(scale, out.box());
  const int coarse = coarsest(range);
  most_bytes_ = std::max(most_bytes, least_bytes(cubes_.widest.reach(Scale(std::min(range.max + kStep, kMostScale)))));
  levels_.resize(std::max(levels_.size(), std::size_t(coarse) + 1));
  std::swap(levels_[0].in, out);
  find_kept_axis(solid, range, levels_[0].in.box());
  lay_levels(solid, range, levels_[0].in.box(), coarse);
  for (int k = coarse; k >= 0; --k) {
    edge_ = 1 << k;
    reach_ = cubes_.widest.reach(
        Scale(std::min(coarse_scale(cubes_.widest.row_sum, range.max, edge_).possible + kStep, kMostScale)));
    decide_level(k, k > 0 ? levels_[std::size_t(k)].solid : flat_ >= 0 ? along_ : solid, scale);
  }
  std::swap(levels_[0].in, out);
}

/// If all cubes have one size and are turned about y or z, the solid is dilated along that axis first. Then one slice
/// of each cube is left to do.
void OrientedDilation::find_kept_axis(const BitBox& solid, const ScaleRange& range, const VoxelBox& region) {
  flat_ = -1;
  for (const int axis : {1, 2}) {
    if (range.min == range.max && std::all_of(cubes_.rotations.begin(), cubes_.rotations.end(),
                                              [&](const Rotation& r) { return keeps_axis(r, axis); }))
      flat_ = axis;
  }
  if (flat_ >= 0)
    dilate_along(solid, flat_, cube_radius(range.max),
                 intersect(solid.box(), region.grown(cubes_.widest.reach(range.max))), along_);
}

/// Returns the level of the largest voxels. Each of them must lie in one cell of the field.
int OrientedDilation::coarsest(const ScaleRange& range) const {
  int level = 0;
  while (cube_radius(range.max) >> (level + 1) >= kLeastRadius &&
         (cubes_.rotations.size() == 1 || cubes_.edge % (kCell << (level + 1)) == 0))
    ++level;
  return level;
}

void OrientedDilation::lay_levels(const BitBox& solid, const ScaleRange& range, const VoxelBox& region, int coarsest) {
  const BitBox* from = &solid;
  VoxelBox box = region;
  CoarseScale s{range.min, range.max};
  for (int k = 0; k <= coarsest; ++k) {
    Level& level = levels_[std::size_t(k)];
    if (k > 0) {
      box = halved(box);
      level.in.reset(box);
      s = {coarse_scale(cubes_.widest.row_sum, range.min, 1 << k).sure,
           coarse_scale(cubes_.widest.row_sum, range.max, 1 << k).possible};
      const std::int32_t reach = cubes_.widest.reach(Scale(std::min(s.possible + kStep, kMostScale)));
      level.solid.reset(intersect(halved(from->box()), level.in.box().grown(reach)));
      halve(*from, level.solid);
      from = &level.solid;
    }
    level.may.reset(level.in.box());
    box = level.in.box();
  }
  Level& top = levels_[std::size_t(coarsest)];
  if (s.sure >= 0) cube_.run(*from, cubes_.widest.inner(Scale(s.sure)) / kScaleOne, top.in);
  cube_.run(*from, cubes_.widest.reach(Scale(std::min(s.possible, kMostScale))), top.may);
}

void OrientedDilation::decide_level(int level, const BitBox& solid, const ScaleLattice& scale) {
  Level& here = levels_[std::size_t(level)];
  tables_.lay(here.in.box(), reach_);
  list_blocks(here, scale);
  decide_blocks(solid, scale);
  finish(here);
  if (level == 0) return;
  double_up(here.in, levels_[std::size_t(level - 1)].in);
  double_up(here.may, levels_[std::size_t(level - 1)].may);
}

void OrientedDilation::list_blocks(const Level& level, const ScaleLattice& scale) {
  const VoxelBox& box = level.in.box();
  parts_.clear();
  blocks_.clear();
  open_.clear();
  for (std::int32_t z = floor_div(box.min.z, kSlices) * kSlices; z < box.max.z; z += kSlices) {
    for (std::int32_t y = floor_div(box.min.y, kAcross) * kAcross; y < box.max.y; y += kAcross) {
      for (std::int32_t x = box.min.x; x < box.max.x; x += 64) list_blocks({x, y, z}, level, scale);
    }
  }
  maybe_.assign(edge_ > 1 ? open_.size() : 0, 0);
}

/// Lists the blocks in a word's width that have open voxels: those that may be in, and are not surely in.
void OrientedDilation::list_blocks(VoxelCoord first, const Level& level, const ScaleLattice& scale) {
  const VoxelBox rows = intersect(level.in.box(), {first, first + VoxelCoord{64, kAcross, kSlices}});
  const std::int32_t column = (first.x - level.in.box().min.x) / 64;
  std::uint64_t words[kSlices * kAcross] = {}, any = 0;
  for_each_row(rows, [&](std::int32_t y, std::int32_t z) {
    std::uint64_t& word = words[(z - first.z) * kAcross + y - first.y];
    any |= word = level.may.row(y, z)[column] & ~level.in.row(y, z)[column];
  });
  for (std::int32_t i = 0; any != 0; ++i, any >>= kAcross) {
    constexpr Word kAll = (1U << kAcross) - 1;
    if ((any & kAll) == 0) continue;
    Block block{first + VoxelCoord{kAcross * i, 0, 0}, parts_.size(), 0, open_.size()};
    for (std::int32_t k = 0; k < kSlices; ++k) {
      for (std::int32_t j = 0; j < kAcross; ++j) {
        open_.push_back(Word(words[k * kAcross + j] >> (kAcross * i)) & kAll);
        if (open_.back() != 0) block.slices |= 1U << k;
      }
    }
    add_parts(block, scale);
    blocks_.push_back(block);
  }
}

/// Makes one part of all cells with open voxels that have the same rotation and scales.
void OrientedDilation::add_parts(Block& block, const ScaleLattice& scale) {
  for (std::int32_t y = 0; y < kAcross / kCell; ++y) {
    Word open = 0;
    for (std::int32_t i = 0; i < kSlices * kAcross; ++i) {
      if (i % kAcross / kCell == y) open |= open_[block.open + std::size_t(i)];
    }
    for (std::int32_t x = 0; x < kAcross / kCell; ++x) {
      const Word mask = (open >> (kCell * x) & 0xff) << (kCell * x);
      if (mask == 0) continue;
      const Part part = part_of(block.first + VoxelCoord{kCell * x, kCell * y, 0}, scale);
      const auto same = std::find_if(parts_.begin() + std::ptrdiff_t(block.part), parts_.end(), [&](const Part& p) {
        return p.rotation == part.rotation && p.min == part.min && p.max == part.max;
      });
      Word* rows = (same == parts_.end() ? parts_.emplace_back(part) : *same).mask + kCell * y;
      for (std::int32_t j = 0; j < kCell; ++j) rows[j] |= mask;
    }
  }
  block.parts = parts_.size() - block.part;
}

/// Returns the part of the cell that begins at a voxel, without its mask.
OrientedDilation::Part OrientedDilation::part_of(VoxelCoord cell, const ScaleLattice& scale) const {
  const VoxelCoord first = cell * edge_;
  const std::uint16_t rotation = cubes_.at(first);
  const std::int32_t size = kCell * edge_;
  const ScaleRange s = scale_range(scale, {first, first + VoxelCoord{size, size, size}});
  std::int32_t least = coarse_scale(row_sums_[rotation], s.min, edge_).sure,
               most = coarse_scale(row_sums_[rotation], s.max, edge_).possible;
  if (s.min != s.max) {
    least = floor_div(least, kStep) * kStep;
    most = ceil_div(most, kStep) * kStep;
  }
  return {{}, rotation, least, std::min(most, kMostScale)};
}

/// Decides blocks in groups. If the cubes of a block do not fit in memory, the block goes on in the next group.
void OrientedDilation::decide_blocks(const BitBox& solid, const ScaleLattice& scale) {
  group_.clear();
  for (const Block& block : blocks_) {
    Block some = block;
    some.parts = 0;
    for (std::size_t i = block.part; i < block.part + block.parts; ++i) {
      if (!prepare(parts_[i])) {
        if (some.parts > 0) group_.push_back(some);
        sweep(solid, scale);
        kept_.clear();
        kept_bytes_ = 0;
        some = block;
        some.part = i;
        some.parts = 0;
        prepare(parts_[i]);
      }
      ++some.parts;
    }
    group_.push_back(some);
  }
  sweep(solid, scale);
}

/// Makes the part's cubes. Returns false if they may not fit in memory together with the others.
bool OrientedDilation::prepare(Part& part) {
  const Rotation& rotation = cubes_.rotations[part.rotation];
  const auto there = [&](std::int32_t s) { return s < 0 || kept_.count(key(rotation, s)) != 0; };
  if (!kept_.empty() && kept_bytes_ + 2 * CubeRows::most_bytes(reach_) > most_bytes_ &&
      !(there(part.min) && there(part.max)))
    return false;
  part.least = part.min < 0 ? nullptr : cube(rotation, part.min);
  part.most = cube(rotation, part.max);
  return true;
}

const CubeRows* OrientedDilation::cube(const Rotation& rotation, std::int32_t s) {
  auto& found = kept_[key(rotation, s)];
  if (!found) {
    found = std::make_unique<CubeRows>(rotation, Scale(s), flat());
    kept_bytes_ += found->bytes();
  }
  return found.get();
}

void OrientedDilation::sweep(const BitBox& solid, const ScaleLattice& scale) {
  if (group_.empty()) return;
  solid_ = &solid;
  scale_ = &scale;
  const std::int32_t before =
      // Slices before a block where its first block of slices may begin.
      ceil_div(reach_, CubeRows::kEdge) * CubeRows::kEdge;
  std::size_t first = 0, last = 0;  // blocks in reach of the slice
  for (std::int32_t z = group_.front().first.z - before; z < group_.back().first.z + kSlices + reach_; ++z) {
    while (first < group_.size() && group_[first].first.z + kSlices - 1 + reach_ < z) ++first;
    while (last < group_.size() && group_[last].first.z - before <= z) ++last;
    if (first == last) continue;
    const bool any = tables_.load(solid, z);
    for (std::size_t i = first; i < last; ++i) ask_slice(group_[i], z - group_[i].first.z, any);
  }
  group_.clear();
}

/// `any`: the slice or one of the next seven holds a voxel.
void OrientedDilation::ask_slice(Block& block, std::int32_t dz_of_first, bool any) {
  tables_.place(block.first.x, block.first.y);
  constexpr std::int32_t edge = CubeRows::kEdge;
  const std::int32_t begins = dz_of_first - floor_div(dz_of_first, edge) * edge;
  for (std::size_t i = block.part; i < block.part + block.parts; ++i) {
    Part& part = parts_[i];
    for (std::int32_t k = begins; k < kSlices; k += edge) {
      if ((block.slices >> k & 1) != 0) look(block, part, k, dz_of_first - k, any);
    }
    for (std::uint32_t left = part.asks; left != 0; left &= left - 1) {
      const int slice = std::countr_zero(left);
      ask_part(block, part, slice, dz_of_first - slice);
    }
  }
}

void OrientedDilation::look(const Block& block, Part& part, int slice, std::int32_t dz, bool any) const {
  const Word* open = &open_[block.open + std::size_t(slice * kAcross)];
  part.near[slice] = any && dz <= part.most->reach() ? tables_.near(*part.most, dz, part.mask, open) : 0;
  part.asks = (part.asks & ~(1U << slice)) | (part.near[slice] != 0 ? 1U << slice : 0);
}

/// Decides the voxels of one slice of the block by the part's least cube, and then by its largest.
void OrientedDilation::ask_part(const Block& block, Part& part, int slice, std::int32_t dz) {
  const std::uint64_t near = part.near[slice];
  Word* open = &open_[block.open + std::size_t(slice * kAcross)];
  if (part.least != nullptr && tables_.ask(*part.least, dz, near, part.mask, open)) {
    Word left = 0;
    for (std::int32_t j = 0; j < kAcross; ++j) left |= open[j] & part.mask[j];
    if (left == 0) part.asks &= ~(1U << slice);
  }
  if (part.least == part.most) return;
  if (edge_ == 1) return ask_each(block, part, slice, dz);
  Word* maybe = &maybe_[block.open + std::size_t(slice * kAcross)];
  Word asking[kAcross], left[kAcross];
  for (std::int32_t j = 0; j < kAcross; ++j) left[j] = asking[j] = open[j] & ~maybe[j] & part.mask[j];
  if (!tables_.ask(*part.most, dz, near, part.mask, left)) return;
  for (std::int32_t j = 0; j < kAcross; ++j) maybe[j] |= asking[j] ^ left[j];
}

/// Decides the voxels that meet nothing of the least cube, each by its own scale.
void OrientedDilation::ask_each(const Block& block, const Part& part, int slice, std::int32_t dz) {
  Scale scales[kAcross * kAcross] = {};  // 0: not looked up yet
  Word* open = &open_[block.open + std::size_t(slice * kAcross)];
  const VoxelCoord first = block.first + VoxelCoord{0, 0, slice};
  tables_.ask_each(*part.most, dz, part.near[slice], part.mask, open,
                   [&](std::int32_t dy, CubeRow row, const Word* met) {
                     for (std::int32_t j = 0; j < kAcross; ++j) {
                       for (Word left = met[j] & open[j]; left != 0; left &= left - 1) {
                         const int i = std::countr_zero(left);
                         const VoxelCoord p = first + VoxelCoord{i, j, 0};
                         Scale& s = scales[j * kAcross + i];
                         if (s == 0) s = scale_->at(p);
                         if (holds(cubes_.rotations[part.rotation], s, p, row, dy, dz)) open[j] &= ~(Word(1) << i);
                       }
                     }
                   });
}

/// Returns whether the cube of scale `s` around p holds a solid voxel of the row.
bool OrientedDilation::holds(const Rotation& rotation, Scale s, VoxelCoord p, CubeRow row, std::int32_t dy,
                             std::int32_t dz) const {
  const VoxelBox& box = solid_->box();
  if (p.y + dy < box.min.y || p.y + dy >= box.max.y) return false;
  const std::int32_t x = p.x - box.min.x;
  return any_bit(solid_->row(p.y + dy, p.z + dz), box.max.x - box.min.x, x + row.first, x + row.last,
                 [&](std::int32_t at) { return in_oriented_cube(rotation, s, at - x, dy, dz); });
}

/// Writes the result of the level. A voxel that is no longer open is in. Open large voxels stay only if they
/// may be in.
void OrientedDilation::finish(Level& level) const {
  const VoxelBox& box = level.in.box();
  for (const Block& block : blocks_) {
    const std::int32_t column = (block.first.x - box.min.x) / 64, shift = block.first.x & 63;
    for_each_row(intersect(box, {block.first, block.first + VoxelCoord{kAcross, kAcross, kSlices}}),
                 [&](std::int32_t y, std::int32_t z) {
                   const std::size_t word = block.open + std::size_t((z - block.first.z) * kAcross + y - block.first.y);
                   const std::uint64_t all = std::uint64_t((1U << kAcross) - 1) << shift;
                   std::uint64_t &in = level.in.row(y, z)[column], &may = level.may.row(y, z)[column];
                   in |= may & all & ~(std::uint64_t(open_[word]) << shift);
                   if (edge_ > 1) may &= in | ~all | std::uint64_t(maybe_[word]) << shift;
                 });
  }
}

}  // namespace bp::detail
