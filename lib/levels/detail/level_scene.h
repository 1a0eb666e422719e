#pragma once
#include <map>
#include <memory>
#include <mutex>
#include <optional>

#include "lib/levels/detail/level_voxels.h"
#include "lib/levels/detail/ruler.h"

namespace bp {

/// A mesh around the scene that levels follow from, in place of a closing of their own.
struct LevelStart {
  LatticeMesh mesh;  ///< in the frame of the solid of `reductions`
  int reductions = 0;
  std::uint64_t parts_and_holes = 0;
  double scale_world = 0;  ///< of its closing; 0: the scene's own surface
};

/// What all levels of a chain share. Several threads may use it at once.
class LevelScene {
 public:
  /// As LodChain's constructor.
  LevelScene(const StreamHeader& header, std::unique_ptr<BrickShelf> solid, Backends& backends, LodOptions options);

  [[nodiscard]] const LodOptions& options() const { return options_; }
  /// Its memory is what the scene leaves for levels.
  [[nodiscard]] const PassContext& context() const { return options_.context; }
  /// Returns the limit on memory at which all steps of the chain fit; 0: not known.
  [[nodiscard]] std::uint64_t all_steps_limit();
  [[nodiscard]] const Bounds3d& bounds() const { return bounds_; }
  [[nodiscard]] const Ruler& ruler() const { return *ruler_; }
  [[nodiscard]] LevelVoxels& voxels() { return voxels_; }
  [[nodiscard]] LodGround ground() const;

  [[nodiscard]] bool is_bounding() const { return options_.mode == MeshMode::bounding; }
  /// Whether there are triangles that a level lies around, or follows.
  [[nodiscard]] bool has_triangles() const {
    return (options_.mode == MeshMode::fit || options_.enclose == Enclose::scene) && !options_.scene.empty();
  }

  /// The triangles, in the frame of a solid. They are kept if they are small; else levels that need them at the same
  /// time share them.
  [[nodiscard]] std::shared_ptr<const Enclosed> enclosed(const LevelVoxels::Solid& solid);

  /// Takes bytes off the memory that levels have.
  void take_off(std::uint64_t bytes);
  /// Returns about the most bytes that a level takes which begins with a mesh of so many faces, or with a closing (0):
  /// the mesh, the triangles that stay inside or that a fit follows, and the measure of its error (docs/levels.md).
  [[nodiscard]] std::uint64_t bytes_of_level(std::uint64_t faces) const;

  /// The scene's surface as a start, if it bounds a solid, and is smaller than that of the voxels.
  [[nodiscard]] std::optional<LevelStart> own_surface();

 private:
  void make_ruler();

  LodOptions options_;
  const PassContext all_;  // with the memory that the scene takes, too
  Bounds3d bounds_;
  LevelVoxels voxels_;
  std::optional<Ruler> ruler_;
  std::mutex mutex_;                                       // of what follows
  std::map<int, std::weak_ptr<const Enclosed>> enclosed_;  // by reductions
  std::shared_ptr<const Enclosed> kept_;                   // the small one that was made last
};

}  // namespace bp
