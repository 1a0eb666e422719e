#include "lib/check/detail/surface.h"

#include <algorithm>
#include <atomic>
#include <tuple>

#include "lib/core/parallel.h"
#include "lib/exact/expansion.h"
#include "lib/exact/triangle_intersection.h"
#include "lib/geometry/crossing.h"

namespace bp {

namespace {

constexpr std::int64_t kGrain = 256;  // triangles per work item
// Meetings that are counted in one work item: 20 for each triangle, and as many as there are for a few large ones.
// Where a hundred thousand triangles lie at one place, all pairs meet. That is too many to count, and the first ones
// tell it.
constexpr std::uint64_t kMostMet = 20 * kGrain;
// Pairs of overlapping boxes that are tested at most, and as many more for each triangle: some seconds. Thin
// slivers side by side have the same box, so that all pairs of them would be tested.
constexpr std::uint64_t kMostPairs = std::uint64_t(1) << 27, kPairsEach = 256;

std::vector<std::uint32_t> with_area(const WeldedMesh& mesh) {
  std::vector<std::uint32_t> list;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (mesh.degenerate[t] == 0) list.push_back(std::uint32_t(t));
  return list;
}

std::vector<TriangleD> corners_of(const WeldedMesh& mesh, const std::vector<std::uint32_t>& list) {
  std::vector<TriangleD> triangles;
  triangles.reserve(list.size());
  for (const std::uint32_t t : list) triangles.push_back(mesh.corners(t));
  return triangles;
}

bool before(const Example& a, const Example& b) {
  return std::tie(a.index, a.other) < std::tie(b.index, b.other);
}

/// Counts e and keeps it if it is one of the first `n` by number, in whichever order they come.
void add_sorted(Finding& f, const Example& e, std::size_t n) {
  ++f.count;
  if (n == 0 || (f.examples.size() == n && !before(e, f.examples.back()))) return;
  if (f.examples.size() == n) f.examples.pop_back();
  f.examples.insert(std::upper_bound(f.examples.begin(), f.examples.end(), e, before), e);
}

/// The sign of the signed volume of one closed component.
class VolumeSign {
 public:
  explicit VolumeSign(const Vec3d& origin) : origin_(origin) {}
  void add(const TriangleD& t) {
    Vec3d d[3];
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < 3; ++i) d[k][i] = t[k][i] - origin_[i];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      const double l = d[0][i] * d[1][j] * d[2][k], r = d[0][j] * d[1][i] * d[2][k];
      sum_ += l - r;
      permanent_ += std::abs(l) + std::abs(r);
    }
    ++count_;
  }
  /// Returns the sign if it is certain; 0 if not. At most 3 (differences) + 2 (products) + 1 + 3 n (sums) roundings
  /// reach any term.
  [[nodiscard]] int certain() const {
    const double bound = (3 * double(count_) + 16) * 0x1p-53 * permanent_;
    return sum_ > bound ? 1 : -sum_ > bound ? -1 : 0;
  }

 private:
  Vec3d origin_;
  double sum_ = 0, permanent_ = 0;
  std::uint64_t count_ = 0;
};

/// Returns the exact sign: that of the sum of the corners' determinants.
int exact_volume_sign(const WeldedMesh& mesh, const std::vector<std::uint32_t>& triangles) {
  const auto sum = std::make_unique<Expansion<kAnyLength>>();
  for (const std::uint32_t number : triangles) {
    const TriangleD t = mesh.corners(number);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      sum->add_product(t[0][i], t[1][j], t[2][k]);
      sum->add_product(-t[0][j], t[1][i], t[2][k]);
    }
  }
  return sum->sign();
}

}  // namespace

Surface::Surface(const WeldedMesh& mesh) : mesh_(mesh), triangle_(with_area(mesh)), bvh_(corners_of(mesh, triangle_)) {
  for (std::size_t i = 0; i < bvh_.size(); ++i) bounds_.merge(bounds_of(bvh_.item(i).corners));
}

Finding Surface::self_intersections(std::size_t max_examples, bool within_parts) const {
  const auto n = std::int64_t(bvh_.size());
  const std::uint64_t most = kMostPairs + kPairsEach * std::uint64_t(n);
  std::atomic<std::uint64_t> pairs = 0;
  std::vector<Finding> found(std::size_t((n + kGrain - 1) / kGrain));
  parallel_ranges(n, kGrain, [&](std::int64_t begin, std::int64_t end) {
    Finding& here = found[std::size_t(begin / kGrain)];
    for (std::int64_t i = begin; i < end && !here.at_least && pairs <= most; ++i) {
      std::uint64_t seen = 0;
      const TriangleBvh::Item& a = bvh_.item(std::size_t(i));
      const auto& corners_a = mesh_.triangles[triangle_[a.id]];
      here.at_least = bvh_.visit(bounds_of(a.corners), [&](const TriangleBvh::Item& b) {
        ++seen;
        if (b.id > a.id && (!within_parts || mesh_.component[triangle_[a.id]] == mesh_.component[triangle_[b.id]]) &&
            triangles_meet_beyond_shared(mesh_.points.data(), corners_a, mesh_.triangles[triangle_[b.id]]))
          add_sorted(here, {mesh_.number[triangle_[a.id]], mesh_.number[triangle_[b.id]], a.corners[0]}, max_examples);
        return here.count == kMostMet;
      });
      pairs += seen;
    }
  });
  Finding all;
  // The number of pairs does not depend on the threads, and what was found before does.
  if (pairs > most) {
    all.at_least = true;
    return all;
  }
  for (const Finding& f : found) {
    for (const Example& e : f.examples) add_sorted(all, e, max_examples);
    all.count += f.count - f.examples.size();
    all.at_least |= f.at_least;
  }
  return all;
}

std::int64_t Surface::touched_by(const TriangleD& t) const {
  std::int64_t touched = kNone;
  const auto find = [&](const auto& here, const auto& corners) {
    const bool segment = collinear(here[0], here[1], here[2]);
    bvh_.visit(bounds_of(t), [&](const TriangleBvh::Item& b) {
      const auto& there = corners(b);
      if (!(segment ? degenerate_triangle_meets(here.data(), there.data())
                    : triangles_intersect(here.data(), there.data())))
        return false;
      touched = triangle_[b.id];
      return true;
    });
  };
  if (in_predicate_domain(t[0]) && in_predicate_domain(t[1]) && in_predicate_domain(t[2])) {
    find(t, [](const TriangleBvh::Item& b) -> const TriangleD& { return b.corners; });
  } else {
    find(widened(t), [](const TriangleBvh::Item& b) { return widened(b.corners); });
  }
  return touched;
}

int Surface::winding(const Vec3d& p, std::uint32_t ignored) const {
  int sum = 0;
  bvh_.visit_above(p, [&](const TriangleBvh::Item& t) {
    if (ignored != kNoComponent && mesh_.component[triangle_[t.id]] == ignored) return;
    sum += in_predicate_domain(p) ? crossing_above(t.corners, p) : crossing_above(widened(t.corners), WidePoint{p});
  });
  return sum;
}

Finding inverted_components(const WeldedMesh& mesh, const Surface& surface, std::size_t max_examples) {
  std::vector<std::vector<std::uint32_t>> members;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t c = mesh.component[t];
    if (c == std::uint32_t(-1)) continue;  // zero area
    if (c >= members.size()) members.resize(c + 1);
    members[c].push_back(std::uint32_t(t));
  }
  Finding inverted;
  for (std::size_t c = 0; c < members.size(); ++c) {
    const Vec3d corner = mesh.corners(members[c][0])[0];
    VolumeSign volume(corner);
    for (const std::uint32_t t : members[c]) volume.add(mesh.corners(t));
    int sign = volume.certain();
    if (sign == 0) sign = exact_volume_sign(mesh, members[c]);
    if (sign <= 0 && surface.winding(corner, std::uint32_t(c)) == 0)
      inverted.add({mesh.number[members[c][0]], 0, corner}, max_examples);
  }
  return inverted;
}

}  // namespace bp
