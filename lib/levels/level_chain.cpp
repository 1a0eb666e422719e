#include "lib/levels/level_chain.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace bp {

namespace {

// Which levels that nobody asked for are left out. A smooth body's error grows by 4 with a quarter of the faces, so
// errors end no list.
constexpr double kWorthHaving = 1.3;  // times as near as the level after it, at least
constexpr double kCrumpled = 3;       // volumes of the level before

/// Whether there are clearly fewer faces than the level's budget: its voxels, or its scale, show no more.
bool falls_short(const LodLevel& level, const LodTarget& target) {
  return clearly_fewer(level.mesh.triangles.size(), target.faces);
}

/// Faces of a level that follow from a first one which fell short.
std::uint64_t following(std::uint64_t first_faces, std::size_t steps) {
  return std::max(steps < 32 ? first_faces >> (2 * steps) : 0, kLeastFaces);
}

/// Whether a level is worth having after the one before.
bool is_coarser(const LodLevel& level, const LodLevel& before, double diagonal) {
  if (level.mesh.triangles.size() >= before.mesh.triangles.size()) return false;
  return !(level.error_world > diagonal);  // beyond it, the scene is a point where the level would be drawn
}

/// Whether the target of a level follows from the first level, not from a list.
bool follows(const ChainRange& range, std::size_t i, const LodTarget& target) {
  return i > 0 && target.error_world == 0 && range.first + i >= range.request.faces.size();
}

/// first_faces: of a first level that fell short, from which the others follow; else 0.
LodTarget target_of(const ChainRange& range, std::size_t i, std::uint64_t dense_faces, std::uint64_t first_faces) {
  LodTarget target = level_target(range.request, range.first + i, range.first, dense_faces);
  target.keep_voxels = range.keep_voxels && i == 0;
  if (first_faces > 0 && follows(range, i, target)) target.faces = following(first_faces, i);
  return target;
}

/// A level that was made, until the next one tells whether it is worth having.
struct Waiting {
  LodLevel level;
  LodTarget target;
};

/// Why a level is left out that follows `before`; faces 0: it is not.
LeftOut not_worth_having(const Waiting& now, const LodLevel& before, const ChainRange& range) {
  const LodLevel& level = now.level;
  LeftOut reason{now.target, before.mesh.triangles.size(), level.mesh.triangles.size(), level.error_world};
  if (!is_coarser(level, before, range.diagonal)) return reason;
  reason.volume_ratio = volume_of(level) / volume_of(before);
  if (range.request.is_chosen && reason.volume_ratio > kCrumpled) return reason;
  return {};
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
  MadeLevels made;
  std::optional<Waiting> before;
  std::uint64_t first_faces = 0;  // above 0: the first level fell short
  const auto keep = [&](Waiting& w) {
    steps.complete(w.level, range.first + made.levels.size(), w.target);
    made.facts.push_back(facts_of(w.level, w.target));
    made.levels.push_back(std::move(w.level));
  };
  for (std::size_t i = 0; i < range.count; ++i) {
    const LodTarget target = target_of(range, i, chain.dense_faces(), first_faces);
    const std::uint64_t faces_before = before ? before->level.mesh.triangles.size() : 0;
    if (follows(range, i, target) && target.faces >= faces_before) {
      made.left_out.push_back({target, faces_before});
      continue;
    }
    steps.begin("level " + std::to_string(range.first + i));
    Waiting now{chain.make(target), target};
    if (i == 0 && falls_short(now.level, target)) first_faces = now.level.mesh.triangles.size();
    if (before) {
      const LeftOut reason = not_worth_having(now, before->level, range);
      if (reason.faces > 0) made.left_out.push_back(reason);
      if (reason.volume_ratio > 0) break;
      if (reason.faces > 0) continue;
      if (range.request.is_chosen && before->level.error_world * kWorthHaving > now.level.error_world) {
        made.left_out.push_back(
            {before->target, 0, faces_before, before->level.error_world, now.level.mesh.triangles.size()});
      } else {
        now.level.error_world = std::max(now.level.error_world, before->level.error_world);
        keep(*before);
      }
    }
    before = std::move(now);
  }
  if (before) keep(*before);
  return made;
}

}  // namespace bp
