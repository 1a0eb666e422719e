// Source: Sutherland and Hodgman, Reentrant Polygon Clipping, 1974. One side of the square is cut after the other.
#include "lib/image/clip.h"

#include <cmath>

#include "lib/core/vec3.h"

namespace bp {

namespace {

struct Corner {
  Vec3d p;
  std::array<double, 3> light;
};

/// A side of the square: the axis that it crosses, and the outward direction.
struct Side {
  std::size_t axis;
  double sign;
};
constexpr Side kSides[] = {{0, -1}, {0, 1}, {1, -1}, {1, 1}};

bool inside(const Vec3d& p, Side side, double limit) {
  return side.sign * p[side.axis] <= limit;
}

Corner crossing(const Corner& a, const Corner& b, Side side, double limit) {
  if (b.p < a.p) return crossing(b, a, side, limit);  // gives the same point for the triangle on the edge's other side
  const double at = side.sign * limit, s = (at - a.p[side.axis]) / (b.p[side.axis] - a.p[side.axis]);
  Corner c;
  for (std::size_t i = 0; i < 3; ++i) {
    c.p[i] = a.p[i] + s * (b.p[i] - a.p[i]);
    c.light[i] = a.light[i] + s * (b.light[i] - a.light[i]);
  }
  c.p[side.axis] = at;
  return c;
}

std::vector<Corner> clip(const std::vector<Corner>& polygon, Side side, double limit) {
  std::vector<Corner> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const bool a_in = inside(a.p, side, limit);
    if (a_in) kept.push_back(a);
    if (a_in != inside(b.p, side, limit)) kept.push_back(crossing(a, b, side, limit));
  }
  return kept;
}

LinearColor color_of(const Corner& c) {
  const auto channel = [](double x) { return std::uint16_t(std::lround(x)); };
  return {channel(c.light[0]), channel(c.light[1]), channel(c.light[2])};
}

}  // namespace

std::vector<ClippedTriangle> clip(const TriangleD& t, const TriangleColors& colors, double limit) {
  std::vector<Corner> polygon;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!is_finite(t[k])) return {};
    polygon.push_back({t[k], {double(colors[k].r), double(colors[k].g), double(colors[k].b)}});
  }
  for (const Side side : kSides) polygon = clip(polygon, side, limit);
  std::vector<ClippedTriangle> fan;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const Corner &a = polygon[0], &b = polygon[i - 1], &c = polygon[i];
    fan.push_back({{a.p, b.p, c.p}, {color_of(a), color_of(b), color_of(c)}});
  }
  return fan;
}

bool clip(std::array<Vec3d, 2>& line, double limit) {
  if (!is_finite(line[0]) || !is_finite(line[1])) return false;
  for (const Side side : kSides) {
    const bool first = inside(line[0], side, limit), second = inside(line[1], side, limit);
    if (!first && !second) return false;
    if (first && second) continue;
    line[first ? 1 : 0] = crossing({line[0], {}}, {line[1], {}}, side, limit).p;
  }
  return true;
}

}  // namespace bp
