#pragma once
#include <deque>
#include <memory>
#include <mutex>

#include "lib/device/backend.h"
#include "lib/levels/lod_level.h"

namespace bp {

/// Holds the voxels that levels are made of: the scene's solid, its reductions to voxels of twice the size for coarser
/// levels, and closings. Several threads may use it at once.
class LevelVoxels {
 public:
  /// The scene's solid, in voxels of one size.
  struct Solid {
    StreamHeader header;
    std::unique_ptr<BrickShelf> shelf;
    int reductions = 0;  ///< the voxels have 2^reductions times the first size
  };
  /// The closing of a solid, or the solid itself.
  struct Closing {
    StreamHeader header;
    std::unique_ptr<BrickShelf> voxels;  ///< null: the solid itself, not closed
    double scale_world = 0;
  };

  /// `solid` holds the bricks of `header`. Keeps references to `backends` and `options`.
  LevelVoxels(const StreamHeader& header, std::unique_ptr<BrickShelf> solid, Backends& backends,
              const LodOptions& options);

  /// Returns the solid in voxels of 2^n times the first size. Each is made on the first request and kept: a reduction
  /// has a quarter of the surface of the one before.
  [[nodiscard]] const Solid& reduced(int n);
  [[nodiscard]] static Closing as_it_is(const Solid& solid, double scale_world) {
    return {solid.header, nullptr, scale_world};
  }
  /// Closes the solid by LodOptions::field at this scale; without a field, at this scale everywhere. Uses the memory of
  /// `context`. Only one closing is made at a time, since all share the backends. Throws as close_stream().
  [[nodiscard]] Closing closed_at(const Solid& solid, double scale_world, const PassContext& context);

 private:
  /// Returns the solid with the rooms that cubes of this scale or of smaller ones shut off; null if there are none. A
  /// ball leaves a hole open in a wall that is thinner than the hole is wide, and a fit would follow both sides of the
  /// wall. A cube that is too large fills a room without shutting its hole, so smaller ones are tried, too.
  [[nodiscard]] std::unique_ptr<BrickShelf> with_rooms(const Solid& solid, const ScaleField& field,
                                                       const PassContext& context);
  [[nodiscard]] ScaleField field_at(const Solid& solid, double scale_world, const PassContext& context) const;

  Backends& backends_;
  const LodOptions& options_;
  std::mutex closing_;        // held by the thread that uses backends_
  std::mutex mutex_;          // guards solids_
  std::deque<Solid> solids_;  // finest first; none moves when another one is added
};

/// Returns the number of parts plus handles of a closing, as meshing would count them: parts that touch only along an
/// edge or at a corner are joined first. Throws out_of_resource if the memory does not suffice.
[[nodiscard]] std::uint64_t parts_and_holes(const LevelVoxels::Closing& closing, const PieceMemory& memory);

}  // namespace bp
