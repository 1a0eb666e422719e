#include <algorithm>

#include "samples/plant/parts.h"

/// Components of equipment, made of solids, sheets and tubes.
namespace plant {

void Parts::flange(Vec center, Vec axis, double radius) {
  cylinder(center - axis * (0.3 * radius), axis, 1.5 * radius, 0.6 * radius, sides(10));
}

void Parts::valve(Vec center, Vec axis, double radius) {
  const double r = radius;
  lathe(center - axis * (2 * r), axis, {{1.1 * r, 0}, {1.7 * r, 1.4 * r}, {1.7 * r, 2.6 * r}, {1.1 * r, 4 * r}},
        sides(10));
  flange(center - axis * (2 * r), axis, r);
  flange(center + axis * (2 * r), axis, r);
  cylinder(center, kUp, 0.3 * r, 5 * r, sides(6));
  ring(center + kUp * (4.6 * r), kUp, 1.6 * r, 0.2 * r, sides(12), sides(4));
  const auto [u, v] = across(kUp);
  beam(center + kUp * (4.6 * r) - u * (1.6 * r), center + kUp * (4.6 * r) + u * (1.6 * r), 0.2 * r, 0.2 * r);
  beam(center + kUp * (4.6 * r) - v * (1.6 * r), center + kUp * (4.6 * r) + v * (1.6 * r), 0.2 * r, 0.2 * r);
}

void Parts::pipe(const std::vector<Vec>& points, double radius) {
  const int n = sides(10);
  tube(points, radius, n, 3 * radius);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec way = points[i + 1] - points[i];
    const double length = std::sqrt(dot(way, way));
    if (length < 12 * radius) continue;
    flange(points[i] + way * (4 * radius / length), way * (1 / length), radius);
    if (random.chance(0.3)) valve(points[i] + way * random.uniform(0.35, 0.65), way * (1 / length), radius);
  }
}

void Parts::pump(Vec at, bool along_x) {
  const Vec axis = along_x ? Vec{1, 0, 0} : Vec{0, 0, 1}, side = cross(kUp, axis);
  const Vec middle = at + kUp * 0.8;
  box(at - Vec{1.4, 0, 1.4} + axis * 0.0, at + Vec{1.4, 0.3, 1.4});
  cylinder(middle - axis * 1.3, axis, 0.42, 1.2, sides(12));
  for (int i = 0; i < 6; ++i) ring(middle - axis * (1.2 - 0.18 * i), axis, 0.44, 0.03, sides(12), 4);
  cylinder(middle - axis * 0.1, axis, 0.09, 0.5, sides(8));
  lathe(middle + axis * 0.3, axis, {{0, 0}, {0.35, 0}, {0.55, 0.15}, {0.55, 0.45}, {0.35, 0.6}, {0, 0.6}}, sides(14));
  beam(at + axis * 0.6 + kUp * 0.3, at + axis * 0.6 + kUp * 0.6, 0.5, 0.5);
  pipe({middle + axis * 0.8, middle + axis * 2.2, middle + axis * 2.2 + kUp * 1.5}, 0.14);
  pipe({middle + axis * 0.6 + kUp * 0.4, middle + axis * 0.6 + kUp * 2.4, middle + axis * 0.6 + kUp * 2.4 + side * 1.6},
       0.12);
}

void Parts::ladder(Vec foot, double height, Vec outward, bool caged) {
  const Vec side = cross(kUp, outward) * 0.25;
  beam(foot - side, foot - side + kUp * (height + 1), 0.05, 0.08);
  beam(foot + side, foot + side + kUp * (height + 1), 0.05, 0.08);
  for (double y = 0.3; y < height; y += 0.3) tube({foot - side + kUp * y, foot + side + kUp * y}, 0.015, 5);
  for (double y = 2.4; caged && y < height; y += 0.9) {
    std::vector<Vec> hoop;
    for (int i = 0; i <= 6; ++i) {
      const Turn t = turn(i, 12);
      hoop.push_back(foot + kUp * y + unit(side) * (0.38 * t.cosine) + outward * (0.7 * t.sine));
    }
    tube(hoop, 0.02, 5);
  }
  for (int i = 2; caged && height > 3 && i <= 4; ++i) {
    const Turn t = turn(i, 12);
    const Vec p = foot + unit(side) * (0.38 * t.cosine) + outward * (0.7 * t.sine);
    beam(p + kUp * 2.4, p + kUp * (height + 1), 0.04, 0.01);
  }
}

void Parts::railing(const std::vector<Vec>& points) {
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec a = points[i], b = points[i + 1];
    const double length = std::sqrt(dot(b - a, b - a));
    const int posts = std::max(1, int(length / 1.5));
    for (int k = 0; k <= posts; ++k) {
      const Vec p = a + (b - a) * (double(k) / posts);
      beam(p, p + kUp * 1.1, 0.05, 0.05);
    }
    for (const double y : {0.55, 1.1}) tube({a + kUp * y, b + kUp * y}, 0.024, 5, 0, true);
    beam(a + kUp * 0.08, b + kUp * 0.08, 0.01, 0.15);
  }
}

void Parts::stairs(Vec foot, Vec run, double rise, double width) {
  const Vec along = unit(run), side = cross(kUp, along) * (width / 2), top = foot + run + kUp * rise;
  beam(foot - side, top - side, 0.06, 0.25);
  beam(foot + side, top + side, 0.06, 0.25);
  const int steps = std::max(1, int(rise / 0.19));
  for (int i = 0; i < steps; ++i) {
    const Vec p = foot + (top - foot) * ((i + 0.5) / steps);
    beam(p - side, p + side, 0.26, 0.04);
  }
  railing({foot - side, top - side});
  railing({foot + side, top + side});
}

void Parts::platform(Vec lo, double dx, double dz, bool railed) {
  const Vec x{dx, 0, 0}, z{0, 0, dz};
  for (const auto& [a, b] : {std::array<Vec, 2>{lo, lo + x}, {lo + z, lo + x + z}, {lo, lo + z}, {lo + x, lo + x + z}})
    beam(a - kUp * 0.1, b - kUp * 0.1, 0.12, 0.2);
  const int bars = std::max(2, int(dx / 0.25));
  for (int i = 1; i < bars; ++i) {
    const Vec p = lo + x * (double(i) / bars);
    beam(p, p + z, 0.02, 0.05);
  }
  for (double t = 1; t < dz; t += 1) beam(lo + Vec{0, -0.03, t}, lo + x + Vec{0, -0.03, t}, 0.03, 0.04);
  if (railed) railing({lo, lo + x, lo + x + z, lo + z, lo});
}

void Parts::wall(Vec corner, Vec along, double length, double height, int openings, bool door) {
  const Vec thickness = cross(along, kUp) * 0.2;
  const auto panel = [&](double from, double to, double bottom, double top) {
    const Vec a = corner + along * from + kUp * bottom, b = corner + along * to + kUp * top + thickness;
    box({std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)},
        {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)});
  };
  const double bay = length / openings;
  for (int i = 0; i < openings; ++i) {
    const bool is_door = door && i == openings / 2;
    const double from = i * bay, lo = from + bay * 0.25, hi = from + bay * 0.75;
    const double sill = is_door ? 0 : height * 0.35, lintel = is_door ? height * 0.8 : height * 0.6;
    panel(from, lo, 0, height);
    panel(hi, from + bay, 0, height);
    panel(lo, hi, lintel, height);
    if (is_door) continue;
    panel(lo, hi, 0, sill);
    panel((lo + hi) / 2 - 0.04, (lo + hi) / 2 + 0.04, sill, lintel);  // a mullion; there is no glass
  }
}

void Parts::drum(Vec at) {
  lathe(at, kUp,
        {{0, 0.02},
         {0.28, 0.02},
         {0.29, 0},
         {0.29, 0.29},
         {0.31, 0.3},
         {0.29, 0.31},
         {0.29, 0.58},
         {0.31, 0.59},
         {0.29, 0.6},
         {0.29, 0.88},
         {0.28, 0.86},
         {0, 0.86}},
        sides(10));
}

void Parts::tank(Vec center, double radius, double height, bool dome) {
  const int n = sides(28);
  std::vector<std::array<double, 2>> profile{{0, 0}, {radius, 0}};
  const int courses = std::max(2, int(height / 2.4));
  for (int i = 1; i <= courses; ++i) profile.push_back({radius, height * i / courses});
  for (int i = 1; i < 4; ++i) {
    const double t = i / 4.0;
    profile.push_back({radius * (1 - t), height + (dome ? 0.25 * radius * t * (2 - t) : 0.12 * radius * t)});
  }
  profile.push_back({0, height + (dome ? 0.25 : 0.12) * radius});
  lathe(center, kUp, profile, n);
  for (int i = 1; i < courses; i += 2) ring(center + kUp * (height * i / courses), kUp, radius, 0.08, n, 4);
  const int posts = std::max(12, int(radius * 4));
  // Stairs wind up the shell.
  const int steps = int(height / 0.2);
  for (int i = 0; i < steps; ++i) {
    const Turn t = turn(i, 3 * steps);
    const Vec out{t.cosine, 0, t.sine}, p = center + out * radius + kUp * (height * i / steps);
    beam(p, p + out * 0.9, 0.28, 0.04);
    if (i % 4 == 0) beam(p + out * 0.88, p + out * 0.88 + kUp * 1.1, 0.05, 0.05);
  }
  std::vector<Vec> rail, stair_rail;
  for (int i = 0; i <= posts; ++i) {
    const Turn t = turn(i, posts), s = turn(i, 3 * posts);
    rail.push_back(center + Vec{t.cosine * radius * 0.98, height, t.sine * radius * 0.98});
    stair_rail.push_back(center + Vec{s.cosine * (radius + 0.88), height * i / posts + 1.1, s.sine * (radius + 0.88)});
  }
  railing(rail);
  tube(stair_rail, 0.03, 5, 0, true);
  cylinder(center + kUp * height, kUp, 0.4, 0.3 * radius, sides(10));
  for (int i = 0; i < 3; ++i) {
    const Turn t = turn(2 * i + 7, 18);
    const Vec out{t.cosine, 0, t.sine};
    pipe({center + out * (radius - 0.2) + kUp * 0.8, center + out * (radius + 3) + kUp * 0.8}, 0.2);
  }
}

void Parts::column(Vec center, double radius, double height) {
  cylinder(center, kUp, radius * 1.3, 0.6, sides(16));
  std::vector<std::array<double, 2>> profile{{radius * 1.2, 0.6}, {radius, 3}};
  const int courses = std::max(3, int(height / 3));
  for (int i = 1; i <= courses; ++i) profile.push_back({radius, 3 + (height - 3) * i / courses});
  for (int i = 1; i < 4; ++i) {
    const Turn t = turn(i, 16);
    profile.push_back({radius * t.cosine, height + 0.5 * radius * t.sine});
  }
  profile.push_back({0, height + 0.5 * radius});
  lathe(center, kUp, profile, sides(18));
  Vec foot = center + Vec{radius + 0.25, 0, 0};
  const double storey = 7;
  for (double y = storey; y < height; y += storey) {
    ladder(foot, storey, foot.x > center.x ? Vec{1, 0, 0} : Vec{-1, 0, 0}, true);
    std::vector<Vec> rail;
    const int posts = 10;
    for (int i = 0; i <= posts; ++i) {
      const Turn t = turn(i, posts);
      rail.push_back(center + Vec{t.cosine * (radius + 1.4), y, t.sine * (radius + 1.4)});
    }
    railing(rail);
    lathe(center, kUp, {{radius - 0.05, y - 0.1}, {radius + 1.45, y - 0.1}, {radius + 1.45, y}, {radius - 0.05, y}},
          sides(18), true);
    for (int i = 0; i < 6; ++i) {
      const Turn t = turn(i, 6);
      const Vec out{t.cosine, 0, t.sine};
      beam(center + out * radius + kUp * (y - 1), center + out * (radius + 1.3) + kUp * (y - 0.1), 0.08, 0.08);
      if (i % 2 == 1) flange(center + out * (radius + 0.2) + kUp * (y + 2), out, 0.2);
    }
    foot = Vec{2 * center.x - foot.x, y, center.z};
  }
  const Turn t = turn(random.integer(1, 15), 16);
  const Vec out{t.cosine, 0, t.sine};
  const Vec side = out * (radius + 0.4);
  pipe({center + kUp * (height + 0.4 * radius), center + kUp * (height + 1.5 + 0.4 * radius),
        center + side + out * 0.8 + kUp * (height + 1.5 + 0.4 * radius), center + side + out * 0.8 + kUp * 1.0},
       0.18);
}

void Parts::vessel(Vec center, Vec axis, double radius, double length) {
  std::vector<std::array<double, 2>> profile{{0, -length / 2 - 0.5 * radius}};
  for (int i = 3; i >= 0; --i) {
    const Turn t = turn(i, 16);
    profile.push_back({radius * t.cosine, -length / 2 - 0.5 * radius * t.sine});
  }
  for (int i = 0; i <= 3; ++i) {
    const Turn t = turn(i, 16);
    profile.push_back({radius * t.cosine, length / 2 + 0.5 * radius * t.sine});
  }
  profile.push_back({0, length / 2 + 0.5 * radius});
  lathe(center, axis, profile, sides(16));
  for (const double at : {-0.3, 0.3}) {
    const Vec p = center + axis * (at * length);
    ring(p, axis, radius, 0.06, sides(16), 4);
    beam({p.x, 0, p.z}, {p.x, p.y - 0.6 * radius, p.z}, 0.4, 1.4 * radius);
    beam({p.x, 0, p.z}, {p.x, 0.3, p.z}, 2 * radius, 2 * radius);
  }
  for (const double at : {-0.4, 0.0, 0.35}) {
    const Vec p = center + axis * (at * length) + kUp * (radius * 0.95);
    pipe({p, p + kUp * random.uniform(1, 2)}, 0.12);
    flange(p + kUp * 0.5, kUp, 0.2);
  }
}

void Parts::sphere_tank(Vec center, double radius) {
  const int n = sides(28), stacks = sides(14);
  std::vector<std::array<double, 2>> profile;
  for (int i = 0; i <= stacks; ++i) {
    const Turn t = turn(i, 2 * stacks);
    profile.push_back({i == 0 || i == stacks ? 0 : radius * t.sine, -radius * t.cosine});
  }
  const Vec middle = center + kUp * (radius * 1.3);
  lathe(middle, kUp, profile, n);
  for (int i = 0; i < 10; ++i) {
    const Turn t = turn(i, 10), s = turn(i + 1, 10);
    const Vec leg = center + Vec{t.cosine * radius, 0, t.sine * radius},
              next = center + Vec{s.cosine * radius, 0, s.sine * radius};
    cylinder(leg, kUp, 0.3, radius * 1.3, sides(8));
    beam(leg + kUp * 0.5, next + kUp * radius, 0.08, 0.08);
    beam(leg + kUp * radius, next + kUp * 0.5, 0.08, 0.08);
  }
  platform(middle + Vec{-1.5, radius + 0.2, -1.5}, 3, 3, true);
  stairs(center + Vec{radius * 1.6, 0, -1}, Vec{-radius * 1.1, 0, 0} + Vec{0, 0, 0}, radius * 2.35, 0.9);
  pipe({middle - kUp * (radius - 0.1), center + kUp * 0.8, center + Vec{0, 0.8, radius * 1.5}}, 0.25);
}

void Parts::silo(Vec center, double radius, double height) {
  lathe(center, kUp,
        {{0.3, 1.5},
         {radius, 4.5},
         {radius, height * 0.5},
         {radius, height},
         {0.5, height + 0.4 * radius},
         {0, height + 0.4 * radius}},
        sides(22));
  for (double y = 5; y < height; y += 1.2) ring(center + kUp * y, kUp, radius, 0.05, sides(22), 4);
  for (int i = 0; i < 8; ++i) {
    const Turn t = turn(i, 8);
    const Vec leg = center + Vec{t.cosine * radius, 0, t.sine * radius};
    beam(leg, leg + kUp * 4.8, 0.25, 0.25);
  }
  ladder(center + Vec{0, 0, radius + 0.2}, height, {0, 0, 1}, true);
}

void Parts::frame(Vec corner, int bays_x, int bays_z, int levels, double bay, double storey) {
  for (int i = 0; i <= bays_x; ++i) {
    for (int k = 0; k <= bays_z; ++k) {
      const Vec foot = corner + Vec{i * bay, 0, k * bay};
      box(foot - Vec{0.4, 0, 0.4}, foot + Vec{0.4, 0.4, 0.4});
      beam(foot, foot + kUp * (levels * storey + 1.2), 0.3, 0.3);
    }
  }
  for (int level = 1; level <= levels; ++level) {
    const Vec floor = corner + kUp * (level * storey);
    for (int i = 0; i <= bays_x; ++i)
      beam(floor + Vec{i * bay, -0.15, 0}, floor + Vec{i * bay, -0.15, bays_z * bay}, 0.2, 0.3);
    for (int k = 0; k <= bays_z; ++k)
      beam(floor + Vec{0, -0.15, k * bay}, floor + Vec{bays_x * bay, -0.15, k * bay}, 0.2, 0.3);
    for (int i = 0; i < bays_x; ++i) {
      for (int k = 0; k < bays_z; ++k) {
        if (random.chance(0.75)) platform(floor + Vec{i * bay, 0, k * bay}, bay, bay, false);
      }
      beam(floor + Vec{i * bay, -storey, 0}, floor + Vec{(i + 1) * bay, 0, 0}, 0.1, 0.1);  // bracing
    }
    railing({floor, floor + Vec{bays_x * bay, 0, 0}, floor + Vec{bays_x * bay, 0, bays_z * bay},
             floor + Vec{0, 0, bays_z * bay}, floor});
    const Vec flight{bays_x * bay * 0.6, 0, 0};
    const Vec side{0, 0, -0.8};
    level % 2 == 1 ? stairs(floor - kUp * storey + side + Vec{0.5, 0, 0}, flight, storey, 0.9)
                   : stairs(floor - kUp * storey + side + Vec{0.5, 0, 0} + flight, flight * -1, storey, 0.9);
  }
}

}  // namespace plant
