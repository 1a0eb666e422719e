#include "lib/voxel/winding.h"

#include <algorithm>

#include "lib/voxel/overlap.h"

// Bounds of the integers, with E the triangle's extent. A column inside the triangle lies within E of each vertex.
//   edges: two products of E and E                        64 bits up to E = 2^30, else 128
//   height: normal (2 E^2) times E, three terms: 6 E^3    64 bits up to E = 2^20, 128 up to 2^41

namespace bp {

namespace {

constexpr std::int64_t kHalf = kFixedOne / 2;

/// First and last voxel whose centre lies in [low, high], along one axis.
std::int64_t first_centre(std::int64_t low) {
  return (low - kHalf + kFixedOne - 1) >> kFixedBits;
}
std::int64_t last_centre(std::int64_t high) {
  return (high - kHalf) >> kFixedBits;
}

/// Columns on the inner side of edge e of the projection along z, counted from (x, y).
template <class Int>
HalfSpace<Int> column_space(const Corners& t, int e, bool clockwise, std::int64_t x, std::int64_t y) {
  const std::int64_t* from = t.p[clockwise ? (e + 1) % 3 : e];
  const std::int64_t* to = t.p[clockwise ? e : (e + 1) % 3];
  const Int dx = to[0] - from[0], dy = to[1] - from[1];
  // (e, e^2) adds dx e^2 - dy e: that decides where the column stands on the edge's line.
  const bool on_line_is_inside = dy < 0 || (dy == 0 && dx > 0);
  HalfSpace<Int> h;
  h.at = dx * (y * kFixedOne + kHalf - from[1]) - dy * (x * kFixedOne + kHalf - from[0]) - (on_line_is_inside ? 0 : 1);
  h.step[0] = -dy * kFixedOne;
  h.step[1] = dx * kFixedOne;
  return h;
}

/// EdgeInt and PlaneInt hold the values of the bounds above.
template <class EdgeInt, class PlaneInt>
void cross(const Corners& t, const VoxelBox& tile, std::vector<Crossing>& out) {
  const PlaneInt normal[3] = {normal_component<PlaneInt>(t, 0), normal_component<PlaneInt>(t, 1),
                              normal_component<PlaneInt>(t, 2)};
  if (normal[2] == 0) return;
  const std::int64_t x0 = std::max<std::int64_t>(first_centre(t.low(0)), tile.min.x),
                     y0 = std::max<std::int64_t>(first_centre(t.low(1)), tile.min.y),
                     x1 = std::min<std::int64_t>(last_centre(t.high(0)), tile.max.x - 1),
                     y1 = std::min<std::int64_t>(last_centre(t.high(1)), tile.max.y - 1);
  if (x0 > x1 || y0 > y1) return;
  const bool clockwise = normal[2] < 0;
  HalfSpace<EdgeInt> edges[3];
  for (int e = 0; e < 3; ++e) edges[e] = column_space<EdgeInt>(t, e, clockwise, x0, y0);
  const PlaneInt half_step = (clockwise ? -normal[2] : normal[2]) * kHalf;
  for (std::int64_t y = y0; y <= y1; ++y) {
    std::int32_t first = 0, last = std::int32_t(x1 - x0);
    bool any = true;
    for (int e = 0; e < 3 && any; ++e) {
      any = clip(edges[e].value(0, std::int32_t(y - y0), 0), edges[e].step[0], first, last);
    }
    for (std::int32_t i = first; any && i <= last; ++i) {
      const std::int64_t x = x0 + i;
      // Height above corner a: -(nx dx + ny dy) / nz, exact; then in half voxels above the tile, rounded down and up.
      const std::int64_t dx = x * kFixedOne + kHalf - t.p[0][0], dy = y * kFixedOne + kHalf - t.p[0][1];
      PlaneInt above = -(normal[0] * dx + normal[1] * dy);
      if (clockwise) above = -above;
      // a.z = whole half voxels + rest keeps the products small.
      const std::int64_t a_half = t.p[0][2] >> (kFixedBits - 1), a_rest = t.p[0][2] & (kHalf - 1);
      const PlaneInt value = above + (clockwise ? -normal[2] : normal[2]) * a_rest;
      const PlaneInt down = floor_div(value, half_step);
      const std::int64_t below = a_half + std::int64_t(down);
      const std::int64_t up = below + (down * half_step == value ? 0 : 1);
      if ((below >> 1) < tile.min.z || (below >> 1) >= tile.max.z) continue;
      Crossing c{};
      c.x = std::uint32_t(x - tile.min.x) & 511;
      c.y = std::uint32_t(y - tile.min.y) & 511;
      c.z = std::uint32_t((up >> 1) - tile.min.z) & 1023;
      c.down = clockwise ? 1 : 0;
      out.push_back(c);
    }
  }
}

}  // namespace

void find_crossings(std::span<const FixedTriangle> triangles, const VoxelBox& tile, std::vector<Crossing>& out) {
  for (const FixedTriangle& triangle : triangles) {
    const Corners t(triangle);
    if (first_centre(t.low(0)) > last_centre(t.high(0)) || first_centre(t.low(1)) > last_centre(t.high(1))) continue;
    const std::int64_t extent = t.extent();
    if (extent <= kSmallExtent) {
      cross<std::int64_t, std::int64_t>(t, tile, out);
    } else if (extent <= kMediumExtent) {
      cross<std::int64_t, Int128>(t, tile, out);
    } else {
      cross<Int128, Int128>(t, tile, out);
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
