#include "lib/quads/detail/strips.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace bp {

namespace {

constexpr std::uint32_t kNoSide = ~std::uint32_t(0);
constexpr std::size_t kLeastQuadsAtVertex = 3;
constexpr double kSideways = 0.02;  // weight of a move within the surface, against one across it
constexpr double kLongPower = 4;    // of the longest edge over the mean one
constexpr double kDiagonal = 1.4;   // of a square, over its side

/// Per side of each quad, 4 q + side, the same side in the other quad.
std::vector<std::uint32_t> twins_of(const std::vector<Quad>& quads) {
  std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> sides;
  sides.reserve(4 * quads.size());
  for (std::uint32_t q = 0; q < quads.size(); ++q) {
    for (std::uint32_t s = 0; s < 4; ++s) {
      const std::uint32_t a = quads[q][s], b = quads[q][(s + 1) % 4];
      sides.emplace_back(std::min(a, b), std::max(a, b), 4 * q + s);
    }
  }
  std::sort(sides.begin(), sides.end());
  std::vector<std::uint32_t> twins(sides.size(), kNoSide);
  for (std::size_t i = 0; i + 1 < sides.size(); i += 2) {
    twins[std::get<2>(sides[i])] = std::get<2>(sides[i + 1]);
    twins[std::get<2>(sides[i + 1])] = std::get<2>(sides[i]);
  }
  return twins;
}

/// Returns the strip through `side`, as sides 4 q + s by which it enters its quads.
std::vector<std::uint32_t> walk(const std::vector<std::uint32_t>& twins, std::uint32_t side) {
  std::vector<std::uint32_t> entered;
  std::uint32_t at = side;
  do {
    entered.push_back(at);
    at = twins[at / 4 * 4 + (at + 2) % 4];
  } while (at != side);
  return entered;
}

/// Returns whether all entries are different. `seen` is empty before and after.
bool are_distinct(const Strip& strip, std::vector<char>& seen) {
  bool distinct = true;
  for (const auto& rung : strip.rungs) {
    for (const VertexId v : rung) distinct = distinct && !seen[v], seen[v] = 1;
  }
  for (const auto& rung : strip.rungs) seen[rung[0]] = seen[rung[1]] = 0;
  return distinct;
}

Vec3d middle(const Vec3d& a, const Vec3d& b) {
  return 0.5 * (a + b);
}

}  // namespace

std::vector<Strip> strips_of(const std::vector<Quad>& quads, std::size_t vertices) {
  const std::vector<std::uint32_t> twins = twins_of(quads);
  std::vector<std::size_t> count(vertices, 0);
  for (const Quad& q : quads) {
    for (const VertexId v : q) ++count[v];
  }
  std::vector<Strip> strips;
  std::vector<char> walked(2 * quads.size(), 0), seen(vertices, 0);
  for (std::uint32_t i = 0; i < 2 * quads.size(); ++i) {
    if (walked[i]) continue;
    Strip strip;
    bool fine = true;
    for (const std::uint32_t side : walk(twins, i / 2 * 4 + i % 2)) {
      const std::uint32_t q = side / 4, s = side % 4;
      fine = fine && !walked[2 * q + s % 2];
      walked[2 * q + s % 2] = 1;
      strip.quads.push_back(q);
      strip.rungs.push_back({quads[q][s], quads[q][(s + 1) % 4]});
      fine = fine && count[strip.rungs.back()[0]] + count[strip.rungs.back()[1]] >= 4 + kLeastQuadsAtVertex;
    }
    if (fine && are_distinct(strip, seen)) strips.push_back(std::move(strip));
  }
  return strips;
}

std::vector<Strip> single_quads(const std::vector<Quad>& quads, std::size_t vertices, int most_worse) {
  std::vector<int> count(vertices, 0);
  for (const Quad& q : quads) {
    for (const VertexId v : q) ++count[v];
  }
  const auto off = [](int n) { return std::abs(n - 4); };
  std::vector<Strip> singles;
  for (std::uint32_t i = 0; i < quads.size(); ++i) {
    const Quad& q = quads[i];
    for (std::size_t k = 0; k < 2; ++k) {
      const int a = count[q[k]], b = count[q[k + 1]], c = count[q[k + 2]], d = count[q[(k + 3) % 4]];
      if (std::min(b, d) <= 3 || a + c - 2 < 3) continue;
      const int worse = off(a + c - 2) + off(b - 1) + off(d - 1) - off(a) - off(b) - off(c) - off(d);
      if (worse <= most_worse) singles.push_back({{{q[k], q[k + 2]}}, {i}, 0});
    }
  }
  return singles;
}

void price_strips(std::vector<Strip>& strips, const std::vector<Quad>& quads, const std::vector<Vec3d>& tight,
                  double edge) {
  std::vector<std::vector<std::uint32_t>> at(tight.size());
  std::vector<Vec3d> area(quads.size());
  for (std::uint32_t i = 0; i < quads.size(); ++i) {
    const Quad& q = quads[i];
    for (const VertexId v : q) at[v].push_back(i);
    area[i] = 0.5 * cross(tight[q[2]] - tight[q[0]], tight[q[3]] - tight[q[1]]);
  }
  std::vector<char> gone(quads.size(), 0);
  for (Strip& strip : strips) {
    for (const std::uint32_t q : strip.quads) gone[q] = 1;
    double volume = 0, shape = 0;
    for (const auto& [a, d] : strip.rungs) {
      const Vec3d m = middle(tight[a], tight[d]);
      double longest = edge;
      for (const VertexId v : {a, d}) {
        const Vec3d step = m - tight[v];
        for (const std::uint32_t q : at[v]) {
          if (gone[q]) continue;
          volume += std::abs(dot(area[q], step)) / 3 + kSideways * length(area[q]) * length(step) / 3;
          for (const VertexId u : quads[q]) longest = std::max(longest, u == v ? 0 : length(tight[u] - m) / kDiagonal);
        }
      }
      shape += std::pow(longest / edge, kLongPower) / double(strip.rungs.size());
    }
    for (const std::uint32_t q : strip.quads) gone[q] = 0;
    strip.price = volume * shape / double(strip.quads.size());
  }
}

}  // namespace bp
