#include "lib/pass/voxelize/detail/surface_chunks.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstring>
#include <unordered_map>

#include "lib/grid/clip.h"
#include "lib/grid/tile_grid.h"
#include "lib/voxel/voxelize.h"

// Chunks as in content-defined chunking (Muthitacharoen, Chen, Mazières 2001), with a triangle in the place of a window
// of bytes.

namespace bp {

namespace {

constexpr const char* kJob = "voxels of a chunk";
constexpr std::size_t kMaskWords = kBrickWords / 64;

template <class T>
void append(std::string& out, const T* values, std::size_t n) {
  out.append(reinterpret_cast<const char*>(values), n * sizeof(T));
}

bool is_place(const TriangleD& t) {
  std::uint64_t h = std::bit_cast<std::uint64_t>(t[0][0]) * 0x9e3779b97f4a7c15u;
  h = (h ^ (h >> 29) ^ std::bit_cast<std::uint64_t>(t[1][1])) * 0xbf58476d1ce4e5b9u;
  h = (h ^ (h >> 32) ^ std::bit_cast<std::uint64_t>(t[2][2])) * 0x94d049bb133111ebu;
  return h >> (64 - ChunkCutter::kMeanBits) == 0;
}

/// A brick in the bytes of a chunk.
struct PackedBrick {
  BrickCoord coord{};
  std::uint64_t mask[kMaskWords];  ///< a bit for each word that is not 0
  const char* words = nullptr;     ///< the words that are not 0
};

/// Takes a brick off the front of `in`; returns false if the bytes are no brick of the grid.
bool take_brick(std::string_view& in, const BrickBox& grid, PackedBrick& out) {
  std::int32_t at[3];
  if (in.size() < sizeof at + sizeof out.mask) return false;
  std::memcpy(at, in.data(), sizeof at);
  std::memcpy(out.mask, in.data() + sizeof at, sizeof out.mask);
  in.remove_prefix(sizeof at + sizeof out.mask);
  out.coord = {at[0], at[1], at[2]};
  out.words = in.data();
  std::size_t words = 0;
  for (const std::uint64_t m : out.mask) words += std::size_t(std::popcount(m));
  if (!grid.contains(out.coord) || in.size() < words * sizeof(std::uint64_t)) return false;
  in.remove_prefix(words * sizeof(std::uint64_t));
  return true;
}

/// Adds the brick's voxels. Other threads may add to the bits at the same time.
void add_brick(const PackedBrick& brick, BrickBits& bits) {
  const char* from = brick.words;
  for (std::size_t i = 0; i < kMaskWords; ++i) {
    for (std::uint64_t left = brick.mask[i]; left != 0; left &= left - 1, from += sizeof(std::uint64_t)) {
      std::uint64_t word;
      std::memcpy(&word, from, sizeof word);
      std::atomic_ref(bits[i * 64 + std::size_t(std::countr_zero(left))]).fetch_or(word, std::memory_order_relaxed);
    }
  }
}

void append_brick(BrickCoord c, const std::uint64_t* bits, std::string& out) {
  std::uint64_t mask[kMaskWords]{}, words[kBrickWords];
  std::size_t n = 0;
  for (std::size_t i = 0; i < kBrickWords; ++i) {
    if (bits[i] == 0) continue;
    mask[i / 64] |= std::uint64_t(1) << (i % 64);
    words[n++] = bits[i];
  }
  if (n == 0) return;
  const std::int32_t at[] = {c.x, c.y, c.z};
  append(out, at, 3);
  append(out, mask, kMaskWords);
  append(out, words, n);
}

}  // namespace

// --- Cutting ---------------------------------------------------------------------------------------------------------

std::vector<std::uint32_t> ChunkCutter::places(std::span<const TriangleD> triangles) {
  std::vector<std::uint32_t> found;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (is_place(triangles[i])) found.push_back(std::uint32_t(i));
  }
  return found;
}

void ChunkCutter::add(std::span<const TriangleD> triangles, std::span<const std::uint32_t> places) {
  std::size_t begin = 0;
  const auto take_to = [&](std::size_t end) {
    while (open_ + (end - begin) >= kMost) {
      const auto n = std::size_t(kMost - open_);
      take(triangles.subspan(begin, n));
      begin += n;
      cut();
    }
    take(triangles.subspan(begin, end - begin));
    begin = end;
  };
  for (const std::uint32_t place : places) {
    take_to(place + 1);
    if (open_ >= kLeast) cut();
  }
  take_to(triangles.size());
}

void ChunkCutter::take(std::span<const TriangleD> triangles) {
  hash_.add(std::as_bytes(triangles));
  open_ += triangles.size();
}

ResultKey ChunkCutter::content_of(std::span<const TriangleD> triangles) {
  ContentHash hash;
  hash.add(std::as_bytes(triangles));
  return hash.value();
}

void ChunkCutter::cut() {
  chunks_.push_back({open_, hash_.value()});
  hash_.reset();
  open_ = 0;
}

std::vector<ChunkCutter::Chunk> ChunkCutter::finish() {
  if (open_ > 0) cut();
  return std::move(chunks_);
}

ResultKey chunk_key(const ChunkCutter::Chunk& chunk, const GridFrame& frame, std::int64_t slack) {
  return KeyHash(kJob).add(chunk, frame, slack).key();
}

// --- Voxels ----------------------------------------------------------------------------------------------------------

std::optional<std::string> chunk_voxels(std::span<const TriangleD> triangles, const GridFrame& frame,
                                        const BrickBox& grid, std::int64_t slack) {
  const TileGrid bricks(voxels_of(grid), kBrickEdge);
  std::vector<FixedTriangle> fixed;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> sorted;
  // The last brick of a thread: neighbours in a file are neighbours in space.
  std::vector<std::uint32_t>* last = nullptr;
  std::uint64_t last_brick = 0;
  std::size_t meetings = 0;
  fixed.reserve(triangles.size());
  for (const TriangleD& t : triangles) {
    fixed.push_back(to_fixed(frame, t));
    for_each_tile(
        fixed.back(), bricks.voxels.min, bricks.edge_vox, bricks.count,
        [&](TileCoord at) {
          const std::uint64_t brick = bricks.index(at);
          if (last == nullptr || brick != last_brick) last = &sorted[last_brick = brick];
          last->push_back(std::uint32_t(fixed.size() - 1));
          ++meetings;
        },
        slack);
    if (meetings > kChunkMeetings) return std::nullopt;
  }
  std::vector<std::uint64_t> order;
  for (const auto& [brick, numbers] : sorted) order.push_back(brick);
  std::sort(order.begin(), order.end());
  std::string out;
  BitBox bits;
  std::vector<FixedTriangle> within;
  for (const std::uint64_t brick : order) {
    within.clear();
    for (const std::uint32_t i : sorted[brick]) within.push_back(fixed[i]);
    const VoxelBox box = bricks.box(bricks.coord(brick));
    bits.reset(box);
    voxelize_surface(within, bits, slack);
    append_brick(brick_of(box.min), bits.data(), out);
    if (out.size() > kChunkBytes) return std::nullopt;
  }
  return out;
}

// --- Their union -----------------------------------------------------------------------------------------------------

bool BrickSum::add(const std::string& chunk) {
  PackedBrick brick;
  for (std::string_view in = chunk; !in.empty();) {
    if (!take_brick(in, grid_, brick)) return false;
  }
  for (std::string_view in = chunk; take_brick(in, grid_, brick);) {
    if (BrickBits* const bits = bricks_.find(brick.coord)) {
      add_brick(brick, *bits);
      continue;
    }
    Shelved& shelved = shelved_[CoordHash()(brick.coord) % shelved_.size()];
    const std::lock_guard lock(shelved.mutex);
    BrickBits bits;
    if (shelf_.get(brick.coord, bits) == BrickFill::empty) shelved.bricks.push_back(brick.coord);
    add_brick(brick, bits);
    shelf_.put(brick.coord, classify(bits), bits);
  }
  return true;
}

std::vector<BrickCoord> BrickSum::coords() const {
  std::vector<BrickCoord> all = bricks_.coords();
  for (const Shelved& shelved : shelved_) all.insert(all.end(), shelved.bricks.begin(), shelved.bricks.end());
  return all;
}

void BrickSum::take(BitBox& out) {
  load_voxels(shelf_, out);
  bricks_.take(out);
}

}  // namespace bp
