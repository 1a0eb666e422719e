#include "lib/atlas/detail/face_regions.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <tuple>

#include "lib/core/vec3.h"
#include "lib/mesh/inner_edges.h"

namespace bp {

namespace {

constexpr double kFirstCosine = 0.77;  // 40 degrees: the limit for large parts at first
constexpr double kLeastCosine = 0.5;   // 60 degrees
constexpr double kLargePart = 0.002;   // share of the whole area

}  // namespace

FaceRegions::FaceRegions(const LatticeMesh& mesh) {
  normals_.reserve(mesh.triangles.size());
  areas_.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    const auto edge = [&](std::size_t k) {
      const LatticeCoord d = mesh.vertices[t[k]] - mesh.vertices[t[0]];
      return Vec3d{double(d.x), double(d.y), double(d.z)};
    };
    const Vec3d n = cross(edge(1), edge(2));
    const double l = length(n);
    normals_.push_back(l > 0 ? (1 / l) * n : Vec3d{});
    areas_.push_back(l / 2);
  }
  join(mesh);
}

void FaceRegions::join(const LatticeMesh& mesh) {
  neighbours_.assign(mesh.triangles.size(), {kNone, kNone, kNone});
  for_each_inner_edge(mesh.triangles, [this](std::uint32_t c, std::uint32_t d) {
    neighbours_[c / 3][c % 3] = d / 3;
    neighbours_[d / 3][d % 3] = c / 3;
  });
}

Vec3d FaceRegions::direction(const std::vector<std::uint32_t>& faces) const {
  Vec3d sum{};
  for (const std::uint32_t f : faces) sum = sum + areas_[f] * normals_[f];
  return unit(sum, {0, 0, 1});
}

/// Grows all seeds at once. A face goes to the part whose direction is nearest to its own, of the parts that reach it.
void FaceRegions::grow(const std::vector<Seed>& seeds, double least_cosine, std::uint32_t first_part,
                       std::vector<std::uint32_t>& part) const {
  using Offer = std::tuple<double, std::uint32_t, std::uint32_t>;  // angle (as a cost), face, seed
  std::priority_queue<Offer, std::vector<Offer>, std::greater<>> offers;
  for (std::uint32_t s = 0; s < seeds.size(); ++s) offers.emplace(-1, seeds[s].face, s);
  while (!offers.empty()) {
    const auto [off, face, seed] = offers.top();
    offers.pop();
    if (part[face] != kNone) continue;
    part[face] = first_part + seed;
    for (const std::uint32_t next : neighbours_[face]) {
      if (next == kNone || part[next] != kNone) continue;
      const double cosine = dot(normals_[next], seeds[seed].direction);
      if (cosine >= least_cosine) offers.emplace(1 - cosine, next, seed);
    }
  }
}

std::vector<FaceRegions::Seed> FaceRegions::large_seeds(const std::vector<std::uint32_t>& by_area) const {
  const double least = kLargePart * std::accumulate(areas_.begin(), areas_.end(), 0.0);
  std::vector<Seed> seeds;
  std::vector<std::uint32_t> part(normals_.size(), kNone), faces;
  for (const std::uint32_t f : by_area) {
    if (part[f] != kNone) continue;
    std::vector<Seed> one{{f, normals_[f]}};
    std::vector<std::uint32_t> stack{f};
    faces.clear();
    part[f] = f;
    double area = 0;
    while (!stack.empty()) {
      const std::uint32_t g = stack.back();
      stack.pop_back();
      faces.push_back(g);
      area += areas_[g];
      for (const std::uint32_t next : neighbours_[g]) {
        if (next == kNone || part[next] != kNone || dot(normals_[next], normals_[f]) < kFirstCosine) continue;
        part[next] = f;
        stack.push_back(next);
      }
    }
    if (area >= least) seeds.push_back({f, direction(faces)});
  }
  return seeds;
}

std::vector<std::vector<std::uint32_t>> FaceRegions::cut() const {
  std::vector<std::uint32_t> by_area(normals_.size()), part(normals_.size(), kNone);
  std::iota(by_area.begin(), by_area.end(), std::uint32_t(0));
  std::stable_sort(by_area.begin(), by_area.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return areas_[a] > areas_[b]; });
  const std::vector<Seed> seeds = large_seeds(by_area);
  grow(seeds, kLeastCosine, 0, part);
  std::uint32_t parts = std::uint32_t(seeds.size());
  for (const std::uint32_t f : by_area) {
    if (part[f] == kNone) grow({{f, normals_[f]}}, kLeastCosine, parts++, part);
  }
  std::vector<std::vector<std::uint32_t>> faces(parts);
  for (const std::uint32_t f : by_area) faces[part[f]].push_back(f);
  return faces;
}

std::vector<std::vector<std::uint32_t>> FaceRegions::joined(const std::vector<std::uint32_t>& faces) const {
  std::vector<std::uint32_t> sorted = faces, open, stack;
  std::sort(sorted.begin(), sorted.end());
  std::vector<bool> taken(sorted.size());
  const auto place = [&](std::uint32_t f) {
    const auto found = std::lower_bound(sorted.begin(), sorted.end(), f);
    return found != sorted.end() && *found == f ? std::size_t(found - sorted.begin()) : sorted.size();
  };
  std::vector<std::vector<std::uint32_t>> parts;
  for (const std::uint32_t f : faces) {
    if (taken[place(f)]) continue;
    parts.emplace_back();
    taken[place(f)] = true;
    stack = {f};
    while (!stack.empty()) {
      const std::uint32_t g = stack.back();
      stack.pop_back();
      parts.back().push_back(g);
      for (const std::uint32_t next : neighbours_[g]) {
        const std::size_t at = next == kNone ? sorted.size() : place(next);
        if (at == sorted.size() || taken[at]) continue;
        taken[at] = true;
        stack.push_back(next);
      }
    }
  }
  return parts;
}

}  // namespace bp
