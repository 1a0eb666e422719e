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
  /// least, most: sides of blocks, scene units.
  NearRules(const ScaleField& field, double least, double most) : field_(field), least_(least), most_(most) {}

  /// Evaluates as the field does, all along the edge.
  [[nodiscard]] std::shared_ptr<const ScaleField> along(const Vec3d& a, const Vec3d& b) {
    const double edge = length(b - a);
    if (field_.rules.size() < kFewRules || edge > 2 * most_) return {std::shared_ptr<void>(), &field_};
    double side = least_;
    while (edge > 2 * side) side *= 2;
    const Vec3d middle = 0.5 * (a + b);
    Block at{side};
    Vec3d centre{};
    for (std::size_t i = 0; i < 3; ++i) {
      at[i + 1] = std::floor(middle[i] / side);
      centre[i] = (at[i + 1] + 0.5) * side;
    }
    const std::lock_guard lock(mutex_);
    if (blocks_.size() > kMostBlocks) blocks_.clear();
    std::shared_ptr<const ScaleField>& found = blocks_[at];
    if (!found) found = std::make_shared<ScaleField>(field_.near(centre, 2 * side));
    return found;
  }

 private:
  using Block = std::array<double, 4>;  // its side, and its place in sides
  static constexpr std::size_t kFewRules = 8, kMostBlocks = 4096;
  const ScaleField& field_;
  const double least_, most_;
  std::mutex mutex_;
  std::map<Block, std::shared_ptr<const ScaleField>> blocks_;
};

}  // namespace

EdgeLimit scaled_edges(const ScaleField& scale, const GridFrame& frame, double factor) {
  constexpr double kLeast = 4, kMost = 64;  // voxels
  const auto rules = std::make_shared<NearRules>(scale, kLeast * frame.voxel, kMost * frame.voxel);
  return [rules, &frame, factor](const LatticeCoord& a, const LatticeCoord& b) {
    const double edge = length(to_double(b - a));
    if (edge <= 2 * kLatticePerVoxel) return true;
    const Vec3d from = frame.world(a), to = frame.world(b);
    return rules->along(from, to)->reaches_along(from, to, edge / kLatticePerVoxel * frame.voxel / factor, frame.voxel);
  };
}

}  // namespace bp
