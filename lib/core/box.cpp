#include "lib/core/box.h"

#include <cmath>

namespace bp {

double Bounds3d::diagonal() const {
  if (empty()) return 0;
  const double x = max[0] - min[0], y = max[1] - min[1], z = max[2] - min[2];
  return std::sqrt(x * x + y * y + z * z);
}

}  // namespace bp
