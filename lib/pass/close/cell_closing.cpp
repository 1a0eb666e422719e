#include "lib/pass/close/cell_closing.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <set>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/grid/clip.h"
#include "lib/pass/close/detail/tile_closer.h"
#include "lib/pass/turn.h"

namespace bp {

namespace {

constexpr double kMostOverLeast = 3;  // memory of a full cell over that of a nearly empty one

constexpr const char* kJob = "closing of a cell";

/// Packs the bricks of a box that are not empty: place, fill, and bits unless full; then an end mark.
std::string packed(const BitBox& bits) {
  std::string out;
  for_each_brick(bits.box(), [&](BrickCoord c) {
    BrickBits brick;
    const VoxelCoord first = first_voxel(c);
    for (std::int32_t z = 0; z < kBrickEdge; ++z) {
      for (std::int32_t y = 0; y < kBrickEdge; ++y) {
        brick[std::size_t(z * kBrickEdge + y)] =
            bits.row(first.y + y, first.z + z)[(first.x - bits.box().min.x) / kBrickEdge];
      }
    }
    const BrickFill fill = classify(brick);
    if (fill == BrickFill::empty) return;
    const BrickCoord at = c - brick_of(bits.box().min);
    for (const std::int32_t x : {at.x, at.y, at.z, std::int32_t(fill)})
      out.append(reinterpret_cast<const char*>(&x), sizeof x);
    if (fill == BrickFill::mixed) out.append(reinterpret_cast<const char*>(brick.data()), sizeof brick);
  });
  return out + 'e';
}

/// Unpacks them onto the shelf. Returns false if the bytes are no bricks of the cell.
bool unpack(const std::string& in, const VoxelBox& cell, BrickShelf& shelf) {
  const BrickBox bricks = bricks_of(cell);
  if (in.empty() || in.back() != 'e') return false;
  const std::size_t end = in.size() - 1;
  for (std::size_t at = 0; at < end;) {
    std::int32_t head[4];
    BrickBits bits;
    if (end - at < sizeof head) return false;
    std::memcpy(head, in.data() + at, sizeof head);
    at += sizeof head;
    const BrickCoord c = bricks.min + BrickCoord{head[0], head[1], head[2]};
    const bool mixed = head[3] == std::int32_t(BrickFill::mixed);
    if (!bricks.contains(c) || (mixed && end - at < sizeof bits)) return false;
    if (mixed) {
      std::memcpy(bits.data(), in.data() + at, sizeof bits);
      at += sizeof bits;
    } else {
      bits.fill(~std::uint64_t(0));
    }
    shelf.put(c, classify(bits), bits);
  }
  return true;
}

ScaleField uniform(double scale_world) {
  ScaleField field;
  field.base = scale_world;
  return field;
}

/// Closes the cells of a level.
class CellCloser {
 public:
  CellCloser(const StreamHeader& header, const BrickShelf& solid, Backends& backends, double scale_world,
             const CellClosing& options, BrickShelf& closing)
      : solid_(solid),
        options_(options),
        closing_(closing),
        field_(uniform(scale_world)),
        scale_(field_.upper_bound(header.frame)),
        backends_(backends.size()),
        closer_({header, solid, field_, options.closing}, closing, backends, backends.size()) {}

  CellClosingCounts operator()() {
    std::vector<CellCoord> cells = cells_in_reach();
    put_in_turn(cells, options_.context.turn);
    counts_.cells = cells.size();
    if (!options_.keep_cavities && !cells.empty()) lay_flood(cells);
    std::size_t next = 0, done = 0;
    pipeline<CellCoord>(
        in_flight(),
        [&](CellCoord& cell) {
          if (next == cells.size()) return false;
          cell = cells[next++];
          return true;
        },
        [&](const CellCoord& cell) { close(cell); },
        [&](const CellCoord&) { report("closing", ++done, cells.size()); });
    if (closer_.floods()) fill_cavities();
    counts_.kept = kept_;
    return counts_;
  }

 private:
  [[nodiscard]] std::vector<CellCoord> cells_in_reach() const {
    std::set<CellCoord> cells;
    for (const BrickCoord brick : solid_.coords()) {
      const VoxelBox reach = voxels_of(brick).grown(closer_.widest().dilation_vox);
      const CellCoord first = options_.cells.of(reach.min);
      const CellCoord last = options_.cells.of({reach.max.x - 1, reach.max.y - 1, reach.max.z - 1});
      for_each(Box<CellCoord>{first, {last.x + 1, last.y + 1, last.z + 1}}, [&](CellCoord c) { cells.insert(c); });
    }
    return {cells.begin(), cells.end()};
  }

  void lay_flood(const std::vector<CellCoord>& cells) {
    for (const CellCoord c : cells) grid_ = hull(grid_, options_.cells.box(c));
    closer_.flood(grid_, options_.cells.edge_vox);
  }

  /// Returns how many cells fit in memory at once: bits of a cell with its halo, and what closing and labelling need,
  /// which has about the same size.
  [[nodiscard]] int in_flight() const {
    const MemoryShare& memory = options_.context.memory;
    const std::uint64_t needed = least_cell_bytes(options_.cells, closer_.widest().total_vox());
    const double bytes = kMostOverLeast * double(needed);
    if (needed > memory.bytes) {
      throw NeedsMemory(fmt::format("closing a cell of {} voxels with a halo of {}", options_.cells.edge_vox,
                                    closer_.widest().total_vox()),
                        needed, memory.bytes, memory.limit_with(needed - memory.bytes),
                        {Remedy::smaller_tiles, Remedy::smaller_scale});
    }
    const double fit = std::min(double(memory.bytes) / bytes, double(backends_));
    return std::max(1, int(fit));
  }

  [[nodiscard]] ResultKey key_of(const VoxelBox& cell) const {
    KeyHash hash(kJob);
    hash.add(scale_, options_.closing, options_.cells);
    add_voxels(hash, solid_, cell.grown(closer_.widest().total_vox()), brick_of(cell.min));
    return hash.key();
  }

  void close(CellCoord coord) {
    const VoxelBox cell = options_.cells.box(coord);
    ResultKey key;
    std::string result;
    BitBox closed;
    if (options_.context.results != nullptr) {
      key = key_of(cell);
      if (options_.context.results->get(key, result) && unpack(result, cell, closing_)) {
        ++kept_;
        closed.reset(cell);
        if (closer_.floods()) load_voxels(closing_, closed);
        return closer_.label(cell, closed);
      }
    }
    closer_.close(cell, closer_.widest(), closed);
    closer_.keep(cell, closed);
    if (options_.context.results != nullptr) options_.context.results->put(key, packed(closed));
  }

  /// Fills cavities, also in cells that hold no voxel.
  void fill_cavities() {
    closer_.resolve();
    const CellCoord first = options_.cells.of(grid_.min);
    const VoxelCoord size = grid_.size();
    const std::int64_t edge = options_.cells.edge_vox, nx = size.x / edge, ny = size.y / edge, nz = size.z / edge;
    parallel_for(nx * ny * nz, [&](std::int64_t i) {
      const CellCoord at{std::int32_t(i % nx), std::int32_t(i / nx % ny), std::int32_t(i / nx / ny)};
      const VoxelBox cell = options_.cells.box(first + at);
      BitBox bits;
      if (closer_.has_enclosed(cell)) closer_.fill(cell, bits);
    });
  }

  void report(const char* pass, std::uint64_t done, std::uint64_t total) const {
    options_.context.report(pass, "cells", done, total);
  }

  const BrickShelf& solid_;
  const CellClosing& options_;
  BrickShelf& closing_;
  const ScaleField field_;
  const Scale scale_;
  const std::size_t backends_;
  TileCloser closer_;
  VoxelBox grid_;
  std::atomic<std::uint64_t> kept_{0};
  CellClosingCounts counts_;
};

}  // namespace

std::uint64_t least_cell_bytes(const Cells& cells, std::int32_t halo_vox) {
  const double side = double(cells.edge_vox) + 2.0 * halo_vox + 64;
  return std::uint64_t((12 * side * side * side / 8 + (16 << 20)) / kMostOverLeast);
}

CellClosingCounts close_cells(const StreamHeader& header, const BrickShelf& solid, Backends& backends,
                              double scale_world, const CellClosing& options, BrickShelf& closing) {
  return CellCloser(header, solid, backends, scale_world, options, closing)();
}

}  // namespace bp
