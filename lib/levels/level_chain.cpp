#include "lib/levels/level_chain.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "lib/levels/lod_chain.h"

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

/// Whether a level is as near as another one, for no higher price.
bool is_in_front(const LodLevel& level, const LodLevel& other) {
  return level.error_world <= other.error_world && level.price <= other.price;
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

LodTarget LevelSequence::target(std::size_t i) const {
  return target_of(range_, i, chain_.dense_faces(), first_faces_);
}

std::vector<std::size_t> LevelSequence::next() {
  batch_.clear();
  std::uint64_t before = made_.levels.empty() ? 0 : made_.levels.back().level.mesh.triangles.size();
  for (; at_ < range_.count; ++at_) {
    const LodTarget wanted = target(at_);
    const bool follows_others = follows(range_, at_, wanted);
    // Budgets that follow from the first level wait until it is made.
    if (follows_others && at_ > 0 && !is_first_made_) break;
    if (follows_others && wanted.faces >= before) {
      if (!batch_.empty()) break;
      made_.left_out.push_back({wanted, before});
      continue;
    }
    before = wanted.faces;
    batch_.push_back(at_);
  }
  std::vector<std::size_t> numbers;
  for (const std::size_t i : batch_) numbers.push_back(range_.first + i);
  return numbers;
}

void LevelSequence::make_next() {
  std::vector<LodTarget> targets;
  for (const std::size_t i : batch_) targets.push_back(target(i));
  std::vector<LodLevel> levels = chain_.make(targets);
  if (!std::exchange(is_first_made_, true) && falls_short(levels[0], targets[0]))
    first_faces_ = levels[0].mesh.triangles.size();
  for (std::size_t i = 0; i < levels.size(); ++i) {
    MadeLevel now{std::move(levels[i]), targets[i]};
    LeftOut reason;
    if (!made_.levels.empty()) reason = not_worth_having(now, made_.levels.back().level, range_);
    if (reason.faces == 0) {
      made_.levels.push_back(std::move(now));
      continue;
    }
    made_.left_out.push_back(reason);
    if (reason.volume_ratio > 0) {
      at_ = range_.count;
      return;
    }
  }
}

/// Another try at the level's faces, closed as the next one; nothing if that is no way to make it.
std::optional<LodLevel> LevelSequence::closed_as(const LodLevel& next, LodTarget target) {
  if (target.faces == 0 || target.error_world > 0 || target.scale_world || next.scale_world == 0) return std::nullopt;
  target.scale_world = next.scale_world;
  return chain_.make(target);
}

/// Where a level is farther off than the next one, which has fewer faces, it gives way to one with the closing of that
/// if it is at least as near as the next one, for no higher price; else it is left out unless it has the lower price,
/// since it holds less.
void LevelSequence::keep_front() {
  std::vector<MadeLevel>& levels = made_.levels;
  for (std::size_t i = levels.size(); i-- > 1;) {
    const LodLevel& next = levels[i].level;
    MadeLevel& finer = levels[i - 1];
    if (finer.level.error_world <= next.error_world) continue;
    std::optional<LodLevel> other = closed_as(next, finer.target);
    if (other && other->reached && is_coarser(next, *other, range_.diagonal) && is_in_front(*other, next)) {
      finer.level = *std::move(other);
    } else if (finer.level.price >= next.price) {
      leave_out(finer, next);
      levels.erase(levels.begin() + std::ptrdiff_t(i - 1));
    }
  }
}

/// Notes that the level is not there, for the next one is nearly as near.
void LevelSequence::leave_out(const MadeLevel& made, const LodLevel& next) {
  const LodLevel& level = made.level;
  made_.left_out.push_back(
      {made.target, 0, level.mesh.triangles.size(), level.error_world, next.mesh.triangles.size()});
}

MadeLevels LevelSequence::take() {
  keep_front();
  std::vector<MadeLevel> kept;  // coarsest first
  for (; !made_.levels.empty(); made_.levels.pop_back()) {
    MadeLevel& made = made_.levels.back();
    if (!kept.empty() && is_needless(made.level, kept.back().level, range_)) {
      leave_out(made, kept.back().level);
    } else {
      kept.push_back(std::move(made));
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
