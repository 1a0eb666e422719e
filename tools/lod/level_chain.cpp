#include "tools/lod/level_chain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/error.h"
#include "tools/notes/face_notes.h"

namespace bp {

namespace {

constexpr double kWorthwhile = 1.25;  // times the faces, for a quarter of the voxels' area: else there are no more

/// Whether the level has clearly fewer faces than its budget: its voxels, or its scale, show no more.
bool falls_short(const LodLevel& level, const LodTarget& target) {
  return target.faces > 0 && !too_few_note(level.mesh.triangles.size(), target.faces).empty();
}

/// Budget and scale of a level that follow from a first one which fell short.
LodTarget following(LodTarget target, const LodRequest& request, const LodLevel& first, std::size_t steps) {
  const std::uint64_t faces = first.mesh.triangles.size();
  target.faces = std::max(steps < 32 ? faces >> (2 * steps) : 0, kLeastFaces);
  if (!request.scale) target.scale_world = std::ldexp(first.scale_world, int(steps));
  return target;
}

/// Voxels of the scene, and the finest level that they give.
struct Attempt {
  VoxelizedScene scene;
  LodRequest request;
  LodTarget target;
  std::unique_ptr<LodChain> chain;
  LodLevel finest;
  int halvings = 0;
  bool finest_voxel = false;  // halving makes them no smaller

  Attempt(Build& build, int n) : scene(build.voxelize(0, nullptr, n)), halvings(n) {
    build.report.stage("measure the scene");
    chain = std::make_unique<LodChain>(scene.header, std::move(scene.solid), build.backends, build.lod_options());
    build.report.stage("level 0");
    request = request_for(build.options, scene.counts.scene.triangles);
    target = target_of(request, 0, 0, scene.header.bounds.diagonal(), scene.header.frame.voxel, chain->dense_faces());
    const SceneSize size{scene.header.bounds, scene.counts.scene.triangles};
    const auto voxel = [&](int times) { return voxel_size(build.options, size, times); };
    target.detail = voxel(0) / voxel(halvings);
    finest_voxel = voxel(halvings + 1) >= voxel(halvings);
    finest = chain->make(target);
  }
  [[nodiscard]] std::uint64_t faces() const { return finest.mesh.triangles.size(); }
  [[nodiscard]] bool may_be_halved() const { return !finest_voxel && falls_short(finest, target); }
};

/// The last attempt that was worthwhile, or the one after it. What does not fit in memory fails: a smaller memory must
/// not make something else.
std::unique_ptr<Attempt> best_attempt(Build& build) {
  auto attempt = std::make_unique<Attempt>(build, 0);
  const bool readable_again = may_refine(build.options);
  for (int halvings = 1; readable_again && attempt->may_be_halved(); ++halvings) {
    const auto enough = std::uint64_t(kWorthwhile * double(attempt->faces()));
    attempt.reset();  // its memory is wanted
    attempt = std::make_unique<Attempt>(build, halvings);
    if (attempt->faces() < enough) break;
  }
  return attempt;
}

}  // namespace

std::vector<LodLevel> make_levels(Build& build, LodChain& chain, const ChainRange& range,
                                  std::optional<LodLevel> finest) {
  const LodRequest& request = range.request;
  std::vector<LodLevel> levels;
  bool short_of_faces = false;
  for (std::size_t i = 0; i < range.count; ++i) {
    const std::size_t number = range.first + levels.size();
    LodTarget target = target_of(request, range.first + i, range.first, range.bounds.diagonal(), range.scene_voxel,
                                 chain.dense_faces());
    target.detail = range.detail;
    const bool follows = target.error_world == 0 && range.first + i >= request.faces.size() && i > 0;
    if (follows && short_of_faces) target = following(target, request, levels.front(), i);
    if (follows && target.faces >= levels.back().mesh.triangles.size()) continue;
    LodLevel level;
    if (i == 0 && finest) {
      level = std::move(*finest);
    } else {
      build.report.stage(fmt::format("level {}", number));
      level = chain.make(target);
    }
    if (i == 0) short_of_faces = falls_short(level, target);
    if (!levels.empty()) {
      if (level.mesh.triangles.size() >= levels.back().mesh.triangles.size()) continue;
      if (level.error_world > range.bounds.diagonal()) continue;  // the scene is a point where it would be drawn
      level.error_world = std::max(level.error_world, levels.back().error_world);
    }
    build.finish_level(level, number, target, range.input_hash);
    levels.push_back(std::move(level));
  }
  if (const std::size_t left_out = range.count - levels.size(); left_out > 0)
    build.note(
        fmt::format("{} of {} levels {} left out: no fewer faces than the one before, or an error beyond the "
                    "scene's size",
                    left_out, range.count, left_out == 1 ? "is" : "are"));
  return levels;
}

MadeChain make_chain(Build& build) {
  MadeChain made;
  const std::unique_ptr<Attempt> attempt = best_attempt(build);
  made.levels = make_levels(build, *attempt->chain,
                            {attempt->request, 0, level_count(attempt->request), attempt->scene.header.frame.voxel,
                             attempt->scene.header.bounds, attempt->scene.counts.input_hash, attempt->target.detail},
                            std::move(attempt->finest));
  made.scene = std::move(attempt->scene);
  return made;
}

}  // namespace bp
