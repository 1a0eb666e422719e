#include "lib/live/detail/blurred_box.h"

namespace bp {

namespace {

constexpr std::ptrdiff_t kRow = BlurredBox::kSide, kSlice = kRow * BlurredBox::kSide, kAll = kSlice * BlurredBox::kSide;
/// Box filters of reach 2, 2 and 1 along each axis come near to a Gaussian of 2 voxels.
constexpr std::array kReaches{2, 2, 1};
constexpr int kSum = 75;  // sum of the weights along one axis: 5 * 5 * 3
/// Values are shifted after two axes, so that the third keeps within 16 bits. That halves the memory, and doubles the
/// values of a vector.
constexpr int kShift = 3;
constexpr float kWeight = 1.0F / float(((kSum * kSum) >> kShift) * kSum);
static_assert(((kSum * kSum) >> kShift) * kSum < 1 << 16);

}  // namespace

/// Sums 2 reach + 1 values along an axis, three times. Values within a reach of the ends of the box are left over from
/// before; they reach no corner of the brick. Rows run into each other, so that the compiler makes vectors of the loop.
void BlurredBox::blur_along(std::ptrdiff_t stride) {
  for (const int reach : kReaches) {
    const std::ptrdiff_t edge = stride * reach, far = stride * (reach - 1);  // far is 0 for a reach of 1
    const std::uint16_t* const from = values_.data();
    std::uint16_t* const to = other_.data();
    if (reach == 1) {
      for (std::ptrdiff_t i = edge; i < kAll - edge; ++i) to[i] = from[i] + from[i - edge] + from[i + edge];
    } else {
      for (std::ptrdiff_t i = edge; i < kAll - edge; ++i)
        to[i] = from[i] + from[i - far] + from[i + far] + from[i - edge] + from[i + edge];
    }
    values_.swap(other_);
  }
}

void BlurredBox::reset(const BitBox& solid, VoxelCoord first) {
  values_.resize(std::size_t(kAll));
  other_.resize(std::size_t(kAll));
  for (int z = 0; z < kSide; ++z) {
    for (int y = 0; y < kSide; ++y) {
      const std::uint64_t* const row = solid.row(first.y + y - kApron, first.z + z - kApron);
      const std::int32_t x0 = first.x - kApron - solid.box().min.x;
      std::uint16_t* const out = values_.data() + z * kSlice + y * kRow;
      for (int x = 0; x < kSide; ++x) out[x] = std::uint16_t((row[(x0 + x) >> 6] >> ((x0 + x) & 63)) & 1);
    }
  }
  blur_along(1);
  blur_along(kRow);
  for (std::uint16_t& value : values_) value = std::uint16_t(value >> kShift);
  blur_along(kSlice);
}

BlurredBox::Level BlurredBox::at(int x, int y, int z) const {
  const std::uint16_t* const p = values_.data() + (z + kApron) * kSlice + (y + kApron) * kRow + x + kApron;
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
