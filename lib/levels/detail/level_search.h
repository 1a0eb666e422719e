#pragma once
#include <optional>
#include <vector>

#include "lib/grid/shelf_stream.h"
#include "lib/levels/detail/best_level.h"
#include "lib/levels/detail/convex_levels.h"
#include "lib/levels/detail/level_scene.h"

namespace bp {

/// Returns whether a level of the target may be simplified from a finer mesh. That holds for bounding levels that are
/// no cage and ask for a number of faces alone, 32 or more.
[[nodiscard]] bool may_follow(const LevelScene& scene, const LodTarget& target);
/// Returns whether the level may be simplified from this start: it has 50 faces for each part and hole of the start.
[[nodiscard]] bool follows_from(const LevelScene& scene, const LodTarget& target, const LevelStart& start);

/// Returns the parameters that all meshes of a level share. has_triangles: whether the scene's triangles are known
/// (LevelScene).
[[nodiscard]] MeshParams params_of_level(const LodOptions& options, const LodTarget& target, bool has_triangles);

/// Makes one level: proposes several meshes to BestLevel, and returns the best (LodChain::make). Several searches may
/// work in one scene at the same time.
class LevelSearch {
 public:
  /// `context`: its memory is for this level alone. `start`: the mesh to simplify; null: none. Keeps references.
  LevelSearch(LevelScene& scene, const PassContext& context, const LodTarget& target, const LevelStart* start);

  /// `left` receives the mesh halfway to the level, from which coarser levels may be simplified; it stays empty if
  /// there is none. Null: no level follows. Throws as close_stream() and mesh_stream().
  [[nodiscard]] LodLevel make(std::optional<LevelStart>* left = nullptr);

 private:
  using Solid = LevelVoxels::Solid;
  using Closing = LevelVoxels::Closing;
  using Keep = ShelfSource::Keep;

  [[nodiscard]] bool is_of_few_faces() const;
  [[nodiscard]] bool is_simple() const;
  [[nodiscard]] double finest() const;
  [[nodiscard]] double larger_scale(const Solid& solid, double scale) const;
  [[nodiscard]] bool has_too_many_parts(const Closing& closing, std::uint64_t faces_per_part) const;
  [[nodiscard]] bool is_within(const LodLevel& level) const;
  [[nodiscard]] std::vector<ConvexLevel> convex_ways();

  void propose_closings();
  void propose_least_volume(const Closing& closing);
  void leave_start(LatticeMesh halfway, const Solid& solid, std::uint64_t parts, double scale);
  [[nodiscard]] LodLevel coarser();
  [[nodiscard]] LodLevel cage();

  LodLevel mesh(MeshParams params, const Solid& solid, const Closing& closing, Keep keep);
  [[nodiscard]] MeshParams least_volume(const Solid& solid) const;
  [[nodiscard]] MeshParams mesh_params(const Solid& solid, std::optional<double> near_world) const;

  LevelScene& scene_;
  const LodOptions& options_;
  const PassContext& context_;
  const LodTarget target_;
  const LevelStart* start_;
  const LodGround ground_;
  BestLevel best_;
  std::optional<LevelStart>* left_ = nullptr;  // the parameter of make()
};

}  // namespace bp
