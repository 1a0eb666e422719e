#include "gpu/device_closing.h"

#include <algorithm>

#include "gpu/kernels/device_error.h"

namespace bp {

namespace {

std::int32_t round_down(std::int32_t v, std::int32_t to) {
  return floor_div(v, to) * to;
}
std::int32_t round_up(std::int32_t v, std::int32_t to) {
  return ceil_div(v, to) * to;
}

VoxelRange range_in(const VoxelBox& box, VoxelCoord origin) {
  const VoxelCoord a = box.min - origin, b = box.max - origin;
  return {a.x, a.y, a.z, b.x, b.y, b.z};
}

/// Returns the words of the BitBox of `box`, in whole words of 64 voxels.
BoxOfWords words_in(const VoxelBox& box, VoxelCoord origin) {
  const std::int32_t x0 = round_down(box.min.x, 64), x1 = round_up(box.max.x, 64);
  return {(x1 - x0) / 32,       box.max.y - box.min.y, box.max.z - box.min.z,
          (x0 - origin.x) / 32, box.min.y - origin.y,  box.min.z - origin.z};
}

std::int32_t floor_sqrt(std::uint32_t v) {
  std::int32_t r = 0;
  while (std::uint64_t(r + 1) * std::uint64_t(r + 1) <= v) ++r;
  return r;
}

/// Returns the scale for kernels: a constant, or the samples on the device.
ScaleView view_of(const ScaleLattice& scale, const TileLayout& layout, const Scale* samples) {
  ScaleView view;
  view.constant = scale.max;
  if (scale.constant()) return view;
  view.samples = samples;
  view.nx = scale.size.x, view.ny = scale.size.y, view.nz = scale.size.z;
  view.ox = layout.ox, view.oy = layout.oy, view.oz = layout.oz;
  return view;
}

/// Returns the bounds of the erosion by balls.
TransformBounds bounds_of(Scale most, bool wide) {
  TransformBounds bounds;
  bounds.wide = wide;
  bounds.limit = std::uint32_t(ball_bound(most));
  bounds.reach = bounds.limit == 0 ? 0 : floor_sqrt(bounds.limit - 1);
  return bounds;
}

void zero(void* p, std::size_t bytes, cudaStream_t stream) {
  BP_CUDA_CHECK(cudaMemsetAsync(p, 0, bytes, stream));
}

}  // namespace

TileLayout lay_out(const VoxelBox& solid, const ScaleLattice& scale, const Halo& halo, const VoxelBox& interior) {
  const VoxelBox dilated = interior.grown(halo.erosion_vox), reach = dilated.grown(halo.dilation_vox);
  const VoxelCoord low{round_down(reach.min.x, 32), round_down(reach.min.y, kCell), round_down(reach.min.z, kCell)};
  const VoxelCoord high{round_up(reach.max.x, 32), low.y + round_up(reach.max.y - low.y, kUnit),
                        low.z + round_up(reach.max.z - low.z, kUnit)};
  const VoxelBox domain{low, high};
  if (domain.volume() / 32 >= std::int64_t(1) << 31) {
    throw OutOfDeviceMemory(
        fmt::format("GPU: a tile of {} x {} x {} voxels is too large", high.x - low.x, high.y - low.y, high.z - low.z));
  }
  TileLayout t;
  t.shape = {(high.x - low.x) / 32, high.y - low.y, high.z - low.z};
  t.solid = words_in(solid, low);
  t.closed = words_in(interior, low);
  t.dilated = range_in(dilated, low);
  t.interior = range_in(interior, low);
  t.ox = low.x / kScaleStep - scale.origin.x;
  t.oy = low.y / kScaleStep - scale.origin.y;
  t.oz = low.z / kScaleStep - scale.origin.z;
  return t;
}

CubeView view_of(const CubesOver& cubes, const TileLayout& layout, const ScaleLattice& scale) {
  CubeView view;
  view.nx = cubes.size.x, view.ny = cubes.size.y, view.nz = cubes.size.z;
  view.edge = cubes.edge / kCell;
  // A distant field has one cell along the axis, which is the nearest one from anywhere.
  const auto from_first = [&](std::int32_t domain, std::int32_t first) {
    return std::int32_t(std::clamp<std::int64_t>(domain - std::int64_t(first) * view.edge, -(1 << 29), 1 << 29));
  };
  view.ox = from_first(layout.ox + scale.origin.x, cubes.origin.x);
  view.oy = from_first(layout.oy + scale.origin.y, cubes.origin.y);
  view.oz = from_first(layout.oz + scale.origin.z, cubes.origin.z);
  return view;
}

void DeviceClosing::grow(const TileLayout& layout) {
  const std::size_t words = layout.shape.word_count(), quads = layout.shape.quad_count();
  solid_.grow(words);
  dilated_.grow(words);
  contour_.grow(words);
  closed_.grow(words);
  flags_.grow(2 * quads + 2 * ((quads + 3) / 4));
  answers_.grow(2 * quads);
  counts_.grow(1);
}

void DeviceClosing::enqueue(const TileLayout& layout, const std::uint32_t* solid, const TileField& field,
                            std::uint32_t* closed, cudaStream_t stream, const Mark& mark) {
  start(layout, stream);
  pack_bits(solid, layout.solid, layout.shape, solid_.data(), flags_.data(), stream);
  if (mark) mark("pack");
  const std::uint32_t* result = close(layout, field, stream, mark);
  unpack_bits(result, layout.shape, layout.closed, layout.interior, closed, stream);
  if (mark) mark("unpack");
}

void DeviceClosing::enqueue(const TileLayout& layout, const BrickTable& solid, const TileField& field,
                            const BrickTable& closed, std::uint32_t* count, cudaStream_t stream) {
  start(layout, stream);
  pack_bricks(solid, layout.shape, solid_.data(), flags_.data(), stream);
  const std::uint32_t* result = close(layout, field, stream, {});
  zero(count, sizeof(std::uint32_t), stream);
  unpack_bricks(result, layout.shape, closed, count, stream);
}

void DeviceClosing::start(const TileLayout& layout, cudaStream_t stream) {
  grow(layout);
  const std::size_t quads = layout.shape.quad_count();
  zero(flags_.data(), (2 * quads + 2 * ((quads + 3) / 4)) * 4, stream);
}

/// Enqueues the closing of the voxels in solid_, whose cells are flagged. Returns its bits.
const std::uint32_t* DeviceClosing::close(const TileLayout& layout, const TileField& field, cudaStream_t stream,
                                          const Mark& mark) {
  const ScaleLattice& scale = field.scale;
  const auto done = [&](const char* stage) {
    if (mark) mark(stage);
  };
  const GridShape& shape = layout.shape;
  const std::size_t quads = shape.quad_count();
  std::uint32_t *solid_cells = flags_.data(), *contour_cells = solid_cells + quads;
  auto* wanted = reinterpret_cast<std::uint8_t*>(contour_cells + quads);  // two bytes for each quad
  const ScaleView view = view_of(scale, layout, field.samples);
  if (!scale.constant()) {
    bound_cells(view, shape, w_of_cells_.grow(4 * quads), stream);
    done("bounds of scale");
  }

  TransformBounds bounds = bounds_of(scale.max, tuning_.wide);
  const std::uint32_t* result = dilate(layout, field, view, bounds, stream, mark);
  done("dilate");
  if (bounds.reach == 0) return result;  // no ball of the erosion leaves its centre, so E = D
  outer_contour(dilated_.data(), shape, contour_.data(), contour_cells, stream);
  done("contour");
  bounds.offset_at_seed = !scale.constant();
  transform(
      layout, view,
      {true, bounds, contour_.data(), contour_cells, wanted + (quads + 3) / 4 * 4, layout.interior, closed_.data()},
      stream, mark);
  done("erode");
  return closed_.data();
}

/// Enqueues the dilation. Returns the bits of D.
const std::uint32_t* DeviceClosing::dilate(const TileLayout& layout, const TileField& field, const ScaleView& view,
                                           TransformBounds bounds, cudaStream_t stream, const Mark& mark) {
  if (field.cubes != nullptr) {
    dilate_by_turned_cubes(layout, field, view, stream, mark);
  } else if (field.element == StructuringElement::cube && cube_radius(field.scale.max) > 0) {
    dilate_by_cube(layout, field.scale, view, stream);
  } else if (field.element == StructuringElement::ball && bounds.reach > 0) {
    bounds.bound_at_voxel = !field.scale.constant();
    auto* wanted = reinterpret_cast<std::uint8_t*>(flags_.data() + 2 * layout.shape.quad_count());
    transform(layout, view, {false, bounds, solid_.data(), flags_.data(), wanted, layout.dilated, dilated_.data()},
              stream, mark);
  } else {
    return solid_.data();
  }
  return dilated_.data();
}

/// Makes the tables of windows for radii from `least` to `most`. Uses the arrays contour_ and closed_ as memory, since
/// the closing fills them only later.
WindowTables DeviceClosing::windows(const GridShape& shape, int least, int most, cudaStream_t stream) {
  const int last = octave_of(most), first = std::max(1, octave_of(least));
  WindowTables tables{};
  tables.table[0] = solid_.data();
  const std::size_t words = shape.word_count();
  if (last > first) tables_.grow(std::size_t(last - first) * words);
  for (int k = first; k <= last; ++k) {
    std::uint32_t* table = k == first ? closed_.data() : tables_.data() + std::size_t(k - first - 1) * words;
    if (k == first) {
      window_table(solid_.data(), shape, 1 << k, contour_.data(), table, stream);
    } else {
      double_windows(tables.table[k - 1], shape, 1 << (k - 1), table, stream);
    }
    tables.table[k] = table;
  }
  return tables;
}

void DeviceClosing::dilate_by_cube(const TileLayout& layout, const ScaleLattice& scale, const ScaleView& view,
                                   cudaStream_t stream) {
  const GridShape& shape = layout.shape;
  const int most = cube_radius(scale.max);
  const WindowTables tables = windows(shape, cube_radius(scale.min), most, stream);
  if (view.samples == nullptr) return dilate_cube(tables, shape, layout.dilated, most, dilated_.data(), stream);
  zero(counts_.data(), sizeof(WorkCounts), stream);
  dilate_cube_varying(tables, solid_.data(), shape, layout.dilated, view, most, tuning_.multiprocessors,
                      dilated_.data(), contour_.data(), &counts_.data()->rows, stream);
}

/// Cubes along the axes decide most voxels: voxels that the cube around the turned one does not reach are out, voxels
/// that the cube inside it reaches are in.
void DeviceClosing::dilate_by_turned_cubes(const TileLayout& layout, const TileField& field, const ScaleView& view,
                                           cudaStream_t stream, const Mark& mark) {
  const auto done = [&](const char* stage) {
    if (mark) mark(stage);
  };
  const GridShape& shape = layout.shape;
  const int inside = field.cubes->widest.inner(field.scale.min) / kScaleOne,
            around = field.cubes->widest.reach(field.scale.max), longest = 2 * around + 1;
  tables_.grow(std::size_t(turned_table_count(longest)) * shape.word_count());
  lists_.grow(4 * shape.quad_count());
  const WindowTables along = windows(shape, inside, around, stream);
  dilate_cube(along, shape, layout.dilated, around, contour_.data(), stream);
  dilate_cube(along, shape, layout.dilated, inside, dilated_.data(), stream);
  done("dilate: bounds");
  const TurnedTables rows = turned_tables(solid_.data(), shape, longest, tables_.data(), stream);
  done("dilate: tables");
  zero(counts_.data(), sizeof(WorkCounts), stream);
  dilate_turned(
      {rows, shape, field.cubes_there, view, contour_.data(), dilated_.data(), lists_.data(), &counts_.data()->rows},
      tuning_.multiprocessors, stream);
}

int DeviceClosing::slab_words(const TileLayout& layout, const TransformBounds& bounds, int words) {
  const std::size_t one = 2 * transform_bytes(bounds, layout.shape, 1).values;
  int n = int(std::clamp<std::size_t>(tuning_.slab_bytes / one, 1, std::size_t(words)));
  for (;;) {
    try {
      values_.grow(one * std::size_t(n));
      return n;
    } catch (const OutOfDeviceMemory&) {
      if (n == 1) throw;
      n = (n + 1) / 2;  // the device is fuller than expected, so smaller steps are taken
    }
  }
}

void DeviceClosing::transform(const TileLayout& layout, const ScaleView& view, const Transform& t, cudaStream_t stream,
                              const Mark& mark) {
  const auto done = [&](const char* stage) {
    if (mark) mark(stage);
  };
  const GridShape& shape = layout.shape;
  const std::size_t quads = shape.quad_count();
  const CellAnswers answers{answers_.data(), answers_.data() + quads};
  answer_cells(t.seed_cells, w_of_cells_.data(), t.bounds, shape, cells_.grow(answer_bytes(t.bounds, shape)), answers,
               stream);
  apply_answers(t.erosion, solid_.data(), dilated_.data(), answers, t.region, shape, t.out, t.wanted, stream);
  done(t.erosion ? "erode: cells" : "dilate: cells");

  transform_slabs(layout, view, t, answers, stream, done);
}

/// Transforms the words of t.region in slabs. A slab has as many words as the memory for distances holds.
void DeviceClosing::transform_slabs(const TileLayout& layout, const ScaleView& view, const Transform& t,
                                    const CellAnswers& answers, cudaStream_t stream, const Mark& done) {
  const GridShape& shape = layout.shape;
  const int first = std::max(t.region.x0 / 32, 0), last = std::min((t.region.x1 + 31) / 32, shape.words);
  const int step = slab_words(layout, t.bounds, last - first);
  const WorkSizes sizes = work_sizes(shape, step);
  const TransformBytes bytes = transform_bytes(t.bounds, shape, step);
  const std::size_t row_bytes = (bytes.row_flags + 15) / 16 * 16;
  lists_.grow(sizes.rows + sizes.ys + sizes.zs);
  columns_.grow(sizes.ys);
  pass_flags_.grow(row_bytes + bytes.slice_flags);
  const WorkLists lists{counts_.data(), lists_.data(), lists_.data() + sizes.rows,
                        lists_.data() + sizes.rows + sizes.ys, columns_.data()};
  for (int w0 = first; w0 < last; w0 += step) {
    const Slab slab{w0, std::min(step, last - w0)};
    zero(counts_.data(), sizeof(WorkCounts), stream);
    zero(pass_flags_.data(), row_bytes + bytes.slice_flags, stream);
    plan_work(t.wanted, t.seed_cells, t.bounds, shape, slab, lists, stream);
    done(t.erosion ? "erode: plan" : "dilate: plan");
    const TransformArgs args{t.seeds,
                             shape,
                             slab,
                             t.bounds,
                             view,
                             {values_.data(), values_.data() + bytes.values, pass_flags_.data(),
                              pass_flags_.data() + row_bytes, bytes.slice_stride},
                             lists};
    row_pass(args, tuning_.multiprocessors, stream);
    done(t.erosion ? "erode: x" : "dilate: x");
    y_pass(args, tuning_.multiprocessors, stream);
    done(t.erosion ? "erode: y" : "dilate: y");
    z_pass(args, {t.erosion, solid_.data(), dilated_.data(), answers.open, t.region, t.out}, tuning_.multiprocessors,
           stream);
    done(t.erosion ? "erode: z" : "dilate: z");
  }
}

void DeviceClosing::release() {
  for (auto* b : {&solid_, &tables_, &dilated_, &contour_, &closed_, &flags_, &answers_, &lists_}) b->release();
  w_of_cells_.release();
  for (auto* b : {&cells_, &values_, &pass_flags_, &columns_}) b->release();
  counts_.release();
}

}  // namespace bp
