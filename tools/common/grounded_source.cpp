#include "tools/common/grounded_source.h"

namespace bp {

bool GroundedSource::read(std::vector<TriangleD>& out) {
  if (scene_->read(out)) {
    for (const TriangleD& t : out)
      for (const Vec3d& p : t) bounds_.add(p);
    return true;
  }
  if (ended_ || bounds_.empty()) return false;
  ended_ = true;
  const std::size_t height = up_.value_or(scene_->up().value_or(UpAxis::y)) == UpAxis::z ? 2 : 1;
  const std::size_t u = height == 2 ? 0 : 2, v = height == 2 ? 1 : 0;
  Vec3d a = bounds_.min, b = bounds_.min, c = bounds_.max, d = bounds_.min;
  c[height] = bounds_.min[height];
  b[u] = bounds_.max[u];
  d[v] = bounds_.max[v];
  out = {{a, b, c}, {a, c, d}};
  return true;
}

void GroundedSource::rewind() {
  scene_->rewind();
  bounds_ = {};
  ended_ = false;
}

}  // namespace bp
