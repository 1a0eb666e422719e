#include "lib/hulls/detail/solid_cell.h"

#include <algorithm>
#include <map>
#include <optional>

#include "lib/mesh/lattice_geometry.h"

namespace bp {

namespace {

/// A number on a line: num / den, den > 0.
struct Ratio {
  int128 num, den;
  [[nodiscard]] bool operator<(const Ratio& o) const { return num * o.den < o.num * den; }
  [[nodiscard]] std::int64_t below() const { return std::int64_t(floor_div<int128>(num, den)); }
  [[nodiscard]] std::int64_t above() const { return std::int64_t(ceil_div<int128>(num, den)); }
};

/// The lattice coordinates around a number. It is one coordinate if the number is whole, or if the nearest suffices.
struct Around {
  std::int64_t low, high;
  Around(const Ratio& x, SolidCell::Rounding rounding) : low(x.below()), high(x.above()) {
    if (rounding == SolidCell::Rounding::nearest) low = high = Ratio{2 * x.num + x.den, 2 * x.den}.below();
  }
};

void add_corners(const std::array<Around, 3>& around, std::vector<LatticeCoord>& out) {
  for (int i = 0; i < 8; ++i) {
    LatticeCoord p;
    bool repeated = false;
    for (int k = 0; k < 3; ++k) {
      const Around& a = around[std::size_t(k)];
      p[k] = (i >> k & 1) != 0 ? a.high : a.low;
      repeated |= (i >> k & 1) != 0 && a.high == a.low;
    }
    if (!repeated) out.push_back(p);
  }
}

/// A line parallel to an axis, at (u + 1/2, v + 1/2) in the two other axes. It is moved by an infinitesimal along u,
/// and by a far smaller one along v, so that it meets no vertex and no edge.
struct Line {
  int axis;
  std::int64_t u, v;
  [[nodiscard]] int u_axis() const { return (axis + 1) % 3; }
  [[nodiscard]] int v_axis() const { return (axis + 2) % 3; }

  /// Returns twice the area of (a, b, line), times four for the half units.
  [[nodiscard]] int128 turn(const LatticeCoord& a, const LatticeCoord& b) const {
    const int i = u_axis(), j = v_axis();
    return int128(b[i] - a[i]) * (2 * (v - a[j]) + 1) - int128(b[j] - a[j]) * (2 * (u - a[i]) + 1);
  }
  [[nodiscard]] int side(const LatticeCoord& a, const LatticeCoord& b) const {
    const int s = sign_of(turn(a, b));
    if (s != 0) return s;
    const std::int64_t along_u = a[v_axis()] - b[v_axis()];
    return along_u != 0 ? sign_of(along_u) : sign_of(b[u_axis()] - a[u_axis()]);
  }
};

struct Crossing {
  Ratio at;
  int turn;  ///< +1: the face looks along the axis
};

std::optional<Crossing> crossing(const Line& line, const LatticeCoord& a, const LatticeCoord& b,
                                 const LatticeCoord& c) {
  const int turn = line.side(a, b);
  if (turn == 0 || line.side(b, c) != turn || line.side(c, a) != turn) return {};
  int128 wa = line.turn(b, c), wb = line.turn(c, a), wc = line.turn(a, b), sum = wa + wb + wc;
  if (sum == 0) return {};
  if (sum < 0) wa = -wa, wb = -wb, wc = -wc, sum = -sum;
  const LatticeCoord ab = b - a, ac = c - a;  // they are small, for the products
  return Crossing{{a[line.axis] * sum + wb * ab[line.axis] + wc * ac[line.axis], sum}, turn};
}

/// The range in which segment ab lies in the cell, as shares of ab; nothing if it misses the cell.
struct Span {
  Ratio enter{0, 1}, leave{1, 1};
};

std::optional<Span> span_within(const LatticeBox& cell, const LatticeCoord& a, const LatticeCoord& b) {
  for (int i = 0; i < 3; ++i) {
    if (std::max(a[i], b[i]) < cell.min[i] || std::min(a[i], b[i]) > cell.max[i]) return {};
  }
  Span span;
  for (int i = 0; i < 3; ++i) {
    const std::int64_t d = b[i] - a[i];
    const std::int64_t near = d < 0 ? 2 * cell.max[i] + 1 : 2 * cell.min[i] - 1;
    const std::int64_t far = d < 0 ? 2 * cell.min[i] - 1 : 2 * cell.max[i] + 1;
    if (d == 0) continue;
    const int128 sign = d < 0 ? -1 : 1, length = 2 * sign * d;
    const Ratio enter{sign * (near - 2 * a[i]), length}, leave{sign * (far - 2 * a[i]), length};
    if (span.enter < enter) span.enter = enter;
    if (leave < span.leave) span.leave = leave;
  }
  if (span.leave < span.enter) return {};
  return span;
}

void add_point_at(const LatticeCoord& a, const LatticeCoord& b, const Ratio& t, SolidCell::Rounding rounding,
                  std::vector<LatticeCoord>& out) {
  const auto at = [&](int i) { return Around({a[i] * t.den + (b[i] - a[i]) * t.num, t.den}, rounding); };
  add_corners({at(0), at(1), at(2)}, out);
}

bool meets_seen_along(const LatticeBox& a, const LatticeBox& b, int axis) {
  for (const int i : {(axis + 1) % 3, (axis + 2) % 3}) {
    if (a.min[i] > b.max[i] + 1 || b.min[i] > a.max[i] + 1) return false;
  }
  return true;
}

/// A convex polygon while it is cut, in floating point.
using Polygon = std::vector<Vec3d>;

/// Returns the part with sign * p[axis] <= sign * at.
Polygon cut(const Polygon& polygon, std::size_t axis, double at, double sign) {
  Polygon kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3d &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    const double dp = sign * (at - p[axis]), dq = sign * (at - q[axis]);
    if (dp >= 0) kept.push_back(p);
    if ((dp < 0) != (dq < 0)) kept.push_back(p + (dp / (dp - dq)) * (q - p));
  }
  return kept;
}

/// Returns the integral of x - low, with x clamped to [low, high], over the polygon seen along x, times six. Summed
/// over the faces it is the volume between low and high.
double volume6_under(const Polygon& polygon, double low, double high) {
  double sum = 0;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    const Vec3d &a = polygon[0], &b = polygon[k], &c = polygon[k + 1];
    const double area2 = (b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]);
    sum += area2 * (std::clamp(a[0], low, high) + std::clamp(b[0], low, high) + std::clamp(c[0], low, high) - 3 * low);
  }
  return sum;
}

}  // namespace

SolidCell::SolidCell(LatticeMesh mesh) : cell_(box_of(mesh.vertices)) {
  Surface surface{std::move(mesh), {}};
  const std::vector<LatticeCoord>& p = surface.mesh.vertices;
  for (const auto& [a, b, c] : surface.mesh.triangles) {
    faces_.push_back(std::uint32_t(faces_.size()));
    surface.boxes.push_back(box_of(p[a], p[b], p[c]));
  }
  tubes_ = {faces_, faces_, faces_};
  surface_ = std::make_shared<const Surface>(std::move(surface));
}

bool SolidCell::holds_vertex(const LatticeCoord& p) const {
  return cell_.holds({p, p});
}

SolidCell SolidCell::within(const LatticeBox& cell) const {
  SolidCell part(*this);
  part.cell_ = cell;
  for (int axis = 0; axis < 3; ++axis) {
    std::erase_if(part.tubes_[std::size_t(axis)],
                  [&](std::uint32_t f) { return !meets_seen_along(surface_->boxes[f], cell, axis); });
  }
  std::erase_if(part.faces_, [&](std::uint32_t f) {
    return !meets_seen_along(surface_->boxes[f], cell, 0) || !meets_seen_along(surface_->boxes[f], cell, 1);
  });
  return part;
}

bool SolidCell::holds(const LatticeCoord& p) const {
  const Line line{2, p.x, p.y};
  int above = 0;
  for (const auto& [a, b, c] : surface_->mesh.triangles) {
    const auto cross =
        crossing(line, surface_->mesh.vertices[a], surface_->mesh.vertices[b], surface_->mesh.vertices[c]);
    if (cross && Ratio{2 * p.z + 1, 2} < cross->at) above += cross->turn;
  }
  return above != 0;
}

std::vector<LatticeCoord> SolidCell::points(Rounding rounding) const {
  std::vector<LatticeCoord> out;
  add_edge_points(rounding, out);
  add_side_points(rounding, out);
  return out;
}

void SolidCell::add_edge_points(Rounding rounding, std::vector<LatticeCoord>& out) const {
  const std::vector<LatticeCoord>& p = surface_->mesh.vertices;
  std::vector<char> added(p.size(), 0);
  for (const std::uint32_t f : faces_) {
    const Face& t = surface_->mesh.triangles[f];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      const bool holds_a = holds_vertex(p[a]), holds_b = holds_vertex(p[b]);
      if (holds_a && added[a] == 0) added[a] = 1, out.push_back(p[a]);
      if ((holds_a && holds_b) || a > b) continue;  // the adjacent face has the edge, too
      const std::optional<Span> span = span_within(cell_, p[a], p[b]);
      if (!span) continue;
      if (!holds_a) add_point_at(p[a], p[b], span->enter, rounding, out);
      if (!holds_b) add_point_at(p[a], p[b], span->leave, rounding, out);
    }
  }
}

void SolidCell::add_side_points(Rounding rounding, std::vector<LatticeCoord>& out) const {
  for (int axis = 0; axis < 3; ++axis) {
    const Ratio low{2 * cell_.min[axis] - 1, 2}, high{2 * cell_.max[axis] + 1, 2};
    for (int i = 0; i < 4; ++i) {
      Line line{axis, 0, 0};
      line.u = (i & 1) != 0 ? cell_.max[line.u_axis()] : cell_.min[line.u_axis()] - 1;
      line.v = (i & 2) != 0 ? cell_.max[line.v_axis()] : cell_.min[line.v_axis()] - 1;
      const auto add = [&](const Ratio& at) {
        const Around z(at, rounding), u({2 * line.u + 1, 2}, rounding), v({2 * line.v + 1, 2}, rounding);
        std::array<Around, 3> around{z, z, z};
        around[std::size_t(line.u_axis())] = u, around[std::size_t(line.v_axis())] = v;
        add_corners(around, out);
      };
      // Numbers of faces at which the line leaves the solid, less those at which it enters.
      int above_low = 0, above_high = 0;
      for (const std::uint32_t f : tubes_[std::size_t(axis)]) {
        const LatticeBox box = surface_->boxes[f];
        if (box.min[line.u_axis()] > line.u + 1 || box.max[line.u_axis()] < line.u ||
            box.min[line.v_axis()] > line.v + 1 || box.max[line.v_axis()] < line.v)
          continue;
        const Face& t = surface_->mesh.triangles[f];
        const auto cross =
            crossing(line, surface_->mesh.vertices[t[0]], surface_->mesh.vertices[t[1]], surface_->mesh.vertices[t[2]]);
        if (!cross) continue;
        if (low < cross->at) above_low += cross->turn;
        if (high < cross->at) above_high += cross->turn;
        if (!(cross->at < low) && !(high < cross->at)) add(cross->at);
      }
      if (axis != 2) continue;  // each corner once, always by the same line
      if (above_low != 0) add(low);
      if (above_high != 0) add(high);
    }
  }
}

double SolidCell::volume6() const {
  const Vec3d half{0.5, 0.5, 0.5}, low = to_double(cell_.min) - half, high = to_double(cell_.max) + half;
  double sum = 0;
  Polygon polygon;
  for (const std::uint32_t f : tubes_[0]) {
    polygon.clear();
    for (const std::uint32_t v : surface_->mesh.triangles[f]) polygon.push_back(to_double(surface_->mesh.vertices[v]));
    const LatticeBox box = surface_->boxes[f];
    for (int axis = 1; axis < 3; ++axis) {
      if (box.min[axis] < cell_.min[axis]) polygon = cut(polygon, std::size_t(axis), low[std::size_t(axis)], -1);
      if (box.max[axis] > cell_.max[axis]) polygon = cut(polygon, std::size_t(axis), high[std::size_t(axis)], 1);
    }
    if (box.max.x < cell_.min.x) continue;  // all of it is clamped to the lower end
    if (box.min.x < cell_.min.x) polygon = cut(polygon, 0, low[0], -1);
    if (box.min.x <= cell_.max.x && box.max.x > cell_.max.x) {
      sum += volume6_under(cut(polygon, 0, high[0], -1), low[0], high[0]);
      polygon = cut(polygon, 0, high[0], 1);
    }
    sum += volume6_under(polygon, low[0], high[0]);
  }
  return sum;
}

std::vector<SolidCell::Step> SolidCell::steps(int axis) const {
  std::map<std::int64_t, double> weight;
  const std::int64_t reach = std::max<std::int64_t>(1, (cell_.max[axis] - cell_.min[axis]) / 32);
  for (const std::uint32_t f : faces_) {
    const LatticeBox box = surface_->boxes[f];
    if (box.max[axis] - box.min[axis] > reach) continue;
    const Face& t = surface_->mesh.triangles[f];
    const LatticeCoord normal =
        normal_of(surface_->mesh.vertices[t[0]], surface_->mesh.vertices[t[1]], surface_->mesh.vertices[t[2]]);
    if (normal[axis] > 0) weight[box.max[axis]] += double(normal[axis]);      // the solid ends there,
    if (normal[axis] < 0) weight[box.min[axis] - 1] -= double(normal[axis]);  // or begins
  }
  std::vector<Step> found;
  for (const auto& [at, area] : weight) {
    if (at >= cell_.min[axis] && at < cell_.max[axis]) found.push_back({at, area});
  }
  return found;
}

}  // namespace bp
