#pragma once
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/levels/voxel_choice.h"
#include "lib/pass/voxelize/voxelize_pass.h"

/// The levels of a chain: each has fewer faces than the one before, and spends its budget as far as the voxels can.
namespace bp {

class LodChain;

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
  double error_world = 0;  ///< as in LodLevel; NaN: not measured
  double scale_world = 0, voxel = 0;
  double volume = 0;              ///< scene units cubed
  std::uint64_t voxels = 0;       ///< of its closing
  std::uint64_t faces_dense = 0;  ///< of the surface of its voxels
  int attempts = 0;
  bool reached = true;          ///< as in LodLevel
  std::string stopped_by;       ///< as in LevelCounts
  std::vector<TriedWay> tried;  ///< as in LodLevel
};
[[nodiscard]] LevelFacts facts_of(const LodLevel& level, const LodTarget& target);

/// Which levels of a request are made.
struct ChainRange {
  LevelRequest request;              ///< as with_defaults() gives it
  std::size_t first = 0, count = 0;  ///< `first` is the first in one mesh
  double diagonal = 0;               ///< of the scene
  bool keep_voxels = false;          ///< LodTarget::keep_voxels of the first
};

/// A level of a request that is not there, and why.
struct LeftOut {
  LodTarget target;
  std::uint64_t faces_before = 0;  ///< of the level before
  std::uint64_t faces = 0;         ///< it would have; 0: it was not made, for the level before has its budget
  double error_world = 0;          ///< it would have
  std::uint64_t faces_after = 0;   ///< of the next level, which is nearly as near, or nearer; 0: another reason
  double volume_ratio = 0;         ///< its volume over that of the level before, if that is why; else 0
};

/// A level with what it was asked to be.
struct MadeLevel {
  LodLevel level;
  LodTarget target;
};

struct MadeLevels {
  std::vector<MadeLevel> levels;  ///< finest first
  std::vector<LeftOut> left_out;
};

/// Makes at most range.count levels, several at the same time; finest first. A level that has no fewer faces than the
/// one before, or an error above the scene's diagonal, is left out. Of levels that nobody asked for
/// (LevelRequest::is_chosen), one is left out where the next one, which has fewer faces, is nearly as near; and the
/// list ends before a level that holds more than three times the volume of the one before: it is crumpled. A
/// level that is farther off than the next one is made once more with the closing of that; if this does not help, it is
/// left out, unless it holds so much less that it has the lower price. Errors never fall: where less is measured, that
/// of the finer level stands for both. Where the first has clearly fewer faces than its budget, the budgets that follow
/// from it are quarters of what it has, and scales double.
class LevelSequence {
 public:
  /// Keeps a reference to `chain`.
  LevelSequence(LodChain& chain, ChainRange range) : chain_(chain), range_(std::move(range)) {}

  /// Returns the numbers, of those in the request, of the levels that make_next() makes; none if all are made. The
  /// first one is alone where the budgets of others follow from it.
  [[nodiscard]] std::vector<std::size_t> next();
  /// Once after each next() that returns numbers.
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
  std::size_t at_ = 0;              // of the range
  std::vector<std::size_t> batch_;  // of the range: what make_next() makes
  bool is_first_made_ = false;
  std::uint64_t first_faces_ = 0;  // above 0: the first level fell short
  MadeLevels made_;
};

}  // namespace bp
