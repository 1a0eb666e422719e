#include "lib/levels/level_chain.h"

#include <algorithm>
#include <cmath>
#include <iterator>

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

/// Why a level is left out that follows `before`; faces 0: it is not.
LeftOut not_worth_having(const MadeLevel& now, const LodLevel& before, const ChainRange& range) {
  const LodLevel& level = now.level;
  LeftOut reason{now.target, before.mesh.triangles.size(), level.mesh.triangles.size(), level.error_world};
  if (!is_coarser(level, before, range.diagonal)) return reason;
  reason.volume_ratio = volume_of(level) / volume_of(before);
  if (range.request.is_chosen && reason.volume_ratio > kCrumpled) return reason;
  return {};
}

/// Whether nobody asked for a level, and the next one, which has fewer faces, is nearly as near.
bool is_needless(const LodLevel& level, const LodLevel& next, const ChainRange& range) {
  return range.request.is_chosen && level.error_world * kWorthHaving > next.error_world;
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
  facts.scale_world = level.scale_world;
  facts.voxel = level.mesh.frame.voxel;
  facts.volume = counts.measures.volume;
  facts.voxels = level.counts.voxels;
  facts.faces_dense = counts.simplify.faces_in;
  facts.attempts = level.attempts;
  facts.reached = level.reached;
  facts.stopped_by = counts.stopped_by;
  facts.tried = level.tried;
  return facts;
}

LodTarget LevelSequence::target() const {
  return target_of(range_, at_, chain_.dense_faces(), first_faces_);
}

std::optional<std::size_t> LevelSequence::next() {
  for (; at_ < range_.count; ++at_) {
    const std::uint64_t before = made_.levels.empty() ? 0 : made_.levels.back().level.mesh.triangles.size();
    if (!follows(range_, at_, target()) || target().faces < before) return range_.first + at_;
    made_.left_out.push_back({target(), before});
  }
  return std::nullopt;
}

void LevelSequence::make_next() {
  MadeLevel now{{}, target()};
  now.level = chain_.make(now.target);
  if (at_++ == 0 && falls_short(now.level, now.target)) first_faces_ = now.level.mesh.triangles.size();
  if (made_.levels.empty()) return made_.levels.push_back(std::move(now));
  const LeftOut reason = not_worth_having(now, made_.levels.back().level, range_);
  if (reason.faces == 0) return made_.levels.push_back(std::move(now));
  made_.left_out.push_back(reason);
  if (reason.volume_ratio > 0) at_ = range_.count;
}

MadeLevels LevelSequence::take() {
  std::vector<MadeLevel> kept;  // coarsest first
  for (; !made_.levels.empty(); made_.levels.pop_back()) {
    auto& [level, target] = made_.levels.back();
    if (!kept.empty() && is_needless(level, kept.back().level, range_)) {
      const std::uint64_t faces_after = kept.back().level.mesh.triangles.size();
      made_.left_out.push_back({target, 0, level.mesh.triangles.size(), level.error_world, faces_after});
    } else {
      kept.push_back(std::move(made_.levels.back()));
    }
  }
  made_.levels.assign(std::make_move_iterator(kept.rbegin()), std::make_move_iterator(kept.rend()));
  for (std::size_t i = 1; i < made_.levels.size(); ++i) {
    double& error = made_.levels[i].level.error_world;
    error = std::max(error, made_.levels[i - 1].level.error_world);
  }
  return std::move(made_);
}

}  // namespace bp
