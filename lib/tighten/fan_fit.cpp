// Sources: cutting planes for a linear objective ([Kel60]); here they are few enough that Seidel's scheme [Se91] solves
// them at once.
#include "lib/tighten/fan_fit.h"

#include <bit>

#include "lib/core/vec3.h"

namespace bp {

namespace {

constexpr int kCutRounds = 12;

}  // namespace

void FanFit::clear() {
  rim_.clear();
  points_.clear();
  avoided_.clear();
}

bool FanFit::close() {
  gradient_ = {};
  for (std::size_t i = 0; i < rim_.size(); ++i) gradient_ = gradient_ + cross(rim_[i], rim_[(i + 1) % rim_.size()]);
  gradient_ = (1.0 / 6) * gradient_;
  const double size = length(gradient_);
  if (!(size > 0)) return false;
  outward_ = (1 / size) * gradient_;
  return true;
}

double FanFit::volume(const Vec3d& x) const {
  return dot(gradient_, x);
}

void FanFit::set_plane(Point& point) const {
  const std::uint32_t s = point.sector;
  point.plane_of = s;
  point.normal = cross(rim_[s] - point.at, rim_[s + 1 == rim_.size() ? 0 : s + 1] - point.at);
  point.margin = kFitMargin / 2 * length(point.normal);
}

/// Moves each point to the face that it lies under, walking at most once around the fan.
void FanFit::bind(const Vec3d& apex) {
  const auto n = std::uint32_t(rim_.size());
  spokes_.clear();
  for (const Vec3d& r : rim_) spokes_.push_back(cross(outward_, r - apex));
  for (Point& point : points_) {
    const Vec3d p = point.at - apex;
    std::uint32_t& s = point.sector;
    int turned = 0;
    for (std::uint32_t step = 0; step < n; ++step) {
      const std::uint32_t next = s + 1 == n ? 0 : s + 1;
      if (turned <= 0 && dot(spokes_[s], p) < 0) {
        s = s == 0 ? n - 1 : s - 1;
        turned = -1;
      } else if (turned >= 0 && dot(spokes_[next], p) >= 0) {
        s = next;
        turned = 1;
      } else {
        break;
      }
    }
  }
}

/// Adds the deepest violation of each face to cuts_. Returns false if there is none.
bool FanFit::cut(const Vec3d& apex) {
  deepest_.assign(rim_.size(), 0);
  deepest_point_.assign(rim_.size(), 0);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Point& point = points_[i];
    if (point.plane_of != point.sector) set_plane(point);
    const double height = dot(point.normal, apex - point.at) - point.margin;
    if (height < deepest_[point.sector]) {
      deepest_[point.sector] = height;
      deepest_point_[point.sector] = i;
    }
  }
  const std::size_t before = cuts_.size();
  for (std::size_t s = 0; s < rim_.size(); ++s) {
    if (deepest_[s] >= 0) continue;
    const Point& point = points_[deepest_point_[s]];
    const Vec3d n = (1 / length(point.normal)) * point.normal;
    cuts_.push_back({n, dot(n, point.at) + kFitMargin});
  }
  return cuts_.size() > before;
}

void FanFit::add_plane(const Vec3d& normal, const Vec3d& through, const Vec3d& obstacle) {
  const double size = length(normal);
  if (!(size > 0)) return;
  const Vec3d n = (1 / size) * normal;
  avoided_.push_back({n, dot(n, through) + kFitMargin});
  obstacles_.push_back(obstacle);
}

/// Adds a plane so that the face over p, seen along outward_, passes above it.
void FanFit::avoid_corner(const Vec3d& apex, const Vec3d& p) {
  for (std::size_t s = 0; s < rim_.size(); ++s) {
    const Vec3d &a = rim_[s], &b = rim_[s + 1 == rim_.size() ? 0 : s + 1];
    if (dot(cross(outward_, a - apex), p - apex) < 0 || dot(cross(outward_, b - apex), p - apex) >= 0) continue;
    const Vec3d normal = cross(a - p, b - p);
    if (dot(normal, outward_) > 0 && dot(normal, apex - p) < kFitMargin * length(normal)) add_plane(normal, p, p);
  }
}

/// Adds planes so that spokes that cross pq, seen along outward_, pass above it.
void FanFit::avoid_edge(const Vec3d& apex, const Vec3d& p, const Vec3d& q) {
  const Vec3d across = cross(outward_, q - p);
  for (const Vec3d& r : rim_) {
    const Vec3d spoke = cross(outward_, r - apex);
    if (dot(spoke, p - apex) * dot(spoke, q - apex) > 0 || dot(across, apex - p) * dot(across, r - p) > 0) continue;
    Vec3d normal = cross(r - p, q - p);
    if (dot(normal, outward_) < 0) normal = -1.0 * normal;
    if (dot(normal, apex - p) >= kFitMargin * length(normal)) continue;
    const double at_p = dot(spoke, p - apex), at_q = dot(spoke, q - apex),
                 share = at_p == at_q ? 0 : at_p / (at_p - at_q);
    add_plane(normal, p, p + share * (q - p));  // the point where they cross
  }
}

/// Adds a plane so that the apex lies above pqr, if it is over it, seen along outward_.
void FanFit::avoid_face(const Vec3d& apex, const Vec3d& p, const Vec3d& q, const Vec3d& r) {
  Vec3d normal = cross(q - p, r - p);
  const double turn = dot(normal, outward_) < 0 ? -1 : 1;
  normal = turn * normal;
  const auto beside = [&](const Vec3d& a, const Vec3d& b) { return turn * dot(cross(outward_, b - a), apex - a) < 0; };
  if (beside(p, q) || beside(q, r) || beside(r, p)) return;
  if (dot(normal, apex - p) >= kFitMargin * length(normal)) return;
  add_plane(normal, p, apex - (dot(normal, apex - p) / dot(normal, outward_)) * outward_);  // under the apex
}

bool FanFit::avoid(const Vec3d& apex, const Blocker& blocker, const Vec3d& shift) {
  const std::size_t before = avoided_.size();
  obstacles_.clear();
  std::array<Vec3d, 8> p;
  for (std::size_t i = 0; i < blocker.count; ++i) {
    p[i] = blocker.points[i] - shift;
    avoid_corner(apex, p[i]);
  }
  for (std::size_t i = 0; i < blocker.count; ++i) {
    for (std::size_t j = i + 1; j < blocker.count; ++j) {
      const bool edge = blocker.count == 3 || std::popcount(i ^ j) == 1;
      if (edge) avoid_edge(apex, p[i], p[j]);
    }
  }
  if (blocker.count == 3) avoid_face(apex, p[0], p[1], p[2]);
  // The side that looks outward is tested as two triangles.
  for (std::size_t axis = 0; blocker.count == 8 && axis < 3; ++axis) {
    const std::size_t u = std::size_t(1) << (axis + 1) % 3, v = std::size_t(1) << (axis + 2) % 3;
    const std::size_t at = outward_[axis] > 0 ? std::size_t(1) << axis : 0;
    avoid_face(apex, p[at], p[at + u], p[at + u + v]);
    avoid_face(apex, p[at], p[at + u + v], p[at + v]);
  }
  return avoided_.size() > before;
}

std::optional<Vec3d> FanFit::least_volume(const Vec3d& start, double reach) {
  Quadric q;  // gradient . x + |gradient| / (2 reach) |x - start|^2: without cuts, x is `reach` from start
  const double pull = length(gradient_) / (2 * reach);
  q.xx = q.yy = q.zz = pull;
  q.bx = gradient_[0] / 2 - pull * start[0];
  q.by = gradient_[1] / 2 - pull * start[1];
  q.bz = gradient_[2] / 2 - pull * start[2];
  cuts_ = avoided_;
  GrowingMinimum minimum(q, start);
  std::optional<Vec3d> x = minimum.under(cuts_);
  for (int round = 0; x && round < kCutRounds; ++round) {
    bind(*x);
    if (!cut(*x)) break;
    x = minimum.under(cuts_);
  }
  return x;
}

}  // namespace bp
