#include "tools/lod/scene/scene_levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/error.h"
#include "lib/geometry/surface_distance.h"
#include "lib/pass/leaf/fewer_triangles.h"
#include "tools/lod/bake_levels.h"
#include "tools/lod/choices.h"
#include "tools/run/enclosed_triangles_limit.h"

namespace bp {

namespace {

/// A level that shows less than this share of its pixels otherwise than the scene needs no fit beside it.
constexpr double kLooksTheSame = 0.01;

std::vector<TriangleD> triangles_of(const SceneLeaf& leaf) {
  std::vector<TriangleD> all;
  all.reserve(leaf.triangles());
  for (const LeafPart& part : leaf.parts) {
    const auto at = [&](std::uint32_t v) {
      Vec3d p;
      for (std::size_t i = 0; i < 3; ++i) p[i] = leaf.origin[i] + leaf.unit * part.vertices[v].at[i];
      return p;
    };
    for (const auto& t : part.triangles) all.push_back({at(t[0]), at(t[1]), at(t[2])});
  }
  return all;
}

std::vector<TriangleD> triangles_of(const LatticeMesh& mesh) {
  std::vector<TriangleD> all;
  all.reserve(mesh.triangles.size());
  const auto at = [&](std::uint32_t v) { return mesh.frame.world(mesh.vertices[v]); };
  for (const auto& t : mesh.triangles) all.push_back({at(t[0]), at(t[1]), at(t[2])});
  return all;
}

/// Returns the whole scene as one piece, in a unit in which float32 holds its vertices from the middle.
SceneLeaf whole_scene(const SceneLooks& looks, const Bounds3d& bounds) {
  constexpr int kFloatBits = 24;
  int exponent = 0;
  (void)std::frexp(bounds.longest_side() / 2, &exponent);
  return cut_leaf(looks, bounds, std::ldexp(1.0, exponent - kFloatBits));
}

void require_memory(const Build& build, std::uint64_t triangles) {
  const MemoryShare memory = build.context().memory;
  const std::uint64_t needed = triangles * (kLeafBytesPerTriangle + kCollapseBytesPerTriangle);
  if (needed <= memory.bytes) return;
  throw NeedsMemory(fmt::format("levels from {} triangles of the scene", triangles), needed, memory.bytes,
                    memory.limit_with(needed - memory.bytes));
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
  require_memory(build, scene.size.triangles);
  const Bounds3d& bounds = scene.size.bounds;
  const SceneLeaf whole = whole_scene(*read_looks(build, scene, part_of(build.budget.work, 0.4)), bounds);
  const std::vector<TriangleD> all = triangles_of(whole);
  const TriangleBvh tree(all);
  views_ = std::make_unique<DepthViews>(all, bounds);
  std::vector<std::uint64_t> most;
  for (const LodTarget& target : targets) most.push_back(target.faces);
  std::vector<SceneLeaf> leaves = with_fewer_triangles(whole, most);
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    if (leaves[i].triangles() > most[i]) continue;
    Level& level = levels_[i];
    level.leaf = std::make_shared<const SceneLeaf>(std::move(leaves[i]));
    if (level.leaf->triangles() == all.size()) continue;  // the scene itself
    const std::vector<TriangleD> own = triangles_of(*level.leaf);
    const double tolerance = bounds.diagonal() / 1000;
    level.difference = views_->difference(own);
    level.error_world = std::max(largest_distance(own, tree, tolerance).at_most,
                                 largest_distance(all, TriangleBvh(own), tolerance).at_most);
  }
}

std::vector<std::uint64_t> SceneLevels::open() const {
  std::vector<std::uint64_t> faces;
  for (const Level& level : levels_)
    if (level.leaf == nullptr || level.difference > kLooksTheSame) faces.push_back(level.target.faces);
  return faces;
}

CompleteLevels SceneLevels::with(CompleteLevels fits) const {
  CompleteLevels all;
  std::uint64_t faces = UINT64_MAX;
  double error = 0;
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    const Level& level = levels_[i];
    const auto fit = std::find_if(fits.facts.begin(), fits.facts.end(),
                                  [&](const LevelFacts& f) { return f.target.faces == level.target.faces; });
    const bool has_fit = fit != fits.facts.end();
    if (level.leaf == nullptr && !has_fit) continue;
    LodLevel* const fitted = has_fit ? &fits.levels[std::size_t(fit - fits.facts.begin())] : nullptr;
    const bool is_fit =
        level.leaf == nullptr || (has_fit && views_->difference(triangles_of(fitted->mesh)) < level.difference);
    LevelFacts facts;
    if (is_fit) facts = std::move(*fit);
    if (!is_fit) {
      facts.target = level.target;
      facts.faces = level.leaf->triangles();
      facts.error_world = level.error_world;
      facts.voxel = scene_.voxels.header.frame.voxel;
    }
    if (facts.faces >= faces) continue;
    faces = facts.faces;
    facts.error_world = error = std::max(error, facts.error_world);
    all.facts.push_back(std::move(facts));
    all.levels.push_back(is_fit ? std::move(*fitted) : told(i));
    all.scenes.push_back(is_fit ? nullptr : level.leaf);
  }
  return all;
}

/// Returns what a level from the scene tells besides its triangles.
LodLevel SceneLevels::told(std::size_t number) const {
  LodLevel level;
  level.mesh.frame = scene_.voxels.header.frame;
  const OptionText text =
      option_text(build_.options, scene_.enclosed, levels_[number].target, number, 0, level.mesh.frame);
  level.mesh.provenance = {make_provenance("bplod", text, scene_.voxels.counts.input_hash)};
  return level;
}

}  // namespace bp
