#pragma once
#include <optional>
#include <vector>

#include "lib/grid/shelf_stream.h"
#include "lib/levels/detail/best_level.h"
#include "lib/levels/detail/convex_levels.h"
#include "lib/levels/detail/level_scene.h"

namespace bp {

/// Whether a level of the target may follow from a mesh: it encloses, and nothing but a number of faces is asked for.
[[nodiscard]] bool may_follow(const LevelScene& scene, const LodTarget& target);
/// Whether it follows from this one: the faces suffice for its parts and holes.
[[nodiscard]] bool follows_from(const LevelScene& scene, const LodTarget& target, const LevelStart& start);

/// Returns what every mesh of a level is made by. has_triangles: those of the scene are known (LevelScene).
[[nodiscard]] MeshParams params_of_level(const LodOptions& options, const LodTarget& target, bool has_triangles);

/// Makes one level: proposes what may be best, and takes the best (LodChain::make). Searches in one scene may work at
/// the same time.
class LevelSearch {
 public:
  /// `context`: its memory is for this level. `start`: what the level follows from; null: none. Keeps references.
  LevelSearch(LevelScene& scene, const PassContext& context, const LodTarget& target, const LevelStart* start);

  /// `left` receives what coarser levels may follow from, unless the best mesh was made in a way that leaves nothing;
  /// null: no level follows. Throws as close_stream() and mesh_stream().
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
  std::optional<LevelStart>* left_ = nullptr;  // as make() has it
};

}  // namespace bp
