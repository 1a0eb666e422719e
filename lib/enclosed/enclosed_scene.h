#pragma once
#include <memory>
#include <optional>
#include <utility>

#include "lib/enclosed/enclosed_triangles.h"
#include "lib/enclosed/enclosed_voxels.h"
#include "lib/enclosed/near_triangles.h"
#include "lib/enclosed/scene_part.h"

namespace bp {

/// The triangles of a scene, which stay inside exactly. is_near() asks the scene's voxels, or `near` if there are few
/// triangles: a guess is enough, and quick.
class EnclosedScene final : public EnclosedTriangles {
 public:
  /// `voxels`: the scene's voxels in `frame`. `part`: encloses only a part of the scene. `near`: answers is_near() in
  /// place of the voxels; may be null.
  EnclosedScene(std::vector<TriangleD> triangles, const GridFrame& frame, const BrickShelf& voxels,
                const std::optional<ScenePart>& part, std::unique_ptr<const NearTriangles> near,
                const Rounding& rounding = {})
      : EnclosedTriangles(std::move(triangles), frame, part ? std::optional(part->box) : std::nullopt, rounding),
        near_(std::move(near)) {
    if (!near_) voxels_.emplace(voxels);
    if (part && !part->voxels->coords().empty()) held_.emplace(*part->voxels);
  }
  [[nodiscard]] bool allows(std::span<const NewFace> star, std::span<const Tetrahedron> swept,
                            Blocker* blocker) const override {
    return EnclosedTriangles::allows(star, swept, blocker) && (!held_ || held_->allows(star, swept, blocker));
  }
  [[nodiscard]] std::vector<Vec3d> contact_points(const LatticeCoord& origin, const LatticeBox& within) const override {
    std::vector<Vec3d> points = EnclosedTriangles::contact_points(origin, within);
    if (!held_) return points;
    const std::vector<Vec3d> more = held_->contact_points(origin, within);
    points.insert(points.end(), more.begin(), more.end());
    return points;
  }
  [[nodiscard]] bool is_near(std::span<const NewFace> faces, double distance) const override {
    return near_ ? near_->is_near(faces, distance) : voxels_->is_near(faces, distance);
  }
  void expect_near(double distance) const override {
    if (voxels_) voxels_->prepare(distance);
  }
  [[nodiscard]] std::uint64_t bytes() const override {
    const auto of = [](const auto& one) { return one ? one->bytes() : 0; };
    return EnclosedTriangles::bytes() + of(near_) + of(voxels_) + of(held_);
  }

 private:
  std::unique_ptr<const NearTriangles> near_;
  std::optional<NearMasks> voxels_;  // none if `near` answers is_near()
  std::optional<EnclosedVoxels> held_;
};

}  // namespace bp
