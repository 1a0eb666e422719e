#include "lib/pass/mesh/detail/scaled_edges.h"

#include <cmath>
#include <map>
#include <memory>
#include <mutex>

#include "lib/core/vec3.h"

namespace bp {

namespace {

/// The rules of a field that matter for an edge: a field may have thousands, and few of them are near.
class NearRules {
 public:
  NearRules(const ScaleField& field, double block) : field_(field), block_(block) {}

  /// Evaluates as the field does, all along the edge.
  [[nodiscard]] std::shared_ptr<const ScaleField> along(const Vec3d& a, const Vec3d& b) {
    if (field_.rules.size() < kFewRules || length(b - a) > 2 * block_) return {std::shared_ptr<void>(), &field_};
    const Vec3d middle = 0.5 * (a + b);
    Block at{};
    Vec3d centre{};
    for (std::size_t i = 0; i < 3; ++i) {
      at[i] = std::int64_t(std::floor(middle[i] / block_));
      centre[i] = (double(at[i]) + 0.5) * block_;
    }
    const std::lock_guard lock(mutex_);
    if (blocks_.size() > kMostBlocks) blocks_.clear();
    std::shared_ptr<const ScaleField>& found = blocks_[at];
    if (!found) found = std::make_shared<ScaleField>(field_.near(centre, 2 * block_));
    return found;
  }

 private:
  using Block = std::array<std::int64_t, 3>;
  static constexpr std::size_t kFewRules = 8, kMostBlocks = 1024;
  const ScaleField& field_;
  const double block_;  // side, scene units
  std::mutex mutex_;
  std::map<Block, std::shared_ptr<const ScaleField>> blocks_;
};

}  // namespace

EdgeLimit scaled_edges(const ScaleField& scale, const GridFrame& frame, double factor) {
  constexpr double kBlock = 64;  // voxels
  const auto rules = std::make_shared<NearRules>(scale, kBlock * frame.voxel);
  return [rules, &frame, factor](const LatticeCoord& a, const LatticeCoord& b) {
    const double edge = length(to_double(b - a));
    if (edge <= 2 * kLatticePerVoxel) return true;
    const Vec3d from = frame.world(a), to = frame.world(b);
    return rules->along(from, to)->reaches_along(from, to, edge / kLatticePerVoxel * frame.voxel / factor, frame.voxel);
  };
}

}  // namespace bp
