#include "tools/scale/explain.h"

#include <fmt/format.h>

#include <cmath>

#include "lib/core/error.h"
#include "tools/notes/scale_notes.h"
#include "tools/scale/orientation_rules.h"

namespace bp {

namespace {

VoxelCoord voxel_of(const GridFrame& frame, const Vec3d& point) {
  constexpr double kFar = 1 << 30;
  const Vec3d at = frame.to_voxels(point);
  VoxelCoord voxel;
  for (int i = 0; i < 3; ++i) {
    const double v = std::floor(at[std::size_t(i)]);
    if (!(std::abs(v) < kFar)) fail(ErrorCode::bad_argument, "the point is too far from the grid");
    voxel[i] = std::int32_t(v);
  }
  return voxel;
}

}  // namespace

std::string explain_point(const ScaleField& field, const OrientationField& orientation, const StreamHeader& header,
                          const Vec3d& point) {
  const VoxelCoord voxel = voxel_of(header.frame, point);
  const VoxelBox one{voxel, {voxel.x + 1, voxel.y + 1, voxel.z + 1}};
  const double sampled = double(field.sample(header.frame, one).at(voxel)) / kScaleOne;
  const std::vector<double> steps = field.steps(point);
  std::string text = fmt::format("scale {:.6g}; in the closing {:.6g}, {:.6g} voxels\n", steps.back(),
                                 sampled * header.frame.voxel, sampled);
  text += fmt::format("{:.6g}  base\n", steps[0]);
  std::size_t idle = 0;
  for (std::size_t i = 0; i < field.rules.size(); ++i) {
    const ScaleRule& rule = field.rules[i];
    if (steps[i + 1] == steps[i]) {
      ++idle;
      continue;
    }
    text += fmt::format("{:.6g}  {}\n", steps[i + 1], rule_text(rule));
  }
  if (idle > 0) text += fmt::format("{} rule{} nothing here\n", idle, idle == 1 ? " changes" : "s change");
  if (!orientation.empty())
    text += "cube " + orientation_text(orientation.rotations[orientation.index_at(voxel)]) + "\n";
  return text;
}

}  // namespace bp
