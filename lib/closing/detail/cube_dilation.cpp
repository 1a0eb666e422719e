// A windowed OR of width 2 r + 1. Along x it works by doubling: a word shifted by its own window width and ORed doubles
// the window. Along y and z, where whole words line up, it uses the block-wise prefixes and suffixes of van Herk (1992)
// and Gil and Werman (1993): three operations per word whatever the width.
#include "lib/closing/detail/cube_dilation.h"

#include <algorithm>
#include <cstring>

#include "lib/closing/detail/simd.h"

namespace bp::detail {

namespace {

// Words handled together along z, so that a window of them stays in the second-level cache.
constexpr std::size_t kChunk = 256;

/// Ors into `to` the row `from`, moved by `shift` voxels towards +x. Reads from[-shift / 64 - 1] on.
BP_CLONES void or_shifted(const std::uint64_t* from, std::uint64_t* to, std::int64_t n, std::int32_t shift) {
  const std::uint64_t* a = from - shift / 64;
  const int b = shift % 64;
  if (b == 0) {
    for (std::int64_t i = 0; i < n; ++i) to[i] = from[i] | a[i];
  } else {
    for (std::int64_t i = 0; i < n; ++i) to[i] = from[i] | (a[i] << b) | (a[i - 1] >> (64 - b));
  }
}

/// Sets `to` to the row `from`, moved by `shift` voxels towards -x. Reads up to from[n + shift / 64].
BP_CLONES void shift_down(const std::uint64_t* from, std::uint64_t* to, std::int64_t n, std::int32_t shift) {
  const std::uint64_t* a = from + shift / 64;
  const int b = shift % 64;
  if (b == 0) {
    for (std::int64_t i = 0; i < n; ++i) to[i] = a[i];
  } else {
    for (std::int64_t i = 0; i < n; ++i) to[i] = (a[i] >> b) | (a[i + 1] << (64 - b));
  }
}

/// out[t] = OR of in[t .. t + 2 r], t in [0, n), for vectors of `len` words that lie `in_step` and `out_step` apart.
/// `in` holds n + 2 r vectors and is overwritten; `prefix` has room for one vector.
BP_CLONES void window_or(std::uint64_t* in, std::size_t in_step, std::int64_t n, std::int32_t r, std::size_t len,
                         std::uint64_t* out, std::size_t out_step, std::uint64_t* prefix) {
  const std::int64_t width = 2 * std::int64_t(r) + 1, last = n + 2 * std::int64_t(r);
  for (std::int64_t block = 0; block < n; block += width) {
    for (std::int64_t t = std::min(block + width, last) - 2; t >= block; --t) {  // suffixes of this block
      std::uint64_t* v = in + std::size_t(t) * in_step;
      for (std::size_t i = 0; i < len; ++i) v[i] |= v[i + in_step];
    }
    std::memset(prefix, 0, len * sizeof(std::uint64_t));
    for (std::int64_t t = block; t < std::min(block + width, n); ++t) {  // with prefixes of the next
      if (t > block) {
        const std::uint64_t* v = in + std::size_t(t + width - 1) * in_step;
        for (std::size_t i = 0; i < len; ++i) prefix[i] |= v[i];
      }
      const std::uint64_t* v = in + std::size_t(t) * in_step;
      std::uint64_t* o = out + std::size_t(t) * out_step;
      for (std::size_t i = 0; i < len; ++i) o[i] = v[i] | prefix[i];
    }
  }
}

bool any(const std::uint64_t* words, std::int32_t n) {
  std::uint64_t all = 0;
  for (std::int32_t i = 0; i < n; ++i) all |= words[i];
  return all != 0;
}

}  // namespace

/// Dilates one slice in x and y, over the rows and words of `out`. If nothing is in reach, it returns false and `slice`
/// is zero.
bool CubeDilation::dilate_slice_xy(const BitBox& solid, std::int32_t z, std::int32_t r, const VoxelBox& out,
                                   std::uint64_t* slice) {
  const VoxelBox& in = solid.box();
  const std::int32_t height = out.max.y - out.min.y, words = (out.max.x - out.min.x) / 64, pad = (r + 63) / 64 + 1;
  const std::size_t slice_words = std::size_t(height) * std::size_t(words);
  const std::int32_t y0 = std::max(in.min.y, out.min.y - r), y1 = std::min(in.max.y, out.max.y + r);
  const VoxelBox reach{{out.min.x - 64 * pad, y0, z}, {out.max.x + 64 * pad, y1, z + 1}};
  const VoxelBox from = intersect(in, reach);
  bool found = false;
  if (!from.empty()) {
    // The line reaches `pad` words beyond `out` at both ends. `pad` zeros stand before it, since the shifts read them.
    const std::int32_t line = words + 2 * pad, first = (from.min.x - in.min.x) / 64,
                       count = (from.max.x - from.min.x) / 64, at = pad + (from.min.x - reach.min.x) / 64;
    line_a_.assign(std::size_t(line + 2 * pad), 0);
    line_b_.assign(std::size_t(line + 2 * pad), 0);
    rows_.assign(std::size_t(height + 2 * r) * std::size_t(words), 0);
    for (std::int32_t y = y0; y < y1; ++y) {
      const std::uint64_t* row = solid.row(y, z) + first;
      if (!any(row, count)) continue;
      found = true;
      std::fill_n(line_a_.data() + pad, line, 0);
      std::copy_n(row, count, line_a_.data() + at);
      std::uint64_t *a = line_a_.data() + pad, *b = line_b_.data() + pad;
      for (std::int32_t width = 1; width < 2 * r + 1;) {
        const std::int32_t shift = std::min(width, 2 * r + 1 - width);
        or_shifted(a, b, line, shift);
        std::swap(a, b);
        width += shift;
      }
      shift_down(a + pad, rows_.data() + std::size_t(y - (out.min.y - r)) * std::size_t(words), words, r);
    }
  }
  if (!found) {
    std::memset(slice, 0, slice_words * sizeof(std::uint64_t));
    return false;
  }
  prefix_.resize(std::max(std::size_t(words), kChunk));
  window_or(rows_.data(), std::size_t(words), height, r, std::size_t(words), slice, std::size_t(words), prefix_.data());
  return true;
}

void CubeDilation::run(const BitBox& solid, std::int32_t r, BitBox& out) {
  const VoxelBox& box = out.box();
  if (box.empty()) return;
  const std::int32_t depth = box.max.z - box.min.z;
  const std::size_t slice = std::size_t(out.word_count() / depth);
  slices_.resize(slice * std::size_t(depth + 2 * r));
  for (std::int32_t i = 0; i < depth + 2 * r; ++i)
    dilate_slice_xy(solid, box.min.z - r + i, r, box, slices_.data() + std::size_t(i) * slice);
  prefix_.resize(std::max(prefix_.size(), kChunk));
  for (std::size_t begin = 0; begin < slice; begin += kChunk) {
    window_or(slices_.data() + begin, slice, depth, r, std::min(kChunk, slice - begin), out.data() + begin, slice,
              prefix_.data());
  }
}

}  // namespace bp::detail
