#pragma once
#include <memory>

#include "lib/device/backend.h"
#include "lib/levels/lod_chain.h"

namespace bp {

/// The voxels that levels are made of: the solid of a scene, which is reduced to voxels of twice the size as levels get
/// coarser, and its closings.
class LevelVoxels {
 public:
  /// The solid, or a closing of it.
  struct Closing {
    StreamHeader header;
    std::unique_ptr<BrickShelf> voxels;  ///< null: the solid as it is
    double scale_world = 0;
  };

  /// `solid` holds the bricks of `header`. Keeps references to `backends` and `options`.
  LevelVoxels(const StreamHeader& header, std::unique_ptr<BrickShelf> solid, Backends& backends,
              const LodOptions& options);

  [[nodiscard]] const StreamHeader& header() const { return header_; }
  [[nodiscard]] const GridFrame& frame() const { return header_.frame; }
  [[nodiscard]] BrickShelf& solid() const { return *solid_; }
  [[nodiscard]] int reductions() const { return reductions_; }

  /// To voxels of 2^n times the size of those at first; never back.
  void reduce_to(int n);
  [[nodiscard]] Closing as_it_is(double scale_world) const { return {header_, nullptr, scale_world}; }
  /// By LodOptions::field at this scale, or by the scale alone. Throws as close_stream().
  [[nodiscard]] Closing closed_at(double scale_world) const;
  /// Parts and handles of a closing that was made, as meshing would find them: what touches only along an edge or a
  /// corner is joined first. Throws out_of_resource if the memory does not suffice for counting.
  [[nodiscard]] std::uint64_t parts_and_holes(const Closing& closing) const;

 private:
  [[nodiscard]] ScaleField field_at(double scale_world) const;

  StreamHeader header_;
  std::unique_ptr<BrickShelf> solid_;
  Backends& backends_;
  const LodOptions& options_;
  int reductions_ = 0;
};

}  // namespace bp
