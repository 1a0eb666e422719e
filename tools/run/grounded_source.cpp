#include "tools/run/grounded_source.h"

#include <array>

#include "lib/core/up_axis.h"

namespace bp {

bool GroundedSource::read(std::vector<TriangleD>& out) {
  if (scene_->read(out)) {
    for (const TriangleD& t : out)
      for (const Vec3d& p : t) bounds_.add(p);
    return true;
  }
  if (ended_ || bounds_.empty()) return false;
  ended_ = true;
  // The rectangle has the least y in axes whose y points up, and the extent of the scene as seen from above.
  const AxisTurn turn = to_y_up(up_.value_or(scene_->up().value_or(UpAxis::y)));
  Bounds3d upright;
  for (const Vec3d& p : {bounds_.min, bounds_.max}) upright.add(turn(p));
  const Vec3d &lo = upright.min, &hi = upright.max;
  const Vec3d corners[] = {lo, {lo[0], lo[1], hi[2]}, {hi[0], lo[1], hi[2]}, {hi[0], lo[1], lo[2]}};
  std::array<Vec3d, 4> q;
  for (std::size_t i = 0; i < 4; ++i) q[i] = turn.inverse()(corners[i]);
  out = {{q[0], q[1], q[2]}, {q[0], q[2], q[3]}};
  return true;
}

void GroundedSource::rewind() {
  scene_->rewind();
  bounds_ = {};
  ended_ = false;
}

}  // namespace bp
