#include "lib/closing/detail/halves.h"

#include <algorithm>
#include <vector>

#include "lib/closing/detail/rows.h"
#include "lib/core/clones.h"

namespace bp::detail {

namespace {

/// Joins bits 2 i and 2 i + 1 by OR into bit i.
BP_INLINE std::uint64_t pairs(std::uint64_t w) {
  w = (w | w >> 1) & 0x5555555555555555;
  w = (w | w >> 1) & 0x3333333333333333;
  w = (w | w >> 2) & 0x0f0f0f0f0f0f0f0f;
  w = (w | w >> 4) & 0x00ff00ff00ff00ff;
  w = (w | w >> 8) & 0x0000ffff0000ffff;
  return (w | w >> 16) & 0xffffffff;
}

/// Copies bit i to bits 2 i and 2 i + 1.
BP_INLINE std::uint64_t doubled(std::uint64_t w) {
  w = (w | w << 16) & 0x0000ffff0000ffff;
  w = (w | w << 8) & 0x00ff00ff00ff00ff;
  w = (w | w << 4) & 0x0f0f0f0f0f0f0f0f;
  w = (w | w << 2) & 0x3333333333333333;
  w = (w | w << 1) & 0x5555555555555555;
  return w | w << 1;
}

BP_CLONES void join_pairs(const std::uint64_t* words, std::size_t n, std::uint64_t* to) {
  for (std::size_t i = 0; i < n; ++i) to[i] = pairs(words[2 * i]) | pairs(words[2 * i + 1]) << 32;
}
BP_CLONES void split_pairs(const std::uint64_t* words, std::size_t n, std::uint64_t* to) {
  for (std::size_t i = 0; i < n; ++i) {
    to[2 * i] = doubled(words[i] & 0xffffffff);
    to[2 * i + 1] = doubled(words[i] >> 32);
  }
}

}  // namespace

void halve(const BitBox& from, BitBox& to) {
  const VoxelBox &small = from.box(), &large = to.box();
  const auto words = std::size_t(to.words_per_row());
  std::vector<std::uint64_t> line(2 * words);
  const std::int32_t x0 = 2 * large.min.x, first = std::max(small.min.x, x0),
                     last = std::min(small.max.x, 2 * large.max.x);
  const auto place = std::ptrdiff_t(first - x0) / 64, skipped = std::ptrdiff_t(first - small.min.x) / 64,
             count = std::ptrdiff_t(last - first) / 64;
  for_each_row(large, [&](std::int32_t y, std::int32_t z) {
    std::fill(line.begin(), line.end(), 0);
    for (int i = 0; i < 4 && count > 0; ++i) {
      const std::int32_t sy = 2 * y + i % 2, sz = 2 * z + i / 2;
      if (sy < small.min.y || sy >= small.max.y || sz < small.min.z || sz >= small.max.z) continue;
      const std::uint64_t* row = from.row(sy, sz) + skipped;
      for (std::ptrdiff_t k = 0; k < count; ++k) line[std::size_t(place + k)] |= row[k];
    }
    join_pairs(line.data(), words, to.row(y, z));
  });
}

void double_up(const BitBox& from, BitBox& to) {
  const VoxelBox &large = from.box(), &small = to.box();
  std::vector<std::uint64_t> line(2 * std::size_t(from.words_per_row()));
  const auto skipped = std::ptrdiff_t(small.min.x - 2 * large.min.x) / 64;
  for_each_row(halved(small), [&](std::int32_t y, std::int32_t z) {
    split_pairs(from.row(y, z), std::size_t(from.words_per_row()), line.data());
    for (int i = 0; i < 4; ++i) {
      const std::int32_t sy = 2 * y + i % 2, sz = 2 * z + i / 2;
      if (sy < small.min.y || sy >= small.max.y || sz < small.min.z || sz >= small.max.z) continue;
      std::copy_n(line.data() + skipped, to.words_per_row(), to.row(sy, sz));
    }
  });
}

}  // namespace bp::detail
