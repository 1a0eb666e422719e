#include "samples/plant/modules.h"

#include "samples/plant/parts.h"

namespace plant {

namespace {

constexpr Vec kX{1, 0, 0}, kZ{0, 0, 1};

void ground(Parts& p) {
  p.box({-0.1, -0.5, -0.1}, {kPlot + 0.1, 0, kPlot + 0.1});
}

void drums(Parts& p, Vec corner, int rows) {
  for (int k = 0; k < rows; ++k) {
    for (int i = 0; i < 20; ++i) p.drum(corner + Vec{0.7 * i, 0, 0.7 * k});
  }
}

/// Steel frames with vessels inside, distillation columns beside them, pumps in front, pipes between all of them.
void process(Parts& p) {
  const int bays = p.random.integer(3, 4), levels = p.random.integer(2, 4);
  p.frame({6, 0, 8}, bays, 3, levels, 6, 5);
  for (int level = 0; level < levels; ++level) {
    for (int i = 0; i < bays; ++i)
      p.vessel({9 + 6.0 * i, level * 5 + 1.8, 17}, kZ, p.random.uniform(0.7, 1.2), p.random.uniform(5, 9));
  }
  const int columns = p.random.integer(3, 4);
  for (int i = 0; i < columns; ++i)
    p.column({38 + 5.5 * i, 0, p.random.uniform(12, 20)}, p.random.uniform(0.9, 1.6), p.random.uniform(22, 40));
  for (int i = 0; i < 9; ++i) p.pump({6 + 5.0 * i, 0, 36}, i % 2 == 0);
  for (int i = 0; i < 24; ++i) {
    const double x = p.random.uniform(6, 30), y = p.random.uniform(2, levels * 5.0), z = p.random.uniform(28, 32);
    const double far = x + p.random.uniform(6, 26), top = y + p.random.uniform(1, 3), front = p.random.uniform(34, 44);
    p.pipe(
        {{x, y, p.random.uniform(10, 24)}, {x, y, z}, {far, y, z}, {far, top, z}, {far, top, front}, {far, 1, front}},
        p.random.uniform(0.06, 0.22));
  }
}

void tanks(Parts& p) {
  for (int i = 0; i < 2; ++i) {
    for (int k = 0; k < 2; ++k) {
      p.tank({15.0 + 30 * i, 0, 13.0 + 24 * k}, p.random.uniform(6.5, 9.5), p.random.uniform(8, 15),
             p.random.chance(0.5));
    }
  }
  for (const double z : {0.8, 25.0, 49.0}) p.box({1, 0, z - 0.2}, {59, 1.5, z + 0.2});  // bund walls
  for (const double x : {1.0, 30.0, 59.0}) p.box({x - 0.2, 0, 0.8}, {x + 0.2, 1.5, 49});
  for (int i = 0; i < 14; ++i) {
    const int layer = i / 7;
    const double z = 23.0 + 0.6 * (i % 7), x = p.random.uniform(3, 10), y = 0.7 + 0.45 * layer;
    const double far = p.random.uniform(40, 57);
    p.pipe({{x, y, z}, {far, y, z}, {far, y + 0.9, z}, {far, y + 0.9, z + 14}, {far, 0.3, z + 14}},
           p.random.uniform(0.08, 0.2));
  }
  for (int i = 0; i < 6; ++i) p.pump({5.0 + 4 * i, 0, 47}, true);
  for (int i = 0; i < 4; ++i) p.stairs({1.0, 0, 4.0 + 12 * i}, {-0.9, 0, 0.01}, 1.4, 0.8);
}

/// A corrugated roof on frames, over `bays` bays.
void hall_roof(Parts& p, double x, double z, double w, double d, double h, double ridge, int bays) {
  for (int i = 0; i < bays; ++i) {
    const Vec at{x + w * i / bays, h, z - 0.6}, u{w / bays + 0.1, 0, 0};
    p.zigzag(at, u, {0, ridge - h, d / 2 + 0.6}, 24, kUp * 0.08);
    p.zigzag(at + Vec{0, ridge - h, d / 2 + 0.6}, u, {0, h - ridge, d / 2 + 0.6}, 24, kUp * 0.08);
  }
  for (int i = 0; i <= bays; ++i) {
    const double at = x + w * i / bays;
    p.beam({at, 0, z + 0.6}, {at, h, z + 0.6}, 0.3, 0.3);
    p.beam({at, 0, z + d - 0.6}, {at, h, z + d - 0.6}, 0.3, 0.3);
    p.beam({at, h, z + 0.6}, {at, ridge - 0.2, z + d / 2}, 0.2, 0.3);
    p.beam({at, ridge - 0.2, z + d / 2}, {at, h, z + d - 0.6}, 0.2, 0.3);
    p.beam({at, h, z + 0.6}, {at, h, z + d - 0.6}, 0.12, 0.12);
    for (int k = 1; k < 8; ++k) {
      const double t = k / 8.0, top = h + (ridge - h - 0.2) * (t < 0.5 ? 2 * t : 2 - 2 * t);
      p.beam({at, h, z + d * t}, {at, top, z + d * t}, 0.08, 0.08);
    }
  }
}

/// A building shell: walls with windows and doors, no floor, a roof; machines inside.
void hall(Parts& p) {
  const double w = 46, d = 32, h = p.random.uniform(8, 12), x = 7, z = 8, ridge = h + 4;
  const int bays = 8;
  p.wall({x, 0, z}, kX, w, h, bays, true);
  p.wall({x + w, 0, z + d}, kX * -1, w, h, bays, true);
  p.wall({x + w, 0, z}, kZ, d, h, 5, p.random.chance(0.5));
  p.wall({x, 0, z + d}, kZ * -1, d, h, 5, true);
  hall_roof(p, x, z, w, d, h, ridge, bays);
  p.beam({x + 1, h - 1.5, z + 1.2}, {x + w - 1, h - 1.5, z + 1.2}, 0.3, 0.5);
  p.beam({x + 1, h - 1.5, z + d - 1.2}, {x + w - 1, h - 1.5, z + d - 1.2}, 0.3, 0.5);
  p.beam({x + w / 3, h - 1, z + 1}, {x + w / 3, h - 1, z + d - 1}, 0.8, 0.9);
  for (int i = 0; i < 8; ++i) {
    p.vessel({x + 5 + 5.0 * i, 2.2, z + 9}, kZ, p.random.uniform(0.8, 1.3), 5);
    p.pump({x + 5 + 5.0 * i, 0, z + 16}, false);
    p.silo({x + 5 + 5.0 * i, 0, z + 25}, 1.6, h - 3);
  }
  for (int i = 0; i < 16; ++i) {
    const double y = p.random.uniform(3.5, h - 2), from = p.random.uniform(3, 20), at = z + p.random.uniform(3, d - 3);
    const double far = from + p.random.uniform(8, 22);
    p.pipe({{x + from, 1, at}, {x + from, y, at}, {x + far, y, at}, {x + far, y, at + 2}, {x + far, 1.5, at + 2}},
           p.random.uniform(0.05, 0.15));
  }
  for (int i = 0; i < 5; ++i) {  // roof vents
    p.cylinder({x + 5 + 9.0 * i, ridge - 1, z + d / 2}, kUp, 0.7, 2.2, 12);
    p.ladder({x - 0.4, 0, z + 4 + 6.0 * i}, h, kX * -1, true);
  }
  drums(p, {x + 2, 0, z + 2}, 2);
}

void spheres(Parts& p) {
  for (int i = 0; i < 3; ++i) p.sphere_tank({12 + 18.0 * i, 0, 15}, p.random.uniform(5, 6.5));
  for (int i = 0; i < 6; ++i) p.vessel({6 + 8.0 * i, 2.5, 39}, kZ, 1.6, 14);
  p.platform({3, 5, 36}, 48, 3, true);
  p.stairs({2, 0, 35}, {0, 0, -7}, 5, 1);
  for (int i = 0; i < 20; ++i) {
    const int layer = i / 10;
    const double z = 26 + 0.5 * (i % 10), y = 1.0 + 1.2 * layer, x = p.random.uniform(3, 12);
    const double far = x + p.random.uniform(18, 40);
    p.pipe({{x, y, z + 6}, {x, y, z}, {far, y, z}, {far, y, z - 5}, {far, 0.4, z - 5}}, p.random.uniform(0.06, 0.16));
  }
}

/// Silos in two rows, with a conveyor gallery over each.
void silos(Parts& p) {
  for (int k = 0; k < 2; ++k) {
    const double z = 12.0 + 22 * k, height = p.random.uniform(16, 24);
    for (int i = 0; i < 6; ++i) p.silo({7 + 9.0 * i, 0, z}, 3.8, height);
    const Vec lo{2, height + 2.2, z - 1.5};
    p.platform(lo, 56, 3, true);
    for (int i = 0; i <= 14; ++i) {
      const double x = 2 + 4.0 * i;
      p.beam({x, lo.y, lo.z}, {x, lo.y + 3, lo.z}, 0.12, 0.12);
      p.beam({x, lo.y, lo.z + 3}, {x, lo.y + 3, lo.z + 3}, 0.12, 0.12);
      p.beam({x, lo.y + 3, lo.z}, {x, lo.y + 3, lo.z + 3}, 0.12, 0.12);
      p.cylinder({x, lo.y + 1, lo.z + 0.8}, kZ, 0.15, 1.4, 8);
    }
    p.zigzag({2, lo.y + 3.1, lo.z - 0.2}, {56, 0, 0}, {0, 0, 3.4}, 120, kUp * 0.1);
    p.sheet({2, lo.y + 1.2, lo.z + 0.8}, {56, 0, 0}, {0, 0, 1.4}, 56, 2);
    p.frame({3, 0, z + 6}, 1, 1, int(height / 5), 4.0, 5.0);
    p.beam({1, 1, z}, {58, 1, z}, 1.2, 0.4);
  }
}

/// Cooling towers are thin shells, open above and below.
void cooling(Parts& p) {
  for (int i = 0; i < 2; ++i) {
    const Vec at{16 + 28.0 * i, 0, 18};
    const double height = p.random.uniform(30, 40);
    std::vector<std::array<double, 2>> profile;
    for (int k = 0; k <= 16; ++k) {
      const double t = k / 16.0, q = (t - 0.75) / 0.75;
      profile.push_back({7 * std::sqrt(1 + 2.2 * q * q), 3 + (height - 3) * t});
    }
    for (int k = 16; k >= 0; --k) profile.push_back({profile[std::size_t(k)][0] - 0.3, profile[std::size_t(k)][1]});
    p.lathe(at, kUp, profile, 48, true);
    for (int k = 0; k < 28; ++k) {
      const Turn t = turn(k, 28), s = turn(k + 1, 28);
      const double r = profile[0][0];
      p.beam(at + Vec{t.cosine * (r + 1), 0, t.sine * (r + 1)}, at + Vec{s.cosine * r, 3.2, s.sine * r}, 0.3, 0.3);
      p.beam(at + Vec{s.cosine * (r + 1), 0, s.sine * (r + 1)}, at + Vec{t.cosine * r, 3.2, t.sine * r}, 0.3, 0.3);
    }
    p.pipe({at + Vec{0, 2, 0}, at + Vec{0, 2, 16}, at + Vec{10, 2, 16}, at + Vec{10, 0.8, 24}}, 0.6);
  }
  for (int i = 0; i < 3; ++i) {  // chimneys, open, with ladders and guy wires
    const Vec at{10 + 18.0 * i, 0, 42};
    const double height = p.random.uniform(35, 55);
    p.lathe(at, kUp, {{1.6, 0}, {1.2, height / 2}, {1.0, height}, {0.9, height}, {1.1, height / 2}, {1.5, 0}}, 20,
            true);
    p.ladder(at + Vec{1.8, 0, 0}, height * 0.9, kX, true);
    for (int k = 0; k < 6; ++k) {
      const Turn t = turn(k, 6);
      p.cable(at + Vec{t.cosine, height * 0.8, t.sine}, at + Vec{t.cosine * 7, 0, t.sine * 7}, 0.5, 0.03);
    }
    p.ring(at + kUp * (height * 0.8), kUp, 1.3, 0.15, 20, 5);
  }
  for (int i = 0; i < 4; ++i) p.pump({44.0 + 4 * i, 0, 36}, false);
}

/// Rows of heat exchangers on two storeys, pumps, and a substation under cables.
void exchangers(Parts& p) {
  p.frame({4, 0, 6}, 5, 3, 2, 6, 5);
  for (int i = 0; i < 14; ++i) p.vessel({5.5 + 2.1 * i, 6.3, 15}, kZ, 0.7, p.random.uniform(8, 12));
  for (int i = 0; i < 10; ++i) p.vessel({5.5 + 3.0 * i, 1.6, 15}, kZ, 0.9, p.random.uniform(8, 12));
  for (int i = 0; i < 8; ++i) p.pump({5 + 4.0 * i, 0, 32}, true);
  for (int i = 0; i < 20; ++i) {
    const double x = p.random.uniform(5, 30), y = p.random.uniform(3, 9), z = p.random.uniform(26, 28);
    const double far = x + p.random.uniform(2, 8);
    p.pipe({{x, y, 24}, {x, y, z}, {x, 1, z}, {far, 1, z}, {far, 1, 31}}, p.random.uniform(0.06, 0.18));
  }
  for (int i = 0; i < 3; ++i) {  // transformers
    const Vec at{42, 0, 8 + 12.0 * i};
    p.box(at, at + Vec{5, 3.5, 4});
    for (int k = 0; k < 14; ++k) {
      p.box(at + Vec{0.3 + 0.33 * k, 0.4, -0.7}, at + Vec{0.38 + 0.33 * k, 3.2, 0.05});
      p.box(at + Vec{0.3 + 0.33 * k, 0.4, 3.95}, at + Vec{0.38 + 0.33 * k, 3.2, 4.7});
    }
    for (int k = 0; k < 3; ++k) {
      const Vec foot = at + Vec{1 + 1.5 * k, 3.5, 2};
      std::vector<std::array<double, 2>> profile{{0, 0}};
      for (int j = 0; j < 10; ++j) profile.push_back({j % 2 == 0 ? 0.25 : 0.12, 0.15 * j});
      profile.push_back({0, 1.5});
      p.lathe(foot, kUp, profile, 10);
      p.cable(foot + kUp * 1.5, {54, 11, at.z + 1.5 * k}, 0.8, 0.03);
    }
  }
  for (int i = 0; i < 4; ++i) {
    const Vec foot{54, 0, 5 + 12.0 * i};
    p.beam(foot, foot + kUp * 12, 0.5, 0.5);
    p.beam(foot + Vec{0, 11, -2}, foot + Vec{0, 11, 2}, 0.3, 0.3);
    for (int k = -1; k <= 1 && i < 3; ++k)
      p.cable(foot + Vec{0, 11.2, 1.8 * k}, foot + Vec{0, 11.2, 12 + 1.8 * k}, 1, 0.03);
  }
  drums(p, {36, 0, 44}, 5);
}

/// A stretch of pipe rack along the plot's far edge. Its pipes have the same places on every plot, so that they meet.
void rack(Parts& p) {
  constexpr double kNear = 51, kFar = 57;
  for (int i = 0; i <= 10; ++i) {
    const double x = 6.0 * i;
    for (const double z : {kNear, kFar}) {
      p.box({x - 0.4, 0, z - 0.4}, {x + 0.4, 0.5, z + 0.4});
      p.beam({x, 0, z}, {x, 8.6, z}, 0.3, 0.3);
    }
    for (const double y : {4.5, 6.5, 8.5}) p.beam({x, y, kNear - 0.3}, {x, y, kFar + 0.3}, 0.3, 0.3);
    if (i < 10 && i % 3 == 0) {
      for (const double z : {kNear, kFar}) {
        p.beam({x, 0.5, z}, {x + 6, 4.4, z}, 0.12, 0.12);
        p.beam({x, 4.4, z}, {x + 6, 0.5, z}, 0.12, 0.12);
      }
    }
  }
  for (int level = 0; level < 2; ++level) {
    for (int i = 0; i < 9; ++i) {
      const double y = 4.9 + 2 * level, z = kNear + 0.6 + 0.6 * i, r = 0.08 + 0.035 * ((i * 5 + level * 3) % 7);
      if ((i + level) % 4 == 1) {  // an expansion loop
        p.pipe({{0, y, z}, {26, y, z}, {26, y + 1.2, z}, {34, y + 1.2, z}, {34, y, z}, {60, y, z}}, 0.1);
      } else {
        p.pipe({{0, y, z}, {30, y, z}, {60, y, z}}, r);
      }
    }
  }
  for (int k = 0; k < 3; ++k) {  // cable trays
    const double z = kNear + 0.8 + 1.7 * k;
    p.sheet({0, 8.8, z}, {60, 0, 0}, {0, 0, 1}, 30, 1);
    for (int j = 0; j < 5; ++j) p.tube({{0, 8.85, z + 0.15 + 0.17 * j}, {60, 8.85, z + 0.15 + 0.17 * j}}, 0.05, 6);
    for (int i = 0; i < 60; ++i) p.beam({i + 0.5, 8.82, z}, {i + 0.5, 8.82, z + 1}, 0.04, 0.02);
  }
  for (int i = 0; i < 5; ++i) {  // pipes that leave for the module
    const double x = 6 + 11.0 * i + p.random.uniform(0, 5), y = 5.2 + 2 * (i % 2);
    p.pipe({{x, y, 54}, {x, y + 0.8, 54}, {x, y + 0.8, 49.5}, {x, 1.2, 49.5}, {x, 1.2, 47}}, 0.12);
  }
}

/// 60 m of fence along x: posts, wires and an open sheet of mesh.
void fence(Parts& p) {
  for (int i = 0; i < 24; ++i) {
    const double x = 2.5 * i;
    p.beam({x, 0, 0}, {x, 2.4, 0}, 0.06, 0.06);
    p.beam({x, 2.4, 0}, {x, 2.8, 0.35}, 0.05, 0.05);
  }
  p.sheet({0, 0.1, 0}, {60, 0, 0}, {0, 2.2, 0}, 48, 2);
  for (int k = 0; k < 3; ++k)
    p.tube({{0, 2.5 + 0.12 * k, 0.1 + 0.1 * k}, {60, 2.5 + 0.12 * k, 0.1 + 0.1 * k}}, 0.01, 5);
}

/// Drums, stacked: as many as it takes to reach the number of triangles that was asked for.
void yard(Parts& p, std::uint64_t drums) {
  constexpr std::uint64_t kRow = 60, kRows = 60;
  for (std::uint64_t i = 0; i < drums; ++i) {
    const std::uint64_t x = i % kRow, z = i / kRow % kRows, y = i / (kRow * kRows);
    p.drum({6 + 0.75 * double(x), 0.9 * double(y), 3 + 0.75 * double(z)});
  }
}

}  // namespace

void build(Kind kind, std::uint64_t seed, double detail, std::uint64_t items, Sink& sink) {
  Parts p(sink, seed, detail);
  switch (kind) {
    case Kind::process:
      return process(p);
    case Kind::tanks:
      return tanks(p);
    case Kind::hall:
      return hall(p);
    case Kind::spheres:
      return spheres(p);
    case Kind::silos:
      return silos(p);
    case Kind::cooling:
      return cooling(p);
    case Kind::exchangers:
      return exchangers(p);
    case Kind::rack:
      return rack(p);
    case Kind::fence:
      return fence(p);
    case Kind::ground:
      return ground(p);
    case Kind::yard:
      return yard(p, items);
  }
}

}  // namespace plant
