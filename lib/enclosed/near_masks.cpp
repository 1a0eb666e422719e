#include "lib/enclosed/near_masks.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>

#include "lib/core/parallel.h"
#include "lib/grid/coord_hash.h"
#include "lib/mesh/lattice_geometry.h"
#include "lib/volume/dilate_ball.h"
#include "lib/volume/reduce.h"

namespace bp {

namespace {

constexpr double kLeastReach = 8;         // shortest distance, in voxels of the mask, of a mask with larger voxels
constexpr std::size_t kMostBricks = 512;  // bricks of a mask, about: 16 MiB
constexpr std::uint64_t kWorkBytes = 64 << 20;  // memory while a mask is made, bytes
// Rows of voxels that are looked at for one piece of a face; a piece with more is halved.
constexpr std::int64_t kMostRows = 256;

/// A shelf of bricks in memory, each once.
class Bricks final : public BrickShelf {
 public:
  void put(BrickCoord coord, BrickFill fill, const BrickBits& bits) override {
    const std::lock_guard lock(mutex_);
    if (fill == BrickFill::empty) return drop(coord);
    bricks_[coord] = fill == BrickFill::full ? nullptr : std::make_unique<BrickBits>(bits);
  }
  BrickFill get(BrickCoord coord, BrickBits& out) const override {
    const BrickFill fill = this->fill(coord);
    if (fill == BrickFill::mixed) {
      out = *bricks_.find(coord)->second;
    } else {
      out.fill(fill == BrickFill::full ? ~std::uint64_t(0) : 0);
    }
    return fill;
  }
  [[nodiscard]] BrickFill fill(BrickCoord coord) const override {
    const auto it = bricks_.find(coord);
    if (it == bricks_.end()) return BrickFill::empty;
    return it->second ? BrickFill::mixed : BrickFill::full;
  }
  void drop(BrickCoord coord) override { bricks_.erase(coord); }
  [[nodiscard]] std::vector<BrickCoord> coords() const override {
    std::vector<BrickCoord> all;
    for (const auto& [coord, bits] : bricks_) all.push_back(coord);
    std::sort(all.begin(), all.end(), [](const BrickCoord& a, const BrickCoord& b) {
      return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
    });
    return all;
  }
  [[nodiscard]] std::uint64_t memory_bytes() const override {
    std::uint64_t sum = 0;
    for (const auto& [coord, bits] : bricks_) sum += bits ? sizeof(BrickBits) : 0;
    return sum;
  }
  /// Finds a brick; returns false if it is empty, and null bits if it is full.
  [[nodiscard]] bool find(BrickCoord coord, const BrickBits*& bits) const {
    const auto it = bricks_.find(coord);
    if (it == bricks_.end()) return false;
    bits = it->second.get();
    return true;
  }

 private:
  std::mutex mutex_;
  std::unordered_map<BrickCoord, std::unique_ptr<BrickBits>, CoordHash> bricks_;
};

}  // namespace

class NearMasks::Mask {
 public:
  Mask(const BrickShelf& voxels, double distance) {
    std::unique_ptr<Bricks> larger;
    for (std::size_t count = voxels.coords().size(); count > kMostBricks || distance / double(2 * edge_) >= kLeastReach;
         count /= 4) {
      auto doubled = std::make_unique<Bricks>();
      reduce(larger ? *larger : voxels, GridFrame{}, *doubled);  // the origin stays: voxel p lies in p / 2
      larger = std::move(doubled);
      edge_ *= 2;
    }
    const double reach = std::min(distance / double(edge_), kMostReach);
    dilate_ball(larger ? *larger : voxels, reach, bricks_, {kWorkBytes});
  }

  [[nodiscard]] VoxelCoord voxel_of(const LatticeCoord& p) const {
    return {std::int32_t(floor_div(p.x, edge_)), std::int32_t(floor_div(p.y, edge_)),
            std::int32_t(floor_div(p.z, edge_))};
  }

  /// Returns whether all voxels from `low` to `high` are set.
  [[nodiscard]] bool holds(const VoxelCoord& low, const VoxelCoord& high) const {
    const auto brick_of = [](std::int32_t v) { return floor_div(v, kBrickEdge); };
    for (std::int32_t bz = brick_of(low.z); bz <= brick_of(high.z); ++bz) {
      for (std::int32_t by = brick_of(low.y); by <= brick_of(high.y); ++by) {
        for (std::int32_t bx = brick_of(low.x); bx <= brick_of(high.x); ++bx) {
          if (!holds({bx, by, bz}, low, high)) return false;
        }
      }
    }
    return true;
  }

  /// Returns the answer for a face or an edge with these bounds, if the voxels around it tell: all are in the mask, or
  /// the box is too small to be cut.
  [[nodiscard]] std::optional<bool> answer_for(const LatticeBox& box) const {
    const VoxelCoord low = voxel_of(box.min), high = voxel_of(box.max);
    const VoxelCoord size = high - low;
    const bool is_small = std::max({size.x, size.y, size.z}) <= 1;
    if (!is_small && std::int64_t(size.y + 1) * (size.z + 1) > kMostRows) return {};
    if (holds(low, high)) return true;
    return is_small ? std::optional(false) : std::nullopt;
  }

  [[nodiscard]] bool holds(const std::array<LatticeCoord, 3>& t) const {
    if (const std::optional<bool> all = answer_for(box_of(t[0], t[1], t[2]))) return *all;
    const auto middle = [](const LatticeCoord& a, const LatticeCoord& b) {
      return LatticeCoord{(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2};
    };
    const std::array<LatticeCoord, 3> m = {middle(t[0], t[1]), middle(t[1], t[2]), middle(t[2], t[0])};
    return holds(m) && holds({t[0], m[0], m[2]}) && holds({m[0], t[1], m[1]}) && holds({m[2], m[1], t[2]});
  }
  [[nodiscard]] bool holds(const LatticeCoord& a, const LatticeCoord& b) const {
    if (const std::optional<bool> all = answer_for(box_of(a, b, b))) return *all;
    const LatticeCoord m{(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2};
    return holds(a, m) && holds(m, b);
  }
  [[nodiscard]] std::uint64_t bytes() const { return bricks_.memory_bytes(); }

 private:
  [[nodiscard]] bool holds(const BrickCoord& brick, const VoxelCoord& low, const VoxelCoord& high) const {
    const BrickBits* bits = nullptr;
    if (!bricks_.find(brick, bits)) return false;
    if (bits == nullptr) return true;
    const VoxelCoord first = first_voxel(brick);
    VoxelCoord a, b;
    for (int i = 0; i < 3; ++i) {
      a[i] = std::max(low[i] - first[i], 0);
      b[i] = std::min(high[i] - first[i], kBrickEdge - 1);
    }
    const std::uint64_t row = (~std::uint64_t(0) << a.x) & (~std::uint64_t(0) >> (kBrickEdge - 1 - b.x));
    for (std::int32_t z = a.z; z <= b.z; ++z) {
      for (std::int32_t y = a.y; y <= b.y; ++y) {
        const std::size_t at = std::size_t(z) * kBrickEdge + std::size_t(y);
        if ((~(*bits)[at] & row) != 0) return false;
      }
    }
    return true;
  }

  std::int64_t edge_ = kLatticePerVoxel;  // edge of its voxels, lattice units
  Bricks bricks_;
};

/// The mask for a distance, which may not be made yet.
struct NearMasks::Entry {
  double distance = 0;
  std::mutex making;
  std::unique_ptr<const Mask> owner;
  std::atomic<const Mask*> mask{nullptr};  // null until it is whole
  Entry* next = nullptr;
};

NearMasks::~NearMasks() {
  for (Entry* entry = entries_; entry != nullptr;) delete std::exchange(entry, entry->next);
}

NearMasks::Entry& NearMasks::entry(double distance) const {
  const auto find = [&]() -> Entry* {
    Entry* entry = entries_.load(std::memory_order_acquire);
    while (entry != nullptr && entry->distance != distance) entry = entry->next;
    return entry;
  };
  if (Entry* known = find()) return *known;
  const std::lock_guard lock(adding_);
  if (Entry* known = find()) return *known;
  auto added = std::make_unique<Entry>();
  added->distance = distance;
  added->next = entries_.load(std::memory_order_relaxed);
  entries_.store(added.get(), std::memory_order_release);
  return *added.release();
}

const NearMasks::Mask& NearMasks::mask(double distance) const {
  Entry& entry = this->entry(distance);
  if (const Mask* made = entry.mask) return *made;
  const std::lock_guard lock(entry.making);
  if (!entry.owner) {
    isolated([&] { entry.owner = std::make_unique<Mask>(voxels_, distance); });
    entry.mask = entry.owner.get();
  }
  return *entry.owner;
}

bool NearMasks::is_near(std::span<const NewFace> faces, double distance) const {
  const Mask& mask = this->mask(distance);
  const auto is_set = [&](const LatticeCoord& p) {
    const VoxelCoord at = mask.voxel_of(p);
    return mask.holds(at, at);
  };
  return std::all_of(faces.begin(), faces.end(), [&](const NewFace& f) {  // far corners refuse most
    return std::all_of(f.corners.begin(), f.corners.end(), is_set) && mask.holds(f.corners);
  });
}

bool NearMasks::is_near(const LatticeCoord& a, const LatticeCoord& b, double distance) const {
  const Mask& mask = this->mask(distance);
  const auto is_set = [&](const LatticeCoord& p) {
    const VoxelCoord at = mask.voxel_of(p);
    return mask.holds(at, at);
  };
  return is_set(a) && is_set(b) && mask.holds(a, b);
}

std::uint64_t NearMasks::bytes_of_mask(const BrickShelf& voxels) {
  // A mask grows into bricks around those of the voxels, and has about kMostBricks at most.
  constexpr std::uint64_t kGrowth = 2;
  return std::min<std::uint64_t>(kGrowth * voxels.coords().size(), kMostBricks) * sizeof(BrickBits);
}

std::uint64_t NearMasks::bytes() const {
  std::uint64_t sum = 0;
  for (const Entry* entry = entries_; entry != nullptr; entry = entry->next) {
    const Mask* mask = entry->mask;
    sum += mask != nullptr ? mask->bytes() : 0;
  }
  return sum;
}

}  // namespace bp
