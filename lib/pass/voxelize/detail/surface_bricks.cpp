#include "lib/pass/voxelize/detail/surface_bricks.h"

#include <algorithm>

#include "lib/grid/clip.h"
#include "lib/voxel/voxel_boxes.h"
#include "lib/voxel/voxelize_brick.h"

namespace bp {

namespace {

constexpr std::size_t kTogether = 256;  // triangles whose boxes are found at once: they stay in the first-level cache

bool is_longer_than_brick(const VoxelBox& box) {
  std::int64_t longest = 0;
  for (int axis = 0; axis < 3; ++axis) longest = std::max(longest, std::int64_t(box.max[axis]) - box.min[axis]);
  return longest > kBrickEdge;
}

}  // namespace

/// Remembers bricks that a thread has used lately: neighbours in a file are neighbours in space.
class SurfaceBricks::Finder {
 public:
  explicit Finder(SurfaceBricks& bricks) : bricks_(bricks) {}
  [[nodiscard]] BrickBits* operator()(BrickCoord c) {
    Slot& slot = slots_[std::size_t((c.x & 3) | (c.y & 3) << 2 | (c.z & 3) << 4)];
    if (slot.bits == nullptr || slot.coord != c) slot = {c, bricks_.find(c)};
    return slot.bits;
  }

 private:
  struct Slot {
    BrickCoord coord;
    BrickBits* bits = nullptr;
  };
  SurfaceBricks& bricks_;
  std::array<Slot, 64> slots_;  // one for each brick of a block of 4^3
};

void SurfaceBricks::add(std::span<const TriangleD> triangles, const GridFrame& frame, std::int64_t slack,
                        std::vector<FixedTriangle>& rest) {
  const FixedFrame to_fixed(frame);
  Finder find(*this);
  std::array<VoxelBox, kTogether> touched;
  for (std::size_t begin = 0; begin < triangles.size(); begin += kTogether) {
    const auto some = triangles.subspan(begin, std::min(kTogether, triangles.size() - begin));
    voxel_boxes(some, frame, slack, touched.data());
    for (std::size_t i = 0; i < some.size(); ++i) {
      if (!add(some[i], slack, touched[i], to_fixed, find)) rest.push_back(to_fixed(some[i]));
    }
  }
}

bool SurfaceBricks::add(const TriangleD& t, std::int64_t slack, const VoxelBox& touched, const FixedFrame& to_fixed,
                        Finder& find) {
  if (is_longer_than_brick(touched)) return false;
  const BrickBox at = bricks_of(touched);
  const bool one = at.volume() == 1;
  const VoxelCoord size = touched.size();
  const bool thin = int(size.x == 1) + int(size.y == 1) + int(size.z == 1) >= 2;
  for (BrickCoord c = at.min; c.z < at.max.z; ++c.z) {
    for (c.y = at.min.y; c.y < at.max.y; ++c.y) {
      for (c.x = at.min.x; c.x < at.max.x; ++c.x) {
        BrickBits* const bits = find(c);
        if (bits == nullptr) return false;
        SharedRows rows(c, *bits);
        const VoxelBox within = one ? touched : intersect(touched, rows.box());
        if (!settle_by_box(thin, within, rows)) voxelize_brick(to_fixed(t), slack, rows);
      }
    }
  }
  return true;
}

BrickBits* SurfaceBricks::find(BrickCoord c) {
  Shard& shard = shard_of(c);
  const std::lock_guard lock(shard.mutex);
  const auto at = shard.bricks.find(c);
  if (at != shard.bricks.end()) return at->second.get();
  if (count_.fetch_add(1) >= most_) {
    --count_;
    return nullptr;
  }
  return shard.bricks.emplace(c, std::make_unique<BrickBits>()).first->second.get();
}

std::vector<BrickCoord> SurfaceBricks::coords() const {
  std::vector<BrickCoord> all;
  for (const Shard& shard : shards_) {
    for (const auto& [coord, bits] : shard.bricks) {
      if (std::any_of(bits->begin(), bits->end(), [](std::uint64_t word) { return word != 0; })) all.push_back(coord);
    }
  }
  return all;
}

void SurfaceBricks::take(BitBox& out) {
  for_each_brick(out.box(), [&](BrickCoord c) {
    Shard& shard = shard_of(c);
    std::unique_ptr<BrickBits> bits;
    {
      const std::lock_guard lock(shard.mutex);
      const auto at = shard.bricks.find(c);
      if (at == shard.bricks.end()) return;
      bits = std::move(at->second);
      shard.bricks.erase(at);
      --count_;
    }
    const VoxelCoord first = first_voxel(c);
    const std::int32_t word = (first.x - out.box().min.x) / kBrickEdge;
    for (std::int32_t z = 0; z < kBrickEdge; ++z) {
      for (std::int32_t y = 0; y < kBrickEdge; ++y)
        out.row(first.y + y, first.z + z)[word] |= (*bits)[std::size_t(z * kBrickEdge + y)];
    }
  });
}

}  // namespace bp
