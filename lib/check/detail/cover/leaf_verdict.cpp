#include "lib/check/detail/cover/leaf_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/check/counted.h"
#include "lib/exact/predicates.h"
#include "lib/exact/triangle_part.h"
#include "lib/geometry/triangle_totals.h"

namespace bp {

namespace {

constexpr double kLeafRounding = 16;        // rounding of values computed from a leaf and the scene, for rounding_of()
constexpr double kMostLeafError = 0x1p-18;  // of the longest edge of the scene's box
constexpr double kFlat = 0x1p-22;  // relative to the same edge: float32 rounds that much in a tile four times as long

double rounded_leaf_error(const Bounds3d& cell, const TriangleD& t, double error) {
  return error + kLeafRounding * rounding_of(cell, t);
}

}  // namespace

void report_verdicts(const CoverTile& tile, const CoverCounts& counts, std::vector<TileFinding>& findings) {
  const auto add = [&](CoverVerdict verdict, const char* what, Answer answer = Answer::refuted) {
    const std::uint64_t n = counts.of(verdict);
    if (n == 0) return;
    findings.push_back(
        {fmt::format("{}: {} {} {} of the scene", tile.place, tile.uri, what, counted(n, "triangle")), answer});
  };
  add(CoverVerdict::missing, "does not show");
  if (counts.strays > 0)
    findings.push_back({fmt::format("{}: {} shows {} that the scene does not have", tile.place, tile.uri,
                                    counted(counts.strays, "triangle"))});
  add(CoverVerdict::touching, "is touched by");
  add(CoverVerdict::outside, "leaves outside");
  add(CoverVerdict::undecided, "cannot be decided for", Answer::undecided);
  add(CoverVerdict::rounded, "is as near as coordinates may be off to", Answer::undecided);
  add(CoverVerdict::bare, "draws nothing for");
  add(CoverVerdict::uncovered, "has no child for");
}

CoverVerdict compare_with_leaf(LeafProof& proof, const Bounds3d& cell, const TriangleD& t, double error) {
  if (in_predicate_domain(t[0]) && in_predicate_domain(t[1]) && in_predicate_domain(t[2]) &&
      collinear(t[0], t[1], t[2]))
    return CoverVerdict::fine;
  const std::vector<Vec3d> part = part_within(t, cell);
  if (part.empty()) return CoverVerdict::fine;
  switch (proof.add(part, rounded_leaf_error(cell, t, error))) {
    case LeafProof::Cover::whole:
      return CoverVerdict::fine;
    case LeafProof::Cover::thin:
      return CoverVerdict::thin;
    case LeafProof::Cover::flat:
      return CoverVerdict::flat;
    case LeafProof::Cover::missing:
      return CoverVerdict::missing;
    default:
      return CoverVerdict::undecided;
  }
}

CoverVerdict compare_with_nothing(const Bounds3d& cell, const TriangleD& t, double error, double flat) {
  const TriangleBvh nothing({});
  LeafProof proof(nothing, cell, flat);
  return compare_with_leaf(proof, cell, t, error);
}

LeafErrors judge_leaf_errors(const std::vector<CoverTile>& tiles, const std::vector<bool>& mine, TriangleSource& scene,
                             std::vector<TileFinding>& findings) {
  const auto is_leaf = [](const CoverTile& tile) { return tile.leaf_error.has_value(); };
  const Bounds3d bounds = bounds_of(scene);
  LeafErrors all{scene.counts().rounding, 0, 0, std::vector<char>(tiles.size(), 0)};
  if (bounds.empty() || std::none_of(tiles.begin(), tiles.end(), is_leaf)) return all;
  double edge = 0, farthest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    edge = std::max(edge, bounds.max[k] - bounds.min[k]);
    farthest = std::max({farthest, std::abs(bounds.min[k]), std::abs(bounds.max[k])});
  }
  all.flat = kFlat * edge;
  const double most = kMostLeafError * edge + 2 * kLeafRounding * 0x1p-50 * farthest;
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    if (!is_leaf(tiles[i])) continue;
    const double error = rounded_leaf_error(*tiles[i].cell, {bounds.min, bounds.max, bounds.max}, *tiles[i].leaf_error);
    all.largest = std::max(all.largest, error + all.rounding.most);
    all.refused[i] = error > most;
    if (all.refused[i] && mine[i])
      findings.push_back({fmt::format("{}: {} is compared to within {:.3g}; rounding of this scene is {:.3g} at most",
                                      tiles[i].place, tiles[i].uri, error, most)});
  }
  return all;
}

}  // namespace bp
