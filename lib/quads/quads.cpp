// [TPC*10] pairs triangles greedily by the squareness of the quad, and repairs the rest by flips and moves. Here the
// surface stays as it is, and a better matching is searched for.
#include "lib/quads/quads.h"

#include <algorithm>
#include <cmath>

#include "lib/exact/triangle_intersection.h"
#include "lib/mesh/guard.h"

namespace bp {

namespace {

constexpr double kCountWeight = 0.6;  // value of one more quad, in units of quality
constexpr double kLongAspect = 4;     // a quad whose sides differ more has a lower quality
constexpr double kRoomWeight = 0.5;   // weight of needed room, over the mean of all candidates, against quality
constexpr int kImprovements = 16;     // passes; they end when one finds nothing
constexpr std::uint32_t kNone = ~std::uint32_t(0);

using Triangle = std::array<std::uint32_t, 3>;

Vec3d unit_normal(const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& c) {
  Vec3d n = to_double(normal_of(a, b, c));
  const double l = length(n);
  for (double& x : n) x = l > 0 ? x / l : 0;
  return n;
}

double angle_at(const LatticeCoord& p, const LatticeCoord& q, const LatticeCoord& r) {
  return std::atan2(length(to_double(normal_of(p, q, r))), dot(to_double(q - p), to_double(r - p)));
}

/// Two triangles that may be joined.
struct Candidate {
  std::array<std::uint32_t, 2> faces;
  double weight;
  std::array<Triangle, 2> across;  // the triangles on both sides of the other diagonal
  double room;                     // volume that moving its corners outwards would add, roughly; mostly 0
};

double star_area(const HalfEdgeMesh& mesh, VertexId v) {
  double sum = 0;
  mesh.for_each_outgoing(v, [&](HalfEdgeId h) {
    sum +=
        length(to_double(normal_of(mesh.position(v), mesh.position(mesh.to(h)), mesh.position(mesh.opposite(h))))) / 2;
  });
  return sum;
}

/// Returns the volume that lifting both ends of one diagonal up to the other one adds.
double room_between(const HalfEdgeMesh& mesh, HalfEdgeId h) {
  const VertexId a = mesh.opposite(h), b = mesh.opposite(mesh.twin(h));
  const LatticeCoord &u = mesh.position(mesh.from(h)), &w = mesh.position(mesh.to(h));
  const Vec3d n = cross(to_double(w - u), to_double(mesh.position(b) - mesh.position(a)));
  const double depth = std::abs(dot(n, to_double(mesh.position(a) - u))) / length(n);
  return depth * (star_area(mesh, a) + star_area(mesh, b)) / 3;
}

/// Adds the candidate of an edge, unless its triangles must not be joined.
void add_candidate(const HalfEdgeMesh& mesh, HalfEdgeId h, Guard& guard, QuadKeeps keeps, const Enclosed* enclosed,
                   std::vector<Candidate>& candidates) {
  const HalfEdgeId t = mesh.twin(h);
  const VertexId u = mesh.from(h), w = mesh.to(h), a = mesh.opposite(h), b = mesh.opposite(t);
  const Tetrahedron p = {mesh.position(u), mesh.position(w), mesh.position(a), mesh.position(b)};
  const double quality = quad_quality({p[0], p[3], p[1], p[2]});
  if (quality < kLeastQuadQuality || !mesh.can_flip(h)) return;
  const std::array<NewFace, 2> across = {NewFace{{b, a, u}, {p[3], p[2], p[0]}},
                                         NewFace{{a, b, w}, {p[2], p[3], p[1]}}};
  const std::array<FaceId, 2> faces = {HalfEdgeMesh::face(h), HalfEdgeMesh::face(t)};
  double room = 0;
  if (keeps != QuadKeeps::nothing && orient3d(p[0], p[1], p[2], p[3]) < 0) {
    const std::array<Tetrahedron, 1> between = {p};
    const bool allowed = enclosed != nullptr && enclosed->allows(across, between);
    if (!allowed && keeps == QuadKeeps::enclosed) return;
    if (!allowed) room = room_between(mesh, h);
  }
  if (!guard.faces_are_free(across, faces)) return;
  candidates.push_back({{std::min(faces[0], faces[1]), std::max(faces[0], faces[1])},
                        quality + kCountWeight,
                        {across[0].ids, across[1].ids},
                        room});
}

std::vector<Candidate> find_candidates(const LatticeMesh& lattice, QuadKeeps keeps, const Enclosed* enclosed) {
  const HalfEdgeMesh mesh(lattice);
  const FaceTree tree(mesh);
  Guard guard(mesh, tree);
  std::vector<Candidate> candidates;
  for (HalfEdgeId h = 0; h < 3 * mesh.face_capacity(); ++h) {
    if (mesh.edge(h) == h) add_candidate(mesh, h, guard, keeps, enclosed, candidates);
  }
  return candidates;
}

/// Lowers the weight of each pair that needs room, by its room over the mean room of such pairs.
void charge_room(std::vector<Candidate>& candidates) {
  double sum = 0;
  int n = 0;
  for (const Candidate& c : candidates) {
    sum += c.room;
    n += c.room > 0;
  }
  for (Candidate& c : candidates) c.weight -= c.room > 0 ? kRoomWeight * c.room / (sum / n) : 0;
}

/// Chooses among candidates.
class Pairing {
 public:
  Pairing(const LatticeMesh& mesh, std::vector<Candidate> candidates)
      : lattice_(mesh),
        candidates_(std::move(candidates)),
        edges_(mesh.triangles.size()),
        match_(mesh.triangles.size(), kNone) {
    for (std::uint32_t c = 0; c < candidates_.size(); ++c) {
      for (const std::uint32_t f : candidates_[c].faces) edges_[f].push_back(c);
    }
  }

  std::vector<std::array<std::uint32_t, 2>> run() {
    charge_room(candidates_);
    match();
    improve();
    return pairs_without_conflicts();
  }

  /// Chooses among the pairs `wanted` only.
  std::vector<std::array<std::uint32_t, 2>> run(std::vector<std::array<std::uint32_t, 2>> wanted) {
    std::sort(wanted.begin(), wanted.end());
    for (std::uint32_t c = 0; c < candidates_.size(); ++c) {
      if (std::binary_search(wanted.begin(), wanted.end(), candidates_[c].faces)) set(c, true);
    }
    return pairs_without_conflicts();
  }

 private:
  std::vector<std::array<std::uint32_t, 2>> pairs_without_conflicts() {
    drop_conflicts();
    std::vector<std::array<std::uint32_t, 2>> pairs;
    for (const Candidate& c : candidates_) {
      if (match_[c.faces[0]] == std::uint32_t(&c - candidates_.data())) pairs.push_back(c.faces);
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

  /// Returns the candidates, best first.
  [[nodiscard]] std::vector<std::uint32_t> by_weight() const {
    std::vector<std::uint32_t> order(candidates_.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t i, std::uint32_t j) { return candidates_[i].weight > candidates_[j].weight; });
    return order;
  }

  [[nodiscard]] std::uint32_t other(std::uint32_t candidate, std::uint32_t face) const {
    const auto& faces = candidates_[candidate].faces;
    return faces[0] == face ? faces[1] : faces[0];
  }
  void set(std::uint32_t candidate, bool taken) {
    for (const std::uint32_t f : candidates_[candidate].faces) match_[f] = taken ? candidate : kNone;
  }

  void match() {
    for (const std::uint32_t c : by_weight()) {
      if (candidates_[c].weight <= 0) return;
      if (match_[candidates_[c].faces[0]] == kNone && match_[candidates_[c].faces[1]] == kNone) set(c, true);
    }
  }

  /// Exchanges one pair for two others, or for a better one, where that gains.
  void improve() {
    for (int pass = 0; pass < kImprovements; ++pass) {
      bool changed = false;
      for (std::uint32_t c = 0; c < candidates_.size(); ++c) changed = improve_at(c) || changed;
      if (!changed) return;
    }
  }

  bool improve_at(std::uint32_t c) {
    if (match_[candidates_[c].faces[0]] != c) return false;
    std::uint32_t best[2] = {kNone, kNone};  // a free pair at either end
    for (std::size_t end = 0; end < 2; ++end) {
      for (const std::uint32_t e : edges_[candidates_[c].faces[end]]) {
        if (e == c || match_[other(e, candidates_[c].faces[end])] != kNone) continue;
        if (best[end] == kNone || candidates_[e].weight > candidates_[best[end]].weight) best[end] = e;
      }
    }
    const auto weight = [&](std::uint32_t e) { return e == kNone ? 0.0 : candidates_[e].weight; };
    const bool clash = best[0] != kNone && best[1] != kNone &&
                       other(best[0], candidates_[c].faces[0]) == other(best[1], candidates_[c].faces[1]);
    if (clash) best[weight(best[0]) >= weight(best[1]) ? 1 : 0] = kNone;
    if (weight(best[0]) + weight(best[1]) <= candidates_[c].weight + 1e-9) return false;
    set(c, false);
    for (const std::uint32_t e : best) {
      if (e != kNone) set(e, true);
    }
    return true;
  }

  /// Drops the worse of two quads whose other diagonals cannot be drawn at once.
  void drop_conflicts() {
    std::vector<LatticeBox> boxes(candidates_.size());
    std::vector<std::uint32_t> chosen;
    for (const std::uint32_t c : by_weight()) {
      if (match_[candidates_[c].faces[0]] != c) continue;
      chosen.push_back(c);
      boxes[c] = box_of_triangle(candidates_[c].across[0]);
      for (const std::uint32_t v : candidates_[c].across[1]) boxes[c].add(lattice_.vertices[v]);
    }
    BoxTree tree;
    tree.build(boxes, chosen);
    std::vector<char> kept(candidates_.size(), 0);
    for (const std::uint32_t c : chosen) {
      kept[c] = tree.query(boxes[c], [&](std::uint32_t d) { return !kept[d] || !conflict(c, d); });
      if (!kept[c]) set(c, false);
    }
  }

  [[nodiscard]] LatticeBox box_of_triangle(const Triangle& t) const {
    return box_of(lattice_.vertices[t[0]], lattice_.vertices[t[1]], lattice_.vertices[t[2]]);
  }

  [[nodiscard]] bool conflict(std::uint32_t c, std::uint32_t d) const {
    const Triangle &p = candidates_[c].across[0], &q = candidates_[d].across[0];  // both begin with the diagonal
    if (std::minmax(p[0], p[1]) == std::minmax(q[0], q[1])) return true;          // four triangles at one edge
    for (const Triangle& s : candidates_[c].across) {
      for (const Triangle& t : candidates_[d].across) {
        if (triangles_meet_beyond_shared(lattice_.vertices.data(), s, t)) return true;
      }
    }
    return false;
  }

  const LatticeMesh& lattice_;
  std::vector<Candidate> candidates_;
  std::vector<std::vector<std::uint32_t>> edges_;  // per face: its candidates
  std::vector<std::uint32_t> match_;               // per face: its candidate, or kNone
};

}  // namespace

double quad_bend(const std::array<LatticeCoord, 4>& p) {
  const Vec3d one = to_double(p[2] - p[0]), other = to_double(p[3] - p[1]), n = cross(one, other);
  const double across = length(n) * (length(one) + length(other)) / 2;
  return across > 0 ? std::abs(dot(n, to_double(p[1] - p[0]))) / across : 1;
}

double quad_aspect(const std::array<LatticeCoord, 4>& p) {
  double shortest = HUGE_VAL, longest = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double side = length(to_double(p[(i + 1) % 4] - p[i]));
    shortest = std::min(shortest, side);
    longest = std::max(longest, side);
  }
  return longest / shortest;
}

double quad_quality(const std::array<LatticeCoord, 4>& p) {
  if (quad_bend(p) > kMostQuadBend) return 0;
  const Vec3d along = unit_normal(p[0], p[1], p[2]), along2 = unit_normal(p[0], p[2], p[3]);
  const Vec3d across = unit_normal(p[1], p[2], p[3]), across2 = unit_normal(p[1], p[3], p[0]);
  const double flat = std::min({dot(along, along2), dot(across, across2), dot(along, across), dot(along2, across2)});
  if (flat <= 0) return 0;
  double worst = 0;
  for (std::size_t i = 0; i < 4; ++i)
    worst = std::max(worst, std::abs(angle_at(p[i], p[(i + 1) % 4], p[(i + 3) % 4]) - M_PI / 2));
  return flat * std::max(0.0, 1 - worst / (M_PI / 2)) * std::min(1.0, kLongAspect / quad_aspect(p));
}

std::vector<std::array<std::uint32_t, 2>> pair_triangles(const LatticeMesh& mesh, QuadKeeps keeps,
                                                         const Enclosed* enclosed) {
  return Pairing(mesh, find_candidates(mesh, keeps, enclosed)).run();
}

std::vector<std::array<std::uint32_t, 2>> safe_pairs(const LatticeMesh& mesh,
                                                     const std::vector<std::array<std::uint32_t, 2>>& pairs,
                                                     QuadKeeps keeps, const Enclosed* enclosed) {
  return Pairing(mesh, find_candidates(mesh, keeps, enclosed)).run(pairs);
}

Quad quad_of(const Triangle& a, const Triangle& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {  // a: u w x, b: w u y
      if (a[i] == b[(j + 1) % 3] && a[(i + 1) % 3] == b[j])
        return {a[(i + 1) % 3], a[(i + 2) % 3], a[i], b[(j + 2) % 3]};
    }
  }
  return {kNone, kNone, kNone, kNone};
}

std::array<Triangle, 2> across(const Quad& q) {
  return {Triangle{q[1], q[2], q[3]}, Triangle{q[1], q[3], q[0]}};
}

std::vector<Triangle> drawable_triangles(const LatticeMesh& mesh) {
  std::vector<Triangle> all = mesh.triangles;
  for (const auto& pair : mesh.quads) {
    for (const Triangle& t : across(quad_of(mesh.triangles[pair[0]], mesh.triangles[pair[1]]))) all.push_back(t);
  }
  return all;
}

LatticeMesh innermost_choice(const LatticeMesh& mesh) {
  LatticeMesh out = mesh;
  out.quads.clear();
  for (const auto& pair : mesh.quads) {
    const Quad q = quad_of(mesh.triangles[pair[0]], mesh.triangles[pair[1]]);
    const auto corner = [&](std::size_t i) { return mesh.vertices[q[i]]; };
    if (orient3d(corner(0), corner(1), corner(2), corner(3)) >= 0) continue;  // the other diagonal would add
    for (std::size_t i = 0; i < 2; ++i) out.triangles[pair[i]] = across(q)[i];
  }
  return out;
}

PolygonFaces polygon_faces(const LatticeMesh& mesh) {
  PolygonFaces faces;
  std::vector<char> joined(mesh.triangles.size(), 0);
  for (const auto& pair : mesh.quads) {
    faces.quads.push_back(quad_of(mesh.triangles[pair[0]], mesh.triangles[pair[1]]));
    joined[pair[0]] = joined[pair[1]] = 1;
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!joined[i]) faces.triangles.push_back(mesh.triangles[i]);
  }
  return faces;
}

}  // namespace bp
