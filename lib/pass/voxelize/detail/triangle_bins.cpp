#include "lib/pass/voxelize/detail/triangle_bins.h"

#include <algorithm>
#include <cstring>

#include "lib/core/parallel.h"
#include "lib/voxel/voxelize.h"

namespace bp {

namespace {

constexpr std::size_t kBlock = 32768;                    // triangles passed on at a time, about
constexpr std::size_t kPutBytes = std::size_t(1) << 20;  // bytes put into the store at a time

FixedPoint corner_of(const TileGrid& grid, std::uint64_t tile) {
  const VoxelCoord v = grid.first_voxel(grid.coord(tile));
  return {v.x * kFixedOne, v.y * kFixedOne, v.z * kFixedOne};
}

/// Returns false if a coordinate does not fit.
bool narrow(const FixedTriangle& t, const FixedPoint& corner, NarrowTriangle& out) {
  const std::int64_t c[9] = {t.a.x - corner.x, t.a.y - corner.y, t.a.z - corner.z, t.b.x - corner.x, t.b.y - corner.y,
                             t.b.z - corner.z, t.c.x - corner.x, t.c.y - corner.y, t.c.z - corner.z};
  bool fits = true;
  for (std::size_t i = 0; i < 9; ++i) {
    out[i] = std::int32_t(c[i]);
    fits = fits && out[i] == c[i];
  }
  return fits;
}

FixedTriangle widen(const NarrowTriangle& n, const FixedPoint& o) {
  return {
      {o.x + n[0], o.y + n[1], o.z + n[2]}, {o.x + n[3], o.y + n[4], o.z + n[5]}, {o.x + n[6], o.y + n[7], o.z + n[8]}};
}

/// Puts a batch into bins by tile. The last bin is remembered, since neighbours in a file are neighbours in space.
class BatchSorter {
 public:
  BatchSorter(const TileGrid& grid, TriangleBatch& batch) : grid_(grid), batch_(batch) {}

  void add(const FixedTriangle& t, std::uint64_t tile) {
    if (bin_ == nullptr || bin_->tile != tile) find(tile);
    NarrowTriangle n;
    if (narrow(t, corner_, n)) {
      bin_->narrow.push_back(n);
    } else {
      bin_->wide.push_back(t);
    }
  }

 private:
  void find(std::uint64_t tile) {
    const auto [at, fresh] = index_.try_emplace(tile, batch_.bins.size());
    if (fresh) {
      batch_.bins.emplace_back();
      batch_.bins.back().tile = tile;
    }
    bin_ = &batch_.bins[at->second];
    corner_ = corner_of(grid_, tile);
  }
  const TileGrid& grid_;
  TriangleBatch& batch_;
  std::unordered_map<std::uint64_t, std::size_t> index_;
  TriangleBatch::Bin* bin_ = nullptr;
  FixedPoint corner_{};
};

template <class T>
void put_chunks(Scratch& store, Blocks<T>& records, std::vector<Scratch::Handle>& handles) {
  constexpr std::size_t kRecords = kPutBytes / sizeof(T);
  std::vector<T> chunk;
  const auto put = [&] {
    if (!chunk.empty()) handles.push_back(store.put(std::as_bytes(std::span<const T>(chunk))));
    chunk.clear();
  };
  records.for_each([&](std::span<const T> block) {
    if (chunk.size() + block.size() > kRecords) put();
    chunk.insert(chunk.end(), block.begin(), block.end());
  });
  put();
  records = {};
}

/// Calls body(span of T) for each chunk.
template <class T, class Body>
void get_chunks(const Scratch& store, const std::vector<Scratch::Handle>& handles, const Body& body) {
  std::vector<std::byte> bytes;
  std::vector<T> records;
  for (const Scratch::Handle h : handles) {
    store.get(h, bytes);
    records.resize(bytes.size() / sizeof(T));
    std::memcpy(static_cast<void*>(records.data()), bytes.data(), records.size() * sizeof(T));
    body(std::span<const T>(records));
  }
}

}  // namespace

TriangleBatch TriangleBins::sort(std::span<const FixedTriangle> triangles, std::int64_t slack) const {
  TriangleBatch batch;
  BatchSorter sorter(grid_, batch);
  for (const FixedTriangle& t : triangles) {
    for_each_tile(
        t, grid_.voxels.min, grid_.edge_vox, grid_.count, [&](TileCoord tile) { sorter.add(t, grid_.index(tile)); },
        slack);
  }
  return batch;
}

void TriangleBins::add(TriangleBatch&& batch) {
  for (TriangleBatch::Bin& from : batch.bins) {
    Bin& to = bins_[from.tile];
    const std::uint64_t before = to.bytes();
    to.narrow.append(from.narrow);
    to.wide.append(from.wide);
    records_ += from.narrow.size() + from.wide.size();
    memory_bytes_ += to.bytes() - before;
  }
}

std::uint64_t TriangleBins::table_bytes() const {
  constexpr std::uint64_t kNodeBytes = sizeof(Bin) + 48;  // key, links, bucket, and what malloc adds
  return bins_.size() * kNodeBytes + chunks_ * sizeof(Scratch::Handle);
}

std::vector<std::uint64_t> TriangleBins::tiles() const {
  std::vector<std::uint64_t> all;
  all.reserve(bins_.size());
  for (const auto& [tile, bin] : bins_) all.push_back(tile);
  std::sort(all.begin(), all.end());
  return all;
}

std::uint64_t TriangleBins::memory_bytes(std::uint64_t tile) const {
  const auto at = bins_.find(tile);
  return at == bins_.end() ? 0 : at->second.bytes();
}

void TriangleBins::for_each(std::uint64_t tile, const std::function<void(std::span<const FixedTriangle>)>& body) const {
  const auto at = bins_.find(tile);
  if (at == bins_.end()) return;
  const Bin& bin = at->second;
  const FixedPoint corner = corner_of(grid_, tile);
  std::vector<FixedTriangle> block;  // the body gets many triangles at once, since a device pays for each call
  const auto flush = [&](std::size_t room) {
    if (block.size() + room <= kBlock) return;
    body(block);
    block.clear();
  };
  const auto narrow_records = [&](std::span<const NarrowTriangle> records) {
    flush(records.size());
    for (const NarrowTriangle& n : records) block.push_back(widen(n, corner));
  };
  const auto wide_records = [&](std::span<const FixedTriangle> records) {
    flush(records.size());
    block.insert(block.end(), records.begin(), records.end());
  };
  get_chunks<NarrowTriangle>(store_, bin.narrow_chunks, narrow_records);
  get_chunks<FixedTriangle>(store_, bin.wide_chunks, wide_records);
  bin.narrow.for_each(narrow_records);
  bin.wide.for_each(wide_records);
  if (!block.empty()) body(block);
}

void TriangleBins::spill(std::span<const std::uint64_t> tiles) {
  parallel_for(std::int64_t(tiles.size()), [&](std::int64_t i) {
    Bin& bin = bins_.at(tiles[std::size_t(i)]);
    put_chunks(store_, bin.narrow, bin.narrow_chunks);
    put_chunks(store_, bin.wide, bin.wide_chunks);
  });
  recount();
}

void TriangleBins::release(std::uint64_t tile) {
  const auto at = bins_.find(tile);
  if (at == bins_.end()) return;
  Bin& bin = at->second;
  for (const Scratch::Handle h : bin.narrow_chunks) store_.drop(h);
  for (const Scratch::Handle h : bin.wide_chunks) store_.drop(h);
  bin = Bin();
}

void TriangleBins::recount() {
  memory_bytes_ = chunks_ = 0;
  for (const auto& [tile, bin] : bins_) {
    memory_bytes_ += bin.bytes();
    chunks_ += bin.narrow_chunks.size() + bin.wide_chunks.size();
  }
}

}  // namespace bp
