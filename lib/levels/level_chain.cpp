#include "lib/levels/level_chain.h"

#include <algorithm>
#include <iterator>

#include "lib/levels/lod_chain.h"

namespace bp {

namespace {

// A level that nobody asked for is left out by these two thresholds. Errors alone end no list: the error of a smooth
// body grows by 4 when its faces fall to a quarter.
constexpr double kWorthHaving = 1.3;  // the next level's error is at least this many times larger
constexpr double kCrumpled = 3;       // a level of more than this many volumes of the level before is crumpled

/// Returns whether the level has clearly fewer faces than its budget, because its voxels or its scale show no more.
bool falls_short(const LodLevel& level, const LodTarget& target) {
  return clearly_fewer(level.mesh.triangles.size(), target.faces);
}

/// Returns the budget of a level whose first level fell short: a quarter of the faces for each step.
std::uint64_t following(std::uint64_t first_faces, std::size_t steps) {
  return std::max(steps < 32 ? first_faces >> (2 * steps) : 0, kLeastFaces);
}

/// Returns whether a level is worth having after the level `before`.
bool is_coarser(const LodLevel& level, const LodLevel& before, double diagonal) {
  if (level.mesh.triangles.size() >= before.mesh.triangles.size()) return false;
  // From a distance at which this error is tolerated, the whole scene is a point.
  return !(level.error_world > diagonal);
}

/// Returns whether the error and the price of a level are both at most those of another one.
bool is_in_front(const LodLevel& level, const LodLevel& other) {
  return level.error_world <= other.error_world && level.price <= other.price;
}

/// Returns whether the level's budget is derived from the first level's instead of taken from a list.
bool follows(const ChainRange& range, std::size_t i, const LodTarget& target) {
  return i > 0 && target.error_world == 0 && range.first + i >= range.request.faces.size();
}

/// first_faces: the faces of a first level that fell short, from which the others follow; else 0.
LodTarget target_of(const ChainRange& range, std::size_t i, std::uint64_t dense_faces, std::uint64_t first_faces) {
  LodTarget target = level_target(range.request, range.first + i, range.first, dense_faces);
  target.keep_voxels = range.keep_voxels && i == 0;
  if (first_faces > 0 && follows(range, i, target)) target.faces = following(first_faces, i);
  return target;
}

/// Returns why a level after `before` is left out; with faces 0 it is kept.
LeftOut not_worth_having(const MadeLevel& now, const LodLevel& before, const ChainRange& range) {
  const LodLevel& level = now.level;
  LeftOut reason{now.target, before.mesh.triangles.size(), level.mesh.triangles.size(), level.error_world};
  if (!is_coarser(level, before, range.diagonal)) return reason;
  reason.volume_ratio = volume_of(level) / volume_of(before);
  if (range.request.is_chosen && reason.volume_ratio > kCrumpled) return reason;
  return {};
}

/// Returns whether the level may go: nobody asked for it, and the next one has nearly as small an error with fewer
/// faces.
bool is_needless(const LodLevel& level, const LodLevel& next, const ChainRange& range) {
  return range.request.is_chosen && level.error_world * kWorthHaving > next.error_world;
}

}  // namespace

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
  facts.limbs = counts.limbs;
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

/// Makes the level once more with the scale of the next level's closing. Returns nothing if a scale or an error decides
/// the level, or if the next level has no closing.
std::optional<LodLevel> LevelSequence::closed_as(const LodLevel& next, LodTarget target) {
  if (target.faces == 0 || target.error_world > 0 || target.scale_world || next.scale_world == 0) return std::nullopt;
  target.scale_world = next.scale_world;
  return chain_.make(target);
}

/// Treats levels whose error is larger than that of the next level, which has fewer faces. Such a level is made again
/// with the next level's closing, and the new one is kept if its error and its price are at most the next level's. If
/// this fails, the level is left out, unless its price is lower: then it holds less volume.
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

/// Records that the level was left out because the next one has nearly the same error or a smaller one.
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
