#pragma once
#include <deque>
#include <memory>
#include <mutex>

#include "lib/device/backend.h"
#include "lib/levels/lod_level.h"

namespace bp {

/// The voxels that levels are made of: the solid of a scene, reductions of it to voxels of twice the size, which
/// coarser levels take, and closings. Several threads may use it at once.
class LevelVoxels {
 public:
  /// The solid, in voxels of one size.
  struct Solid {
    StreamHeader header;
    std::unique_ptr<BrickShelf> shelf;
    int reductions = 0;  ///< the voxels have 2^reductions times the size of those at first
  };
  /// A solid, or a closing of it.
  struct Closing {
    StreamHeader header;
    std::unique_ptr<BrickShelf> voxels;  ///< null: the solid as it is
    double scale_world = 0;
  };

  /// `solid` holds the bricks of `header`. Keeps references to `backends` and `options`.
  LevelVoxels(const StreamHeader& header, std::unique_ptr<BrickShelf> solid, Backends& backends,
              const LodOptions& options);

  /// The solid in voxels of 2^n times the size of those at first. Each is made when it is first asked for, and kept:
  /// a reduction has a quarter of the surface of the one before.
  [[nodiscard]] const Solid& reduced(int n);
  [[nodiscard]] static Closing as_it_is(const Solid& solid, double scale_world) {
    return {solid.header, nullptr, scale_world};
  }
  /// By LodOptions::field at this scale, or by the scale alone, within the memory of `context`. One is made after the
  /// other, since they share the backends. Throws as close_stream().
  [[nodiscard]] Closing closed_at(const Solid& solid, double scale_world, const PassContext& context);

 private:
  [[nodiscard]] ScaleField field_at(const Solid& solid, double scale_world, const PassContext& context) const;

  Backends& backends_;
  const LodOptions& options_;
  std::mutex closing_;        // held by the thread that uses backends_
  std::mutex mutex_;          // of solids_
  std::deque<Solid> solids_;  // finest first; none moves when another one is added
};

/// Parts and handles of a closing that was made, as meshing would find them: what touches only along an edge or a
/// corner is joined first. Throws out_of_resource if the memory does not suffice for counting.
[[nodiscard]] std::uint64_t parts_and_holes(const LevelVoxels::Closing& closing, const PieceMemory& memory);

}  // namespace bp
