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

/// Whether C holds voxels that are not enclosed without a closing.
bool has_rooms(const BrickShelf& closed, const BrickShelf& closed_filled, const BrickShelf& enclosed) {
  const std::vector<BrickCoord> coords = closed_filled.coords();
  std::atomic<bool> found{false};
  parallel_for(std::int64_t(coords.size()), [&](std::int64_t i) {
    const BrickCoord at = coords[std::size_t(i)];
    if (found || enclosed.fill(at) == BrickFill::full) return;
    BrickBits e, f, known;
    closed.get(at, e);
    closed_filled.get(at, f);
    enclosed.get(at, known);
    for (std::size_t k = 0; k < kBrickWords; ++k)
      if ((f[k] & ~e[k] & ~known[k]) != 0) found = true;
  });
  return found;
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

Shelf enclosed_voxels(const StreamHeader& header, BrickShelf& touched, Backends& backends, const HiddenOptions& o) {
  return filled(header, touched, backends, o);
}

Shelf unreached_voxels(const StreamHeader& header, BrickShelf& touched, const BrickShelf* enclosed, Backends& backends,
                       const HiddenOptions& o) {
  Shelf closed = closing(header, touched, o.scale_world, true, backends, o);
  Shelf closed_filled = filled(header, *closed, backends, o);
  if (enclosed != nullptr && !has_rooms(*closed, *closed_filled, *enclosed)) return nullptr;
  const Shelf both = walls(touched, *closed, *closed_filled, o);
  closed.reset();
  closed_filled.reset();
  return filled(header, *both, backends, o);
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
  return unseen_voxels(*unreached_voxels(header, touched, nullptr, backends, o), touched, o);
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
