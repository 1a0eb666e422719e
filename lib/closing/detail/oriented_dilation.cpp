#include "lib/closing/detail/oriented_dilation.h"

#include <algorithm>
#include <bit>

#include "lib/closing/closing.h"

namespace bp {

std::size_t turned_cubes_bytes(std::int32_t reach) {
  constexpr std::size_t kEnough = 8 << 20;
  return std::max(kEnough, 2 * detail::RowTables::most_bytes(reach));
}

}  // namespace bp

namespace bp::detail {

namespace {

/// Samples times `factor` / 2^kRotationBits, and `more`. False if that is too large for a sample.
template <class Change>
bool changed(const ScaleLattice& from, const Change& change, ScaleLattice& to) {
  to = from;
  for (Scale& s : to.samples) {
    const std::int32_t value = change(s);
    if (value > 0xffff) return false;
    s = Scale(value);
  }
  to.min = Scale(change(from.min));
  to.max = Scale(change(from.max));
  return change(from.max) <= 0xffff;
}

constexpr std::int32_t kStep = kScaleOne / 2;  ///< scales that differ in a cell are rounded to it: cells share elements

/// Any of the bits [first, last] of a row that begins at bit 0, `bits` long.
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

/// out := voxels of `box`, grown by `r` along y or z, within r of one of `solid` along that axis. `box` is in that of
/// `solid`.
void dilate_along(const BitBox& solid, int axis, std::int32_t r, VoxelBox box, BitBox& out) {
  box.min[axis] -= r;
  box.max[axis] += r;
  out.reset(box);
  copy_voxels(solid, out);
  const VoxelBox& all = out.box();
  const std::int32_t rows = all.max[axis] - all.min[axis], others = all.max[3 - axis] - all.min[3 - axis];
  const auto words = std::size_t(out.words_per_row());
  // Row t takes the `width` rows that end, or begin, with it.
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
  return cubes_.widest.turned;
}

void OrientedDilation::run(const BitBox& solid, const ScaleLattice& scale, BitBox& out, std::size_t most_bytes) {
  bound(solid, scale, out);
  const ScaleRange range = scale_range(scale, out.box());
  reach_ = cubes_.widest.reach(Scale(std::min(range.max + kStep, 0xffff)));
  longest_ = 2 * reach_ + 1;
  most_bytes_ = std::max(most_bytes, turned_cubes_bytes(reach_));
  tables_.lay(out.box(), reach_, longest_);
  find_kept_axis(solid, range, out.box());
  list_blocks(scale, out);
  decide_blocks(solid, scale, out);
}

/// Cubes of one size that are turned about y or z are dilated along that axis first; then one slice of them is left.
void OrientedDilation::find_kept_axis(const BitBox& solid, const ScaleRange& range, const VoxelBox& region) {
  kept_ = -1;
  for (const int axis : {1, 2}) {
    if (range.min == range.max && std::all_of(cubes_.rotations.begin(), cubes_.rotations.end(),
                                              [&](const Rotation& r) { return keeps_axis(r, axis); }))
      kept_ = axis;
  }
  if (kept_ >= 0)
    dilate_along(solid, kept_, cube_radius(range.max), intersect(solid.box(), region.grown(reach_)), along_);
}

/// out := voxels that are in for sure, outer_ := those that may be.
void OrientedDilation::bound(const BitBox& solid, const ScaleLattice& scale, BitBox& out) {
  const ScaleRange range = scale_range(scale, out.box());
  outer_.reset(out.box());
  if (cube_radius(range.min) == cube_radius(range.max)) {
    cube_.run(solid, cubes_.widest.inner(range.min) / kScaleOne, out);
    cube_.run(solid, cubes_.widest.reach(range.max), outer_);
    return;
  }
  ScaleLattice bounds;
  changed(
      scale, [&](Scale s) { return cubes_.widest.inner(s); }, bounds);
  varying_.run(solid, bounds, out.box(), out);
  if (changed(
          scale, [&](Scale s) { return cubes_.widest.outer(s); }, bounds)) {
    varying_.run(solid, bounds, out.box(), outer_);
  } else {
    cube_.run(solid, cubes_.widest.reach(range.max), outer_);
  }
}

void OrientedDilation::list_blocks(const ScaleLattice& scale, const BitBox& out) {
  const VoxelBox& box = out.box();
  parts_.clear();
  blocks_.clear();
  open_.clear();
  maybe_.clear();
  for (std::int32_t z = floor_div(box.min.z, kEdge) * kEdge; z < box.max.z; z += kEdge) {
    for (std::int32_t y = floor_div(box.min.y, kEdge) * kEdge; y < box.max.y; y += kEdge) {
      for (std::int32_t x = box.min.x; x < box.max.x; x += 64) {
        Block block{{x, y, z}, parts_.size(), 0, open_.size(), maybe_.size()};
        if (!take_open(block, out)) continue;
        add_parts(block, scale);
        if (block.varies) maybe_.resize(maybe_.size() + std::size_t(kEdge * kEdge));
        blocks_.push_back(block);
      }
    }
  }
}

/// False, and nothing taken, if the bounds decide for all voxels of the block.
bool OrientedDilation::take_open(Block& block, const BitBox& out) {
  const VoxelBox& box = out.box();
  std::uint64_t words[kEdge * kEdge] = {};
  const std::int32_t column = (block.first.x - box.min.x) / 64;
  for (std::int32_t k = 0; k < kEdge; ++k) {
    const std::int32_t z = block.first.z + k;
    if (z < box.min.z || z >= box.max.z) continue;
    std::uint64_t any = 0;
    for (std::int32_t j = 0; j < kEdge; ++j) {
      const std::int32_t y = block.first.y + j;
      if (y < box.min.y || y >= box.max.y) continue;
      any |= words[k * kEdge + j] = outer_.row(y, z)[column] & ~out.row(y, z)[column];
    }
    if (any != 0) block.slices |= 1U << k;
  }
  if (block.slices != 0) open_.insert(open_.end(), std::begin(words), std::end(words));
  return block.slices != 0;
}

/// Cells with open voxels that are alike become one part.
void OrientedDilation::add_parts(Block& block, const ScaleLattice& scale) {
  std::uint64_t open = 0;
  for (std::size_t i = 0; i < std::size_t(kEdge * kEdge); ++i) open |= open_[block.open + i];
  for (std::int32_t i = 0; i < 64 / kEdge; ++i) {
    const std::uint64_t mask = (open >> (kEdge * i) & 0xff) << (kEdge * i);
    if (mask == 0) continue;
    const VoxelCoord first{block.first.x + kEdge * i, block.first.y, block.first.z};
    ScaleRange s = scale_range(scale, {first, first + VoxelCoord{kEdge, kEdge, kEdge}});
    if (s.min != s.max)
      s = {Scale(s.min / kStep * kStep), Scale(std::min(ceil_div(int(s.max), kStep) * kStep, 0xffff))};
    const std::uint16_t rotation = cubes_.at(first);
    block.varies = block.varies || s.min != s.max;
    const auto same = std::find_if(parts_.begin() + std::ptrdiff_t(block.part), parts_.end(), [&](const Part& p) {
      return p.rotation == rotation && p.min == s.min && p.max == s.max;
    });
    if (same != parts_.end()) {
      same->mask |= mask;
    } else {
      parts_.push_back({mask, rotation, s.min, s.max});
    }
  }
  block.parts = parts_.size() - block.part;
}

/// Group by group: a block whose elements do not fit goes on in the next one.
void OrientedDilation::decide_blocks(const BitBox& solid, const ScaleLattice& scale, BitBox& out) {
  group_.clear();
  for (const Block& block : blocks_) {
    Block some = block;
    some.parts = 0;
    for (std::size_t i = block.part; i < block.part + block.parts; ++i) {
      if (!prepare(parts_[i])) {
        if (some.parts > 0) group_.push_back(some);
        decide_group(solid, scale, out);
        some = block;
        some.part = i;
        some.parts = 0;
        prepare(parts_[i]);
      }
      ++some.parts;
    }
    group_.push_back(some);
  }
  decide_group(solid, scale, out);
}

void OrientedDilation::decide_group(const BitBox& solid, const ScaleLattice& scale, BitBox& out) {
  sweep(kept_ >= 0 ? along_ : solid);
  finish(solid, scale, out);
  group_.clear();
  elements_.clear();
  element_bytes_ = 0;
}

/// False if the part's elements may not fit beside those that are there.
bool OrientedDilation::prepare(Part& part) {
  const std::size_t wanted = elements_.count({part.rotation, part.min}) + elements_.count({part.rotation, part.max});
  if (wanted < 2 && !elements_.empty() && element_bytes_ + 2 * RowTables::most_bytes(reach_) > most_bytes_)
    return false;
  part.least = element(part.rotation, part.min);
  part.most = element(part.rotation, part.max);
  return true;
}

const RowTables::Element* OrientedDilation::element(std::uint16_t rotation, Scale s) {
  auto& found = elements_[{rotation, s}];
  if (!found) {
    found = std::make_unique<RowTables::Element>(tables_.prepare(CubeRows(cubes_.rotations[rotation], s, kept_)));
    element_bytes_ += found->bytes();
  }
  return found.get();
}

void OrientedDilation::sweep(const BitBox& solid) {
  if (group_.empty()) return;
  const std::int32_t before = ceil_div(reach_, kEdge) * kEdge;  // where the first of its blocks of slices may begin
  std::size_t first = 0, last = 0;                              // blocks in reach of the slice
  for (std::int32_t z = group_.front().first.z - before; z < group_.back().first.z + kEdge + reach_; ++z) {
    while (first < group_.size() && group_[first].first.z + kEdge - 1 + reach_ < z) ++first;
    while (last < group_.size() && group_[last].first.z - before <= z) ++last;
    if (first == last) continue;
    const bool any = tables_.load(solid, z);
    for (std::size_t i = first; i < last; ++i) ask(group_[i], z - group_[i].first.z, any);
  }
}

/// `any`: the slice or one of the next seven holds something.
void OrientedDilation::ask(Block& block, std::int32_t dz_of_first, bool any) {
  tables_.place(block.first.x, block.first.y);
  const std::int32_t begins = floor_div(dz_of_first, kEdge) * kEdge;  // of the slice that begins blocks of slices
  const std::int32_t k = dz_of_first - begins;
  for (std::size_t i = block.part; i < block.part + block.parts; ++i) {
    Part& part = parts_[i];
    if ((block.slices >> k & 1) != 0) look(block, part, k, begins, any);
    for (std::uint32_t left = part.asks; left != 0; left &= left - 1) {
      const int slice = std::countr_zero(left);
      ask(block, part, slice, dz_of_first - slice);
    }
  }
}

/// The part's voxels that are open in a slice of the block. False if there is none.
bool OrientedDilation::still_open(const Block& block, const Part& part, int slice, std::uint64_t* open) const {
  std::uint64_t any = 0;
  for (std::int32_t j = 0; j < kEdge; ++j)
    any |= open[j] = open_[block.open + std::size_t(slice * kEdge + j)] & part.mask;
  return any != 0;
}

void OrientedDilation::look(const Block& block, Part& part, int slice, std::int32_t dz, bool any) const {
  const RowTables::Element& most = *part.most;
  std::uint64_t open[kEdge];
  any = any && dz <= most.most_dz && dz >= kEdge * most.first && still_open(block, part, slice, open);
  part.near[slice] = any ? tables_.near(most, dz, open) : 0;
  part.asks = (part.asks & ~(1U << slice)) | (part.near[slice] != 0 ? 1U << slice : 0);
}

/// Of one slice of the block.
void OrientedDilation::ask(const Block& block, Part& part, int slice, std::int32_t dz) {
  std::uint64_t asking[kEdge];
  if (!still_open(block, part, slice, asking)) {
    part.asks &= ~(1U << slice);
    return;
  }
  std::uint64_t* open = &open_[block.open + std::size_t(slice * kEdge)];
  tables_.ask(*part.least, dz, part.near[slice], asking);
  for (std::int32_t j = 0; j < kEdge; ++j) open[j] &= asking[j] | ~part.mask;
  if (part.least == part.most) return;
  std::uint64_t* maybe = &maybe_[block.maybe + std::size_t(slice * kEdge)];
  tables_.ask(*part.most, dz, part.near[slice], asking);
  for (std::int32_t j = 0; j < kEdge; ++j) maybe[j] |= open[j] & part.mask & ~asking[j];
}

void OrientedDilation::finish(const BitBox& solid, const ScaleLattice& scale, BitBox& out) {
  const VoxelBox& box = out.box();
  for (const Block& block : group_) {
    if (block.varies) decide(block, solid, scale);
    const std::int32_t column = (block.first.x - box.min.x) / 64;
    const VoxelBox rows = intersect(box, {block.first, block.first + VoxelCoord{64, kEdge, kEdge}});
    for (std::int32_t z = rows.min.z; z < rows.max.z; ++z) {
      for (std::int32_t y = rows.min.y; y < rows.max.y; ++y) {
        const std::int32_t word = (z - block.first.z) * kEdge + y - block.first.y;
        out.row(y, z)[column] |= outer_.row(y, z)[column] & ~open_[block.open + std::size_t(word)];
      }
    }
  }
}

/// Voxels that the least scale of their cell leaves open and the largest does not: by their own.
void OrientedDilation::decide(const Block& block, const BitBox& solid, const ScaleLattice& scale) {
  for (std::int32_t i = 0; i < kEdge * kEdge; ++i) {
    std::uint64_t& open = open_[block.open + std::size_t(i)];
    for (std::size_t k = block.part; k < block.part + block.parts; ++k) {
      const Part& part = parts_[k];
      if (part.least == part.most) continue;
      for (std::uint64_t left = open & maybe_[block.maybe + std::size_t(i)] & part.mask; left != 0; left &= left - 1) {
        const int x = std::countr_zero(left);
        const VoxelCoord p = block.first + VoxelCoord{x, i % kEdge, i / kEdge};
        if (holds(part, solid, p, scale.at(p))) open &= ~(std::uint64_t(1) << x);
      }
    }
  }
}

bool OrientedDilation::holds(const Part& part, const BitBox& solid, VoxelCoord p, Scale s) const {
  const VoxelBox& box = solid.box();
  const Rotation& r = cubes_.rotations[part.rotation];
  const CubeRows& rows = part.most->rows;
  for (std::int32_t dz = std::max(-rows.reach(), box.min.z - p.z); dz <= std::min(rows.reach(), box.max.z - 1 - p.z);
       ++dz) {
    for (const CubeRow* row = rows.begin(dz); row < rows.begin(dz + 1); ++row) {
      const std::int32_t y = p.y + row->dy, x = p.x - box.min.x;
      if (y < box.min.y || y >= box.max.y) continue;
      const auto inside = [&](std::int32_t at) { return in_oriented_cube(r, s, at - x, row->dy, dz); };
      if (any_bit(solid.row(y, p.z + dz), box.max.x - box.min.x, x + row->first, x + row->last, inside)) return true;
    }
  }
  return false;
}

}  // namespace bp::detail
