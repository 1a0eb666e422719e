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
constexpr int kLayers = 2;  // of voxels of the scene that are seen

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

Shelf closing(const StreamHeader& header, BrickShelf& solid, double scale, bool keep_cavities, Backends& backends,
              const HiddenOptions& o) {
  return close_shelf(header, solid, backends, uniform(scale), {o.element}, close_options(o, keep_cavities));
}

/// The voxels that solid ones enclose, and these.
Shelf filled(const StreamHeader& header, BrickShelf& solid, Backends& backends, const HiddenOptions& o) {
  StreamHeader around = header;
  around.bricks = bricks_around(solid);
  return closing(around, solid, 0, false, backends, o);
}

/// G and C.
Shelf walls(const BrickShelf& touched, const BrickShelf& closed, const BrickShelf& closed_filled,
            const HiddenOptions& o) {
  Shelf out = o.context.make_shelf();
  const std::vector<BrickCoord> coords = closed_filled.coords();
  parallel_for(std::int64_t(coords.size()), [&](std::int64_t i) {
    const BrickCoord at = coords[std::size_t(i)];
    BrickBits g, e, f;
    touched.get(at, g);
    closed.get(at, e);
    closed_filled.get(at, f);
    for (std::size_t k = 0; k < kBrickWords; ++k) g[k] |= f[k] & ~e[k];
    out->put(at, classify(g), g);
  });
  return out;
}

void keep_common(const BitBox& with, BitBox& voxels) {
  for (std::int64_t i = 0; i < voxels.word_count(); ++i) voxels.data()[i] &= with.data()[i];
}

/// A brick of what the outside does not reach, less what it sees of the scene.
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

HiddenVoxels hidden_voxels(const StreamHeader& header, BrickShelf& touched, Backends& backends,
                           const HiddenOptions& o) {
  Shelf unreached;
  {
    Shelf closed = closing(header, touched, o.scale_world, true, backends, o);
    const Shelf both = walls(touched, *closed, *filled(header, *closed, backends, o), o);
    closed.reset();
    unreached = filled(header, *both, backends, o);
  }
  HiddenVoxels out{o.context.make_shelf()};
  std::atomic<std::uint64_t> count{0};
  const std::vector<BrickCoord> coords = unreached->coords();
  parallel_for(std::int64_t(coords.size()), [&](std::int64_t i) {
    const BitBox bits = unseen_brick(*unreached, touched, coords[std::size_t(i)]);
    count += bits.count();
    store_voxels(bits, *out.voxels);
  });
  out.count = count;
  return out;
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
