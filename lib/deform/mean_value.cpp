#include "lib/deform/mean_value.h"

#include <algorithm>
#include <cmath>

#include "lib/core/vec3.h"
#include "lib/deform/detail/raw_weights.h"

namespace bp {

namespace {

constexpr std::size_t kWide = detail::kWide;
constexpr double kOnCage = 1e-9;  // of the diagonal: nearer points are taken for points of the cage
constexpr double kFarAway = 8;    // diagonals: such points are outside, and their weights have few digits

std::vector<TriangleD> triangles_of(const Cage& cage) {
  std::vector<TriangleD> triangles;
  for (const Cage::Face& f : cage.faces)
    triangles.push_back({cage.vertices[f.corner[0]], cage.vertices[f.corner[1]], cage.vertices[f.corner[2]]});
  return triangles;
}

bool is_finite(const Vec3d& p) {
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

}  // namespace

MeanValueCoordinates::MeanValueCoordinates(Cage cage) : cage_(std::move(cage)), faces_(triangles_of(cage_)) {}

void MeanValueCoordinates::evaluate(std::span<const Vec3d> points, CoordinateRows& out) const {
  thread_local detail::RawScratch raw;
  out.columns = cage_.vertices.size();
  out.weights.resize(points.size() * out.columns);
  out.places.resize(points.size());
  for (std::size_t i = 0; i < points.size(); i += kWide) take_group(points, i, raw, out);
}

/// A group that is not full repeats its last point.
void MeanValueCoordinates::take_group(std::span<const Vec3d> points, std::size_t first, detail::RawScratch& raw,
                                      CoordinateRows& out) const {
  const std::size_t count = std::min(kWide, points.size() - first);
  detail::WideVec group{};
  Vec3d local[kWide];
  for (std::size_t k = 0; k < kWide; ++k) {
    const Vec3d& p = points[first + std::min(k, count - 1)];
    local[k] = is_finite(p) ? cage_.to_cage(p) : Vec3d{};
    group.x[k] = local[k][0], group.y[k] = local[k][1], group.z[k] = local[k][2];
  }
  const unsigned doubtful = detail::raw_weights(cage_, group, raw);
  for (std::size_t k = 0; k < count; ++k) {
    const std::span<double> weights = out.row(first + k);
    CoordinateRows::Place& place = out.places[first + k];
    if (is_finite(points[first + k])) {
      for (std::size_t v = 0; v < weights.size(); ++v) weights[v] = raw.vertices[v].sum[k];
      finish(local[k], weights, place, (doubtful >> k & 1) == 0);
    } else {
      std::fill(weights.begin(), weights.end(), 0.0);
      place = CoordinateRows::Place::nowhere;
    }
  }
}

/// The sum of the weights is the mean of one over the distance to the cage, in all directions: a ray from inside leaves
/// before it comes back, so the sum is above 0; one from outside enters first, so it is below.
void MeanValueCoordinates::finish(const Vec3d& point, std::span<double> weights, CoordinateRows::Place& place,
                                  bool trusted) const {
  place = CoordinateRows::Place::inside;
  if (!trusted) {
    if (nearest(point, weights) <= kOnCage) return reproduce(point, weights);
    std::vector<double> slow;
    detail::raw_weights_slowly(cage_, point, slow);
    std::copy(slow.begin(), slow.end(), weights.begin());
  }
  double sum = 0;
  for (const double w : weights) sum += w;
  if (!(sum > 0) || length(point) > kFarAway) {
    place = CoordinateRows::Place::outside;
    (void)nearest(point, weights);
  } else {
    const double scale = 1 / sum;
    for (double& w : weights) w *= scale;
  }
  reproduce(point, weights);
}

/// The weights of the nearest point of the cage; returns its distance.
double MeanValueCoordinates::nearest(const Vec3d& point, std::span<double> weights) const {
  const TriangleBvh::Nearest found = faces_.nearest(point);
  const TriangleBvh::Item& item = faces_.item(found.item);
  const std::array<double, 3> share = barycentric(item.corners, nearest_point(point, item.corners));
  std::fill(weights.begin(), weights.end(), 0.0);
  for (std::size_t i = 0; i < 3; ++i) weights[cage_.faces[item.id].corner[i]] += share[i];
  return std::sqrt(found.distance_squared);
}

/// The least change, by squares, after which the weights give the point exactly: what rounding left, or the offset of a
/// point outside. The origin is the mean of the vertices, so that the sum stays.
void MeanValueCoordinates::reproduce(const Vec3d& point, std::span<double> weights) const {
  Vec3d missing = point;
  for (std::size_t v = 0; v < weights.size(); ++v) missing = missing - weights[v] * cage_.vertices[v];
  const Vec3d slope{dot(cage_.spread[0], missing), dot(cage_.spread[1], missing), dot(cage_.spread[2], missing)};
  for (std::size_t v = 0; v < weights.size(); ++v) weights[v] += dot(slope, cage_.vertices[v]);
}

}  // namespace bp
