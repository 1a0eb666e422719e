#include "lib/pass/hide/hidden_pass.h"

#include <atomic>

#include "lib/core/parallel.h"
#include "lib/grid/count_bits.h"
#include "lib/grid/shelf_stream.h"
#include "lib/pass/mesh/complement.h"
#include "lib/volume/dilate.h"

namespace bp {

namespace {

using Shelf = std::unique_ptr<BrickShelf>;
constexpr int kLayers = 2;  // layers of the scene's voxels that are seen

CloseOptions close_options(const HiddenOptions& o, bool keep_cavities) {
  CloseOptions c;
  c.keep_cavities = keep_cavities;
  c.context = o.context;
  return c;
}

ScaleField uniform(double scale) {
  ScaleField field;
  field.base = scale;
  return field;
}

/// Puts solid voxels on a shelf, and adds those that they enclose. Returns the number of these.
std::uint64_t fill(const StreamHeader& header, BrickShelf& solid, Backends& backends, const HiddenOptions& o,
                   BrickShelf& filled) {
  StreamHeader around = header;
  around.bricks = bricks_around(solid);
  ShelfSource source(around, solid, nullptr, ShelfSource::Keep::all);
  ShelfSink sink(nullptr, &filled);
  return close_stream(source, sink, backends, uniform(0), {o.element}, close_options(o, false)).cavity_voxels;
}

/// Puts the enclosed voxels and C on a shelf.
Shelf walls(const BrickShelf& enclosed, const BrickShelf& closed, const BrickShelf& closed_filled,
            const HiddenOptions& o) {
  Shelf out = o.context.make_shelf();
  const std::vector<BrickCoord> coords = closed_filled.coords();
  parallel_for(std::int64_t(coords.size()), [&](std::int64_t i) {
    const BrickCoord at = coords[std::size_t(i)];
    BrickBits u, e, f;
    enclosed.get(at, u);
    closed.get(at, e);
    closed_filled.get(at, f);
    for (std::size_t k = 0; k < kBrickWords; ++k) u[k] |= f[k] & ~e[k];
    out->put(at, classify(u), u);
  });
  return out;
}

void keep_common(const BitBox& with, BitBox& voxels) {
  for (std::int64_t i = 0; i < voxels.word_count(); ++i) voxels.data()[i] &= with.data()[i];
}

/// Returns a brick of the unreached voxels, without those of the scene that the outside sees.
BitBox unseen_brick(const BrickShelf& unreached, const BrickShelf& touched, BrickCoord at) {
  const VoxelBox brick = voxels_of({at, {at.x + 1, at.y + 1, at.z + 1}});
  BitBox behind(brick.grown(kLayers)), scene(behind.box());
  load_voxels(unreached, behind);
  load_voxels(touched, scene);
  BitBox seen = behind;
  for (std::int64_t i = 0; i < seen.word_count(); ++i) seen.data()[i] = ~seen.data()[i];
  for (int layer = 0; layer < kLayers; ++layer) {
    dilate(seen, 1);
    keep_common(scene, seen);
  }
  for (std::int64_t i = 0; i < seen.word_count(); ++i) behind.data()[i] &= ~seen.data()[i];
  BitBox out(brick);
  copy_voxels(behind, out);
  return out;
}

}  // namespace

Shelf enclosed_voxels(const StreamHeader& header, BrickShelf& touched, Backends& backends, const HiddenOptions& o) {
  Shelf out = o.context.make_shelf();
  fill(header, touched, backends, o, *out);
  return out;
}

// The closing is that of U: G and the voxels that G encloses. It is not that of G, since U has less boundary and gives
// the same O'. A path over faces from a voxel outside U to one in U crosses G no farther away, along each axis, so the
// voxel is as near to U as to G. So U and G have the same dilation outside U. They have the same erosion, too: a voxel
// that erodes another one there is not in U, for G would be in reach of it. O cannot enter U in either case. So C of U
// is C of G without U. The voxels that G and C enclose hold U anyway; without C they are U.
Shelf unreached_voxels(const StreamHeader& header, BrickShelf& enclosed, Backends& backends, const HiddenOptions& o) {
  Shelf closed = close_shelf(header, enclosed, backends, uniform(o.scale_world), {o.element}, close_options(o, true));
  Shelf closed_filled = o.context.make_shelf();
  if (fill(header, *closed, backends, o, *closed_filled) == 0) return nullptr;
  const Shelf both = walls(enclosed, *closed, *closed_filled, o);
  closed.reset();
  closed_filled.reset();
  Shelf out = o.context.make_shelf();
  fill(header, *both, backends, o, *out);
  return out;
}

HiddenVoxels unseen_voxels(const BrickShelf& unreached, const BrickShelf& touched, const HiddenOptions& o) {
  HiddenVoxels out{o.context.make_shelf()};
  std::atomic<std::uint64_t> count{0};
  const std::vector<BrickCoord> coords = unreached.coords();
  parallel_for(std::int64_t(coords.size()), [&](std::int64_t i) {
    const BitBox bits = unseen_brick(unreached, touched, coords[std::size_t(i)]);
    count += bits.count();
    store_voxels(bits, *out.voxels);
  });
  out.count = count;
  return out;
}

HiddenVoxels hidden_voxels(const StreamHeader& header, BrickShelf& touched, Backends& backends,
                           const HiddenOptions& o) {
  const Shelf enclosed = enclosed_voxels(header, touched, backends, o);
  const Shelf unreached = unreached_voxels(header, *enclosed, backends, o);
  return unseen_voxels(unreached ? *unreached : *enclosed, touched, o);
}

std::unique_ptr<BrickShelf> opening(const StreamHeader& header, BrickShelf& solid, Backends& backends,
                                    const HiddenOptions& o) {
  Shelf out = o.context.make_shelf();
  StreamHeader around = header;
  around.bricks = bricks_around(solid);
  ShelfSource source(around, solid, nullptr, ShelfSource::Keep::all);
  ComplementSource complement(source);
  ShelfSink sink(nullptr, out.get());
  ComplementSink opened(sink, around);
  close_stream(complement, opened, backends, uniform(o.scale_world), {o.element}, close_options(o, true));
  opened.finish();
  return out->coords().empty() ? nullptr : std::move(out);
}

}  // namespace bp
