#pragma once
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "lib/image/surface_views.h"
#include "lib/pass/leaf/leaf_paint.h"
#include "lib/pass/leaf/scene_leaf.h"
#include "tools/lod/scene/lod_scene.h"

namespace bp {

/// Levels that are to be looked at (--mode visual): the scene's own triangles, or fewer of them, where these look more
/// like the scene than a fit does.
class SceneLevels {
 public:
  /// Makes a level of the scene's triangles for each target, finest first, that these can meet. Reads the scene once
  /// more. A scene of more than kMostEnclosedTriangles has none, and a note says so. Throws NeedsMemory.
  SceneLevels(Build& build, const LodScene& scene, const std::vector<LodTarget>& targets);

  /// Returns the limit on memory at which levels of the scene's triangles can be made, without images. 0: none are.
  [[nodiscard]] static std::uint64_t limit(const Build& build, const LodScene& scene,
                                           const std::vector<LodTarget>& targets);
  /// Returns the limit on memory at which the images of the scene can be written into levels.
  [[nodiscard]] static std::uint64_t images_limit(const Build& build, const LodScene& scene);

  /// Returns the faces of the targets that a fit may look nearer for: there is no level yet, or it shows more than a
  /// hundredth of the pixels otherwise than the scene.
  [[nodiscard]] std::vector<std::uint64_t> open() const;
  /// Returns a level for each target that is met: the fit where that looks nearer. Left out are levels with no fewer
  /// faces than the one before, and levels that look farther off than the next one. The error of a level from the scene
  /// is the largest distance from it to the scene, and from what the views show of the scene to it; where it is less
  /// than that of the finer level, that stands for both.
  [[nodiscard]] CompleteLevels with(CompleteLevels fits) const;

 private:
  struct Level {
    LodTarget target;
    std::shared_ptr<const SceneLeaf> leaf;  // null: the triangles cannot meet the target
    double difference = 0;                  // SurfaceViews::difference()
    double error_world = 0;
  };
  struct Candidate {
    std::size_t number = 0;          // of the target
    std::optional<std::size_t> fit;  // number of the fit that is taken; none: the level is from the scene
    std::uint64_t faces = 0;
    double difference = 0;
  };
  void offer(Level& level, SceneLeaf&& leaf, const LeafImages& images) const;
  [[nodiscard]] std::vector<Candidate> candidates(const CompleteLevels& fits) const;
  [[nodiscard]] LodLevel told(const LodTarget& target, std::size_t number) const;
  [[nodiscard]] LevelFacts facts_of(std::size_t number) const;

  const Build& build_;
  const LodScene& scene_;
  std::vector<Level> levels_;
  std::unique_ptr<SurfaceViews> views_;
  std::set<std::uint32_t> broken_;
};

}  // namespace bp
