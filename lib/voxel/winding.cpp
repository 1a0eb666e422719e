#include "lib/voxel/winding.h"

#include <algorithm>

#include "lib/voxel/column_crossings.h"

namespace bp {

namespace {

template <class EdgeInt, class PlaneInt>
void append_crossings(const Corners& t, const VoxelBox& tile, std::vector<Crossing>& out) {
  ColumnCrossings<EdgeInt, PlaneInt> crossings(t, tile);
  for (Crossing c{}; crossings.next(c);) out.push_back(c);
}

}  // namespace

void find_crossings(std::span<const FixedTriangle> triangles, const VoxelBox& tile, std::vector<Crossing>& out) {
  for (const FixedTriangle& triangle : triangles) {
    const Corners t(triangle);
    if (first_centre(t.low(0)) > last_centre(t.high(0)) || first_centre(t.low(1)) > last_centre(t.high(1))) continue;
    const std::int64_t extent = t.extent();
    if (extent <= kSmallExtent) {
      append_crossings<std::int64_t, std::int64_t>(t, tile, out);
    } else if (extent <= kMediumExtent) {
      append_crossings<std::int64_t, Int128>(t, tile, out);
    } else {
      append_crossings<Int128, Int128>(t, tile, out);
    }
  }
}

void add_crossings(std::span<const Crossing> crossings, const VoxelBox& tile, std::span<std::int32_t> numbers) {
  const std::size_t width = std::size_t(tile.size().x);
  for (const Crossing& c : crossings) numbers[c.x + c.y * width] += c.down != 0 ? 1 : -1;
}

void fill_winding(std::vector<Crossing>& crossings, const VoxelBox& tile, std::span<const std::uint64_t> skip,
                  std::span<std::int32_t> numbers, BitBox& bits) {
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) { return a.z < b.z; });
  const VoxelCoord size = tile.size();
  const std::size_t width = std::size_t(size.x), words = (width + 63) / 64;
  std::vector<std::uint64_t> inside(words * std::size_t(size.y), 0);
  const auto update = [&](std::size_t x, std::size_t y) {
    const std::uint64_t bit = std::uint64_t(1) << (x % 64);
    std::uint64_t& word = inside[y * words + x / 64];
    word = numbers[x + y * width] != 0 ? word | bit : word & ~bit;
  };
  for (std::size_t y = 0; y < std::size_t(size.y); ++y)
    for (std::size_t x = 0; x < width; ++x)
      if (numbers[x + y * width] != 0) update(x, y);
  std::size_t next = 0;
  const auto pass = [&](std::uint32_t z) {  // the crossings up to the centres of slice z
    for (; next < crossings.size() && crossings[next].z <= z; ++next) {
      const Crossing& c = crossings[next];
      numbers[c.x + c.y * width] += c.down != 0 ? 1 : -1;
      update(c.x, c.y);
    }
  };
  const std::size_t offset = std::size_t(tile.min.x - bits.box().min.x) / 64;
  for (std::int32_t z = 0; z < size.z; ++z) {
    pass(std::uint32_t(z));
    for (std::size_t y = 0; y < std::size_t(size.y); ++y) {
      std::uint64_t* row = bits.row(tile.min.y + std::int32_t(y), tile.min.z + z) + offset;
      for (std::size_t w = 0; w < words; ++w) {
        row[w] |= skip.empty() ? inside[y * words + w] : inside[y * words + w] & ~skip[y * words + w];
      }
    }
  }
  pass(std::uint32_t(size.z));
}

}  // namespace bp
