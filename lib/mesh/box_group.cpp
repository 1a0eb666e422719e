#include "lib/mesh/box_group.h"

namespace bp {

bool BoxGroup::grow(std::uint32_t k, const SmallBox& b) {
  SmallBox grown = box(k);
  bool inside = true;
  for (std::size_t i = 0; i < 3; ++i) {
    inside &= grown.min[i] <= b.min[i] && b.max[i] <= grown.max[i];
    grown.min[i] = std::min(grown.min[i], b.min[i]);
    grown.max[i] = std::max(grown.max[i], b.max[i]);
  }
  if (!inside) set(k, grown);
  return !inside;
}

SmallBox BoxGroup::around() const {
  SmallBox around = box(0);
  for (std::uint32_t k = 1; k < kWidth; ++k) {
    const SmallBox b = box(k);
    for (std::size_t i = 0; i < 3; ++i) {
      around.min[i] = std::min(around.min[i], b.min[i]);
      around.max[i] = std::max(around.max[i], b.max[i]);
    }
  }
  return around;
}

}  // namespace bp
