#include "lib/exact/polygon_cut.h"

#include <algorithm>
#include <cmath>

#include "lib/exact/predicates.h"

// Ear clipping (Meisters 1975, [Mei75]). An ear is a corner that turns to the left and whose triangle with its
// neighbours holds no other corner. A simple polygon always has two ears, and clipping one leaves a simple polygon. If
// another corner is in the triangle, then one that does not turn to the left is in it, too: the one nearest to the tip.
// So the search looks only at such corners (blockers_). Clipping makes angles smaller, so no corner becomes a blocker.

namespace bp {

namespace {

/// Returns the sum of the normals of the fan's triangles, each as long as twice its area.
Vec3d newell_normal(std::span<const Vec3d> p) {
  Vec3d n{}, from{};
  for (std::size_t k = 1; k < p.size(); ++k) {
    const Vec3d to{p[k][0] - p[0][0], p[k][1] - p[0][1], p[k][2] - p[0][2]};
    n[0] += from[1] * to[2] - from[2] * to[1];
    n[1] += from[2] * to[0] - from[0] * to[2];
    n[2] += from[0] * to[1] - from[1] * to[0];
    from = to;
  }
  return n;
}

int largest_axis(const Vec3d& n) {
  const double x = std::abs(n[0]), y = std::abs(n[1]), z = std::abs(n[2]);
  return z >= x && z >= y ? 2 : x >= y ? 0 : 1;
}

bool fan_folds(std::span<const Vec3d> p, int axis, int side) {
  for (std::size_t k = 2; k < p.size(); ++k) {
    if (orient2d(p[0], p[k - 1], p[k], axis) == -side) return true;
  }
  return false;
}

bool in_domain(std::span<const Vec3d> corners) {
  return std::all_of(corners.begin(), corners.end(), [](const Vec3d& p) { return in_predicate_domain(p); });
}

}  // namespace

std::span<const CutTriangle> PolygonCutter::cut(std::span<const Vec3d> corners) {
  if (corners.size() < 4 || corners.size() > kMostCorners) return {};
  const Vec3d normal = newell_normal(corners);
  const int axis = largest_axis(normal), side = sign_of(normal[std::size_t(axis)]);
  if (side == 0 || !in_domain(corners) || !fan_folds(corners, axis, side)) return {};
  project(corners, axis, side < 0);
  sort_blockers();
  if (!clip()) return {};
  return triangles_;
}

void PolygonCutter::project(std::span<const Vec3d> corners, int axis, bool mirrored) {
  const std::size_t u = std::size_t(axis + (mirrored ? 2 : 1)) % 3, v = std::size_t(axis + (mirrored ? 1 : 2)) % 3;
  const std::size_t n = corners.size();
  points_.clear();
  before_.clear(), after_.clear();
  ears_.assign(n, Ear::unknown);
  removed_.assign(n, false);
  for (std::size_t i = 0; i < n; ++i) {
    points_.push_back({corners[i][u], corners[i][v], 0});
    before_.push_back(std::uint32_t(i == 0 ? n - 1 : i - 1));
    after_.push_back(std::uint32_t(i + 1 == n ? 0 : i + 1));
  }
}

void PolygonCutter::sort_blockers() {
  Vec3d low = points_[0], high = low;
  blockers_.clear();
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    for (std::size_t k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], points_[i][k]);
      high[k] = std::max(high[k], points_[i][k]);
    }
    if (turn_at(i) <= 0) blockers_.push_back(i);
  }
  along_ = high[0] - low[0] >= high[1] - low[1] ? 0 : 1;
  std::sort(blockers_.begin(), blockers_.end(), [&](std::uint32_t a, std::uint32_t b) {
    const double at = points_[a][along_], bt = points_[b][along_];
    return at != bt ? at < bt : a < b;
  });
}

int PolygonCutter::turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  return orient2d(points_[a], points_[b], points_[c], 2);
}

/// Clips ears until a triangle is left. Returns false if the rest has no ear, or folds. After an ear, the corner behind
/// it is passed over; else all ears could be thin ones around that corner. A quad gets the fan from its second corner.
bool PolygonCutter::clip() {
  triangles_.clear();
  std::uint32_t tip = 1;
  for (left_ = points_.size(); left_ > 3;) {
    if (!clip_any(tip)) return false;
  }
  const std::uint32_t first = triangles_.back()[0], second = after_[first], third = after_[second];
  triangles_.push_back({first, second, third});
  return turn(first, second, third) >= 0;
}

/// Clips the first ear from `tip` on. If there is none, it clips a corner without area, as a double edge or equal
/// corners leave.
bool PolygonCutter::clip_any(std::uint32_t& tip) {
  std::uint32_t found = tip;
  std::size_t tried = 0;
  for (; tried < left_ && !is_ear(found); ++tried) found = after_[found];
  if (tried == left_) {
    for (tried = 0; tried < left_ && turn_at(found) != 0; ++tried) found = after_[found];
    if (tried == left_) return false;
  }
  tip = after_[after_[found]];
  remove(found);
  return true;
}

void PolygonCutter::remove(std::uint32_t tip) {
  const std::uint32_t a = before_[tip], b = after_[tip];
  triangles_.push_back({a, tip, b});
  after_[a] = b;
  before_[b] = a;
  removed_[tip] = true;
  ears_[a] = ears_[b] = Ear::unknown;
  --left_;
}

bool PolygonCutter::is_ear(std::uint32_t tip) {
  if (ears_[tip] == Ear::unknown) ears_[tip] = turn_at(tip) > 0 && is_free(tip) ? Ear::yes : Ear::no;
  return ears_[tip] == Ear::yes;
}

/// Returns true if no other corner is in the triangle of the tip, which has an area.
bool PolygonCutter::is_free(std::uint32_t tip) const {
  const std::array<std::uint32_t, 3> ear{before_[tip], tip, after_[tip]};
  const std::size_t across = 1 - along_;
  const auto [low, high] = std::minmax({points_[ear[0]][along_], points_[ear[1]][along_], points_[ear[2]][along_]});
  const auto [least, most] = std::minmax({points_[ear[0]][across], points_[ear[1]][across], points_[ear[2]][across]});
  const auto begin = std::partition_point(blockers_.begin(), blockers_.end(),
                                          [&, low = low](std::uint32_t p) { return points_[p][along_] < low; });
  for (auto p = begin; p != blockers_.end() && points_[*p][along_] <= high; ++p) {
    const double at = points_[*p][across];
    if (at >= least && at <= most && !removed_[*p] && blocks(*p, ear)) return false;
  }
  return true;
}

/// Returns whether corner `p` lies in the closed triangle. A corner on a corner of the triangle, as at both ends of a
/// double edge, counts only if the outline goes on into the triangle from there.
bool PolygonCutter::blocks(std::uint32_t p, const std::array<std::uint32_t, 3>& ear) const {
  if (std::find(ear.begin(), ear.end(), p) != ear.end()) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    if (turn(ear[k], ear[(k + 1) % 3], p) < 0) return false;
  }
  const auto same = std::find_if(ear.begin(), ear.end(), [&](std::uint32_t e) { return points_[e] == points_[p]; });
  if (same == ear.end()) return true;
  const auto k = std::size_t(same - ear.begin());
  const auto goes_in = [&](std::uint32_t q) {
    return turn(ear[k], ear[(k + 1) % 3], q) > 0 && turn(ear[(k + 2) % 3], ear[k], q) > 0;
  };
  return goes_in(before_[p]) || goes_in(after_[p]);
}

}  // namespace bp
