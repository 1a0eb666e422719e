#include "tools/lod/scene/scene_levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/error.h"
#include "lib/geometry/surface_distance.h"
#include "lib/pass/leaf/fewer_triangles.h"
#include "lib/pass/mesh/surface_around.h"
#include "tools/cli/names.h"
#include "tools/lod/bake_levels.h"
#include "tools/run/enclosed_triangles_limit.h"
#include "tools/run/provenance.h"

namespace bp {

namespace {

/// A level that shows less than this share of its pixels otherwise than the scene needs no fit beside it.
constexpr double kLooksTheSame = 0.02;

/// Returns the whole scene as one piece. The unit is so small that numbers of 32 bits hold what floats hold.
SceneLeaf whole_scene(const SceneLooks& looks, const Bounds3d& bounds) {
  constexpr int kBits = 30;
  int exponent = 0;
  (void)std::frexp(bounds.longest_side() / 2, &exponent);
  SceneLeaf leaf = cut_leaf(looks, bounds, std::ldexp(1.0, exponent - kBits));
  for (double& x : leaf.origin) x = std::nearbyint(x / leaf.unit) * leaf.unit;  // what vertices are relative to
  return leaf;
}

/// Returns whether a level has all triangles of the scene.
bool is_whole(const std::shared_ptr<const SceneLeaf>& level, const SceneLeaf& scene) {
  return level != nullptr && level->triangles() == scene.triangles();
}

constexpr double kImagesBeside = 0.2;  // share of the memory for work: for images while levels are compared

/// Levels are written when nothing else is in memory but their triangles.
MemoryShare memory_for_images(const Build& build) {
  constexpr double kOfWork = 1.6;
  return part_of(build.budget.work, kOfWork);
}

/// Returns the memory for the images of a file: while its data grow, they are there twice.
std::uint64_t bytes_of_images(const LodScene& scene) {
  return scene.textures != nullptr ? 2 * scene.textures->written_bytes() : 0;
}

/// Returns the bytes of the work with its results.
std::uint64_t bytes_of_work(const LodScene& scene, const std::vector<LodTarget>& targets) {
  constexpr std::uint64_t kResultBytesPerTriangle = 300;  // a vertex for each corner, here and in the file
  const std::uint64_t triangles = scene.size.triangles;
  std::uint64_t work = triangles * (kLeafBytesPerTriangle + kCollapseBytesPerTriangle);
  for (const LodTarget& target : targets) work += kResultBytesPerTriangle * std::min(target.faces, triangles);
  return work;
}

/// Checks the memory of the work with its results, and that of the images' files.
void require_memory(const Build& build, const LodScene& scene, const std::vector<LodTarget>& targets) {
  const auto require = [](const std::string& what, std::uint64_t needed, const MemoryShare& memory, Remedies others) {
    if (needed > memory.bytes) throw NeedsMemory(what, needed, memory.bytes, memory.limit_for(needed), others);
  };
  require(fmt::format("levels from {} triangles of the scene", scene.size.triangles), bytes_of_work(scene, targets),
          build.context().memory, {});
  require("writing the images of the scene", bytes_of_images(scene), memory_for_images(build), {Remedy::no_textures});
}

}  // namespace

SceneLevels::SceneLevels(Build& build, const LodScene& scene, const std::vector<LodTarget>& targets)
    : build_(build), scene_(scene) {
  for (const LodTarget& target : targets) levels_.push_back({target, nullptr});
  if (scene.size.triangles > kMostEnclosedTriangles) {
    build.note(fmt::format("--mode visual: the scene has more than {} triangles, and all its levels are fits",
                           kMostEnclosedTriangles));
    return;
  }
  build.report.begin("levels from the scene");
  require_memory(build, scene, targets);
  const Bounds3d& bounds = scene.size.bounds;
  const SceneLeaf whole = whole_scene(*read_looks(build, scene, part_of(build.budget.work, kLooksBeside)), bounds);
  const LeafImages images(whole, scene.textures.get(), part_of(build.budget.work, kImagesBeside));
  for (const auto& [image, fault] : images.broken()) {
    build.note(fault + "; levels from the scene leave it out");
    broken_.insert(image);
  }
  const std::vector<TriangleD> all = world_triangles(whole);
  if (all.empty()) return;  // no triangle has an area
  const TriangleBvh tree(all);
  const bool has_colors = build.options.colors() && scene.has_colors();
  views_ = std::make_unique<SurfaceViews>(all, bounds, has_colors ? paint_of(whole, images) : SurfaceViews::ColorAt());
  std::vector<TriangleD> shown;
  for (const std::uint32_t i : views_->shown()) shown.push_back(all[i]);
  std::vector<std::uint64_t> most;
  for (const LodTarget& target : targets) most.push_back(target.faces);
  for (const LeafFolds folds : {LeafFolds::plain, LeafFolds::held}) {
    std::vector<SceneLeaf> leaves = with_fewer_triangles(whole, most, folds);
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      if (leaves[i].triangles() > most[i] || is_whole(levels_[i].leaf, whole)) continue;
      offer(levels_[i], std::move(leaves[i]), images);
    }
  }
  for (Level& level : levels_) {
    if (level.leaf == nullptr || is_whole(level.leaf, whole)) continue;
    const std::vector<TriangleD> own = world_triangles(*level.leaf);
    const double tolerance = bounds.diagonal() / 1000;
    level.error_world = std::max(largest_distance(own, tree, tolerance).at_most,
                                 shown.empty() ? 0 : largest_distance(shown, TriangleBvh(own), tolerance).at_most);
  }
}

/// Gives a level these triangles unless it has some that look nearer.
void SceneLevels::offer(Level& level, SceneLeaf&& leaf, const LeafImages& images) const {
  const double difference = views_->difference(world_triangles(leaf), paint_of(leaf, images));
  if (level.leaf != nullptr && level.difference <= difference) return;
  level.leaf = std::make_shared<const SceneLeaf>(std::move(leaf));
  level.difference = difference;
}

std::uint64_t SceneLevels::limit(const Build& build, const LodScene& scene, const std::vector<LodTarget>& targets) {
  return scene.size.triangles > kMostEnclosedTriangles
             ? 0
             : build.context().memory.limit_for(bytes_of_work(scene, targets));
}

std::uint64_t SceneLevels::images_limit(const Build& build, const LodScene& scene) {
  if (scene.textures == nullptr) return 0;
  return std::max(part_of(build.budget.work, kImagesBeside).limit_for(LeafImages::bytes_needed(*scene.textures)),
                  memory_for_images(build).limit_for(bytes_of_images(scene)));
}

std::vector<std::uint64_t> SceneLevels::open() const {
  std::vector<std::uint64_t> faces;
  for (const Level& level : levels_)
    if (level.leaf == nullptr || level.difference > kLooksTheSame) faces.push_back(level.target.faces);
  return faces;
}

/// Returns for each target that is met the one that looks nearer.
std::vector<SceneLevels::Candidate> SceneLevels::candidates(const CompleteLevels& fits) const {
  std::vector<Candidate> best;
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    const Level& level = levels_[i];
    const Candidate own{i, {}, level.leaf != nullptr ? level.leaf->triangles() : 0, level.difference};
    const auto fit = std::find_if(fits.facts.begin(), fits.facts.end(),
                                  [&](const LevelFacts& f) { return f.target.faces == level.target.faces; });
    if (fit == fits.facts.end()) {
      if (level.leaf != nullptr) best.push_back(own);
      continue;
    }
    const auto at = std::size_t(fit - fits.facts.begin());
    const double difference = views_ ? views_->difference(world_triangles(fits.levels[at].mesh)) : 0;
    const bool is_own = level.leaf != nullptr && (level.difference <= difference || !fit->reached);
    best.push_back(is_own ? own : Candidate{i, at, fit->faces, difference});
  }
  return best;
}

CompleteLevels SceneLevels::with(CompleteLevels fits) const {
  const std::vector<Candidate> best = candidates(fits);
  CompleteLevels all;
  all.left_out = std::move(fits.left_out);
  all.broken = broken_;
  std::erase_if(all.left_out, [&](const LeftOut& out) {
    const auto meets = [&](const Candidate& c) { return levels_[c.number].target.faces == out.target.faces; };
    return std::any_of(best.begin(), best.end(), meets);
  });
  double error = 0;
  for (std::size_t i = 0; i < best.size(); ++i) {
    const auto& [number, fit, faces, difference] = best[i];
    const LodTarget& target = levels_[number].target;
    const LevelFacts facts = fit ? fits.facts[*fit] : facts_of(number);
    const std::uint64_t before = all.facts.empty() ? UINT64_MAX : all.facts.back().faces;
    const bool is_worse = views_ && i + 1 < best.size() && best[i + 1].difference < difference;
    if (is_worse || faces >= before) {
      const std::uint64_t after = is_worse ? best[i + 1].faces : 0;
      all.left_out.push_back({target, is_worse ? 0 : before, faces, facts.error_world, after});
      continue;
    }
    all.levels.push_back(fit ? std::move(fits.levels[*fit]) : told(target, all.levels.size()));
    all.scenes.push_back(fit ? nullptr : levels_[number].leaf);
    all.facts.push_back(facts);
    all.facts.back().error_world = error = std::max(error, facts.error_world);
  }
  return all;
}

LevelFacts SceneLevels::facts_of(std::size_t number) const {
  LevelFacts facts;
  facts.target = levels_[number].target;
  facts.stopped_by = kFromScene;
  facts.faces = levels_[number].leaf->triangles();
  facts.error_world = levels_[number].error_world;
  facts.voxel = scene_.voxels.header.frame.voxel;
  return facts;
}

/// Returns what a level from the scene tells besides its triangles.
LodLevel SceneLevels::told(const LodTarget& target, std::size_t number) const {
  LodLevel level;
  level.mesh.frame = scene_.voxels.header.frame;
  OptionText text;
  text.add("level", number).add("mode", build_.options.mode_name()).add("faces", target.faces).add("from", "scene");
  text.add("up", name_of(level.mesh.frame.up));
  level.mesh.provenance = {make_provenance("bplod", text, scene_.voxels.counts.input_hash)};
  return level;
}

}  // namespace bp
