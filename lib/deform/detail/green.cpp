#include "lib/deform/detail/green.h"

#include <cmath>
#include <numbers>

#include "lib/core/vec3.h"

namespace bp::detail {

namespace {

constexpr double kTiny = 1e-300;
constexpr double kWhole = 4 * std::numbers::pi;

GreenFace face_of(const Cage& cage, const Cage::Face& f) {
  GreenFace out;
  const auto at = [&](std::size_t i) { return cage.vertices[f.corner[i % 3]]; };
  const Vec3d normal = cross(at(1) - at(0), at(2) - at(0));
  out.twice_area = length(normal);
  if (!(out.twice_area > kTiny)) return out;
  out.normal = (1 / out.twice_area) * normal;
  out.part = 1 / kWhole;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d along = at(i + 2) - at(i + 1);
    out.out[i] = (1 / length(along)) * cross(along, out.normal);
    out.per[i] = length(along) / out.twice_area / kWhole;
  }
  for (std::size_t i = 0; i < 3; ++i) out.angle[i] = dot(out.out[(i + 1) % 3], out.out[(i + 2) % 3]);
  return out;
}

}  // namespace

GreenCage green_cage(const Cage& cage) {
  GreenCage out;
  for (const Cage::Face& f : cage.faces) out.faces.push_back(face_of(cage, f));
  for (const Cage::Edge& e : cage.edges) out.lengths.push_back(length(cage.vertices[e.b] - cage.vertices[e.a]));
  return out;
}

BP_WIDE_CLONES unsigned green_weights(const CageView& cage, const WideVec& points, CoordinateScratch& scratch,
                                      Wide& total) {
  WideBits near{};
  green_formula<Wide>(cage, points, scratch.green, total, near);
  return bits_of(near);
}

void green_weights_slowly(const Cage& cage, const CageView& view, const Vec3d& point, std::span<double> weights) {
  using Real = long double;
  GreenScratch<Real> scratch;
  scratch.resize(cage);
  bool near = false;
  Real total;
  green_formula<Real>(view, Vec<Real>{point[0], point[1], point[2]}, scratch, total, near);
  std::size_t at = 0;
  for (std::size_t v = 0; v < scratch.sums.size(); ++v) weights[at++] = double(scratch.sums[v]);
  for (std::size_t f = 0; f < scratch.face_weights.size(); ++f) weights[at++] = double(scratch.face_weights[f]);
}

}  // namespace bp::detail
