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

/// Returns a text about the rule that changes the scale last, among the rules that an entry became.
std::string entry_text(const ScalePlan& plan, std::size_t last, std::size_t boxes) {
  const std::string text = rule_text(plan.field.rules[last]);
  return boxes > 1 ? fmt::format("{}, one of {} boxes", text, boxes) : text;
}

}  // namespace

std::string explain_point(const ScalePlan& plan, const OrientationField& orientation, const StreamHeader& header,
                          const Vec3d& point) {
  const VoxelCoord voxel = voxel_of(header.frame, point);
  const VoxelBox one{voxel, {voxel.x + 1, voxel.y + 1, voxel.z + 1}};
  const double sampled = double(plan.field.sample(header.frame, one).at(voxel)) / kScaleOne;
  const std::vector<double> steps = plan.field.steps(point);
  std::string text = fmt::format("scale {:.6g}; in the closing {:.6g}, {:.6g} voxels\n", steps.back(),
                                 sampled * header.frame.voxel, sampled);
  text += fmt::format("{:.6g}  base\n", steps[0]);
  std::size_t next = 0, idle = 0;
  for (const RuleEntry& entry : plan.entries) {
    const std::size_t end = next + entry.rules;
    std::size_t last = end;
    for (std::size_t i = next; i < end; ++i) {
      if (steps[i + 1] != steps[i]) last = i;
    }
    if (last < end) text += fmt::format("{:.6g}  {}\n", steps[end], entry_text(plan, last, entry.rules));
    idle += last == end;
    next = end;
  }
  if (idle > 0) text += fmt::format("{} rule{} nothing here\n", idle, idle == 1 ? " changes" : "s change");
  if (!orientation.empty())
    text += "cube " + orientation_text(orientation.rotations[orientation.index_at(voxel)]) + "\n";
  return text;
}

}  // namespace bp
