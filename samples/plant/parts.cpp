#include "samples/plant/parts.h"

#include <algorithm>
#include <map>

namespace plant {

namespace {

constexpr double kPi = 3.14159265358979323846;

/// Taylor sums for |x| <= pi/4: additions and multiplications only, exact to about one rounding.
double sine_sum(double x) {
  double term = x, sum = x;
  for (int k = 1; k < 10; ++k) sum += term *= -x * x / (2 * k * (2 * k + 1));
  return sum;
}
double cosine_sum(double x) {
  double term = 1, sum = 1;
  for (int k = 1; k < 10; ++k) sum += term *= -x * x / (2 * k * (2 * k - 1));
  return sum;
}

/// Returns the line with its corners replaced by curves that begin and end `bend` from each corner.
std::vector<Vec> rounded(const std::vector<Vec>& points, double bend, int steps) {
  if (bend <= 0 || points.size() < 3) return points;
  std::vector<Vec> out{points.front()};
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Vec c = points[i], from = c + unit(points[i - 1] - c) * bend, to = c + unit(points[i + 1] - c) * bend;
    for (int k = 0; k <= steps; ++k) {
      const double t = double(k) / steps;
      out.push_back(from * ((1 - t) * (1 - t)) + c * (2 * t * (1 - t)) + to * (t * t));
    }
  }
  out.push_back(points.back());
  return out;
}

}  // namespace

std::array<Vec, 2> across(Vec axis) {
  const Vec helper = std::abs(axis.y) < 0.9 ? kUp : Vec{0, 0, 1};
  const Vec u = unit(cross(helper, axis));
  return {u, cross(axis, u)};
}

Turn turn(int i, int n) {
  // Reduce to the nearest quarter turn, exactly, in integers.
  const int quarter = (8 * i + n) / (2 * n);
  const double rest = double(4 * i - quarter * n) / (4.0 * n) * 2 * kPi;
  const double c = cosine_sum(rest), s = sine_sum(rest);
  switch (quarter & 3) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

const std::vector<Turn>& turns(int n) {
  static std::map<int, std::vector<Turn>> tables;
  std::vector<Turn>& table = tables[n];
  for (int i = int(table.size()); i < n; ++i) table.push_back(turn(i, n));
  return table;
}

int Parts::sides(int n) const {
  return std::max(5, int(std::lround(n * detail_)));
}

/// Bit i of a corner's number tells whether it lies at the high end of axis i.
void Parts::box_faces() {
  static constexpr std::uint32_t kQuads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                                 {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& q : kQuads) {
    sink_.face(q[0], q[1], q[2]);
    sink_.face(q[0], q[2], q[3]);
  }
}

void Parts::box(Vec lo, Vec hi) {
  const Sink::Wants wants = sink_.part(8, 12);
  if (wants & Sink::vertices) {
    for (int i = 0; i < 8; ++i) sink_.vertex({i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z});
  }
  if (wants & Sink::faces) box_faces();
}

void Parts::beam(Vec a, Vec b, double width, double height) {
  const Sink::Wants wants = sink_.part(8, 12);
  if (wants & Sink::vertices) {
    const auto [u, v] = across(unit(b - a));
    for (int i = 0; i < 8; ++i)
      sink_.vertex((i & 4 ? b : a) + u * ((i & 1 ? 0.5 : -0.5) * width) + v * ((i & 2 ? 0.5 : -0.5) * height));
  }
  if (wants & Sink::faces) box_faces();
}

void Parts::sheet(Vec corner, Vec u, Vec v, int across, int up) {
  const auto row = std::uint32_t(across + 1);
  const Sink::Wants wants = sink_.part(row * std::uint32_t(up + 1), 2 * std::uint32_t(across * up));
  if (wants & Sink::vertices) {
    for (int j = 0; j <= up; ++j) {
      for (int i = 0; i <= across; ++i) sink_.vertex(corner + u * (double(i) / across) + v * (double(j) / up));
    }
  }
  if (wants & Sink::faces) {
    for (std::uint32_t j = 0; j < std::uint32_t(up); ++j) {
      for (std::uint32_t i = 0; i < std::uint32_t(across); ++i) {
        const std::uint32_t a = j * row + i;
        sink_.face(a, a + 1, a + row + 1);
        sink_.face(a, a + row + 1, a + row);
      }
    }
  }
}

void Parts::zigzag(Vec corner, Vec u, Vec v, int waves, Vec rise) {
  const auto columns = std::uint32_t(2 * waves + 1);
  const Sink::Wants wants = sink_.part(2 * columns, 2 * (columns - 1));
  if (wants & Sink::vertices) {
    for (std::uint32_t i = 0; i < columns; ++i) {
      const Vec p = corner + u * (double(i) / (columns - 1)) + rise * double(i & 1);
      sink_.vertex(p);
      sink_.vertex(p + v);
    }
  }
  if (wants & Sink::faces) {
    for (std::uint32_t i = 0; i + 1 < columns; ++i) {
      sink_.face(2 * i, 2 * i + 2, 2 * i + 3);
      sink_.face(2 * i, 2 * i + 3, 2 * i + 1);
    }
  }
}

void Parts::lathe(Vec base, Vec axis, const std::vector<std::array<double, 2>>& profile, int sides, bool loop) {
  const auto n = std::uint32_t(sides);
  const std::size_t rings = profile.size(), bands = loop ? rings : rings - 1;
  const auto ring_size = [&](std::size_t i) { return profile[i % rings][0] > 0 ? n : 1u; };
  std::uint32_t vertex_count = 0, triangle_count = 0;
  for (std::size_t i = 0; i < rings; ++i) vertex_count += ring_size(i);
  for (std::size_t i = 0; i < bands; ++i) triangle_count += ring_size(i) == ring_size(i + 1) ? 2 * n : n;
  const Sink::Wants wants = sink_.part(vertex_count, triangle_count);
  if (wants & Sink::vertices) {
    const auto [u, v] = across(axis);
    const std::vector<Turn>& table = turns(sides);
    for (const auto& [radius, height] : profile) {
      for (int j = 0; j < (radius > 0 ? sides : 1); ++j) {
        const Turn t = table[std::size_t(j)];
        sink_.vertex(base + axis * height + u * (radius * t.cosine) + v * (radius * t.sine));
      }
    }
  }
  if (!(wants & Sink::faces)) return;
  std::uint32_t first = 0;
  for (std::size_t i = 0; i < bands; ++i) {
    const std::uint32_t low = ring_size(i), high = ring_size(i + 1), second = i + 1 == rings ? 0 : first + low;
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t k = (j + 1) % n, a = first + j % low, b = first + k % low, c = second + k % high,
                          d = second + j % high;
      if (low > 1) sink_.face(a, b, c);
      if (high > 1) sink_.face(a, c, d);
    }
    first += low;
  }
}

void Parts::cylinder(Vec base, Vec axis, double radius, double length, int sides) {
  lathe(base, axis, {{0, 0}, {radius, 0}, {radius, length}, {0, length}}, sides);
}

void Parts::ring(Vec center, Vec axis, double radius, double thickness, int sides, int around) {
  std::vector<std::array<double, 2>> profile;
  for (int i = 0; i < around; ++i) {
    const Turn t = turn(i, around);
    profile.push_back({radius + thickness * t.cosine, thickness * t.sine});
  }
  lathe(center, axis, profile, sides, true);
}

void Parts::tube(const std::vector<Vec>& points, double radius, int sides, double bend, bool capped) {
  const std::vector<Vec> path = rounded(points, bend, std::max(2, int(std::lround(3 * detail_))));
  const auto n = std::uint32_t(sides), rings = std::uint32_t(path.size());
  const Sink::Wants wants = sink_.part(n * rings, 2 * n * (rings - 1) + (capped ? 2 * (n - 2) : 0));
  if (wants & Sink::vertices) {
    Vec u{};
    const std::vector<Turn>& table = turns(sides);
    for (std::size_t i = 0; i < path.size(); ++i) {
      const Vec along = unit(path[std::min(i + 1, path.size() - 1)] - path[i > 0 ? i - 1 : 0]);
      u = i == 0 ? across(along)[0] : unit(u - along * dot(u, along));  // carried along without twist
      const Vec v = cross(along, u);
      for (const Turn t : table) {
        sink_.vertex(path[i] + u * (radius * t.cosine) + v * (radius * t.sine));
      }
    }
  }
  if (!(wants & Sink::faces)) return;
  for (std::uint32_t i = 0; i + 1 < rings; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t k = (j + 1) % n, a = i * n;
      sink_.face(a + j, a + k, a + n + k);
      sink_.face(a + j, a + n + k, a + n + j);
    }
  }
  for (std::uint32_t j = 2; capped && j < n; ++j) {
    const std::uint32_t last = (rings - 1) * n;
    sink_.face(0, j, j - 1);
    sink_.face(last, last + j - 1, last + j);
  }
}

void Parts::cable(Vec a, Vec b, double sag, double radius) {
  const int steps = sides(8);
  std::vector<Vec> points;
  for (int i = 0; i <= steps; ++i) {
    const double t = double(i) / steps;
    points.push_back(a + (b - a) * t - kUp * (4 * sag * t * (1 - t)));
  }
  tube(points, radius, 5);
}

}  // namespace plant
