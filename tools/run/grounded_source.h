#pragma once
#include <memory>

#include "lib/core/box.h"
#include "lib/core/triangle_source.h"

namespace bp {

/// A scene on the ground: its own triangles, then two that cover the rectangle below it, at its lowest point, within
/// its bounds. `up`: the axis; empty: what the scene tells, else y.
class GroundedSource final : public TriangleSource {
 public:
  GroundedSource(std::unique_ptr<TriangleSource> scene, std::optional<UpAxis> up) : scene_(std::move(scene)), up_(up) {}
  bool read(std::vector<TriangleD>& out) override;
  void rewind() override;
  [[nodiscard]] const SceneCounts& counts() const override { return scene_->counts(); }
  [[nodiscard]] std::string name() const override { return scene_->name(); }
  [[nodiscard]] std::optional<UpAxis> up() const override { return scene_->up(); }

 private:
  std::unique_ptr<TriangleSource> scene_;
  std::optional<UpAxis> up_;
  Bounds3d bounds_;
  bool ended_ = false;
};

}  // namespace bp
