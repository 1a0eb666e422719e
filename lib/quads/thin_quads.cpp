#include "lib/quads/thin_quads.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "lib/core/disjoint_sets.h"
#include "lib/core/parallel.h"
#include "lib/mesh/lattice_geometry.h"
#include "lib/quads/detail/enclosed_by_pairs.h"
#include "lib/quads/detail/skin.h"
#include "lib/quads/detail/strip_remover.h"
#include "lib/quads/quads.h"

namespace bp {

namespace {

constexpr double kPerStage = 0.6;        // a stage leaves at least this share of the quads, then the mesh is evened out
constexpr double kPerSingles = 0.9;      // like kPerStage, for a stage that came after one without progress
constexpr double kLeastProgress = 0.98;  // a stage that leaves more of the quads made no progress
// Thinning is given up before it begins if there are fewer quads for each part and each hole than these: twice those of
// a cube, and of a ring with four corners.
constexpr std::size_t kQuadsOfPart = 12, kQuadsOfHole = 16;
// Thinning is given up where a stage stops short of its goal with more quads left than this share of those at first and
// than so many times the number wanted: what stands in the way keeps most of them. A beam with seven slanted legs stops
// at 0.15 and twice the number; soups of 150 triangles at 0.22 and four times.
constexpr double kHopelessShare = 0.125, kHopelessTimes = 3;
// Thinning is given up once all its stages together had so many times the quads of the first; that beam takes 4.0.
constexpr double kMostWork = 6;
// The edges that may be missing or too many after a single quad went. After a stage without progress the next one
// counts, until none is left.
constexpr int kNoSingles = -100;
constexpr std::array<int, 4> kWorseAfterStrips{kNoSingles, 0, 2, 8}, kWorseOfSingles{2, 4, 6, 8};
constexpr double kSingle = 4;  // factor of the price of a single quad, since it breaks loops of edges
constexpr int kSweepsOfStage = 2;
constexpr double kSwelling = 0.2;   // times the mean edge
constexpr double kPerRound = 0.25;  // share of the strips that a round tries before prices are renewed
double area_of(const std::vector<Quad>& quads, const std::vector<Vec3d>& p) {
  double area = 0;
  for (const Quad& q : quads) area += 0.5 * length(cross(p[q[2]] - p[q[0]], p[q[3]] - p[q[1]]));
  return area;
}

/// One stage: removes the strips whose removal adds the least volume.
class Thinner {
 public:
  Thinner(const CellQuads& cage, std::vector<Vec3d> tight, const Enclosed& enclosed,
          const std::optional<MirrorPlane>& plane)
      : remover_(cage, enclosed, plane), tight_(std::move(tight)), changed_(remover_.mesh().vertex_capacity(), 0) {}

  /// Removes strips until `goal` quads are left, or as many as are possible. `last`: the number for the whole cage.
  CellQuads run(std::size_t goal, std::size_t last, int most_worse) {
    while (remover_.left() > goal) {
      const std::size_t before = remover_.left();
      const bool anew = failed_.empty();
      round(goal, last, most_worse);
      if (remover_.left() < before) continue;
      if (anew) break;
      failed_.clear();  // what was in the way of a strip may have gone elsewhere
    }
    return remover_.result();
  }

 private:
  void round(std::size_t goal, std::size_t last, int most_worse) {
    const std::vector<Strip> strips = strips_by_price(last, most_worse);
    touched_.assign(changed_.size(), 0);
    remover_.refresh();
    const auto most = std::size_t(kPerRound * double(strips.size())) + 1;
    std::size_t removed = 0;
    for (std::size_t i = 0; i < strips.size() && remover_.left() > goal && (i < most || removed == 0); ++i) {
      stop_if_asked();
      if (!has_failed(strips[i])) removed += remove(strips[i]);
    }
  }

  [[nodiscard]] std::vector<Strip> strips_by_price(std::size_t last, int most_worse) const {
    std::vector<Quad> quads;
    std::vector<std::uint32_t> number;
    for (std::uint32_t q = 0; q < remover_.quads().size(); ++q) {
      if (remover_.is_alive(q)) quads.push_back(remover_.quads()[q]), number.push_back(q);
    }
    std::vector<Strip> strips = strips_of(quads, changed_.size());
    for (Strip& single : single_quads(quads, changed_.size(), most_worse)) strips.push_back(std::move(single));
    price_strips(strips, quads, tight_, std::sqrt(area_of(quads, tight_) / double(last)));
    for (Strip& s : strips) {
      if (s.rungs.size() == 1) s.price *= kSingle;
      for (std::uint32_t& q : s.quads) q = number[q];
    }
    std::stable_sort(strips.begin(), strips.end(), [](const Strip& a, const Strip& b) { return a.price < b.price; });
    return strips;
  }

  /// Returns whether the condition holds for all corners of the quads.
  template <class Condition>
  [[nodiscard]] bool all_corners(const std::vector<std::uint32_t>& quads, const Condition& holds) const {
    return std::all_of(quads.begin(), quads.end(), [&](std::uint32_t q) {
      return std::all_of(remover_.quads()[q].begin(), remover_.quads()[q].end(), holds);
    });
  }

  /// Returns whether the strip could not be removed, and nothing has changed at its vertices since then.
  [[nodiscard]] bool has_failed(const Strip& strip) const {
    const auto failed = failed_.find(strip.quads);
    return failed != failed_.end() &&
           all_corners(strip.quads, [&](VertexId v) { return changed_[v] <= failed->second; });
  }

  /// Removes a strip unless it meets what this round has changed. Returns whether it is gone.
  bool remove(const Strip& strip) {
    const std::vector<std::uint32_t> gone = remover_.quads_of(strip);
    if (!std::all_of(gone.begin(), gone.end(), [&](std::uint32_t q) { return remover_.is_alive(q); }) ||
        !all_corners(gone, [&](VertexId v) { return touched_[v] == 0; }))
      return false;
    if (!remover_.remove(strip, gone)) {
      failed_[strip.quads] = changes_;
      return false;
    }
    ++changes_;
    const HalfEdgeMesh& mesh = remover_.mesh();
    for (const std::array<VertexId, 2>& pair : remover_.merged()) {
      const VertexId from = pair[0], to = pair[1];
      tight_[to] = 0.5 * (tight_[from] + tight_[to]);
      changed_[to] = changes_;
      mesh.for_each_outgoing(to, [&](HalfEdgeId h) { changed_[mesh.to(h)] = changes_; });
    }
    for (const std::uint32_t q : gone) {
      for (const VertexId v : remover_.quads()[q]) touched_[v] = 1;
    }
    return true;
  }

  StripRemover remover_;
  std::vector<Vec3d> tight_;                                  // by vertex: where it lies when the cage is shrunk
  std::map<std::vector<std::uint32_t>, std::size_t> failed_;  // by quads of a strip: changes_ when it failed
  std::size_t changes_ = 0;                                   // strips that were removed
  std::vector<std::size_t> changed_;  // by vertex: changes_ at its last change, or a neighbour's
  std::vector<char> touched_;         // by vertex: merged in this round
};

/// Shrinks the cage, and returns its vertices; then swells it, which leaves room for merging vertices.
std::vector<Vec3d> relax(CellQuads& cage, const Enclosed& enclosed, const std::optional<MirrorPlane>& plane) {
  HalfEdgeMesh mesh(cage.mesh);
  EnclosedByPairs kept(mesh, enclosed);
  kept.give_contacts(false);
  for (const auto& [f, g] : cage.mesh.quads) kept.join(f, g);
  ProxyEditor editor(mesh, kept, {});
  Skin skin(cage, mesh, editor, plane);
  std::vector<Vec3d> tight;
  for (int i = 0; i < kSweepsOfStage; ++i) skin.relax();
  for (VertexId v = 0; v < cage.mesh.vertices.size(); ++v)
    tight.push_back(to_double(mesh.position(v) - cage.mesh.vertices[0]));
  skin.swell(kSwelling);
  for (VertexId v = 0; v < cage.mesh.vertices.size(); ++v) cage.mesh.vertices[v] = mesh.position(v);
  return tight;
}

/// Returns the quads below which a mesh with the parts and holes of this one has no shape to speak of.
std::size_t least_quads(const CellQuads& cage) {
  DisjointSets parts(cage.mesh.vertices.size());
  for (const auto& [a, b, c] : cage.mesh.triangles) {
    parts.unite(a, b);
    parts.unite(b, c);
  }
  std::size_t count = 0;
  for (std::uint32_t v = 0; v < parts.size(); ++v) count += parts.find(v) == v;
  // Each part has vertices + quads - edges = 2 - 2 holes, and two edges for each quad.
  const std::size_t holes = (2 * count + cage.mesh.quads.size() - cage.mesh.vertices.size()) / 2;
  return kQuadsOfPart * count + kQuadsOfHole * holes;
}

}  // namespace

Thinned thinned(CellQuads cage, const Enclosed& enclosed, std::uint64_t faces, const std::optional<MirrorPlane>& plane,
                Thinning thinning, const ThinningSteps& steps) {
  const auto& worse = thinning == Thinning::strips ? kWorseAfterStrips : kWorseOfSingles;
  const std::size_t first = cage.mesh.quads.size(), last = faces / 2;
  const double hopeless = std::max(kHopelessShare * double(first), kHopelessTimes * double(last));
  if (first > last && least_quads(cage) > last) return {{}, true};
  std::vector<Vec3d> tight = relax(cage, enclosed, plane);
  double work = 0;
  for (std::size_t step = 0; cage.mesh.quads.size() > last;) {
    const std::size_t before = cage.mesh.quads.size();
    work += double(before);
    if (steps) steps(first - before, first - last);
    if (work > kMostWork * double(first)) return {{}, true};
    const auto goal = std::max(last, std::size_t((step == 0 ? kPerStage : kPerSingles) * double(before)));
    cage = Thinner(cage, std::move(tight), enclosed, plane).run(goal, last, worse[step]);
    const std::size_t left = cage.mesh.quads.size();
    if (left > goal && double(left) > hopeless) return {{}, true};
    if (double(left) <= kLeastProgress * double(before))
      step = 0;
    else if (++step == worse.size())
      return {};
    tight = relax(cage, enclosed, plane);
  }
  return {std::move(cage), false};
}

}  // namespace bp
