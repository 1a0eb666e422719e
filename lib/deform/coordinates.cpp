#include "lib/deform/coordinates.h"

#include <algorithm>
#include <cmath>

#include "lib/core/vec3.h"
#include "lib/deform/detail/green.h"
#include "lib/deform/detail/likelihood.h"
#include "lib/deform/detail/mean_value.h"
#include "lib/deform/formulas/weights.h"

namespace bp {

namespace {

using detail::Wide;
constexpr std::size_t kWide = detail::kWide;
constexpr double kOnCage = 1e-9;  // of the diagonal: nearer points count as points of the cage

std::vector<TriangleD> triangles_of(const Cage& cage) {
  std::vector<TriangleD> triangles;
  for (const Cage::Face& f : cage.faces)
    triangles.push_back({cage.vertices[f.corner[0]], cage.vertices[f.corner[1]], cage.vertices[f.corner[2]]});
  return triangles;
}

double sum_of(std::span<const double> numbers) {
  double sum = 0;
  for (const double x : numbers) sum += x;
  return sum;
}

/// Returns by how much a face with the edges u and v stretches if they become a and b ([LLC08]).
double stretch(const Vec3d& u, const Vec3d& v, const Vec3d& a, const Vec3d& b) {
  const double square = dot(a, a) * dot(v, v) - 2 * dot(a, b) * dot(u, v) + dot(b, b) * dot(u, u);
  return std::sqrt(std::max(square, 0.0) / 2) / length(cross(u, v));
}

}  // namespace

CoordinateRows::CoordinateRows() = default;
CoordinateRows::~CoordinateRows() = default;

std::size_t columns_of(CoordinateKind kind, const IndexedMesh& cage) {
  const auto is_face = [](const auto& t) { return t[0] != t[1] && t[1] != t[2] && t[2] != t[0]; };
  const std::ptrdiff_t faces =
      kind == CoordinateKind::green ? std::count_if(cage.triangles.begin(), cage.triangles.end(), is_face) : 0;
  return cage.vertices.size() + std::size_t(faces);
}

CageCoordinates::CageCoordinates(Cage cage, CoordinateKind kind)
    : cage_(std::move(cage)), kind_(kind), faces_(triangles_of(cage_)) {
  if (kind == CoordinateKind::green) green_ = std::make_unique<detail::GreenCage>(detail::green_cage(cage_));
}
CageCoordinates::~CageCoordinates() = default;

detail::CageView CageCoordinates::view() const {
  detail::CageView out = detail::view_of(cage_);
  if (green_) out.green = green_->faces.data(), out.edge_lengths = green_->lengths.data();
  return out;
}

std::size_t CageCoordinates::columns() const {
  return cage_.vertices.size() + (green_ ? cage_.faces.size() : 0);
}

std::size_t CageCoordinates::points_at_once() const {
  constexpr std::size_t kNumbers = 20000, kMost = 128;
  return std::clamp(kNumbers / columns() / kWide * kWide, kWide, kMost);
}

std::uint64_t CageCoordinates::bytes_at_once() const {
  constexpr std::size_t kSlow = 5;  // numbers in extended precision for each vertex; other rows need fewer
  using namespace detail;
  const std::size_t vertex = (green_ ? sizeof(GreenVertex<Wide>) : sizeof(MeanVertex<Wide>)) + sizeof(Wide),
                    edge = green_ ? sizeof(GreenEdge<Wide>) : sizeof(MeanEdge<Wide>),
                    face = green_ ? sizeof(Wide) : sizeof(MeanFace<Wide>);
  return points_at_once() * columns() * sizeof(double) +
         cage_.vertices.size() * (vertex + kSlow * sizeof(long double)) +
         cage_.edges.size() * (edge + 2 * sizeof(long double)) + cage_.faces.size() * (face + sizeof(long double));
}

void CageCoordinates::evaluate(std::span<const Vec3d> points, CoordinateRows& out) const {
  if (!out.scratch) out.scratch = std::make_unique<detail::CoordinateScratch>();
  out.scratch->resize(cage_, green_ != nullptr);
  out.columns = columns();
  out.weights.resize(points.size() * out.columns);
  out.places.resize(points.size());
  for (std::size_t i = 0; i < points.size(); i += kWide) take_group(points, i, out);
}

/// A group that is not full repeats its last point.
void CageCoordinates::take_group(std::span<const Vec3d> points, std::size_t first, CoordinateRows& out) const {
  const std::size_t count = std::min(kWide, points.size() - first), vertices = cage_.vertices.size();
  detail::CoordinateScratch& scratch = *out.scratch;
  detail::WideVec group{};
  Vec3d local[kWide];
  for (std::size_t k = 0; k < kWide; ++k) {
    const Vec3d& p = points[first + std::min(k, count - 1)];
    local[k] = is_finite(p) ? cage_.to_cage(p) : Vec3d{};
    group.x[k] = local[k][0], group.y[k] = local[k][1], group.z[k] = local[k][2];
  }
  alignas(sizeof(Wide)) Wide total{};
  const detail::CageView seen = view();
  const unsigned doubtful = green_ ? detail::green_weights(seen, group, scratch, total)
                                   : detail::mean_value_weights(seen, group, scratch, total);
  if (kind_ == CoordinateKind::maximum_likelihood) detail::likelihood_weights(cage_, group, doubtful, total, scratch);
  for (std::size_t k = 0; k < count; ++k) {
    const std::span<double> weights = out.row(first + k);
    CoordinateRows::Place& place = out.places[first + k];
    if (is_finite(points[first + k])) {
      const auto& sums = green_ ? scratch.green.sums : scratch.sums;
      for (std::size_t v = 0; v < vertices; ++v) weights[v] = sums[v][k];
      for (std::size_t f = vertices; f < weights.size(); ++f) weights[f] = scratch.green.face_weights[f - vertices][k];
      place = finish(local[k], weights, total[k], (doubtful >> k & 1) == 0);
    } else {
      std::fill(weights.begin(), weights.end(), 0.0);
      place = CoordinateRows::Place::nowhere;
    }
  }
}

/// Turns weights into coordinates. The sign of `total` tells whether the point is inside. For mean value weights it is
/// the mean of one over the distance to the cage, in all directions. A ray from inside leaves before it comes back, so
/// the mean is above 0; a ray from outside enters first, so it is below 0. For Green coordinates it is the number of
/// times that the cage winds around the point.
CoordinateRows::Place CageCoordinates::finish(const Vec3d& point, std::span<double> weights, double total,
                                              bool trusted) const {
  auto place = CoordinateRows::Place::inside;
  const detail::RowOfWeights<double> row{weights.data()};
  const Nearest near = trusted ? Nearest{} : nearest(point);
  if (!trusted && near.distance > kOnCage) total = slowly(point, weights);
  if (!trusted && near.distance <= kOnCage) {
    take_surface(point, near, weights);
  } else if (!(total > (green_ ? 0.5 : 0.0)) || length(point) > detail::kFarAway) {
    place = CoordinateRows::Place::outside;
    const Nearest from = nearest(point);
    take_surface(from.place, from, weights);
  } else {
    detail::divide_by_sum(view(), row);
  }
  detail::reproduce_point(view(), {point[0], point[1], point[2]}, row);
  return place;
}

/// Computes the weights anew, except those of maximum likelihood. Returns their total.
double CageCoordinates::slowly(const Vec3d& point, std::span<double> weights) const {
  if (green_) {
    detail::green_weights_slowly(cage_, view(), point, weights);
    return sum_of(weights.first(cage_.vertices.size()));
  }
  if (kind_ == CoordinateKind::mean_value) {
    detail::mean_value_weights_slowly(cage_, point, weights);
    return sum_of(weights);
  }
  std::vector<double> mean_value(weights.size());
  detail::mean_value_weights_slowly(cage_, point, mean_value);
  return sum_of(mean_value);
}

CageCoordinates::Nearest CageCoordinates::nearest(const Vec3d& point) const {
  const TriangleBvh::Nearest found = faces_.nearest(point);
  const TriangleBvh::Item& item = faces_.item(found.item);
  const Vec3d place = nearest_point(point, item.corners);
  return {std::sqrt(found.distance_squared), item.id, place, barycentric(item.corners, place)};
}

/// Sets the weights of a point of the cage: those in the face. Green coordinates jump there; their values on the cage
/// are their limits from within. The rest to the sum 1 goes to the corners of the face.
void CageCoordinates::take_surface(const Vec3d& point, const Nearest& near, std::span<double> weights) const {
  double missing = 1;
  if (green_) {
    missing -= slowly(point, weights);
  } else {
    std::fill(weights.begin(), weights.end(), 0.0);
  }
  for (std::size_t i = 0; i < 3; ++i) weights[cage_.faces[near.face].corner[i]] += missing * near.share[i];
}

std::vector<Vec3d> CageCoordinates::moves_of_columns(std::span<const Vec3d> vertex_moves) const {
  std::vector<Vec3d> moves(vertex_moves.begin(), vertex_moves.end());
  if (!green_) return moves;
  for (std::size_t f = 0; f < cage_.faces.size(); ++f) {
    const auto& corner = cage_.faces[f].corner;
    const auto edge = [&](std::size_t i) { return cage_.vertices[corner[i]] - cage_.vertices[corner[0]]; };
    const auto change = [&](std::size_t i) {
      return (1 / cage_.diagonal) * (vertex_moves[corner[i]] - vertex_moves[corner[0]]);
    };
    const Vec3d u = edge(1), v = edge(2), du = change(1), dv = change(2), a = u + du, b = v + dv, across = cross(a, b);
    const Vec3d& rest = green_->faces[f].normal;
    const bool still = (du == Vec3d{} && dv == Vec3d{}) || rest == Vec3d{};
    const double size = std::max(length(across), 1e-300);
    moves.push_back(still ? Vec3d{} : cage_.diagonal * ((stretch(u, v, a, b) / size) * across - rest));
  }
  return moves;
}

}  // namespace bp
