#include "lib/pass/hide/hidden_pass.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <set>
#include <vector>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/grid/brick_voxels.h"
#include "lib/grid/shelf_stream.h"
#include "lib/pass/hide/entered_rooms.h"
#include "lib/pass/mesh/complement.h"
#include "lib/volume/boundary_runs.h"
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

/// Sets a = f(a, b), word by word; the boxes are equal.
template <class F>
void combine(BitBox& a, const BitBox& b, const F& f) {
  for (std::int64_t i = 0; i < a.word_count(); ++i) a.data()[i] = f(a.data()[i], b.data()[i]);
}
constexpr auto kBoth = [](std::uint64_t a, std::uint64_t b) { return a & b; };
constexpr auto kEither = [](std::uint64_t a, std::uint64_t b) { return a | b; };
constexpr auto kLess = [](std::uint64_t a, std::uint64_t b) { return a & ~b; };

BitBox inverse(BitBox a) {
  for (std::int64_t i = 0; i < a.word_count(); ++i) a.data()[i] = ~a.data()[i];
  return a;
}

bool is_empty(const BitBox& voxels) {
  return std::all_of(voxels.data(), voxels.data() + voxels.word_count(), [](std::uint64_t w) { return w == 0; });
}

// Sets of voxels in memory while a tile is at work, and their bytes for lists of voxels.
constexpr double kSets = 6, kListSets = 4;

/// How far around a tile the walls of a scale depend on other voxels, in voxels.
struct WallReach {
  std::int32_t steps, gap, halo;
  explicit WallReach(double scale_vox)
      : steps(2 * std::int32_t(std::ceil(scale_vox))),
        gap(std::int32_t(2 * std::sqrt(2.0) * scale_vox)),
        halo(steps + gap + 1) {}
  [[nodiscard]] double bytes_of_tile(std::int32_t bricks) const {
    return std::pow(double(bricks * kBrickEdge + 2 * halo + kBrickEdge), 3) * (kSets + kListSets) / 8;
  }
};

/// Makes the walls that the outside does not pass at a scale: the enclosed voxels, C and R.
class Walls {
 public:
  Walls(const StreamHeader& header, const BrickShelf& enclosed, const BrickShelf& closed,
        const BrickShelf& closed_filled, const HiddenOptions& o)
      : enclosed_(enclosed),
        closed_(closed),
        closed_filled_(closed_filled),
        memory_(o.context.memory),
        reach_(o.scale_world / header.frame.voxel) {}

  /// Puts the walls on a shelf, tile by tile. Throws NeedsMemory if not even a tile of one brick fits.
  void put(BrickShelf& out) const {
    const std::int32_t edge = tile_bricks();
    std::set<BrickCoord> tiles;
    for (const BrickCoord at : closed_filled_.coords())
      tiles.insert({floor_div(at.x, edge), floor_div(at.y, edge), floor_div(at.z, edge)});
    auto next = tiles.begin();
    run_jobs<BrickCoord>(
        int(std::clamp(double(memory_.bytes) / reach_.bytes_of_tile(edge), 1.0, double(thread_count()))),
        [&](BrickCoord& tile) { return next != tiles.end() && (tile = *next++, true); },
        [&](BrickCoord& tile) {
          const BrickCoord first = tile * edge;
          store_voxels(of_tile(voxels_of({first, first + BrickCoord{edge, edge, edge}})), out);
        });
  }

 private:
  /// Returns the bricks along an edge of a tile: a few, so that what surrounds tiles is not most of the work, but no
  /// more than the memory allows. No result depends on it.
  [[nodiscard]] std::int32_t tile_bricks() const {
    std::int32_t edge = 3 + reach_.halo / kBrickEdge;
    while (edge > 1 && reach_.bytes_of_tile(edge) > double(memory_.bytes)) --edge;
    const auto needed = std::uint64_t(std::ceil(reach_.bytes_of_tile(edge)));
    if (needed > memory_.bytes)
      throw NeedsMemory(fmt::format("finding what a closing of {} voxels hides", reach_.steps / 2), needed,
                        memory_.bytes, memory_.limit_for(needed), {Remedy::larger_voxels, Remedy::smaller_scale});
    return edge;
  }

  [[nodiscard]] BitBox of_tile(const VoxelBox& tile) const {
    BitBox rooms(tile.grown(reach_.halo));
    const VoxelBox& box = rooms.box();
    BitBox enclosed(box), closed(box), walls(tile);
    load_voxels(enclosed_, enclosed);
    load_voxels(closed_, closed);
    load_voxels(closed_filled_, rooms);
    BitBox outside = inverse(rooms);
    combine(rooms, closed, kLess);
    combine(closed, enclosed, kLess);
    if (!is_empty(rooms)) {
      take_gaps(enclosed, closed);
      share_out(std::move(closed), std::move(outside), rooms);
    }
    combine(rooms, enclosed, kEither);
    copy_voxels(rooms, walls);
    return walls;
  }

  /// Takes the voxels out of `added` that lie in gaps: along an axis, in a run of at most reach_.gap between two solid
  /// voxels.
  void take_gaps(const BitBox& solid, BitBox& added) const {
    BitBox gaps(added.box());
    const VoxelCoord size = added.box().size();
    const std::int64_t row = added.words_per_row(), layer = row * size.y;
    for (std::int64_t i = 0; i < layer; ++i) take_gaps_across(solid, added, i, layer, size.z, gaps);
    for (std::int64_t z = 0; z < size.z; ++z)
      for (std::int64_t i = 0; i < row; ++i) take_gaps_across(solid, added, z * layer + i, row, size.y, gaps);
    for (std::int64_t first = 0; first < added.word_count(); first += row) take_gaps_along(solid, added, first, gaps);
    combine(added, gaps, kLess);
  }

  /// Adds the gaps along an axis across x to `gaps`, in 64 columns at once: word `first` and each `step` words on.
  void take_gaps_across(const BitBox& solid, const BitBox& added, std::int64_t first, std::int64_t step,
                        std::int32_t count, BitBox& gaps) const {
    std::array<std::int32_t, 64> begin;  // of the run of each open column
    std::uint64_t open = 0, before = 0;  // columns in a run that began beside a solid voxel; those that are solid
    for (std::int32_t i = 0; i < count; ++i) {
      const std::uint64_t is_solid = solid.data()[first + i * step], is_added = added.data()[first + i * step];
      for (std::uint64_t ends = open & is_solid; ends != 0; ends &= ends - 1) {
        const int column = std::countr_zero(ends);
        if (i - begin[std::size_t(column)] > reach_.gap) continue;
        for (std::int32_t k = begin[std::size_t(column)]; k < i; ++k)
          gaps.data()[first + k * step] |= std::uint64_t(1) << column;
      }
      const std::uint64_t starts = before & is_added;
      for (std::uint64_t left = starts; left != 0; left &= left - 1) begin[std::size_t(std::countr_zero(left))] = i;
      open = (open & is_added) | starts;
      before = is_solid;
    }
  }

  /// Adds the gaps of the row of voxels that begins with word `first` to `gaps`.
  void take_gaps_along(const BitBox& solid, const BitBox& added, std::int64_t first, BitBox& gaps) const {
    const std::int32_t length = added.words_per_row() * 64;
    const auto bit = [&](const BitBox& bits, std::int32_t x) {
      return (bits.data()[first + x / 64] >> x % 64 & 1) != 0;
    };
    std::uint64_t carry = 0;
    for (std::int32_t word = 0; word < added.words_per_row(); ++word) {
      const std::uint64_t is_solid = solid.data()[first + word];
      const std::uint64_t starts = (is_solid << 1 | carry) & added.data()[first + word];
      carry = is_solid >> 63;
      for (std::uint64_t left = starts; left != 0; left &= left - 1) {
        const std::int32_t begin = word * 64 + std::countr_zero(left);
        std::int32_t end = begin;
        while (end < length && end - begin <= reach_.gap && bit(added, end)) ++end;
        if (end == length || end - begin > reach_.gap || !bit(solid, end)) continue;
        for (std::int32_t x = begin; x < end; ++x) gaps.data()[first + x / 64] |= std::uint64_t(1) << x % 64;
      }
    }
  }

  /// Gives the added voxels to the outside or to the rooms, step by step: by lists of voxels, or by sets if the lists
  /// might take more than their share. Both do the same.
  void share_out(BitBox added, BitBox outside, BitBox& rooms) const {
    clear_sides(added);
    const double most = double(added.word_count()) * 8 * kListSets / (2 * sizeof(Place));  // lists grow to twice that
    const bool by_lists = double(added.count()) <= most && added.word_count() <= kMostPlaces / 64;
    by_lists ? share_by_lists(std::move(added), outside, rooms) : share_by_sets(added, outside, rooms);
  }

  void share_by_sets(BitBox& added, BitBox& outside, BitBox& rooms) const {
    for (std::int32_t step = 0; step < reach_.steps; ++step) {
      bool any = dilate_over_faces(added, outside);
      combine(added, outside, kLess);
      any |= dilate_over_faces(added, rooms);
      combine(added, rooms, kLess);
      if (!any) break;
    }
  }

  using Place = std::uint32_t;  // number of a bit in a set of voxels
  static constexpr std::int64_t kMostPlaces = std::int64_t(1) << 32;
  using Front = std::vector<Place>;

  void share_by_lists(BitBox added, const BitBox& outside, BitBox& rooms) const {
    Front outer = take_beside(outside, added), inner = take_beside(rooms, added);
    for (std::int32_t step = 0; step < reach_.steps && !(outer.empty() && inner.empty()); ++step) {
      for (const Place p : inner) rooms.data()[p >> 6] |= std::uint64_t(1) << (p & 63);
      outer = take_next(outer, added);
      inner = take_next(inner, added);
    }
  }

  /// Empties the outermost voxels of the box, so that all others have six neighbours. They are farther away from the
  /// tile than fronts go.
  static void clear_sides(BitBox& voxels) {
    const VoxelBox& box = voxels.box();
    for (int axis = 0; axis < 3; ++axis) {
      for (const std::int32_t at : {box.min[axis], box.max[axis] - 1}) {
        VoxelBox side = box;
        side.min[axis] = at, side.max[axis] = at + 1;
        for_each(side, [&](VoxelCoord p) { voxels.clear(p); });
      }
    }
  }

  /// Takes the voxels out of `added` that share a face with one of `with`.
  [[nodiscard]] static Front take_beside(const BitBox& with, BitBox& added) {
    BitBox beside = with;
    dilate_over_faces(added, beside);
    combine(beside, with, kLess);
    combine(added, beside, kLess);
    Front front;
    for (std::int64_t i = 0; i < beside.word_count(); ++i) {
      for (std::uint64_t w = beside.data()[i]; w != 0; w &= w - 1) front.push_back(Place(i * 64 + std::countr_zero(w)));
    }
    return front;
  }

  /// Takes the voxels out of `added` that share a face with one of `front`.
  [[nodiscard]] static Front take_next(const Front& front, BitBox& added) {
    const Place row = Place(added.words_per_row()) * 64, layer = row * Place(added.box().size().y);
    Front next;
    for (const Place p : front) {
      for (const Place q : {p - 1, p + 1, p - row, p + row, p - layer, p + layer}) {
        std::uint64_t& word = added.data()[q >> 6];
        const std::uint64_t bit = std::uint64_t(1) << (q & 63);
        if ((word & bit) == 0) continue;
        word &= ~bit;
        next.push_back(q);
      }
    }
    return next;
  }

  const BrickShelf &enclosed_, &closed_, &closed_filled_;
  const MemoryShare& memory_;
  const WallReach reach_;
};

/// Returns a brick of the unreached voxels, without those of the scene that the outside sees.
BitBox unseen_brick(const BrickShelf& unreached, const BrickShelf& touched, BrickCoord at) {
  const VoxelBox brick = voxels_of({at, {at.x + 1, at.y + 1, at.z + 1}});
  BitBox behind(brick.grown(kLayers)), scene(behind.box());
  load_voxels(unreached, behind);
  load_voxels(touched, scene);
  BitBox seen = inverse(behind);
  for (int layer = 0; layer < kLayers; ++layer) {
    dilate(seen, 1);
    combine(seen, scene, kBoth);
  }
  combine(behind, seen, kLess);
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
ClosedVoxels closed_voxels(const StreamHeader& header, BrickShelf& enclosed, Backends& backends,
                           const HiddenOptions& o) {
  ClosedVoxels out;
  if (o.scale_world < header.frame.voxel) {
    out.count = count_voxels(enclosed);
    return out;
  }
  out.closed = close_shelf(header, enclosed, backends, uniform(o.scale_world), {o.element}, close_options(o, true));
  out.filled = o.context.make_shelf();
  out.has_rooms = fill(header, *out.closed, backends, o, *out.filled) > 0;
  if (o.entered != nullptr && out.has_rooms) out.has_rooms = leave_open(*o.entered, *out.closed, *out.filled);
  out.count = count_voxels(*out.filled);
  return out;
}

Shelf unreached_voxels(const StreamHeader& header, const BrickShelf& enclosed, ClosedVoxels closed, Backends& backends,
                       const HiddenOptions& o) {
  const Shelf both = o.context.make_shelf();
  Walls(header, enclosed, *closed.closed, *closed.filled, o).put(*both);
  if (o.entered != nullptr) take_out(*o.entered, *both);
  closed = {};
  Shelf out = o.context.make_shelf();
  fill(header, *both, backends, o, *out);
  return out;
}

Shelf unreached_voxels(const StreamHeader& header, BrickShelf& enclosed, Backends& backends, const HiddenOptions& o) {
  ClosedVoxels closed = closed_voxels(header, enclosed, backends, o);
  return closed.has_rooms ? unreached_voxels(header, enclosed, std::move(closed), backends, o) : nullptr;
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

std::uint64_t hidden_limit(const StreamHeader& header, const HiddenOptions& o) {
  if (o.scale_world < header.frame.voxel) return 0;
  const double needed = WallReach(o.scale_world / header.frame.voxel).bytes_of_tile(1);
  return o.context.memory.limit_for(std::uint64_t(std::ceil(needed)));
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
