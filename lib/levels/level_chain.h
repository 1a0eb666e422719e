#pragma once
#include <functional>
#include <memory>
#include <string>

#include "lib/levels/voxel_choice.h"
#include "lib/pass/voxelize/voxelize_pass.h"

/// The levels of a chain: each has fewer faces than the one before, and spends its budget as far as the voxels can.
namespace bp {

struct VoxelizedScene {
  StreamHeader header;
  std::unique_ptr<BrickShelf> solid;
  VoxelizeCounts counts;
};
/// Another solid, of which the header's box holds all bricks, besides those that it holds.
void put_solid(VoxelizedScene& scene, std::unique_ptr<BrickShelf> solid);

/// What is known of a level that was made: for lists, reports and notes.
struct LevelFacts {
  LodTarget target;
  std::uint64_t faces = 0;
  double error_world = 0, distance_world = 0;  ///< as in LodLevel; NaN: not measured
  double scale_world = 0, voxel = 0;
  double volume = 0;              ///< scene units cubed
  std::uint64_t voxels = 0;       ///< of its closing
  std::uint64_t faces_dense = 0;  ///< of the surface of its voxels
  int attempts = 0;
  bool reached = true;     ///< as in LodLevel
  std::string stopped_by;  ///< as in LevelCounts
};
[[nodiscard]] LevelFacts facts_of(const LodLevel& level, const LodTarget& target);

/// What a caller does while levels are made.
struct LevelSteps {
  std::function<void(const std::string&)> begin;  ///< a step of the work begins
  /// Completes a level: colours, provenance. `number` counts the levels that are kept.
  std::function<void(LodLevel&, std::size_t number, const LodTarget&)> complete;
};

/// Which levels of a request are made.
struct ChainRange {
  LevelRequest request;              ///< as with_defaults() gives it
  std::size_t first = 0, count = 0;  ///< `first` is the first in one mesh
  double diagonal = 0;               ///< of the scene
  double detail = 1;                 ///< LodTarget::detail of all of them
};

/// A level of a request that is not there, and why.
struct LeftOut {
  LodTarget target;
  std::uint64_t faces_before = 0;  ///< of the level before
  std::uint64_t faces = 0;         ///< it would have; 0: it was not made, for the level before has its budget
  double error_world = 0;          ///< it would have
};

struct MadeLevels {
  std::vector<LodLevel> levels;   ///< finest first
  std::vector<LevelFacts> facts;  ///< of each
  std::vector<LeftOut> left_out;
};

/// At most range.count levels, finest first. A level that has no fewer faces than the one before, or an error above the
/// scene's diagonal, is left out; the first is always kept. Where the first has clearly fewer faces than its budget,
/// the budgets that follow from it are quarters of what it has, and scales double. Errors never fall.
///   finest  the first level, if it is there already
[[nodiscard]] MadeLevels make_levels(LodChain& chain, const ChainRange& range, const LevelSteps& steps,
                                     std::optional<LodLevel> finest = {});

/// What a chain is made from.
struct ChainSource {
  std::function<VoxelizedScene(int halvings)> voxelize;  ///< with voxels of half the size, so often
  std::function<LodOptions()> options;                   ///< after voxelize()
  std::function<LevelRequest(const StreamHeader&, std::uint64_t triangles)> request;  ///< with_defaults()
  std::function<VoxelRequest(const Bounds3d&)> voxels;
  bool may_refine = false;  ///< smaller voxels may be tried; the scene can be voxelized again
};

struct MadeChain {
  VoxelizedScene scene;  ///< without its voxels
  MadeLevels made;
};

/// All levels, in one mesh each. If the finest takes less than two thirds of its budget, has fewer faces than the scene
/// has triangles, and an error above one and a half voxels, and source.may_refine, voxels and scale are halved, as long
/// as that takes a fifth off the error, and kMostResolution lets them get clearly smaller; the nearest one is taken.
/// Throws out_of_resource where the memory does not suffice: it must not decide what is made.
[[nodiscard]] MadeChain make_chain(const ChainSource& source, Backends& backends, const LevelSteps& steps);

}  // namespace bp
