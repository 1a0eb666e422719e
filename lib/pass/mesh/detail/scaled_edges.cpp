#include "lib/pass/mesh/detail/scaled_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "lib/core/vec3.h"
#include "lib/enclosed/near_masks.h"
#include "lib/grid/coord_hash.h"
#include "lib/grid/scale_field.h"

namespace bp {

namespace {

/// Finds whether S is large enough along lines. Bounds of S are kept for cells of space.
class ScaleLines {
 public:
  ScaleLines(const ScaleField& field, double voxel, ScaledEdgeWork* work) : field_(field), voxel_(voxel), work_(work) {}

  /// Returns whether S is at least `scale` along the line. S is evaluated at points at most a voxel apart, where no
  /// bound decides.
  [[nodiscard]] bool reach(const Vec3d& a, const Vec3d& b, double scale) {
    const Vec3d middle = 0.5 * (a + b);
    const double line = length(a - b);
    const Part part = part_of(cell_of(middle, line));
    if (part->range.least >= scale) return true;
    if (part->range.most < scale) return false;
    if (line > kShortVox * voxel_)
      return value_at(*part, middle) >= scale && reach(a, middle, scale) && reach(middle, b, scale);
    const Point from{a, value_at(*part, a)};
    if (from.s < scale) return false;
    const Point to{b, value_at(*part, b)};
    return to.s >= scale && reach_within(*part, from, to, scale);
  }

 private:
  struct Point {
    Vec3d at;
    double s;  // S there
  };
  /// A part of the field in a ball.
  struct Near : ScalePart {
    double slope;  // S changes by at most so much per unit of length in the ball; infinite near brush strokes
  };
  using Part = std::shared_ptr<const Near>;
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
  static constexpr std::size_t kShards = 32, kMostCells = 1024;  // cells kept in a shard, at most
  static constexpr double kShortVox = 8;  // lines of at most so many voxels are followed within one part
  static constexpr int kCoarse = 6;       // cells of this level or above evaluate all rules
  // Radius of the part in edges: it holds a line as long as two edges whose middle lies in the cell.
  static constexpr double kReach = 1.87;

  /// Returns whether S cannot fall below the scale between two points that reach it: so steep it is nowhere.
  static bool is_too_near_to_fall(const Point& a, const Point& b, double line, double slope, double scale) {
    constexpr double kRounding = 1e-9;  // relative, as that of ranges
    return a.s + b.s - slope * line >= 2 * scale + kRounding * (a.s + b.s + slope * line);
  }

  /// Returns whether S reaches the scale between two points that do, in the ball of the part.
  bool reach_within(const Near& part, const Point& a, const Point& b, double scale) const {
    const double line = length(a.at - b.at);
    if (is_too_near_to_fall(a, b, line, part.slope, scale)) return true;
    Point between{0.5 * (a.at + b.at), 0};
    between.s = value_at(part, between.at);
    if (between.s < scale) return false;
    return line <= voxel_ || (reach_within(part, a, between, scale) && reach_within(part, between, b, scale));
  }

  [[nodiscard]] double value_at(const Near& part, const Vec3d& p) const {
    if (work_ != nullptr) ++work_->points;
    return evaluate(field_, part, p);
  }

  [[nodiscard]] double edge_of(int level) const { return std::ldexp(voxel_, level); }

  [[nodiscard]] Cell cell_of(const Vec3d& p, double line) const {
    Cell cell;
    while (2 * edge_of(cell.level) < line) ++cell.level;
    for (std::size_t i = 0; i < 3; ++i) cell.at[i] = std::int64_t(std::floor(p[i] / edge_of(cell.level)));
    return cell;
  }

  Part part_of(const Cell& cell) {
    if (work_ != nullptr) ++work_->parts;
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
    Near near{part_near(field_, centre, kReach * edge, around.get()), field_.slope};
    for (const std::uint32_t i : near.rules) near.slope = std::max(near.slope, slope_of(field_.rules[i]));
    return std::make_shared<const Near>(std::move(near));
  }

  /// Returns the slope of a rule that may be steeper than the field's.
  static double slope_of(const ScaleRule& rule) {
    if (rule.shape == ScaleShape::view) return rule.per_distance;
    return rule.support == ScaleRule::kNoSupport ? 0 : HUGE_VAL;
  }

  const ScaleField& field_;
  const double voxel_;
  ScaledEdgeWork* const work_;
  std::array<Shard, kShards> shards_;
};

double largest_of(const ScaleField& field) {
  double largest = field.base;
  for (const ScaleRule& rule : field.rules) largest = std::max(largest, rule.scale);
  return largest;
}

/// Answers for edges, and keeps the answers for the last ones: an edge is asked for when a step is planned, and again
/// when it is done.
class ScaledEdges {
 public:
  ScaledEdges(const ScaleField& field, const GridFrame& frame, double factor, const BrickShelf* near,
              ScaledEdgeWork* work)
      : lines_(field, frame.voxel, work), frame_(frame), factor_(factor), largest_(largest_of(field)), kept_(kKept) {
    if (near != nullptr) near_.emplace(*near);
  }

  [[nodiscard]] bool allows(const LatticeCoord& a, const LatticeCoord& b) {
    const double edge = length(to_double(b - a));
    if (edge <= 2 * kLatticePerVoxel) return true;
    const double scale = edge / kLatticePerVoxel * frame_.voxel / factor_;
    if (scale > largest_ && !near_) return false;
    const bool is_turned = std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z);
    const Edge ends = is_turned ? Edge{b, a} : Edge{a, b};
    const std::size_t place = (3 * CoordHash()(ends[0]) + CoordHash()(ends[1])) % kKept;
    std::mutex& mutex = mutexes_[place % mutexes_.size()];
    {
      const std::lock_guard lock(mutex);
      if (kept_[place].ends == ends) return kept_[place].allowed;
    }
    const bool allowed = (scale <= largest_ && lines_.reach(frame_.world(a), frame_.world(b), scale)) || is_near(a, b);
    const std::lock_guard lock(mutex);
    kept_[place] = {ends, allowed};
    return allowed;
  }

 private:
  using Edge = std::array<LatticeCoord, 2>;
  struct Answer {
    Edge ends{};
    bool allowed = true;
  };
  static constexpr std::size_t kKept = std::size_t(1) << 15;  // 1.8 MB

  /// Returns whether the edge lies near the voxels, for the least S along it. S is taken as the power of two below it,
  /// in voxels, so that a few masks serve all edges; below one voxel as 0.
  [[nodiscard]] bool is_near(const LatticeCoord& a, const LatticeCoord& b) {
    if (!near_) return false;
    const Vec3d from = frame_.world(a), to = frame_.world(b);
    for (double s = 0, next = 1;; s = next, next *= 2) {
      if (near_->is_near(a, b, (kNearOfEdge * factor_ * s + 1) * kLatticePerVoxel)) return true;
      if (next * frame_.voxel > largest_ || !lines_.reach(from, to, next * frame_.voxel)) return false;
    }
  }

  // An edge as long as `factor` scales that ends on a ball of radius r leaves it by factor^2 S^2 / (8 r). Where r is as
  // large as the edge, that is an eighth of the edge.
  static constexpr double kNearOfEdge = 1.0 / 8;

  ScaleLines lines_;
  const GridFrame& frame_;
  const double factor_;
  const double largest_;           // the largest scale of the field
  std::optional<NearMasks> near_;  // none: only short edges are allowed
  std::vector<Answer> kept_;
  std::array<std::mutex, 64> mutexes_;
};

}  // namespace

EdgeLimit scaled_edges(const ScaleField& scale, const GridFrame& frame, double factor, const BrickShelf* near,
                       ScaledEdgeWork* work) {
  const auto edges = std::make_shared<ScaledEdges>(scale, frame, factor, near, work);
  return [edges](const LatticeCoord& a, const LatticeCoord& b) { return edges->allows(a, b); };
}

std::uint64_t bytes_of_near_edges(const ScaleField& scale, const GridFrame& frame, const BrickShelf& near) {
  std::uint64_t masks = 1;
  for (double s = frame.voxel; s <= largest_of(scale); s *= 2) ++masks;
  return masks * NearMasks::bytes_of_mask(near);
}

}  // namespace bp
