#pragma once
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/levels/lod_level.h"
#include "lib/levels/voxel_choice.h"
#include "lib/pass/voxelize/voxelize_pass.h"

/// Makes the levels of a chain. Each has fewer faces than the level before, and as many of its budget as the voxels can
/// show.
namespace bp {

class LodChain;

struct VoxelizedScene {
  StreamHeader header;
  std::unique_ptr<BrickShelf> solid;
  VoxelizeCounts counts;
};
constexpr const char* kFromScene = "scene";  ///< LevelFacts::stopped_by, where nothing was closed or meshed

/// The facts about a level that lists, reports and notes tell.
struct LevelFacts {
  LodTarget target;
  std::uint64_t faces = 0;
  double error_world = 0;  ///< as in LodLevel; NaN: not measured
  double scale_world = 0, voxel = 0;
  double volume = 0;              ///< scene units cubed
  std::uint64_t voxels = 0;       ///< of the level's closing
  std::uint64_t faces_dense = 0;  ///< triangles of the dense surface of the closing
  int attempts = 0;
  bool reached = true;          ///< as in LodLevel
  std::string stopped_by;       ///< as in LevelCounts; kFromScene: the level is triangles of the scene
  std::vector<TriedWay> tried;  ///< as in LodLevel
  LimbCounts limbs;             ///< as in LevelCounts
};
[[nodiscard]] LevelFacts facts_of(const LodLevel& level, const LodTarget& target);

/// The part of a request that a sequence makes.
struct ChainRange {
  LevelRequest request;              ///< as with_defaults() gives it
  std::size_t first = 0, count = 0;  ///< `first`: the request's number of the first level that is one mesh
  double diagonal = 0;               ///< diagonal of the scene's bounds
  bool keep_voxels = false;          ///< LodTarget::keep_voxels of the first level
};

/// A level of a request that was left out, and why.
struct LeftOut {
  LodTarget target;
  std::uint64_t faces_before = 0;  ///< faces of the level before
  /// Faces that it would have; 0: it was not made, since the level before has no more faces than its budget.
  std::uint64_t faces = 0;
  double error_world = 0;  ///< error that it would have
  /// Faces of the next level, if that is the reason: its error is nearly as small, or smaller; else 0.
  std::uint64_t faces_after = 0;
  double volume_ratio = 0;  ///< volume over that of the level before, if that is the reason; else 0
};

/// A level and its target.
struct MadeLevel {
  LodLevel level;
  LodTarget target;
};

struct MadeLevels {
  std::vector<MadeLevel> levels;  ///< finest first
  std::vector<LeftOut> left_out;
};

/// Makes at most range.count levels, finest first, several at the same time. These levels are left out:
///   - a level that has no fewer faces than the level before, or an error above the scene's diagonal;
///   - a level that nobody asked for (LevelRequest::is_chosen), if the next one has nearly as small an error with fewer
///     faces;
///   - a level that nobody asked for, and all after it, if it holds more than three times the volume of the level
///     before: it is crumpled;
///   - a level with a larger error than the next one. First it is made again with the closing of the next level. If
///     this does not help, it is left out, unless its price is lower, since it holds much less volume.
/// Errors never fall from level to level: if a coarser one measures less, it gets the finer one's error. If the first
/// level has clearly fewer faces than its budget, the budgets that follow from it are quarters of the faces that it
/// has.
class LevelSequence {
 public:
  /// Keeps a reference to `chain`.
  LevelSequence(LodChain& chain, ChainRange range) : chain_(chain), range_(std::move(range)) {}

  /// Returns the levels that make_next() makes, by their numbers in the request; none if all are made. The first level
  /// is made alone if the budgets of others follow from it.
  [[nodiscard]] std::vector<std::size_t> next();
  /// Makes these levels. Call it once after each next() that returns numbers.
  void make_next();
  /// Returns the levels that are worth having. Ends the sequence.
  [[nodiscard]] MadeLevels take();

 private:
  [[nodiscard]] LodTarget target(std::size_t i) const;
  [[nodiscard]] std::optional<LodLevel> closed_as(const LodLevel& next, LodTarget target);
  void keep_front();
  void leave_out(const MadeLevel& made, const LodLevel& next);

  LodChain& chain_;
  ChainRange range_;
  std::size_t at_ = 0;              // the next level, counted in the range
  std::vector<std::size_t> batch_;  // the levels that make_next() makes, counted in the range
  bool is_first_made_ = false;
  std::uint64_t first_faces_ = 0;  // above 0: the first level fell short
  MadeLevels made_;
};

}  // namespace bp
