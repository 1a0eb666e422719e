#include "lib/pass/mesh/detail/scaled_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <mutex>
#include <unordered_map>

#include "lib/core/vec3.h"
#include "lib/grid/scale_field.h"

namespace bp {

namespace {

/// Answers like ScaleField::reaches_along(), but keeps bounds of S for cells of space, instead of finding them for each
/// line. Both evaluate S at the same points of the line; here some points are skipped since a bound decides.
class ScaleLines {
 public:
  ScaleLines(const ScaleField& field, double voxel) : field_(field), voxel_(voxel), largest_(field.base) {
    for (const ScaleRule& rule : field.rules) largest_ = std::max(largest_, rule.scale);
  }

  /// Returns whether S is at least `scale` along the line. S is evaluated at points at most a voxel apart, where no
  /// bound decides.
  [[nodiscard]] bool reach(const Vec3d& a, const Vec3d& b, double scale) {
    if (scale > largest_) return false;
    if (field_.rules.size() < kFewRules) return field_.reaches_along(a, b, scale, voxel_);
    return evaluate_at(a) >= scale && evaluate_at(b) >= scale && reach_between(a, b, scale);
  }

 private:
  using Part = std::shared_ptr<const ScalePart>;
  /// A cube of space. Its edge is 2^level voxels.
  struct Cell {
    int level = 0;
    std::array<std::int64_t, 3> at{};  // in edges of the cell
    friend bool operator==(const Cell&, const Cell&) = default;
  };
  struct CellHash {
    std::size_t operator()(const Cell& c) const {
      std::uint64_t h = std::uint64_t(c.level);
      for (const std::int64_t x : c.at) h = (h ^ std::uint64_t(x)) * 0x9E3779B97F4A7C15ULL;
      return std::size_t(h ^ h >> 29);
    }
  };
  /// A part of the kept bounds with a lock of its own, so that threads seldom wait for each other.
  struct Shard {
    std::mutex mutex;
    std::unordered_map<Cell, Part, CellHash> parts;
  };
  static constexpr std::size_t kFewRules = 8, kShards = 32, kMostCells = 1024;  // cells kept in a shard, at most
  // Lines of at most so many voxels are followed within one part: finding a part takes as long as evaluating some
  // rules.
  static constexpr std::size_t kFewInPart = 4;
  static constexpr double kFewRulesVox = 8, kManyRulesVox = 2;
  static constexpr int kCoarse = 6;  // cells of this level or above evaluate all rules
  // Radius of the part in edges: it holds a line as long as an edge whose middle lies in the cell.
  static constexpr double kReach = 1.4;

  [[nodiscard]] double evaluate_at(const Vec3d& p) { return evaluate(field_, *part_of(cell_of(p, voxel_)), p); }

  /// The ends of the line are known to reach the scale.
  bool reach_between(const Vec3d& a, const Vec3d& b, double scale) {
    const Vec3d middle = 0.5 * (a + b);
    const double line = length(a - b);
    const Part part = part_of(cell_of(middle, line));
    if (part->range.least >= scale) return true;
    if (part->range.most < scale) return false;
    const double few = part->rules.size() <= kFewInPart ? kFewRulesVox : kManyRulesVox;
    if (line <= few * voxel_) return reach_within(*part, a, b, scale);
    if (evaluate(field_, *part, middle) < scale) return false;
    return reach_between(a, middle, scale) && reach_between(middle, b, scale);
  }

  /// Returns what reach_between() does, for a line in the ball of the part: no other parts are needed.
  bool reach_within(const ScalePart& part, const Vec3d& a, const Vec3d& b, double scale) const {
    const Vec3d middle = 0.5 * (a + b);
    if (evaluate(field_, part, middle) < scale) return false;
    if (length(a - b) <= voxel_) return true;
    return reach_within(part, a, middle, scale) && reach_within(part, middle, b, scale);
  }

  [[nodiscard]] double edge_of(int level) const { return std::ldexp(voxel_, level); }

  [[nodiscard]] Cell cell_of(const Vec3d& p, double line) const {
    Cell cell;
    while (edge_of(cell.level) < line) ++cell.level;
    for (std::size_t i = 0; i < 3; ++i) cell.at[i] = std::int64_t(std::floor(p[i] / edge_of(cell.level)));
    return cell;
  }

  Part part_of(const Cell& cell) {
    Shard& shard = shards_[CellHash()(cell) / 64 % kShards];
    {
      const std::lock_guard lock(shard.mutex);
      const auto found = shard.parts.find(cell);
      if (found != shard.parts.end()) return found->second;
    }
    Part made = make_part(cell);
    const std::lock_guard lock(shard.mutex);
    if (shard.parts.size() >= kMostCells) shard.parts.clear();
    shard.parts[cell] = made;
    return made;
  }

  Part make_part(const Cell& cell) {
    const double edge = edge_of(cell.level);
    Vec3d centre{};
    for (std::size_t i = 0; i < 3; ++i) centre[i] = (double(cell.at[i]) + 0.5) * edge;
    Part around;
    if (cell.level < kCoarse) {
      Cell outer{cell.level + 1, cell.at};
      for (std::int64_t& x : outer.at) x = x >> 1;
      around = part_of(outer);
    }
    return std::make_shared<const ScalePart>(part_near(field_, centre, kReach * edge, around.get()));
  }

  const ScaleField& field_;
  const double voxel_;
  double largest_;  // the largest scale of the field
  std::array<Shard, kShards> shards_;
};

}  // namespace

EdgeLimit scaled_edges(const ScaleField& scale, const GridFrame& frame, double factor) {
  const auto lines = std::make_shared<ScaleLines>(scale, frame.voxel);
  return [lines, &frame, factor](const LatticeCoord& a, const LatticeCoord& b) {
    const double edge = length(to_double(b - a));
    if (edge <= 2 * kLatticePerVoxel) return true;
    return lines->reach(frame.world(a), frame.world(b), edge / kLatticePerVoxel * frame.voxel / factor);
  };
}

}  // namespace bp
