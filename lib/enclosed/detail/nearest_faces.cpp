#include "lib/enclosed/detail/nearest_faces.h"

#include <algorithm>
#include <cmath>

#include "lib/core/parallel.h"
#include "lib/enclosed/face_target.h"
#include "lib/mesh/lattice_geometry.h"
#include "lib/mesh/space_order.h"

namespace bp {

namespace {

constexpr std::int64_t kSortedAtOnce = 1024;
constexpr double kGroup = 0.25;  // radius of the ball of points that share a search, over the reach
constexpr double kSlack = 1e-6;  // lattice units, or their squares: more than all rounding

/// Searches the nearest faces of some of the points.
class NearestFaces {
 public:
  NearestFaces(std::span<const Vec3d> points, const LatticeCoord& origin, const HalfEdgeMesh& mesh,
               const FaceTree& tree, double reach, std::vector<FaceId>& found)
      : points_(points), origin_(origin), mesh_(mesh), tree_(tree), reach_(reach), found_(found) {}

  /// Finds the nearest face of each of these points. Points near in space share a search.
  void find(std::span<const std::uint32_t> numbers) {
    const Ball ball = around(numbers);
    if (numbers.size() > 1 && ball.radius > kGroup * reach_) {
      find(numbers.first(numbers.size() / 2));
      find(numbers.subspan(numbers.size() / 2));
      return;
    }
    gather(ball);
    for (const std::uint32_t i : numbers) found_[i] = nearest(points_[i], ball);
  }

 private:
  struct Ball {
    Vec3d middle;
    double radius;
  };
  struct Candidate {
    double distance;  // distance of the face from the ball's middle
    FaceId face;
    std::array<Vec3d, 3> corners;
  };

  [[nodiscard]] Ball around(std::span<const std::uint32_t> numbers) const {
    Vec3d low = points_[numbers[0]], high = low;
    for (const std::uint32_t i : numbers) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], points_[i][axis]);
        high[axis] = std::max(high[axis], points_[i][axis]);
      }
    }
    return {0.5 * (low + high), 0.5 * length(high - low)};
  }

  /// Gathers all faces that may be the nearest to a point of the ball, in the order of their distance to its middle.
  void gather(const Ball& ball) {
    const double more = 2 * ball.radius + kSlack;
    double least = reach_ + ball.radius;
    if (last_ != kNoId) least = std::min(least, distance(ball.middle, corners(last_)));
    const LatticeCoord at = origin_ + rounded(ball.middle);
    const auto d = std::int64_t(least + more) + 2;
    candidates_.clear();
    tree_.query({at - LatticeCoord{d, d, d}, at + LatticeCoord{d, d, d}}, [&](FaceId f) {
      Candidate c{0, f, corners(f)};
      c.distance = distance(ball.middle, c.corners);
      if (c.distance > least + more) return true;
      least = std::min(least, c.distance);
      candidates_.push_back(c);
      return true;
    });
    std::erase_if(candidates_, [&](const Candidate& c) { return c.distance > least + more; });
    std::sort(candidates_.begin(), candidates_.end(),
              [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });
    if (!candidates_.empty()) last_ = candidates_.front().face;
  }

  [[nodiscard]] FaceId nearest(const Vec3d& p, const Ball& ball) const {
    const double off = length(p - ball.middle) + kSlack;
    double least = reach_ * reach_, least_distance = reach_;
    FaceId best = kNoId;
    for (const Candidate& c : candidates_) {
      if (c.distance - off > least_distance) break;
      const double squared = squared_distance(p, c.corners);
      if (squared > least || (squared == least && c.face > best)) continue;
      least = squared;
      least_distance = std::sqrt(squared);
      best = c.face;
    }
    return best;
  }

  static double distance(const Vec3d& p, const std::array<Vec3d, 3>& corners) {
    return std::sqrt(squared_distance(p, corners));
  }
  [[nodiscard]] std::array<Vec3d, 3> corners(FaceId f) const {
    return {to_double(mesh_.corner(f, 0) - origin_), to_double(mesh_.corner(f, 1) - origin_),
            to_double(mesh_.corner(f, 2) - origin_)};
  }

  std::span<const Vec3d> points_;
  const LatticeCoord origin_;
  const HalfEdgeMesh& mesh_;
  const FaceTree& tree_;
  const double reach_;
  std::vector<FaceId>& found_;
  std::vector<Candidate> candidates_;
  FaceId last_ = kNoId;  // the face nearest to the middle of the last ball that had any: mostly near the next ball, too
};

}  // namespace

std::vector<FaceId> nearest_faces(std::span<const Vec3d> points, const LatticeCoord& origin, const HalfEdgeMesh& mesh,
                                  const FaceTree& tree, double reach) {
  std::vector<FaceId> found(points.size(), kNoId);
  const std::vector<std::uint32_t> order =
      space_order(points.size(), [&](std::uint32_t i) { return rounded(points[i]); });
  parallel_ranges(std::int64_t(order.size()), kSortedAtOnce, [&](std::int64_t begin, std::int64_t end) {
    NearestFaces(points, origin, mesh, tree, reach, found)
        .find(std::span(order).subspan(std::size_t(begin), std::size_t(end - begin)));
  });
  return found;
}

}  // namespace bp
