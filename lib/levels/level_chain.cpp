#include "lib/levels/level_chain.h"

#include <algorithm>
#include <cmath>

namespace bp {

namespace {

/// Whether there are clearly fewer faces than the level's budget: its voxels, or its scale, show no more.
bool falls_short(const LodLevel& level, const LodTarget& target) {
  return clearly_fewer(level.mesh.triangles.size(), target.faces);
}

/// Faces of a level that follow from a first one which fell short.
std::uint64_t following(const LodLevel& first, std::size_t steps) {
  const std::uint64_t faces = first.mesh.triangles.size();
  return std::max(steps < 32 ? faces >> (2 * steps) : 0, kLeastFaces);
}

/// Whether a level is worth having after the one before.
bool is_coarser(const LodLevel& level, const LodLevel& before, double diagonal) {
  if (level.mesh.triangles.size() >= before.mesh.triangles.size()) return false;
  return !(level.error_world > diagonal);  // beyond it, the scene is a point where the level would be drawn
}

}  // namespace

void put_solid(VoxelizedScene& scene, std::unique_ptr<BrickShelf> solid) {
  scene.solid = std::move(solid);
  for (const BrickCoord& c : scene.solid->coords())
    scene.header.bricks = hull(scene.header.bricks, BrickBox{c, {c.x + 1, c.y + 1, c.z + 1}});
}

LevelFacts facts_of(const LodLevel& level, const LodTarget& target) {
  const LevelCounts& counts = level.counts.levels.front();
  LevelFacts facts;
  facts.target = target;
  facts.faces = level.mesh.triangles.size();
  facts.error_world = level.error_world;
  facts.distance_world = level.distance_world;
  facts.scale_world = level.scale_world;
  facts.voxel = level.mesh.frame.voxel;
  facts.volume = counts.measures.volume;
  facts.voxels = level.counts.voxels;
  facts.faces_dense = counts.simplify.faces_in;
  facts.attempts = level.attempts;
  facts.reached = level.reached;
  facts.stopped_by = counts.stopped_by;
  return facts;
}

MadeLevels make_levels(LodChain& chain, const ChainRange& range, const LevelSteps& steps) {
  const LevelRequest& request = range.request;
  MadeLevels made;
  std::vector<LodLevel>& levels = made.levels;
  bool short_of_faces = false;
  for (std::size_t i = 0; i < range.count; ++i) {
    const std::size_t number = range.first + levels.size();
    LodTarget target = level_target(request, range.first + i, range.first, chain.dense_faces());
    target.keep_voxels = range.keep_voxels && i == 0;
    const bool follows = target.error_world == 0 && range.first + i >= request.faces.size() && i > 0;
    if (follows && short_of_faces) target.faces = following(levels.front(), i);
    if (follows && target.faces >= levels.back().mesh.triangles.size()) {
      made.left_out.push_back({target, levels.back().mesh.triangles.size()});
      continue;
    }
    steps.begin("level " + std::to_string(number));
    LodLevel level = chain.make(target);
    if (i == 0) short_of_faces = falls_short(level, target);
    if (!levels.empty() && !is_coarser(level, levels.back(), range.diagonal)) {
      made.left_out.push_back(
          {target, levels.back().mesh.triangles.size(), level.mesh.triangles.size(), level.error_world});
      continue;
    }
    if (!levels.empty()) level.error_world = std::max(level.error_world, levels.back().error_world);
    steps.complete(level, number, target);
    made.facts.push_back(facts_of(level, target));
    levels.push_back(std::move(level));
  }
  return made;
}

}  // namespace bp
