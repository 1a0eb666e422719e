#include "lib/pass/mesh/detail/mend_around.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <optional>
#include <unordered_map>

#include "lib/core/disjoint_sets.h"
#include "lib/core/parallel.h"
#include "lib/exact/triangle_intersection.h"
#include "lib/geometry/apart.h"
#include "lib/geometry/crossing.h"
#include "lib/geometry/triangle_bvh.h"
#include "lib/geometry/welded_triangles.h"
#include "lib/mesh/constrained_minimum.h"
#include "lib/mesh/face_tree.h"
#include "lib/mesh/lattice_geometry.h"

namespace bp {

namespace {

constexpr double kKept = 0x1p-24;  // part of a voxel
// Distance from an apex to the planes around it, lattice units: more than rounding moves it.
constexpr double kAbove = 2;

LatticeBox box_of_face(const LatticeMesh& mesh, const Triangle& face) {
  const auto& [a, b, c] = face;
  return box_of(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
}

bool has_area(const LatticeMesh& mesh, std::size_t f) {
  const auto& [a, b, c] = mesh.triangles[f];
  return normal_of(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]) != LatticeCoord{};
}

TriangleD world_face(const LatticeMesh& mesh, std::uint32_t f) {
  const auto& [a, b, c] = mesh.triangles[f];
  return {mesh.frame.world(mesh.vertices[a]), mesh.frame.world(mesh.vertices[b]), mesh.frame.world(mesh.vertices[c])};
}

/// Returns a box around a triangle of the scene, with a margin for rounding to the lattice and of `off` lattice units.
LatticeBox lattice_box(const TriangleD& t, const GridFrame& frame, double off) {
  const LatticeBox box =
      box_of(rounded(frame.to_lattice(t[0])), rounded(frame.to_lattice(t[1])), rounded(frame.to_lattice(t[2])));
  return box.grown(2 + std::int64_t(std::ceil(off)));
}

/// The scene's triangles, which the mesh must enclose, each with a box.
class SceneBoxes {
 public:
  SceneBoxes(std::span<const TriangleD> triangles, const Rounding& rounding, const GridFrame& frame)
      : triangles_(triangles), rounding_(rounding), kept_(rounding.any() ? kKept * frame.voxel : 0) {
    boxes_.resize(triangles.size());
    parallel_ranges(std::int64_t(boxes_.size()), kItemsAtOnce, [&](std::int64_t begin, std::int64_t end) {
      for (auto i = std::size_t(begin); i < std::size_t(end); ++i)
        boxes_[i] = lattice_box(triangles[i], frame, kept_from(triangles[i]) * kLatticePerVoxel / frame.voxel);
    });
    std::vector<std::uint32_t> all(boxes_.size());
    std::iota(all.begin(), all.end(), 0U);
    tree_.build(boxes_, std::move(all));
  }
  /// Returns whether the face meets triangle i, or may come as near to it as that may be off by.
  [[nodiscard]] bool touches(std::size_t i, const TriangleD& face) const {
    const TriangleD& t = triangles_[i];
    if (rounding_.any()) return !are_apart(t, face, kept_from(t));
    return collinear(t[0], t[1], t[2]) ? degenerate_triangle_meets(t.data(), face.data())
                                       : triangles_intersect(t.data(), face.data());
  }
  [[nodiscard]] const BoxTree& tree() const { return tree_; }  ///< over the boxes

 private:
  [[nodiscard]] double kept_from(const TriangleD& t) const { return rounding_.any() ? rounding_.of(t) + kept_ : 0; }

  std::span<const TriangleD> triangles_;
  const Rounding rounding_;
  const double kept_;  // besides, from a rounded triangle, so that a check in doubles can tell; scene units
  std::vector<LatticeBox> boxes_;
  BoxTree tree_;
};

/// Winding number of the mesh around a point of the scene that lies on no face.
int winding(const LatticeMesh& mesh, const FaceTree& tree, const Vec3d& point) {
  const LatticeCoord p = rounded(mesh.frame.to_lattice(point));
  int sum = 0;
  static_cast<void>(
      tree.query({p - LatticeCoord{2, 2, 2}, {p.x + 2, p.y + 2, kEverywhere.max.z}}, [&](std::uint32_t f) {
        sum += crossing_above(world_face(mesh, f), point);
        return true;
      }));
  return sum;
}

using Faults = std::vector<std::atomic<char>>;  // one flag for each face

/// Marks the faces that have no area, meet other faces or touch the scene. `doubtful`: for each face, whether it may be
/// one of these; no two other faces meet.
void mark_faults(const LatticeMesh& mesh, const FaceTree& tree, const SceneBoxes& scene,
                 const std::vector<char>& doubtful, Faults& faulty) {
  const auto mark = [&](std::uint32_t f) {
    if (!has_area(mesh, f)) {
      faulty[f] = 1;
      return;
    }
    const LatticeBox box = box_of_face(mesh, mesh.triangles[f]);
    static_cast<void>(tree.query(box, [&](std::uint32_t g) {
      const bool is_asked_twice = doubtful[g] != 0 && g <= f;
      if (!is_asked_twice && has_area(mesh, g) &&
          triangles_meet_beyond_shared(mesh.vertices.data(), mesh.triangles[f], mesh.triangles[g]))
        faulty[f] = faulty[g] = 1;
      return true;
    }));
    const TriangleD face = world_face(mesh, f);
    if (!scene.tree().query(box, [&](std::uint32_t t) { return !scene.touches(t, face); })) faulty[f] = 1;
  };
  parallel_ranges(std::int64_t(mesh.triangles.size()), kItemsAtOnce, [&](std::int64_t begin, std::int64_t end) {
    for (auto f = std::uint32_t(begin); f < std::uint32_t(end); ++f) {
      if (doubtful[f] != 0) mark(f);
    }
  });
}

/// Returns one corner of each part of the scene that is connected by corners. If no triangle touches the mesh, each
/// part lies on one side of it.
std::vector<Vec3d> points_of_parts(std::span<const TriangleD> scene) {
  const WeldedTriangles mesh = welded(scene);
  DisjointSets parts(mesh.places.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    parts.unite(a, b);
    parts.unite(b, c);
  }
  std::vector<Vec3d> points;
  for (std::uint32_t i = 0; i < mesh.places.size(); ++i) {
    if (parts.find(i) == i) points.push_back(mesh.places[i]);
  }
  return points;
}

bool is_in_domain(const TriangleD& t) {
  return in_predicate_domain(t[0]) && in_predicate_domain(t[1]) && in_predicate_domain(t[2]);
}

/// A disc of faces of the mesh that a tent may replace.
struct Disc {
  std::vector<FaceId> faces;
  std::vector<VertexId> rim;  // the boundary's vertices, counterclockwise
};

/// Finds the rim from its edges. Returns false if the faces are not a disc.
bool trace_rim(const HalfEdgeMesh& mesh, const std::unordered_map<VertexId, VertexId>& next, Disc& disc) {
  const VertexId first = std::min_element(next.begin(), next.end())->first;
  for (VertexId v = first; disc.rim.empty() || v != first; v = next.at(v)) disc.rim.push_back(v);
  std::vector<VertexId> inner;
  for (const FaceId f : disc.faces) {
    for (HalfEdgeId h = 3 * f; h < 3 * f + 3; ++h) {
      if (!next.contains(mesh.from(h))) inner.push_back(mesh.from(h));
    }
  }
  std::sort(inner.begin(), inner.end());
  inner.erase(std::unique(inner.begin(), inner.end()), inner.end());
  // By Euler's formula, a disc of V inner and R rim vertices has 2 V + R - 2 faces, and no other shape with one rim
  // has.
  return disc.rim.size() == next.size() && disc.faces.size() + 2 == 2 * inner.size() + disc.rim.size();
}

/// Returns the connected sets of faces that have a marked vertex, if they are discs.
std::vector<Disc> discs_around(const HalfEdgeMesh& mesh, const std::vector<char>& marked) {
  std::vector<char> taken(mesh.face_capacity());
  const auto is_wanted = [&](FaceId f) {
    return marked[mesh.from(3 * f)] != 0 || marked[mesh.from(3 * f + 1)] != 0 || marked[mesh.from(3 * f + 2)] != 0;
  };
  std::vector<Disc> discs;
  for (FaceId first = 0; first < mesh.face_capacity(); ++first) {
    if (taken[first] != 0 || !is_wanted(first)) continue;
    Disc disc;
    disc.faces.push_back(first);
    taken[first] = 1;
    std::unordered_map<VertexId, VertexId> next;  // the rim's next vertex after each
    bool is_disc = true;
    for (std::size_t i = 0; i < disc.faces.size(); ++i) {
      for (HalfEdgeId h = 3 * disc.faces[i]; h < 3 * disc.faces[i] + 3; ++h) {
        const FaceId beside = HalfEdgeMesh::face(mesh.twin(h));
        if (!is_wanted(beside)) {
          // A repeated vertex means that the rim meets itself.
          is_disc = next.emplace(mesh.from(h), mesh.to(h)).second && is_disc;
        } else if (taken[beside] == 0) {
          taken[beside] = 1;
          disc.faces.push_back(beside);
        }
      }
    }
    if (is_disc && !next.empty() && trace_rim(mesh, next, disc)) discs.push_back(std::move(disc));
  }
  return discs;
}

/// Puts tents over faults. A tent replaces a disc of faces around a fault: its faces join the disc's rim to an apex
/// outside.
class Tents {
 public:
  /// `faces`: a tree over the mesh's present faces.
  Tents(LatticeMesh& mesh, const FaceTree& faces, const SceneBoxes& scene)
      : mesh_(mesh), faces_(faces), scene_(scene) {}

  /// Puts a tent over each disc for which an apex is found. Returns for each face of the new mesh whether it may have a
  /// fault: it had one, or it is a tent's.
  std::vector<char> put_over(const std::vector<Disc>& discs, const Faults& faulty) {
    std::vector<char> gone(mesh_.triangles.size());
    for (const Disc& disc : discs) {
      for (const FaceId f : disc.faces) gone[f] = 1;
    }
    for (const Disc& disc : discs) {
      if (put_over(disc, gone)) continue;
      for (const FaceId f : disc.faces) gone[f] = 0;
    }
    std::vector<Triangle> kept;
    std::vector<char> doubtful;
    for (std::size_t f = 0; f < mesh_.triangles.size(); ++f) {
      const bool is_new = f >= gone.size();
      if (!is_new && gone[f] != 0) continue;
      kept.push_back(mesh_.triangles[f]);
      doubtful.push_back(is_new || faulty[f] != 0);
    }
    mesh_.triangles = std::move(kept);
    drop_unused_vertices(mesh_.vertices, mesh_.triangles);
    return doubtful;
  }

 private:
  bool put_over(const Disc& disc, const std::vector<char>& gone) {
    const LatticeCoord origin = mesh_.vertices[disc.rim.front()];
    Vec3d middle{}, area{};
    for (std::size_t i = 0; i < disc.rim.size(); ++i) {
      const Vec3d p = to_double(mesh_.vertices[disc.rim[i]] - origin),
                  q = to_double(mesh_.vertices[disc.rim[(i + 1) % disc.rim.size()]] - origin);
      middle = middle + (1 / double(disc.rim.size())) * p;
      area = area + cross(p, q);
    }
    const double size = std::sqrt(length(area));
    if (!(size > 0)) return false;
    const Vec3d up = (1 / length(area)) * area;
    for (const Vec3d& place : apexes(disc, origin, middle, up, size)) {
      const LatticeCoord apex = origin + rounded(place);
      if (is_far(disc, apex) || !is_free(disc, apex, gone)) continue;
      const std::vector<Triangle> tent = tent_over(disc, VertexId(mesh_.vertices.size()));
      mesh_.vertices.push_back(apex);
      mesh_.triangles.insert(mesh_.triangles.end(), tent.begin(), tent.end());
      return true;
    }
    return false;
  }

  static std::vector<Triangle> tent_over(const Disc& disc, VertexId apex) {
    std::vector<Triangle> tent;
    for (std::size_t i = 0; i < disc.rim.size(); ++i)
      tent.push_back({disc.rim[i], disc.rim[(i + 1) % disc.rim.size()], apex});
    return tent;
  }

  /// Returns whether the apex lies so far from the faces that a surface of voxels would lie nearer. Tightening removes
  /// most of a tent: one of 8 to 16 voxels on the horse model ends nearer than voxels do; one of about 60 on a duck
  /// does not.
  [[nodiscard]] bool is_far(const Disc& disc, const LatticeCoord& apex) const {
    constexpr double kFar = 16 * kLatticePerVoxel;
    return std::none_of(disc.faces.begin(), disc.faces.end(), [&](FaceId f) {
      const auto& [a, b, c] = mesh_.triangles[f];
      const TriangleD face{to_double(mesh_.vertices[a] - apex), to_double(mesh_.vertices[b] - apex),
                           to_double(mesh_.vertices[c] - apex)};
      return distance_squared(Vec3d{}, face) <= kFar * kFar;
    });
  }

  /// Returns the places for an apex, relative to `origin`, the best first. The first one lies beyond the planes of all
  /// faces, as near to them as possible; faces that are folded over are ignored. The others lie above the middle of the
  /// rim.
  [[nodiscard]] std::vector<Vec3d> apexes(const Disc& disc, const LatticeCoord& origin, const Vec3d& middle,
                                          const Vec3d& up, double size) const {
    // A face is folded over if the cosine between its normal and the rim's axis is less.
    constexpr double kFolded = 0.1;
    std::vector<Vec3d> places;
    Quadric planes;
    std::vector<PlaneConstraint> beyond;
    for (const FaceId f : disc.faces) {
      const auto& [a, b, c] = mesh_.triangles[f];
      const Vec3d normal = to_double(normal_of(mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]));
      const double twice_area = length(normal);
      if (!(dot(normal, up) > kFolded * twice_area)) continue;
      const Vec3d unit = (1 / twice_area) * normal;
      const double at = dot(unit, to_double(mesh_.vertices[a] - origin)) + kAbove;
      planes.add_plane(unit, -at, twice_area);
      beyond.push_back({unit, at});
    }
    if (const std::optional<Vec3d> place = constrained_minimum(planes, middle, beyond);
        place && length(*place - middle) < 2 * size)
      places.push_back(*place);
    for (const double share : {0.0, 0.125, 0.25, 0.5, 1.0}) places.push_back(middle + (share * size + kAbove) * up);
    return places;
  }

  /// Returns whether the tent meets neither the scene nor the rest of the mesh. Tents that meet each other are found in
  /// the next round.
  bool is_free(const Disc& disc, const LatticeCoord& apex, const std::vector<char>& gone) {
    mesh_.vertices.push_back(apex);
    const std::vector<Triangle> tent = tent_over(disc, VertexId(mesh_.vertices.size() - 1));
    bool free = true;
    for (std::size_t i = 0; i < tent.size() && free; ++i) {
      const auto& [a, b, c] = tent[i];
      const LatticeCoord &p = mesh_.vertices[a], &q = mesh_.vertices[b], &r = mesh_.vertices[c];
      const LatticeBox box = box_of_face(mesh_, tent[i]);
      const TriangleD world{mesh_.frame.world(p), mesh_.frame.world(q), mesh_.frame.world(r)};
      free = normal_of(p, q, r) != LatticeCoord{} && faces_.query(box, [&](std::uint32_t f) {
        return gone[f] != 0 || !has_area(mesh_, f) ||
               !triangles_meet_beyond_shared(mesh_.vertices.data(), tent[i], mesh_.triangles[f]);
      }) && scene_.tree().query(box, [&](std::uint32_t t) { return !scene_.touches(t, world); });
      for (std::size_t j = 0; j < i && free; ++j)
        free = !triangles_meet_beyond_shared(mesh_.vertices.data(), tent[i], tent[j]);
    }
    mesh_.vertices.pop_back();
    return free;
  }

  LatticeMesh& mesh_;
  const FaceTree& faces_;
  const SceneBoxes& scene_;
};

/// Marks the vertices of faulty faces, and those up to `rings` edges away.
std::vector<char> vertices_near(const HalfEdgeMesh& mesh, const Faults& faulty, int rings) {
  std::vector<char> marked(mesh.vertex_capacity());
  for (FaceId f = 0; f < faulty.size(); ++f) {
    for (HalfEdgeId h = 3 * f; faulty[f] != 0 && h < 3 * f + 3; ++h) marked[mesh.from(h)] = 1;
  }
  for (; rings > 0; --rings) {
    const std::vector<char> before = marked;
    for (HalfEdgeId h = 0; h < 3 * faulty.size(); ++h) {
      if (before[mesh.from(h)] != 0) marked[mesh.to(h)] = 1;
    }
  }
  return marked;
}

}  // namespace

bool mend_around(LatticeMesh& mesh, std::span<const TriangleD> scene, const Rounding& rounding) {
  constexpr int kRounds = 6;
  constexpr std::size_t kFewFaults = 50;  // at most one fault for so many faces: a scene of overlapping parts has more
  if (!std::all_of(scene.begin(), scene.end(), is_in_domain)) return false;
  const SceneBoxes inside(scene, rounding, mesh.frame);
  std::vector<char> doubtful(mesh.triangles.size(), 1);
  for (int round = 0; round < kRounds; ++round) {
    const HalfEdgeMesh connected(mesh);
    const FaceTree faces(connected);
    Faults faulty(mesh.triangles.size());
    mark_faults(mesh, faces, inside, doubtful, faulty);
    const auto faults = std::size_t(std::count(faulty.begin(), faulty.end(), 1));
    if (faults * kFewFaults > mesh.triangles.size()) return false;
    if (faults == 0) {
      const std::vector<Vec3d> points = points_of_parts(scene);
      return std::all_of(points.begin(), points.end(), [&](const Vec3d& p) { return winding(mesh, faces, p) > 0; });
    }
    doubtful =
        Tents(mesh, faces, inside).put_over(discs_around(connected, vertices_near(connected, faulty, round)), faulty);
  }
  return false;
}

}  // namespace bp
