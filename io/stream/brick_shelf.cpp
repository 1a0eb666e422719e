#include "io/stream/brick_shelf.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <mutex>
#include <shared_mutex>
#include <unordered_map>

#include "io/files/file.h"
#include "io/store/brick_codec.h"
#include "lib/core/error.h"
#include "lib/grid/coord_hash.h"

namespace bp {

namespace {

constexpr std::size_t kPageBytes = 1024;   // pages of the scratch file; a compressed brick takes 1 to 33 of them
constexpr std::uint64_t kIndexBytes = 80;  // for each entry of the map, about
constexpr std::uint64_t kLeastIndex = std::uint64_t(4) << 20;  // every pool may have this much

void raise(std::atomic<std::uint64_t>& peak, std::uint64_t value) {
  std::uint64_t old = peak.load(std::memory_order_relaxed);
  while (old < value && !peak.compare_exchange_weak(old, value, std::memory_order_relaxed)) {
  }
}

/// Pages of a scratch file. Any free page serves any brick, so the file never outgrows the most that was held at once.
class PageFile {
 public:
  explicit PageFile(std::string directory) : directory_(std::move(directory)) {}

  void write(std::span<const std::byte> bytes, std::span<std::uint32_t> pages) {
    ScratchFile& file = take(pages);
    for_runs(pages, bytes.size(),
             [&](std::uint64_t offset, std::size_t at, std::size_t n) { file.write_at(offset, bytes.subspan(at, n)); });
  }
  void read(std::span<const std::uint32_t> pages, std::span<std::byte> bytes) const {
    for_runs(pages, bytes.size(), [&](std::uint64_t offset, std::size_t at, std::size_t n) {
      file_->read_at(offset, bytes.subspan(at, n));
    });
  }
  void release(std::span<const std::uint32_t> pages) {
    const std::lock_guard lock(mutex_);
    free_.insert(free_.end(), pages.begin(), pages.end());
  }
  [[nodiscard]] std::uint64_t used() const {
    const std::lock_guard lock(mutex_);
    return (end_ - free_.size()) * kPageBytes;
  }
  [[nodiscard]] std::uint64_t size() const {
    const std::lock_guard lock(mutex_);
    return end_ * kPageBytes;
  }

 private:
  ScratchFile& take(std::span<std::uint32_t> pages) {
    const std::lock_guard lock(mutex_);
    if (!file_) file_ = std::make_unique<ScratchFile>(directory_);
    const std::size_t old = std::min(pages.size(), free_.size());
    std::copy(free_.end() - std::ptrdiff_t(old), free_.end(), pages.begin());
    free_.resize(free_.size() - old);
    if (end_ + (pages.size() - old) > 0xffffffffu)
      fail(ErrorCode::out_of_resource, {Remedy::more_memory}, "the scratch file in {} would exceed 4 TiB", directory_);
    for (std::uint32_t& page : pages.subspan(old)) page = std::uint32_t(end_++);
    std::sort(pages.begin(), pages.end());  // neighbouring pages go in one call
    return *file_;
  }

  template <class Body>
  static void for_runs(std::span<const std::uint32_t> pages, std::size_t bytes, const Body& body) {
    for (std::size_t i = 0; i < pages.size();) {
      std::size_t j = i + 1;
      while (j < pages.size() && pages[j] == pages[j - 1] + 1) ++j;
      body(std::uint64_t(pages[i]) * kPageBytes, i * kPageBytes, std::min(bytes, j * kPageBytes) - i * kPageBytes);
      i = j;
    }
  }

  std::string directory_;
  mutable std::mutex mutex_;
  std::unique_ptr<ScratchFile> file_;
  std::vector<std::uint32_t> free_;
  std::uint64_t end_ = 0;
};

}  // namespace

struct ShelfPool::State {
  State(std::uint64_t memory_bytes, std::string temp_dir) : budget(memory_bytes), pages(std::move(temp_dir)) {}

  const std::uint64_t budget;
  PageFile pages;
  std::atomic<std::uint64_t> used{0}, peak{0}, entries{0};

  /// Takes `bytes` unless the memory in use would exceed `limit`.
  bool try_take(std::uint64_t bytes, std::uint64_t limit) {
    std::uint64_t now = used.load();
    do {
      if (now + bytes > limit) return false;
    } while (!used.compare_exchange_weak(now, now + bytes));
    raise(peak, now + bytes);
    return true;
  }
  /// Throws if the index leaves no room for another entry. Threads at work may exceed it by theirs.
  void check_index() const {
    const std::uint64_t bytes = (entries + 1) * kIndexBytes;
    if (bytes <= budget + kLeastIndex) return;
    throw NeedsMemory(fmt::format("the index of {} bricks that wait", entries.load()), bytes, budget, 0,
                      {Remedy::larger_voxels});
  }
  void take_entry() {
    ++entries;
    take(kIndexBytes);
  }
  void give_back_entry() {
    --entries;
    give_back(kIndexBytes);
  }
  void take(std::uint64_t bytes) { raise(peak, used.fetch_add(bytes) + bytes); }
  /// Returns true if the next brick may not fit, however well it compresses.
  [[nodiscard]] bool crowded() const { return used + kIndexBytes + kPageBytes + detail::kBrickBytes > budget; }
  void give_back(std::uint64_t bytes) { used.fetch_sub(bytes); }
};

namespace {

enum class Place : std::uint8_t { none, raw, packed, spilled };

/// A brick. `data` holds its words, its compressed bytes, or the numbers of its pages.
struct Entry {
  BrickFill fill = BrickFill::full;
  Place place = Place::none;
  std::uint32_t size = 0;  // compressed size
  std::unique_ptr<std::byte[]> data;

  [[nodiscard]] std::size_t page_count() const { return (size + kPageBytes - 1) / kPageBytes; }
  [[nodiscard]] std::span<std::uint32_t> pages() const {
    return {reinterpret_cast<std::uint32_t*>(data.get()), page_count()};
  }
  [[nodiscard]] std::uint64_t memory() const {
    switch (place) {
      case Place::none:
        return 0;
      case Place::raw:
        return detail::kBrickBytes;
      case Place::packed:
        return size;
      case Place::spilled:
        return page_count() * sizeof(std::uint32_t);
    }
    return 0;
  }
};

std::span<const std::byte> pack(const BrickBits& bits) {
  thread_local std::vector<std::byte> planes(detail::kBrickBytes), packed;
  detail::to_planes(bits, planes.data());
  detail::compress(planes, detail::kDefaultLevel, false, packed);
  return packed;
}

void unpack(std::span<const std::byte> packed, BrickBits& out) {
  thread_local std::vector<std::byte> planes(detail::kBrickBytes);
  if (const char* fault = detail::decompress(packed, planes))
    fail(ErrorCode::failed, "a brick on the shelf {}; memory or the scratch file is damaged", fault);
  detail::from_planes(planes.data(), out);
}

/// Keeps a compressed brick, whose memory the caller has taken.
void keep_packed(std::span<const std::byte> packed, Entry& entry) {
  entry.place = Place::packed;
  entry.size = std::uint32_t(packed.size());
  entry.data.reset(new std::byte[packed.size()]);
  std::memcpy(entry.data.get(), packed.data(), packed.size());
}

void spill(ShelfPool::State& pool, std::span<const std::byte> packed, Entry& entry) {
  entry.size = std::uint32_t(packed.size());
  entry.data.reset(new std::byte[entry.page_count() * sizeof(std::uint32_t)]);
  pool.pages.write(packed, entry.pages());
  entry.place = Place::spilled;
  pool.take(entry.memory());
}

void load(const ShelfPool::State& pool, const Entry& entry, BrickBits& out) {
  switch (entry.place) {
    case Place::none:
      out.fill(~std::uint64_t(0));
      return;
    case Place::raw:
      std::memcpy(out.data(), entry.data.get(), detail::kBrickBytes);
      return;
    case Place::packed:
      return unpack({entry.data.get(), entry.size}, out);
    case Place::spilled:
      break;
  }
  thread_local std::vector<std::byte> packed;
  packed.resize(entry.size);
  pool.pages.read(entry.pages(), packed);
  unpack(packed, out);
}

void release(ShelfPool::State& pool, const Entry& entry) {
  if (entry.place == Place::spilled) pool.pages.release(entry.pages());
  pool.give_back(entry.memory());
  pool.give_back_entry();
}

/// A share of the bricks, with its own lock. Several threads may read at once.
class Shard {
 public:
  void put(ShelfPool::State& pool, BrickCoord coord, BrickFill fill, const BrickBits& bits) {
    const std::lock_guard lock(mutex_);
    erase(pool, coord);
    if (fill == BrickFill::empty) return;
    pool.check_index();
    Entry entry;
    entry.fill = fill;
    if (fill == BrickFill::mixed) store(pool, coord, bits, entry);
    pool.take_entry();
    entries_.emplace(coord, std::move(entry));
  }

  BrickFill get(const ShelfPool::State& pool, BrickCoord coord, BrickBits& out) const {
    const std::shared_lock lock(mutex_);
    const auto found = entries_.find(coord);
    if (found == entries_.end()) {
      out.fill(0);
      return BrickFill::empty;
    }
    load(pool, found->second, out);
    return found->second.fill;
  }

  BrickFill fill(BrickCoord coord) const {
    const std::shared_lock lock(mutex_);
    const auto found = entries_.find(coord);
    return found == entries_.end() ? BrickFill::empty : found->second.fill;
  }

  void drop(ShelfPool::State& pool, BrickCoord coord) {
    const std::lock_guard lock(mutex_);
    erase(pool, coord);
  }

  /// Compresses one raw brick of this shard; returns false if there is none.
  bool pack_one(ShelfPool::State& pool) {
    if (raw_count_ == 0) return false;
    const std::lock_guard lock(mutex_);
    while (!raw_.empty()) {
      const BrickCoord coord = raw_.back();
      raw_.pop_back();
      const auto found = entries_.find(coord);
      if (found == entries_.end() || found->second.place != Place::raw) continue;
      Entry& entry = found->second;
      BrickBits bits;
      std::memcpy(bits.data(), entry.data.get(), detail::kBrickBytes);
      const std::span<const std::byte> packed = pack(bits);
      --raw_count_;
      pool.give_back(entry.memory());
      pool.take(packed.size());
      keep_packed(packed, entry);
      return true;
    }
    return false;
  }

  void clear(ShelfPool::State& pool) {
    for (const auto& [coord, entry] : entries_) release(pool, entry);
  }

  void list(std::vector<BrickCoord>& out) const {
    const std::shared_lock lock(mutex_);
    for (const auto& [coord, entry] : entries_) out.push_back(coord);
  }

 private:
  void store(ShelfPool::State& pool, BrickCoord coord, const BrickBits& bits, Entry& entry) {
    if (pool.try_take(detail::kBrickBytes, pool.budget / 2)) {
      entry.place = Place::raw;
      entry.data.reset(new std::byte[detail::kBrickBytes]);
      std::memcpy(entry.data.get(), bits.data(), detail::kBrickBytes);
      remember_raw(coord);
      return;
    }
    const std::span<const std::byte> packed = pack(bits);
    if (pool.try_take(packed.size(), pool.budget)) {
      keep_packed(packed, entry);
    } else {
      spill(pool, packed, entry);
    }
  }

  /// Notes a raw brick. raw_ may name bricks that are gone, or name a brick twice; it is made anew before it grows
  /// beyond twice the bricks.
  void remember_raw(BrickCoord coord) {
    if (raw_.size() > 2 * raw_count_.load() + 64) {
      raw_.clear();
      for (const auto& [c, e] : entries_) {
        if (e.place == Place::raw) raw_.push_back(c);
      }
    }
    raw_.push_back(coord);
    ++raw_count_;
  }

  void erase(ShelfPool::State& pool, BrickCoord coord) {
    const auto found = entries_.find(coord);
    if (found == entries_.end()) return;
    if (found->second.place == Place::raw) --raw_count_;
    release(pool, found->second);
    entries_.erase(found);
  }

  mutable std::shared_mutex mutex_;
  std::unordered_map<BrickCoord, Entry, CoordHash> entries_;
  std::vector<BrickCoord> raw_;
  std::atomic<std::size_t> raw_count_{0};  // written only under the lock
};

class PooledShelf final : public BrickShelf {
 public:
  explicit PooledShelf(std::shared_ptr<ShelfPool::State> pool) : pool_(std::move(pool)) {}
  ~PooledShelf() override {
    for (Shard& shard : shards_) shard.clear(*pool_);
  }
  PooledShelf(const PooledShelf&) = delete;
  PooledShelf& operator=(const PooledShelf&) = delete;

  void put(BrickCoord coord, BrickFill fill, const BrickBits& bits) override {
    if (fill == BrickFill::mixed) make_room();
    shard(coord).put(*pool_, coord, fill, bits);
  }
  BrickFill get(BrickCoord coord, BrickBits& out) const override { return shard(coord).get(*pool_, coord, out); }
  [[nodiscard]] BrickFill fill(BrickCoord coord) const override { return shard(coord).fill(coord); }
  void drop(BrickCoord coord) override { shard(coord).drop(*pool_, coord); }
  [[nodiscard]] std::vector<BrickCoord> coords() const override {
    std::vector<BrickCoord> all;
    for (const Shard& shard : shards_) shard.list(all);
    std::sort(all.begin(), all.end());
    return all;
  }

  [[nodiscard]] std::uint64_t memory_bytes() const override { return pool_->used; }

 private:
  // Uses the top bits, since the map inside uses the low ones.
  static std::size_t index(BrickCoord coord) { return CoordHash()(coord) >> 58; }
  Shard& shard(BrickCoord coord) { return shards_[index(coord)]; }
  [[nodiscard]] const Shard& shard(BrickCoord coord) const { return shards_[index(coord)]; }

  /// Compresses raw bricks before any brick is spilled. Takes one shard's lock at a time.
  void make_room() {
    if (!pool_->crowded()) return;
    for (Shard& shard : shards_) {
      while (shard.pack_one(*pool_)) {
        if (!pool_->crowded()) return;
      }
    }
  }

  std::shared_ptr<ShelfPool::State> pool_;
  std::array<Shard, 64> shards_;
};

}  // namespace

ShelfPool::ShelfPool(std::uint64_t memory_bytes, std::string temp_dir)
    : state_(std::make_shared<State>(memory_bytes, std::move(temp_dir))) {}

std::unique_ptr<BrickShelf> ShelfPool::make() const {
  return std::make_unique<PooledShelf>(state_);
}

ShelfFactory ShelfPool::factory() const {
  return [pool = *this] { return pool.make(); };
}

ShelfUse ShelfPool::use() const {
  return {state_->used, state_->peak, state_->pages.used(), state_->pages.size()};
}

std::unique_ptr<BrickShelf> make_shelf(std::uint64_t memory_bytes, const std::string& temp_dir) {
  return ShelfPool(memory_bytes, temp_dir).make();
}

ShelfFactory make_shelf_factory(std::uint64_t memory_bytes, const std::string& temp_dir) {
  return ShelfPool(memory_bytes, temp_dir).factory();
}

}  // namespace bp
