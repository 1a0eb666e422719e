#include "lib/pass/voxelize/detail/tile_fill.h"

#include <algorithm>
#include <cstring>
#include <set>

#include "lib/core/parallel.h"
#include "lib/voxel/winding.h"

namespace bp {

TileFill::TileFill(FillMode mode, const TileGrid& tiles, BrickShelf& shelf, Scratch& store, TileWorks& works)
    : mode_(mode),
      tiles_(tiles),
      shelf_(shelf),
      store_(store),
      works_(works),
      flood_(tiles.voxels, VoxelCoord{tiles.edge_vox, tiles.edge_vox, tiles.edge_vox}) {}

void TileFill::add_crossings(std::uint64_t tile, std::span<const Crossing> crossings) {
  if (crossings.empty()) return;
  const Scratch::Handle handle = store_.put(std::as_bytes(crossings));
  const std::lock_guard lock(mutex_);
  crossings_[tile].push_back(handle);
}

void TileFill::get_crossings(std::uint64_t tile, std::vector<Crossing>& out) const {
  out.clear();
  const auto at = crossings_.find(tile);
  if (at == crossings_.end()) return;
  std::vector<std::byte> bytes;
  for (const Scratch::Handle h : at->second) {
    store_.get(h, bytes);
    const std::size_t old = out.size();
    out.resize(old + bytes.size() / sizeof(Crossing));
    std::memcpy(static_cast<void*>(out.data() + old), bytes.data(), bytes.size());
  }
}

void TileFill::add_surface(std::uint64_t tile, const BitBox& bits) {
  OutsideFlood::Labels labels = OutsideFlood::label(bits, box(tile));
  const std::lock_guard lock(mutex_);
  flood_.join(std::move(labels));
  if (mode_ == FillMode::inside) with_surface_.insert(tile);
}

void TileFill::resolve() {
  flood_.resolve();
}

void TileFill::fill_flood(std::uint64_t tile) {
  const VoxelBox box = this->box(tile);
  const bool without_surface = with_surface_.count(tile) > 0;
  if (!flood_.has_enclosed(box) && !without_surface) return;
  const TileWorks::Lease work(works_);
  work->bits.reset(box);
  load_voxels(shelf_, work->bits);
  BitBox surface;
  if (without_surface) surface = work->bits;
  flood_.fill_enclosed(box, work->bits);
  for (std::int64_t i = 0; i < surface.word_count(); ++i) work->bits.data()[i] &= ~surface.data()[i];
  store(tile, work->bits);
}

void TileFill::store(std::uint64_t tile, const BitBox& bits) {
  store_voxels(bits, shelf_);
  const std::lock_guard lock(mutex_);
  filled_.insert(tile);
}

bool TileFill::has_filled(std::uint64_t tile) const {
  const std::lock_guard lock(mutex_);
  return filled_.contains(tile);
}

/// A column of tiles without a crossing has nothing to fill; in a wide grid most have none.
void TileFill::fill_columns(const PassProgress& progress) {
  const std::uint64_t nx = std::uint64_t(tiles_.count.x), in_layer = nx * std::uint64_t(tiles_.count.y);
  std::set<std::uint64_t> crossed;
  for (const auto& [tile, handles] : crossings_) crossed.insert(tile % in_layer);
  const std::vector<std::uint64_t> columns(crossed.begin(), crossed.end());
  PassSteps steps(progress, "filling", "columns", columns.size());
  parallel_for(std::int64_t(columns.size()), [&](std::int64_t i) {
    const std::uint64_t column = columns[std::size_t(i)];
    fill_column(std::int32_t(column % nx), std::int32_t(column / nx));
    steps.add(1);
  });
}

TileFill::OpenColumns TileFill::open_columns(std::int32_t tx, std::int32_t ty, TileWork& work) const {
  const VoxelCoord size = tiles_.box({tx, ty, 0}).size();
  const std::size_t width = std::size_t(size.x), words = (width + 63) / 64;
  std::vector<std::int32_t> numbers(width * std::size_t(size.y), 0);
  for (std::int32_t tz = 0; tz < tiles_.count.z; ++tz) {
    get_crossings(tiles_.index({tx, ty, tz}), work.crossings);
    bp::add_crossings(work.crossings, tiles_.box({tx, ty, tz}), numbers);
  }
  OpenColumns open{std::vector<std::uint64_t>(words * std::size_t(size.y), 0), 0};
  for (std::size_t y = 0; y < std::size_t(size.y); ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      if (numbers[x + y * width] == 0) continue;
      open.bits[y * words + x / 64] |= std::uint64_t(1) << (x % 64);
      ++open.count;
    }
  }
  return open;
}

/// Fills one column of tiles: first finds the columns of voxels whose crossings cancel, then fills from below.
void TileFill::fill_column(std::int32_t tx, std::int32_t ty) {
  const TileWorks::Lease work(works_);
  const OpenColumns open = open_columns(tx, ty, *work);
  open_columns_ += open.count;
  const VoxelCoord size = tiles_.box({tx, ty, 0}).size();
  std::vector<std::int32_t> numbers(std::size_t(size.x) * std::size_t(size.y), 0);
  BitBox flooded;
  for (std::int32_t tz = 0; tz < tiles_.count.z; ++tz) {
    const std::uint64_t tile = tiles_.index({tx, ty, tz});
    const VoxelBox box = this->box(tile);
    get_crossings(tile, work->crossings);
    const bool flood = open.count > 0 && flood_.has_enclosed(box);
    const bool wound = std::any_of(numbers.begin(), numbers.end(), [](std::int32_t n) { return n != 0; });
    if (work->crossings.empty() && !flood && !wound) continue;
    work->bits.reset(box);
    load_voxels(shelf_, work->bits);
    if (flood) {
      flooded = work->bits;
      flood_.fill_enclosed(box, flooded);
    }
    fill_winding(work->crossings, box, open.bits, numbers, work->bits);
    for (std::int32_t z = box.min.z; flood && z < box.max.z; ++z) {
      for (std::size_t w = 0; w < open.bits.size(); ++w) {
        work->bits.row(box.min.y, z)[w] |= flooded.row(box.min.y, z)[w] & open.bits[w];
      }
    }
    store(tile, work->bits);
  }
}

}  // namespace bp
