#include "lib/deform/cage.h"

#include <cmath>
#include <map>

#include "lib/core/box.h"
#include "lib/core/error.h"
#include "lib/core/vec3.h"

namespace bp {

namespace {

void check_vertices(const IndexedMesh& mesh, const std::string& name) {
  if (mesh.triangles.empty()) fail(ErrorCode::bad_input, "{}: has no faces, and is no cage", name);
  if (mesh.vertices.size() > kMostCageVertices || mesh.triangles.size() > kMostCageTriangles)
    fail(ErrorCode::bad_input, "{}: a cage has {} vertices and {} triangles at most, and this one {} and {}", name,
         kMostCageVertices, kMostCageTriangles, mesh.vertices.size(), mesh.triangles.size());
  for (const Vec3d& v : mesh.vertices) {
    if (!std::isfinite(v[0]) || !std::isfinite(v[1]) || !std::isfinite(v[2]))
      fail(ErrorCode::bad_input, "{}: a cage has a vertex that is not finite", name);
  }
}

/// Sets origin and diagonal, and moves the vertices into that unit.
void take_unit(Cage& cage) {
  Bounds3d bounds;
  for (const Vec3d& v : cage.vertices) bounds.add(v);
  cage.diagonal = bounds.diagonal();
  Vec3d sum{};
  for (const Vec3d& v : cage.vertices) sum = sum + (v - bounds.min);
  cage.origin = bounds.min + (1.0 / double(cage.vertices.size())) * sum;
  for (Vec3d& v : cage.vertices) v = cage.to_cage(v);
}

/// Numbers the edges by their first use, so that faces share them.
class EdgeTable {
 public:
  explicit EdgeTable(Cage& cage) : cage_(cage) {}

  void add(const std::array<std::uint32_t, 3>& corner) {
    Cage::Face face{corner, {}, {}};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = corner[(i + 1) % 3], b = corner[(i + 2) % 3];
      const auto [at, is_new] = numbers_.try_emplace({std::min(a, b), std::max(a, b)}, cage_.edges.size());
      if (is_new) cage_.edges.push_back({a, b}), balance_.push_back(0);
      face.edge[i] = std::uint32_t(at->second);
      face.sign[i] = cage_.edges[at->second].a == a ? 1 : -1;
      balance_[at->second] += int(face.sign[i]);
    }
    cage_.faces.push_back(face);
  }
  /// Returns the number of edges that faces do not use as often one way as the other.
  [[nodiscard]] std::size_t open_edges() const {
    std::size_t open = 0;
    for (const int sum : balance_) open += sum != 0;
    return open;
  }

 private:
  Cage& cage_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> numbers_;
  std::vector<int> balance_;
};

double six_volumes(const Cage& cage) {
  double sum = 0;
  for (const Cage::Face& f : cage.faces)
    sum += dot(cage.vertices[f.corner[0]], cross(cage.vertices[f.corner[1]], cage.vertices[f.corner[2]]));
  return sum;
}

/// Returns the inverse of the spread, by cofactors. A cage with a volume spans all three directions.
std::array<Vec3d, 3> inverse_spread(const Cage& cage) {
  std::array<Vec3d, 3> s{};
  for (const Vec3d& v : cage.vertices) {
    for (std::size_t i = 0; i < 3; ++i) s[i] = s[i] + v[i] * v;
  }
  const std::array<Vec3d, 3> cofactors{cross(s[1], s[2]), cross(s[2], s[0]), cross(s[0], s[1])};
  const double scale = 1 / dot(s[0], cofactors[0]);
  return {scale * cofactors[0], scale * cofactors[1], scale * cofactors[2]};  // symmetric
}

}  // namespace

Cage make_cage(const IndexedMesh& mesh, const std::string& name) {
  constexpr double kLeastVolume = 1e-9;  // six times the volume, over the cube of the diagonal
  check_vertices(mesh, name);
  Cage cage;
  cage.vertices = mesh.vertices;
  take_unit(cage);
  EdgeTable edges(cage);
  for (const auto& t : mesh.triangles) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) edges.add(t);
  }
  if (edges.open_edges() > 0)
    fail(ErrorCode::bad_input, "{}: is no closed cage: edges that are open, or whose faces face both ways: {}", name,
         edges.open_edges());
  const double volume = cage.diagonal > 0 ? six_volumes(cage) : 0;
  if (!(std::abs(volume) > kLeastVolume)) fail(ErrorCode::bad_input, "{}: a cage without volume", name);
  if (volume < 0) {
    for (Cage::Face& f : cage.faces) {
      std::swap(f.corner[1], f.corner[2]), std::swap(f.edge[1], f.edge[2]), std::swap(f.sign[1], f.sign[2]);
      for (double& sign : f.sign) sign = -sign;
    }
  }
  cage.spread = inverse_spread(cage);
  return cage;
}

}  // namespace bp
