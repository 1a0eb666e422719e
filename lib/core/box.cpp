#include "lib/core/box.h"

#include <algorithm>
#include <cmath>

namespace bp {

double Bounds3d::diagonal() const {
  if (empty()) return 0;
  const double x = max[0] - min[0], y = max[1] - min[1], z = max[2] - min[2];
  return std::sqrt(x * x + y * y + z * z);
}

double Bounds3d::longest_side() const {
  double longest = 0;
  for (std::size_t i = 0; !empty() && i < 3; ++i) longest = std::max(longest, max[i] - min[i]);
  return longest;
}

}  // namespace bp
