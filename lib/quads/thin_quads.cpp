// Strips of quads are removed as [DSSC08] removes them; here each step must keep the enclosed set inside.
#include "lib/quads/thin_quads.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "lib/core/disjoint_sets.h"
#include "lib/core/parallel.h"
#include "lib/mesh/lattice_geometry.h"
#include "lib/quads/detail/enclosed_by_pairs.h"
#include "lib/quads/detail/skin.h"
#include "lib/quads/detail/strips.h"
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
constexpr std::array<double, 6> kOutwards{0,    0.1, 0.2,
                                          0.35, 0.5, 0.75};  // times the mean edge: places of merged vertices
constexpr std::array<double, 3> kAlong{0.5, 0, 1};

std::vector<Quad> quads_of(const LatticeMesh& mesh) {
  std::vector<Quad> quads;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 2) {
    quads.push_back(quad_of(mesh.triangles[i], mesh.triangles[i + 1]));
  }
  return quads;
}

double area_of(const std::vector<Quad>& quads, const std::vector<Vec3d>& p) {
  double area = 0;
  for (const Quad& q : quads) area += 0.5 * length(cross(p[q[2]] - p[q[0]], p[q[3]] - p[q[1]]));
  return area;
}

/// One stage: removes strips from a mesh whose pairs of triangles are 2 i and 2 i + 1, as QuadMesher numbers them.
class Thinner {
 public:
  Thinner(const CellQuads& cage, std::vector<Vec3d> tight, const Enclosed& enclosed,
          const std::optional<MirrorPlane>& plane)
      : cage_(cage),
        plane_(plane),
        tight_(std::move(tight)),
        quads_(quads_of(cage.mesh)),
        alive_(quads_.size(), 1),
        left_(quads_.size()),
        mesh_(cage.mesh),
        kept_(mesh_, enclosed),
        is_target_(mesh_.vertex_capacity(), 0),
        changed_(mesh_.vertex_capacity(), 0) {
    kept_.give_contacts(false);
    kept_.allow_flips(true);
    kept_.set_least_quality(0);
    for (std::uint32_t q = 0; q < quads_.size(); ++q) kept_.join(2 * q, 2 * q + 1);
    editor_.emplace(mesh_, kept_, ShapeLimits{});
  }

  /// Removes strips until `goal` quads are left, or as many as are possible. `last`: the number for the whole cage.
  CellQuads run(std::size_t goal, std::size_t last, int most_worse) {
    while (left_ > goal) {
      const std::size_t before = left_;
      const bool anew = failed_.empty();
      round(goal, last, most_worse);
      if (left_ < before) continue;
      if (anew) break;
      failed_.clear();  // what was in the way of a strip may have gone elsewhere
    }
    return result();
  }
  [[nodiscard]] std::size_t left() const { return left_; }

 private:
  void round(std::size_t goal, std::size_t last, int most_worse) {
    std::vector<Quad> quads;
    std::vector<std::uint32_t> number;
    for (std::uint32_t q = 0; q < quads_.size(); ++q) {
      if (alive_[q]) quads.push_back(quads_[q]), number.push_back(q);
    }
    std::vector<Strip> strips = strips_of(quads, mesh_.vertex_capacity());
    for (Strip& single : single_quads(quads, mesh_.vertex_capacity(), most_worse)) strips.push_back(std::move(single));
    price_strips(strips, quads, tight_, std::sqrt(area_of(quads, tight_) / double(last)));
    for (Strip& s : strips) {
      if (s.rungs.size() == 1) s.price *= kSingle;
      for (std::uint32_t& q : s.quads) q = number[q];
    }
    std::stable_sort(strips.begin(), strips.end(), [](const Strip& a, const Strip& b) { return a.price < b.price; });
    touched_.assign(mesh_.vertex_capacity(), 0);
    editor_->refresh();
    const auto most = std::size_t(kPerRound * double(strips.size())) + 1;
    std::size_t removed = 0;
    for (std::size_t i = 0; i < strips.size() && left_ > goal && (i < most || removed == 0); ++i) {
      stop_if_asked();
      if (has_failed(strips[i])) continue;
      removed += remove(strips[i]);
    }
  }

  /// Returns whether the strip could not be removed, and nothing has changed at its vertices since then.
  [[nodiscard]] bool has_failed(const Strip& strip) const {
    const auto failed = failed_.find(strip.quads);
    return failed != failed_.end() && std::all_of(strip.quads.begin(), strip.quads.end(), [&](std::uint32_t q) {
             return std::all_of(quads_[q].begin(), quads_[q].end(),
                                [&](VertexId v) { return changed_[v] <= failed->second; });
           });
  }

  [[nodiscard]] std::uint32_t image(std::uint32_t quad) const {
    const auto half = std::uint32_t(quads_.size() / 2);
    return quad < half ? quad + half : quad - half;
  }

  /// Removes a strip and its mirror image, or leaves everything as it was.
  bool remove(const Strip& strip) {
    std::vector<std::uint32_t> gone = strip.quads;
    if (plane_) {
      for (const std::uint32_t q : strip.quads) gone.push_back(image(q));
      std::sort(gone.begin(), gone.end());
      gone.erase(std::unique(gone.begin(), gone.end()), gone.end());
    }
    for (const std::uint32_t q : gone) {
      if (!alive_[q] || std::any_of(quads_[q].begin(), quads_[q].end(), [&](VertexId v) { return touched_[v] != 0; }))
        return false;
    }
    for (const auto& [from, to] : into_) is_target_[to] = 0;
    into_.clear();
    renamed_.clear();
    editor_->begin_undo();
    for (const std::uint32_t q : gone) kept_.part(2 * q, 2 * q + 1);
    bool done = strip.rungs.size() > 1 || (turn(strip.quads[0], strip.rungs[0][0]) &&
                                           (!plane_ || turn(image(strip.quads[0]), cage_.mate[strip.rungs[0][0]])));
    for (std::size_t i = 0; done && i < strip.rungs.size(); ++i) done = merge_rung(strip.rungs[i]);
    for (const std::uint32_t q : gone) alive_[q] = 0;
    done = done && took_only(gone) && rename(gone);
    if (done) {
      settle(gone);
      return true;
    }
    editor_->undo();
    failed_[strip.quads] = changes_;
    for (std::size_t i = renamed_.size(); i-- > 0;) quads_[renamed_[i].first] = renamed_[i].second;
    for (const std::uint32_t q : gone) {
      alive_[q] = 1;
      kept_.join(2 * q, 2 * q + 1);
    }
    return false;
  }

  /// Returns whether the triangles of these quads, and no others, are gone. Where surfaces touch, a merge may take
  /// triangles of a quad beside the strip.
  [[nodiscard]] bool took_only(const std::vector<std::uint32_t>& gone) const {
    return mesh_.face_count() == 2 * (left_ - gone.size()) &&
           std::none_of(gone.begin(), gone.end(),
                        [&](std::uint32_t q) { return mesh_.alive(2 * q) || mesh_.alive(2 * q + 1); });
  }

  /// Records that the quads are gone.
  void settle(const std::vector<std::uint32_t>& gone) {
    left_ -= gone.size();
    ++changes_;
    for (const auto& [from, to] : into_) {
      tight_[to] = 0.5 * (tight_[from] + tight_[to]);
      changed_[to] = changes_;
      mesh_.for_each_outgoing(to, [&](HalfEdgeId h) { changed_[mesh_.to(h)] = changes_; });
    }
    for (const std::uint32_t q : gone) {
      for (const VertexId v : quads_[q]) touched_[v] = 1;
    }
  }

  /// Makes the diagonal from `corner` that of the quad's triangles.
  bool turn(std::uint32_t quad, VertexId corner) {
    for (HalfEdgeId h = 6 * quad; h < 6 * quad + 3; ++h) {
      if (HalfEdgeMesh::face(mesh_.twin(h)) != 2 * quad + 1) continue;
      return mesh_.from(h) == corner || mesh_.to(h) == corner || editor_->flip(h);
    }
    return false;
  }

  /// Puts the merged vertices into the quads. Returns false if a vertex would have too few of them.
  bool rename(const std::vector<std::uint32_t>& gone) {
    for (const std::array<VertexId, 2>& pair : into_) {
      const VertexId from = pair[0], to = pair[1];  // the lambda cannot capture a binding
      mesh_.for_each_outgoing(to, [&](HalfEdgeId h) {
        const std::uint32_t q = HalfEdgeMesh::face(h) / 2;
        const auto corner = std::find(quads_[q].begin(), quads_[q].end(), from);
        if (corner == quads_[q].end()) return;
        renamed_.push_back({q, quads_[q]});
        *corner = to;
      });
    }
    return std::all_of(gone.begin(), gone.end(), [&](std::uint32_t q) {
      return std::all_of(quads_[q].begin(), quads_[q].end(),
                         [&](VertexId v) { return !mesh_.vertex_alive(v) || quads_around(v) >= 3; });
    });
  }

  [[nodiscard]] std::size_t quads_around(VertexId v) const {
    std::set<std::uint32_t> quads;
    mesh_.for_each_outgoing(v, [&](HalfEdgeId h) { quads.insert(HalfEdgeMesh::face(h) / 2); });
    return quads.size();
  }

  bool merge_rung(const std::array<VertexId, 2>& rung) {
    auto [a, d] = rung;
    if (!mesh_.vertex_alive(a) || !mesh_.vertex_alive(d)) return plane_.has_value();  // its image was merged
    if (!plane_) return merge(a, d, false);
    if (cage_.mate[d] == d) std::swap(a, d);
    const VertexId ma = cage_.mate[a], md = cage_.mate[d];
    if (ma == d) return false;  // the strip runs along the plane
    const bool in_plane = ma == a;
    if (!merge(a, d, in_plane)) return false;
    if (md == d) return in_plane;  // the rung lies in the plane
    const LatticeCoord to = plane_->mirrored(mesh_.position(a));
    return merge_at(ma, md, to);
  }

  /// Merges d into a, at the innermost of some places that is allowed.
  bool merge(VertexId a, VertexId d, bool in_plane) {
    const LatticeCoord &pa = mesh_.position(a), &pd = mesh_.position(d);
    const Vec3d half = 0.5 * to_double(pd - pa), out = normal(a) + normal(d);
    const double size = length(out), rung = spoke(a, d);
    for (const double share : kOutwards)
      for (const double along : kAlong) {
        LatticeCoord to = pa + rounded(2 * along * half + (size > 0 ? share * rung / size : 0) * out);
        if (in_plane) to[plane_->axis] = plane_->lattice();
        if (plane_ && !in_plane &&
            (to[plane_->axis] <= plane_->lattice()) != (mesh_.position(a)[plane_->axis] <= plane_->lattice()))
          return false;
        if (merge_at(a, d, to)) return true;
      }
    return false;
  }

  [[nodiscard]] double spoke(VertexId a, VertexId d) const {
    double sum = 0;
    int n = 0;
    for (const VertexId v : {a, d}) {
      mesh_.for_each_outgoing(
          v, [&](HalfEdgeId h) { sum += length(to_double(mesh_.position(mesh_.to(h)) - mesh_.position(v))), ++n; });
    }
    return sum / n;
  }

  bool merge_at(VertexId a, VertexId d, const LatticeCoord& to) {
    // A strip may cross its image. A vertex that another one was merged into must stay, since into_ names it.
    if (!mesh_.vertex_alive(a) || !mesh_.vertex_alive(d) || is_target_[d]) return false;
    HalfEdgeId edge = kNoId;
    mesh_.for_each_outgoing(a, [&](HalfEdgeId h) {
      if (mesh_.to(h) == d) edge = h;
    });
    if (edge == kNoId || !kept_.allows_corner(d, to) || !editor_->collapse(edge, to)) return false;
    into_.push_back({d, a});
    is_target_[a] = 1;
    return true;
  }

  [[nodiscard]] Vec3d normal(VertexId v) const {
    Vec3d n{};
    mesh_.for_each_outgoing(v, [&](HalfEdgeId h) {
      n = n + to_double(normal_of(mesh_.position(v), mesh_.position(mesh_.to(h)), mesh_.position(mesh_.opposite(h))));
    });
    return unit(n, {});
  }

  CellQuads result() const {
    CellQuads out;
    out.mesh.frame = cage_.mesh.frame;
    std::vector<VertexId> number(mesh_.vertex_capacity(), kNoId);
    for (VertexId v = 0; v < number.size(); ++v) {
      if (!mesh_.vertex_alive(v)) continue;
      number[v] = VertexId(out.mesh.vertices.size());
      out.mesh.vertices.push_back(mesh_.position(v));
    }
    if (plane_) {
      for (VertexId v = 0; v < number.size(); ++v) {
        if (number[v] != kNoId) out.mate.push_back(number[cage_.mate[v]]);
      }
    }
    for (std::uint32_t q = 0; q < quads_.size(); ++q) {
      if (!alive_[q]) continue;
      const auto n = std::uint32_t(out.mesh.triangles.size());
      for (const std::uint32_t f : {2 * q, 2 * q + 1})
        out.mesh.triangles.push_back(
            {number[mesh_.from(3 * f)], number[mesh_.from(3 * f + 1)], number[mesh_.from(3 * f + 2)]});
      out.mesh.quads.push_back({n, n + 1});
    }
    return out;
  }

  const CellQuads& cage_;
  const std::optional<MirrorPlane>& plane_;
  std::vector<Vec3d> tight_;  // by vertex: where it lies when the cage is shrunk
  std::vector<Quad> quads_;
  std::vector<char> alive_;
  std::size_t left_;
  HalfEdgeMesh mesh_;
  EnclosedByPairs kept_;
  std::optional<ProxyEditor> editor_;
  // The next three belong to the strip that is being removed.
  std::vector<std::array<VertexId, 2>> into_;                 // what merged into what
  std::vector<char> is_target_;                               // by vertex: another one was merged into it
  std::vector<std::pair<std::uint32_t, Quad>> renamed_;       // quads as they were
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
