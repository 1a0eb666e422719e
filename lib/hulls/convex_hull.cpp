#include "lib/hulls/convex_hull.h"

#include <algorithm>

#include "lib/core/error.h"
#include "lib/mesh/box_tree.h"
#include "lib/mesh/lattice_geometry.h"
#include "lib/mesh/lattice_mesh.h"

namespace bp {

namespace {

constexpr std::uint32_t kNone = ~std::uint32_t(0);

/// Quickhull [BDH96] with exact signs instead of thick facets. A face stays if a new point lies on its plane. A point
/// outside of the hull always sees some other face. No new face is degenerate, since a horizon edge in line with the
/// point would lie in the plane of the seen face next to it.
class Quickhull {
 public:
  explicit Quickhull(std::span<const LatticeCoord> points)
      : points_(points), next_(points.size(), kNone), face_from_(points.size(), kNone) {}

  /// Returns false if all points lie in a plane.
  bool run() {
    if (!begin()) return false;
    while (!waiting_.empty()) {
      const std::uint32_t f = waiting_.back();
      waiting_.pop_back();
      if (faces_[f].alive && faces_[f].outside != kNone) add(farthest(faces_[f]), f);
    }
    return true;
  }

  /// Returns the corners of the hull: at least three of their edges lie between faces of different planes.
  [[nodiscard]] std::vector<LatticeCoord> corners() const {
    std::vector<std::uint32_t> sharp(points_.size(), 0);
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      if (!faces_[f].alive) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const Face& beside = faces_[faces_[f].beside[k]];
        for (const std::uint32_t v : beside.v) {
          if (side(faces_[f], v) == 0) continue;
          ++sharp[faces_[f].v[k]];  // its other end counts the edge from the other face
          break;
        }
      }
    }
    std::vector<LatticeCoord> found;
    for (std::size_t v = 0; v < sharp.size(); ++v) {
      if (sharp[v] >= 3) found.push_back(points_[v]);
    }
    return found;
  }

  [[nodiscard]] ConvexHull hull() const {
    ConvexHull hull;
    std::vector<std::uint32_t> renamed(points_.size(), kNone);
    for (const Face& face : faces_) {
      if (!face.alive) continue;
      std::array<std::uint32_t, 3> t{};
      for (std::size_t k = 0; k < 3; ++k) {
        std::uint32_t& name = renamed[face.v[k]];
        if (name == kNone) {
          name = std::uint32_t(hull.vertices.size());
          hull.vertices.push_back(points_[face.v[k]]);
        }
        t[k] = name;
      }
      hull.triangles.push_back(t);
    }
    return hull;
  }

 private:
  struct Face {
    std::array<std::uint32_t, 3> v;
    std::array<std::uint32_t, 3> beside;  // across the edge from v[k] to v[k + 1]
    LatticeCoord normal;
    std::uint32_t outside = kNone;  // first of the points that it sees, and no face before it sees
    bool alive = true;
  };

  [[nodiscard]] int side(const Face& face, std::uint32_t p) const {
    return side_along(face.normal, points_[p] - points_[face.v[0]]);
  }

  std::uint32_t add_face(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    faces_.push_back({{a, b, c}, {kNone, kNone, kNone}, normal_of(points_[a], points_[b], points_[c])});
    return std::uint32_t(faces_.size() - 1);
  }

  /// Returns the point that is farthest from a face that it sees. Rounding only changes the order of work.
  [[nodiscard]] std::uint32_t farthest(const Face& face) const {
    std::uint32_t best = face.outside;
    double most = -1;
    for (std::uint32_t p = face.outside; p != kNone; p = next_[p]) {
      const LatticeCoord d = points_[p] - points_[face.v[0]];
      const double height = double(face.normal.x) * double(d.x) + double(face.normal.y) * double(d.y) +
                            double(face.normal.z) * double(d.z);
      if (height > most) most = height, best = p;
    }
    return best;
  }

  /// Begins with a tetrahedron of points far apart.
  bool begin() {
    const auto n = std::uint32_t(points_.size());
    if (n < 4) return false;
    std::array<std::uint32_t, 4> c{};
    for (std::uint32_t p = 1; p < n; ++p) {
      if (points_[p] < points_[c[0]]) c[0] = p;
    }
    const auto pick = [&](std::uint32_t& corner, auto&& measure) {
      double most = 0;
      for (std::uint32_t p = 0; p < n; ++p) {
        const double m = measure(points_[p]);
        if (m > most) most = m, corner = p;
      }
      return most > 0;
    };
    const auto from_first = [&](const LatticeCoord& p) { return to_double(p - points_[c[0]]); };
    if (!pick(c[1], [&](const LatticeCoord& p) { return dot(from_first(p), from_first(p)); })) return false;
    if (!pick(c[2], [&](const LatticeCoord& p) {
          const Vec3d normal = to_double(normal_of(points_[c[0]], points_[c[1]], p));
          return dot(normal, normal);
        }))
      return false;
    const LatticeCoord normal = normal_of(points_[c[0]], points_[c[1]], points_[c[2]]);
    if (!pick(c[3], [&](const LatticeCoord& p) {
          const LatticeCoord d = p - points_[c[0]];
          return side_along(normal, d) == 0 ? 0 : std::abs(dot(to_double(normal), to_double(d))) + 1e-300;
        }))
      return false;
    if (side_along(normal, points_[c[3]] - points_[c[0]]) > 0) std::swap(c[1], c[2]);
    for (const auto& [x, y, z] : {std::array{0, 1, 2}, {1, 0, 3}, {2, 1, 3}, {0, 2, 3}})
      add_face(c[std::size_t(x)], c[std::size_t(y)], c[std::size_t(z)]);
    link({0, 1, 2, 3});
    waiting_ = {3, 2, 1, 0};
    for (std::uint32_t p = 0; p < n; ++p) assign(p, waiting_);
    return true;
  }

  /// Links the first four faces: each edge is there once in either direction.
  void link(std::initializer_list<std::uint32_t> faces) {
    for (const std::uint32_t f : faces) {
      for (const std::uint32_t g : faces) {
        for (std::size_t k = 0; k < 3; ++k) {
          for (std::size_t l = 0; l < 3; ++l) {
            if (faces_[f].v[k] == faces_[g].v[(l + 1) % 3] && faces_[f].v[(k + 1) % 3] == faces_[g].v[l])
              faces_[f].beside[k] = g;
          }
        }
      }
    }
  }

  void assign(std::uint32_t p, const std::vector<std::uint32_t>& faces) {
    for (const std::uint32_t f : faces) {
      if (side(faces_[f], p) <= 0) continue;
      next_[p] = faces_[f].outside;
      faces_[f].outside = p;
      return;
    }
  }

  /// Adds a point: removes the faces that p sees, found from `first` on, and makes a new face over each edge around
  /// them.
  void add(std::uint32_t p, std::uint32_t first) {
    seen_.assign(1, first);
    fresh_.clear();
    faces_[first].alive = false;
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      for (const std::uint32_t g : faces_[seen_[i]].beside) {
        if (!faces_[g].alive || side(faces_[g], p) <= 0) continue;
        faces_[g].alive = false;
        seen_.push_back(g);
      }
    }
    for (const std::uint32_t f : seen_) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t beyond = faces_[f].beside[k];
        if (!faces_[beyond].alive) continue;
        const std::uint32_t a = faces_[f].v[k], b = faces_[f].v[(k + 1) % 3];
        const std::uint32_t made = add_face(a, b, p);
        faces_[made].beside[0] = beyond;
        *std::find(faces_[beyond].beside.begin(), faces_[beyond].beside.end(), f) = made;
        face_from_[a] = made;
        fresh_.push_back(made);
      }
    }
    for (const std::uint32_t f : fresh_) {
      const std::uint32_t g = face_from_[faces_[f].v[1]];
      faces_[f].beside[1] = g;
      faces_[g].beside[2] = f;
    }
    for (const std::uint32_t f : seen_) {
      for (std::uint32_t q = faces_[f].outside, after = kNone; q != kNone; q = after) {
        after = next_[q];
        if (q != p) assign(q, fresh_);
      }
    }
    for (const std::uint32_t f : fresh_) {
      if (faces_[f].outside != kNone) waiting_.push_back(f);
    }
  }

  std::span<const LatticeCoord> points_;
  std::vector<Face> faces_;
  std::vector<std::uint32_t> next_;       // by point: the next one of its face
  std::vector<std::uint32_t> face_from_;  // by point: the new face whose edge to the hull begins there
  std::vector<std::uint32_t> waiting_, seen_, fresh_;
};

}  // namespace

std::optional<ConvexHull> hull_of(std::span<const LatticeCoord> points) {
  if (points.empty()) return {};
  const LatticeBox box = box_of(points);
  constexpr std::int64_t kReach = std::int64_t(1) << 29;  // within this reach normal_of() and side_along() are exact
  for (int i = 0; i < 3; ++i) {
    if (box.max[i] - box.min[i] >= kReach) fail(ErrorCode::bad_argument, "points too far apart for a convex hull");
  }
  Quickhull all(points);
  if (!all.run()) return {};
  ConvexHull hull = all.hull();
  const std::vector<LatticeCoord> corners = all.corners();
  if (corners.size() == hull.vertices.size()) return hull;
  Quickhull sparse(corners);  // without points on edges and sides
  (void)sparse.run();
  return sparse.hull();
}

double volume6_of(const ConvexHull& hull) {
  return double(volume6_of(hull.vertices, hull.triangles));
}

}  // namespace bp
