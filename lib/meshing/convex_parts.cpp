#include "lib/meshing/convex_parts.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "lib/core/error.h"
#include "lib/core/predicates.h"

namespace bp {

namespace {

using Face = std::array<std::uint32_t, 3>;

std::uint32_t find_root(std::vector<std::uint32_t>& parent, std::uint32_t v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

/// Incremental convex hull with exact signs. A face that the new point lies on the plane of is kept: a point outside of
/// the hull always sees some other face, and no new face is degenerate, since a horizon edge in line with the point
/// would lie in the plane of the seen face beside it.
class Hull {
 public:
  explicit Hull(const std::vector<LatticeCoord>& points) : points_(points) { begin(); }

  void add(std::uint32_t p) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> seen_edges;  // of faces that p sees
    std::vector<Face> kept;
    for (const Face& f : faces_) {
      if (side(f, p) <= 0) {
        kept.push_back(f);
        continue;
      }
      for (std::size_t k = 0; k < 3; ++k) seen_edges.insert({f[k], f[(k + 1) % 3]});
    }
    if (kept.size() == faces_.size()) return;
    for (const auto& [a, b] : seen_edges) {
      if (seen_edges.count({b, a}) == 0) kept.push_back({a, b, p});
    }
    faces_ = std::move(kept);
  }

  [[nodiscard]] const std::vector<Face>& faces() const { return faces_; }

 private:
  /// Above 0 if p lies on the side that the face turns to.
  [[nodiscard]] int side(const Face& f, std::uint32_t p) const {
    return orient3d(points_[f[0]], points_[f[1]], points_[f[2]], points_[p]);
  }

  /// A tetrahedron of the first points that are not in one plane.
  void begin() {
    const auto n = std::uint32_t(points_.size());
    for (std::uint32_t b = 1; b < n; ++b) {
      if (points_[b] == points_[0]) continue;
      for (std::uint32_t c = b + 1; c < n; ++c) {
        if (collinear(points_[0], points_[b], points_[c])) continue;
        for (std::uint32_t d = c + 1; d < n; ++d) {
          const Face base{0, b, c};
          const int s = side(base, d);
          if (s == 0) continue;
          const std::uint32_t x = s > 0 ? c : b, y = s > 0 ? b : c;  // (0, x, y) turns away from d
          faces_ = {{0, x, y}, {x, 0, d}, {y, x, d}, {0, y, d}};
          return;
        }
        break;
      }
      break;
    }
    fail(ErrorCode::bad_argument, "all vertices lie in a plane; there is no convex hull");
  }

  const std::vector<LatticeCoord>& points_;
  std::vector<Face> faces_;
};

/// The part of `mesh` made of these faces, with only the vertices that they use, in the order of first use.
LatticeMesh part_of(const LatticeMesh& mesh, const std::vector<Face>& faces) {
  LatticeMesh part;
  part.frame = mesh.frame;
  part.provenance = mesh.provenance;
  std::map<std::uint32_t, std::uint32_t> renamed;
  for (Face f : faces) {
    for (std::uint32_t& v : f) {
      const auto [found, is_new] = renamed.emplace(v, std::uint32_t(part.vertices.size()));
      if (is_new) part.vertices.push_back(mesh.vertices[v]);
      v = found->second;
    }
    part.triangles.push_back(f);
  }
  return part;
}

}  // namespace

std::vector<LatticeMesh> components_of(const LatticeMesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0u);
  for (const Face& f : mesh.triangles) {
    for (const std::uint32_t v : f) parent[find_root(parent, v)] = find_root(parent, f[0]);
  }
  std::map<std::uint32_t, std::size_t> number;
  std::vector<std::vector<Face>> faces;
  for (const Face& f : mesh.triangles) {
    const auto [found, is_new] = number.emplace(find_root(parent, f[0]), faces.size());
    if (is_new) faces.emplace_back();
    faces[found->second].push_back(f);
  }
  std::vector<LatticeMesh> parts;
  for (const std::vector<Face>& f : faces) parts.push_back(part_of(mesh, f));
  return parts;
}

LatticeMesh convex_hull(const LatticeMesh& mesh) {
  Hull hull(mesh.vertices);
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) hull.add(v);
  return part_of(mesh, hull.faces());
}

}  // namespace bp
