#include "lib/live/detail/blurred_box.h"

namespace bp {

namespace {

constexpr std::ptrdiff_t kRow = BlurredBox::kSide, kSlice = kRow * BlurredBox::kSide, kAll = kSlice * BlurredBox::kSide;
/// Box filters of reach 2, 2 and 1 along each axis: nearly a Gaussian of 2 voxels.
constexpr std::array kReaches{2, 2, 1};
constexpr float kWeight = 1.0F / (75.0F * 75.0F * 75.0F);

}  // namespace

/// Sums of 2 reach + 1 values along an axis; what lies beyond the box counts as empty, and reaches no corner of the
/// brick. One pass over memory for each value of the filter, so that the compiler makes vectors of it.
void BlurredBox::blur_rows(std::ptrdiff_t stride, int reach) {
  const std::ptrdiff_t edge = stride * reach;
  other_ = values_;
  for (int step = 1; step <= reach; ++step) {
    const std::ptrdiff_t by = stride * step;
    const std::int32_t* const from = values_.data();
    std::int32_t* const to = other_.data();
    for (std::ptrdiff_t i = edge; i < kAll - edge; ++i) to[i] += from[i - by] + from[i + by];
  }
  values_.swap(other_);
}

void BlurredBox::reset(const BitBox& solid, VoxelCoord first) {
  values_.assign(std::size_t(kAll), 0);
  for (int z = 0; z < kSide; ++z) {
    for (int y = 0; y < kSide; ++y) {
      const std::uint64_t* const row = solid.row(first.y + y - kApron, first.z + z - kApron);
      const std::int32_t x0 = first.x - kApron - solid.box().min.x;
      std::int32_t* const out = values_.data() + z * kSlice + y * kRow;
      for (int x = 0; x < kSide; ++x) out[x] = std::int32_t((row[(x0 + x) >> 6] >> ((x0 + x) & 63)) & 1);
    }
  }
  for (const std::ptrdiff_t stride : {std::ptrdiff_t(1), kRow, kSlice}) {
    for (const int reach : kReaches) blur_rows(stride, reach);
  }
}

BlurredBox::Level BlurredBox::at(int x, int y, int z) const {
  const std::int32_t* const p = values_.data() + (z + kApron) * kSlice + (y + kApron) * kRow + x + kApron;
  float corner[2][2][2];
  for (int k = 0; k < 2; ++k) {
    for (int j = 0; j < 2; ++j) {
      for (int i = 0; i < 2; ++i) corner[k][j][i] = float(p[(k - 1) * kSlice + (j - 1) * kRow + i - 1]) * kWeight;
    }
  }
  Level level{0, {0, 0, 0}};
  for (int k = 0; k < 2; ++k) {
    for (int j = 0; j < 2; ++j) {
      for (int i = 0; i < 2; ++i) {
        const float v = corner[k][j][i] / 8;
        level.value += v;
        level.gradient[0] += i == 1 ? 2 * v : -2 * v;
        level.gradient[1] += j == 1 ? 2 * v : -2 * v;
        level.gradient[2] += k == 1 ? 2 * v : -2 * v;
      }
    }
  }
  return level;
}

}  // namespace bp
