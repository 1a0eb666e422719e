#include "lib/levels/level_chain.h"

#include <algorithm>
#include <cmath>

namespace bp {

namespace {

// Where a level takes less than kUnspent of its budget, and its error is above kNearVox voxels, smaller ones are worth
// four times the time; again, if they lowered the error to less than kNearer of it.
constexpr double kUnspent = 2.0 / 3, kNearVox = 1.5, kNearer = 0.8;

/// Whether there are clearly fewer faces than the level's budget: its voxels, or its scale, show no more.
bool falls_short(const LodLevel& level, const LodTarget& target) {
  return clearly_fewer(level.mesh.triangles.size(), target.faces);
}

/// Faces of a level that follow from a first one which fell short.
std::uint64_t following(const LodLevel& first, std::size_t steps) {
  const std::uint64_t faces = first.mesh.triangles.size();
  return std::max(steps < 32 ? faces >> (2 * steps) : 0, kLeastFaces);
}

/// Voxels of the scene, and the finest level that they give.
struct Attempt {
  VoxelizedScene scene;
  LevelRequest request;
  LodTarget target;
  std::unique_ptr<LodChain> chain;
  LodLevel finest;
  bool finest_voxel = false;  // halving makes them hardly smaller

  Attempt(const ChainSource& source, Backends& backends, const LevelSteps& steps, int halvings)
      : scene(source.voxelize(halvings)) {
    steps.begin("measure the scene");
    chain = std::make_unique<LodChain>(scene.header, std::move(scene.solid), backends, source.options());
    steps.begin("level 0");
    const SceneSize size{scene.header.bounds, scene.counts.scene.triangles};
    request = source.request(scene.header, size.triangles);
    target = level_target(request, 0, 0, chain->dense_faces());
    const VoxelRequest voxels = source.voxels(size.bounds);
    target.keep_voxels = is_named(voxels);
    const auto voxel = [&](int times) { return chosen_voxel(voxels, request, size, times); };
    target.detail = voxel(0) / voxel(halvings);
    finest_voxel = !halving_helps(voxels, request, size, halvings);
    finest = chain->make(target);
  }
  [[nodiscard]] double error() const { return finest.error_world; }
  /// As many faces as the scene has triangles are enough: further ones would show the steps of smaller voxels.
  [[nodiscard]] bool may_be_halved() const {
    return !finest_voxel && finest.mesh.triangles.size() < scene.counts.scene.triangles &&
           double(finest.mesh.triangles.size()) < kUnspent * double(target.faces) &&
           error() > kNearVox * finest.mesh.frame.voxel;
  }
};

/// The nearest attempt of those with ever smaller voxels, as long as these come nearer. What does not fit in memory
/// fails: a smaller memory must not make something else.
std::unique_ptr<Attempt> best_attempt(const ChainSource& source, Backends& backends, const LevelSteps& steps) {
  auto attempt = std::make_unique<Attempt>(source, backends, steps, 0);
  for (int halvings = 1; source.may_refine && attempt->may_be_halved(); ++halvings) {
    const double before = attempt->error();
    attempt.reset();  // its memory is wanted
    attempt = std::make_unique<Attempt>(source, backends, steps, halvings);
    if (attempt->error() > before) return std::make_unique<Attempt>(source, backends, steps, halvings - 1);
    if (attempt->error() > kNearer * before) break;
  }
  return attempt;
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

MadeLevels make_levels(LodChain& chain, const ChainRange& range, const LevelSteps& steps,
                       std::optional<LodLevel> finest) {
  const LevelRequest& request = range.request;
  MadeLevels made;
  std::vector<LodLevel>& levels = made.levels;
  bool short_of_faces = false;
  for (std::size_t i = 0; i < range.count; ++i) {
    const std::size_t number = range.first + levels.size();
    LodTarget target = level_target(request, range.first + i, range.first, chain.dense_faces());
    target.detail = range.detail;
    const bool follows = target.error_world == 0 && range.first + i >= request.faces.size() && i > 0;
    if (follows && short_of_faces) target.faces = following(levels.front(), i);
    if (follows && target.faces >= levels.back().mesh.triangles.size()) {
      made.left_out.push_back({target, levels.back().mesh.triangles.size()});
      continue;
    }
    LodLevel level;
    if (i == 0 && finest) {
      level = std::move(*finest);
    } else {
      steps.begin("level " + std::to_string(number));
      level = chain.make(target);
    }
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

MadeChain make_chain(const ChainSource& source, Backends& backends, const LevelSteps& steps) {
  MadeChain chain;
  const std::unique_ptr<Attempt> attempt = best_attempt(source, backends, steps);
  const double diagonal = attempt->scene.header.bounds.diagonal();
  chain.made = make_levels(*attempt->chain,
                           {attempt->request, 0, level_count(attempt->request), diagonal, attempt->target.detail},
                           steps, std::move(attempt->finest));
  chain.scene = std::move(attempt->scene);
  return chain;
}

}  // namespace bp
