#include "lib/levels/lod_target.h"

#include <algorithm>
#include <cmath>

#include "lib/volume/boundary_runs.h"

namespace bp {

namespace {

constexpr double kLeastSideVox = 48;  // the longest side of a reduced grid has more

/// Returns the edge of `faces` equilateral triangles that together have the area of the scene's surface.
double edge_of(const LodGround& ground, std::uint64_t faces) {
  const double area = double(ground.dense_faces) / kDensePerArea * ground.voxel * ground.voxel;
  return std::sqrt(4 / std::sqrt(3.0) * area / double(faces));
}

}  // namespace

double first_scale(const LodGround& ground, const LodTarget& target, double least) {
  if (target.scale_world) return std::max(*target.scale_world, least);
  double scale = ground.diagonal;
  if (target.faces > 0) scale = std::min(scale, edge_of(ground, target.faces) / kScalesPerLength);
  if (target.error_world > 0) scale = std::min(scale, target.error_world / kScalesPerLength);
  return std::max({scale, least, kLeastScaleVox * ground.voxel});
}

int reductions_for(const LodGround& ground, const LodTarget& target, double scale, int before) {
  if (target.keep_voxels) return before;
  double coarsest = std::min(scale / kLeastScaleVox, double(ground.longest_side_vox) / kLeastSideVox * ground.voxel);
  if (target.faces > 0) {
    const double per_face = double(ground.dense_faces) / double(target.faces);
    coarsest = std::min(coarsest, std::sqrt(per_face / double(kDensePerFace)) * ground.voxel);
    coarsest = std::min(coarsest, std::sqrt(double(ground.dense_faces) / kLeastDenseFaces) * ground.voxel);
  }
  if (target.error_world > 0) coarsest = std::min(coarsest, target.error_world / kVoxelsPerLength);
  int n = before;
  while (ground.voxel * std::ldexp(1.0, n + 1) <= coarsest) ++n;
  return n;
}

double finest_scale(const std::optional<ScalePlan>& plan, double scale) {
  if (!plan) return scale;
  const ScaleField& field = plan->field;
  double least = field.base;
  for (const ScaleRule& rule : field.rules) {
    if (rule.shape != ScaleShape::view && rule.mode != ScaleMode::erase) least = std::min(least, rule.scale);
  }
  least *= scale / field.base;
  for (const RuleEntry& entry : plan->entries) {
    if (entry.shape) least = std::min(least, entry.shape->length / kVoxelsPerLength);
  }
  return least;
}

}  // namespace bp
