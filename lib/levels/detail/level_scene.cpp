#include "lib/levels/detail/level_scene.h"

#include <algorithm>
#include <utility>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/enclosed/enclosed_triangles.h"
#include "lib/pass/mesh/mesh_measures.h"
#include "lib/pass/mesh/outward_scene.h"
#include "lib/pass/mesh/scene_check.h"

namespace bp {

LevelScene::LevelScene(const StreamHeader& header, std::unique_ptr<BrickShelf> solid, Backends& backends, LodOptions o)
    : options_(std::move(o)),
      all_(options_.context),
      bounds_(header.bounds),
      voxels_(header, std::move(solid), backends, options_) {
  take_off(options_.scene.size() * sizeof(TriangleD));
  const BrickShelf& voxels = *voxels_.reduced(0).shelf;
  // The scene is checked here, and not at each level, whose voxels may be larger.
  if (is_bounding() && options_.enclose == Enclose::scene && !options_.is_within)
    require_within(options_.scene, options_.rounding, header.frame, voxels);
  naming_limit([&] { make_ruler(); }, [&] { return all_steps_limit(); });
  options_.surface.reset();
  take_off(ruler_->bytes());
}

void LevelScene::make_ruler() {
  const LevelVoxels::Solid& solid = voxels_.reduced(0);
  const std::vector<TriangleD>* const triangles = has_triangles() ? &options_.scene : nullptr;
  ruler_.emplace(RulerScene{*solid.shelf, options_.surface.get(), triangles, solid.header.frame, options_.mode},
                 context().memory);
}

void LevelScene::take_off(std::uint64_t bytes) {
  PassContext& context = options_.context;
  context.memory.bytes -= std::min(context.memory.bytes, bytes);
  context.pieces = context.pieces.without(bytes);
}

std::uint64_t LevelScene::all_steps_limit() {
  const LevelVoxels::Solid& solid = voxels_.reduced(0);
  return chain_limit(solid.header, *solid.shelf, options_, all_, options_.scene.size());
}

std::uint64_t LevelScene::bytes_of_level(std::uint64_t faces) const {
  const std::uint64_t triangles = has_triangles() ? options_.scene.size() : 0;
  const std::uint64_t each = is_bounding() ? EnclosedTriangles::kBytesEach : kBytesOfFit;
  return faces * kWorkPerFace + triangles * each + ruler_->bytes_of_measure();
}

LodGround LevelScene::ground() const {
  const VoxelCoord size = ruler_->box.size();
  return {ruler_->voxel(), bounds_.diagonal(), ruler_->dense_faces, std::max({size.x, size.y, size.z})};
}

std::shared_ptr<const Enclosed> LevelScene::enclosed(const LevelVoxels::Solid& solid) {
  const std::lock_guard lock(mutex_);
  std::weak_ptr<const Enclosed>& place = enclosed_[solid.reductions];
  if (std::shared_ptr<const Enclosed> made = place.lock()) return made;
  kept_.reset();
  std::shared_ptr<const Enclosed> made;
  isolated([&] { made = enclosed_scene(options_.scene, options_.rounding, solid.header, *solid.shelf); });
  place = made;
  if (made->bytes() <= context().memory.bytes / kSmallShare) kept_ = made;
  return made;
}

std::optional<LevelStart> LevelScene::own_surface() {
  // For a scene of more triangles than the voxels' surface, the latter leads to the level faster.
  if (!has_triangles() || options_.field || options_.scene.size() > ruler_->dense_faces) return std::nullopt;
  const StreamHeader& header = voxels_.reduced(0).header;
  std::optional<LatticeMesh> surface = outward_scene(options_.scene, options_.rounding, header.frame);
  if (!surface) return std::nullopt;
  surface->provenance = header.provenance;
  const MeshMeasures measures = measure(*surface);
  return LevelStart{std::move(*surface), 0, measures.shells + measures.handles, 0};
}

}  // namespace bp
