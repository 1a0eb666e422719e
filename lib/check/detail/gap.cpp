// The nearest points of two triangles are found as usual, corner to face and edge to edge, and prove nothing. The
// direction between them gives a proof: planes across it have the triangles on their two sides, and the distance of the
// planes is the margin or more.
#include "lib/check/detail/gap.h"

#include <algorithm>
#include <cmath>

#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/exact/predicates.h"

namespace bp {

namespace {

// Relative to the triangles' size; bounds the rounding of values computed from about twenty products.
constexpr double kRounding = 1e-14;

struct Nearest {
  Vec3d on_a{}, on_b{};
  double distance = HUGE_VAL;

  void offer(const Vec3d& p, const Vec3d& q) {
    const double d = length(q - p);
    if (d < distance) *this = {p, q, d};
  }
};

double clamped(double x) {
  return std::clamp(x, 0.0, 1.0);
}

/// Offers the nearest points of the segments p + s u and q + t v.
void offer_edges(const Vec3d& p, const Vec3d& u, const Vec3d& q, const Vec3d& v, Nearest& nearest) {
  const Vec3d w = p - q;
  const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), uw = dot(u, w), vw = dot(v, w);
  if (!(uu > 0 && vv > 0)) return;  // corners are offered elsewhere
  const double area = uu * vv - uv * uv;
  double s = area > 0 ? clamped((uv * vw - vv * uw) / area) : 0;
  const double t = clamped((uv * s + vw) / vv);
  s = clamped((uv * t - uw) / uu);
  nearest.offer(p + s * u, q + t * v);
}

/// Offers the point where the edge from p along u crosses the triangle.
void offer_crossing(const Vec3d& p, const Vec3d& u, const TriangleD& t, Nearest& nearest) {
  const double along = along_segment(p, u, t);
  const Vec3d x = p + along * u;
  if (!std::isnan(along)) nearest.offer(x, nearest_point(x, t));
}

Nearest nearest_of(const TriangleD& a, const TriangleD& b) {
  Nearest nearest;
  for (std::size_t i = 0; i < 3; ++i) {
    offer_crossing(a[i], a[(i + 1) % 3] - a[i], b, nearest);
    offer_crossing(b[i], b[(i + 1) % 3] - b[i], a, nearest);
    nearest.offer(a[i], nearest_point(a[i], b));
    nearest.offer(nearest_point(b[i], a), b[i]);
    for (std::size_t j = 0; j < 3; ++j) offer_edges(a[i], a[(i + 1) % 3] - a[i], b[j], b[(j + 1) % 3] - b[j], nearest);
  }
  return nearest;
}

double size_around(const Vec3d& p, const TriangleD& a, const TriangleD& b) {
  double size = 0;
  for (const TriangleD* t : {&a, &b}) {
    for (const Vec3d& c : *t)
      size = std::max({size, std::abs(c[0] - p[0]), std::abs(c[1] - p[1]), std::abs(c[2] - p[2])});
  }
  return size;
}

/// Returns a box around all points nearer than `by`.
Bounds3d box_around(const TriangleD& t, double by) {
  Bounds3d box = bounds_of(t);
  for (std::size_t i = 0; i < 3; ++i) {
    box.min[i] = std::nextafter(box.min[i] - by, -HUGE_VAL);
    box.max[i] = std::nextafter(box.max[i] + by, HUGE_VAL);
  }
  return box;
}

/// Returns how far apart two planes across a direction are, between which nothing of the triangles is; below 0 if there
/// are none. Points are measured from p. Wherever p is, the planes are this far apart.
double between(const TriangleD& a, const TriangleD& b, const Vec3d& p, const Vec3d& across) {
  const Vec3d n = with_largest_one(across);
  const double size = length(n);
  if (!(size > 0)) return -HUGE_VAL;
  double a_low = HUGE_VAL, a_high = -HUGE_VAL, b_low = HUGE_VAL, b_high = -HUGE_VAL;
  for (const Vec3d& c : a) a_low = std::min(a_low, dot(n, c - p)), a_high = std::max(a_high, dot(n, c - p));
  for (const Vec3d& c : b) b_low = std::min(b_low, dot(n, c - p)), b_high = std::max(b_high, dot(n, c - p));
  return std::max(b_low - a_high, a_low - b_high) / size;
}

/// Returns whether planes across a face, or across an edge of each, are so far apart.
bool are_parted(const TriangleD& a, const TriangleD& b, const Vec3d& p, double distance) {
  const auto edge = [](const TriangleD& t, std::size_t k) { return t[(k + 1) % 3] - t[k]; };
  const auto parts = [&](const Vec3d& n) { return between(a, b, p, n) >= distance; };
  if (parts(cross(edge(a, 0), edge(a, 1))) || parts(cross(edge(b, 0), edge(b, 1)))) return true;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (parts(cross(edge(a, i), edge(b, j)))) return true;
    }
  }
  return false;
}

}  // namespace

Answer keeps_gap(const TriangleD& a, const TriangleD& b, double margin) {
  const Nearest nearest = nearest_of(a, b);
  const Vec3d& p = nearest.on_a;
  // The nearest points are rounded as the coordinates are, however small the triangles are. So the error has a second
  // part, which is relative to the largest coordinate.
  double far = 0;
  for (std::size_t i = 0; i < 3; ++i) far = std::max({far, std::abs(p[i]), std::abs(nearest.on_b[i])});
  const double rounding = kRounding * (size_around(p, a, b) + nearest.distance) + 0x1p-48 * far;
  if (nearest.distance < margin - rounding) return Answer::refuted;
  const double least = margin + kRounding * (size_around(p, a, b) + nearest.distance);
  const bool parted = between(a, b, p, nearest.on_b - p) >= least || are_parted(a, b, p, least);
  return parted ? Answer::proven : Answer::undecided;
}

GapAnswer keeps_gap(const TriangleD& t, const TriangleBvh& surface, double margin) {
  GapAnswer all;
  surface.visit(box_around(t, margin), [&](const TriangleBvh::Item& item) {
    const Answer answer = keeps_gap(t, item.corners, margin);
    if (answer == Answer::refuted ||
        (answer == Answer::undecided && (all.answer == Answer::proven || item.id < all.item)))
      all = {answer, item.id};
    return answer == Answer::refuted;  // the next triangle would not change the answer
  });
  return all;
}

double gap_within(const TriangleD& t, const TriangleBvh& surface, double most) {
  double least = std::min(most, std::sqrt(surface.nearest(t[0]).distance_squared));
  surface.visit(box_around(t, least), [&](const TriangleBvh::Item& item) {
    least = std::min(least, nearest_of(t, item.corners).distance);
    return false;
  });
  return least;
}

namespace {

constexpr double kGapRounding = 0x1p-40;  // share of sizes and coordinates; keeps_gap() errs by about 1e-14 of these

struct ClearanceBatch {
  std::uint64_t first = 0;
  std::vector<TriangleD> triangles;
  ClearanceReport result;
};

/// Returns whether cells inside the surface hold all points nearer to the triangle than the distance. Within its own
/// rounding beyond the distance keeps_gap() decides nothing, and the cells must decide nothing there, either.
bool is_deep_inside(const Surface& surface, const InsideCells& cells, const TriangleD& t, double distance) {
  const Bounds3d near = box_around(t, distance);
  double far = surface.bounds().diagonal() + near.diagonal();
  for (std::size_t i = 0; i < 3; ++i) far = std::max({far, std::abs(near.min[i]), std::abs(near.max[i])});
  return cells.hold(box_around(t, distance + kGapRounding * far));
}

/// Adds the triangle to `found` unless it keeps the distance.
void look_at(const WeldedMesh& mesh, const Surface& surface, const InsideCells* cells, std::uint64_t number,
             const TriangleD& t, double distance, std::size_t max_examples, Finding& found) {
  if (distance == 0 || (cells != nullptr && is_deep_inside(surface, *cells, t, distance))) return;
  const GapAnswer gap = keeps_gap(t, surface.bvh(), distance);
  if (gap.answer != Answer::proven) found.add({number, mesh.number[surface.triangle(gap.item)], t[0]}, max_examples);
}

/// Tests a triangle of the scene. Corners outside the domain of exact predicates are a finding of their own.
void check_clearance_of(const WeldedMesh& mesh, const Surface& surface, const InsideCells* cells,
                        const ClearanceQuestion& question, ClearanceBatch& batch) {
  for (std::size_t i = 0; i < batch.triangles.size(); ++i) {
    const TriangleD& t = batch.triangles[i];
    if (!std::all_of(t.begin(), t.end(), [](const Vec3d& p) { return in_predicate_domain(p); })) continue;
    const double off = question.off(t);
    look_at(mesh, surface, cells, batch.first + i, t, off, question.max_examples, batch.result.within);
    if (question.margin > 0)
      look_at(mesh, surface, cells, batch.first + i, t, question.margin + off, question.max_examples,
              batch.result.within_margin);
  }
}

}  // namespace

ClearanceReport check_clearance(const WeldedMesh& mesh, const Surface& surface, const InsideCells* cells,
                                TriangleSource& scene, const ClearanceQuestion& question) {
  ClearanceReport all;
  if (surface.bvh().empty()) return all;
  scene.rewind();
  std::uint64_t read = 0;
  pipeline<ClearanceBatch>(
      4 * thread_count(),
      [&](ClearanceBatch& batch) {
        batch.first = read;
        if (!scene.read(batch.triangles)) return false;
        read += batch.triangles.size();
        return true;
      },
      [&](ClearanceBatch& batch) { check_clearance_of(mesh, surface, cells, question, batch); },
      [&](ClearanceBatch& batch) {
        all.within.append(batch.result.within, question.max_examples);
        all.within_margin.append(batch.result.within_margin, question.max_examples);
      });
  return all;
}

bool any_misplaced(const Surface& surface, TriangleSource& scene, const ClearanceQuestion& question, bool inside) {
  constexpr double kRoundings = 1 + 1e-9;  // of a distance in doubles
  if (surface.bvh().empty()) return false;
  scene.rewind();
  for (std::vector<TriangleD> chunk; scene.read(chunk);) {
    const bool found = std::any_of(chunk.begin(), chunk.end(), [&](const TriangleD& t) {
      const double off = question.off(t) * kRoundings;
      return std::any_of(t.begin(), t.end(), [&](const Vec3d& p) {
        return in_predicate_domain(p) && (surface.winding(p) >= 1) == inside &&
               surface.bvh().nearest(p).distance_squared > off * off;
      });
    });
    if (found) return true;
  }
  return false;
}

double most_off(const std::vector<Vec3d>& points, const Rounding& rounding) {
  double most = 0;
  if (!rounding.any()) return most;
  for (const Vec3d& p : points) most = std::max(most, rounding.of({p, p, p}));
  return most;
}

}  // namespace bp
