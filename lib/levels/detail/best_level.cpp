#include "lib/levels/detail/best_level.h"

#include <cmath>
#include <utility>

#include "lib/levels/detail/voxel_distance.h"
#include "lib/pass/mesh/mesh_measures.h"

namespace bp {

// Two measurements may differ by their tolerances.
double BestLevel::unseen() const {
  return 2 * kTriangleTolerance * ruler_.voxel();
}

/// Returns the factor by which the price multiplies the error: the volume with its skin; 1 for fits.
double BestLevel::weight(const LodLevel& level) const {
  return mode_ == MeshMode::fit ? 1 : volume_of(level) + unseen() * area_world(level.mesh);
}

/// Returns the largest error with which the level would be better than the best one so far; negative: it cannot be
/// better.
double BestLevel::most_error(const LodLevel& level) const {
  if (!level_) return HUGE_VAL;
  if (level.reached != level_->reached) return level.reached ? HUGE_VAL : -1;
  return level_->price / weight(level) - unseen();
}

bool BestLevel::propose(const char* way, LodLevel level) {
  level.reached = faces_ == 0 || level.mesh.triangles.size() <= faces_;
  const double most = most_error(level);
  std::optional<double> error;
  if (most >= 0) error = ruler_.error(level.mesh, most);
  const bool is_better = error && (!level_ || *error < most);
  note(way, level, error.value_or(std::nan("")));
  if (is_better) keep(std::move(level), *error);
  return is_better;
}

bool BestLevel::propose_exact(const char* way, const LodLevel& level) {
  const std::optional<double> error = ruler_.error(level.mesh, unseen());
  if (!error || *error > unseen()) return false;
  note(way, level, *error);
  keep(level, *error);
  return true;
}

void BestLevel::note(const char* way, const LodLevel& level, double error) {
  tried_.push_back({way, level.scale_world, level.mesh.triangles.size(), volume_of(level), error});
}

void BestLevel::keep(LodLevel level, double error) {
  level_ = std::move(level);
  level_->error_world = error;
  level_->price = (error + unseen()) * weight(*level_);
}

LodLevel BestLevel::take() {
  level_->tried = std::move(tried_);
  return std::move(*level_);
}

}  // namespace bp
