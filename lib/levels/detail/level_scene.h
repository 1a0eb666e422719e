#pragma once
#include <map>
#include <memory>
#include <mutex>
#include <optional>

#include "lib/levels/detail/level_voxels.h"
#include "lib/levels/detail/ruler.h"

namespace bp {

/// A mesh around the scene from which levels are simplified, instead of from a closing of their own.
struct LevelStart {
  LatticeMesh mesh;  ///< in the frame of the solid of `reductions`
  int reductions = 0;
  std::uint64_t parts_and_holes = 0;
  double scale_world = 0;  ///< scale of the closing that it was made from; 0: the scene's own surface
};

/// Holds what all levels of a chain share: the voxels, the triangles and the ruler. Several threads may use it at once.
class LevelScene {
 public:
  /// The parameters are those of LodChain's constructor.
  LevelScene(const StreamHeader& header, std::unique_ptr<BrickShelf> solid, Backends& backends, LodOptions options);

  [[nodiscard]] const LodOptions& options() const { return options_; }
  /// Returns the options' context, whose memory is what the scene leaves for levels.
  [[nodiscard]] const PassContext& context() const { return options_.context; }
  /// Returns the limit on memory at which all steps of the chain fit; 0: not known.
  [[nodiscard]] std::uint64_t all_steps_limit();
  [[nodiscard]] const Bounds3d& bounds() const { return bounds_; }
  [[nodiscard]] const Ruler& ruler() const { return *ruler_; }
  [[nodiscard]] LevelVoxels& voxels() { return voxels_; }
  [[nodiscard]] LodGround ground() const;

  [[nodiscard]] bool is_bounding() const { return options_.mode == MeshMode::bounding; }
  /// Returns whether there are triangles that a level encloses or a fit follows.
  [[nodiscard]] bool has_triangles() const {
    return (options_.mode == MeshMode::fit || options_.enclose == Enclose::scene) && !options_.scene.empty();
  }

  /// Returns the triangles that must stay inside, in the frame of the solid. A small one is kept; a large one is shared
  /// by the levels that need it at the same time.
  [[nodiscard]] std::shared_ptr<const Enclosed> enclosed(const LevelVoxels::Solid& solid);

  /// Subtracts `bytes` from the memory that levels have.
  void take_off(std::uint64_t bytes);
  /// Returns about the most bytes that a level takes which begins with a mesh of `faces` faces, or with a closing (0).
  /// These are the mesh, the triangles that stay inside or that a fit follows, and the measurement of the error
  /// (docs/levels.md).
  [[nodiscard]] std::uint64_t bytes_of_level(std::uint64_t faces) const;

  /// Returns the scene's own surface as a start, if it bounds a solid and has no more triangles than the voxels'
  /// surface.
  [[nodiscard]] std::optional<LevelStart> own_surface();

 private:
  void make_ruler();

  LodOptions options_;
  const PassContext all_;  // with the memory that the scene takes, too
  Bounds3d bounds_;
  LevelVoxels voxels_;
  std::optional<Ruler> ruler_;
  std::mutex mutex_;                                       // guards enclosed_ and kept_
  std::map<int, std::weak_ptr<const Enclosed>> enclosed_;  // the key is the number of reductions
  std::shared_ptr<const Enclosed> kept_;                   // the last one made, if it is small
};

}  // namespace bp
