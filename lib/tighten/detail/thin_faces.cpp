#include "lib/tighten/detail/thin_faces.h"

#include <algorithm>
#include <array>

#include "lib/core/vec3.h"
#include "lib/mesh/shells.h"

namespace bp {

namespace {

// triangle_quality() of the faces that are looked at. An angle of ten degrees between two equal edges has 0.3.
constexpr double kThin = 0.3;
constexpr int kFlipRounds = 8;

double quality_of(const HalfEdgeMesh& mesh, FaceId f) {
  return triangle_quality(mesh.corner(f, 0), mesh.corner(f, 1), mesh.corner(f, 2));
}

/// Returns how much the thinner face beside the edge gains by a flip. It is at most 0 if the flip adds more than
/// `most`, if the new edge lies farther above the old one than the skin is thick, or if a new face turns away from the
/// old ones: then the flip makes a fin, which has next to no volume.
double gain_of_flip(const HalfEdgeMesh& mesh, HalfEdgeId h, double most) {
  const HalfEdgeId t = mesh.twin(h);
  if (t == kNoId || !mesh.can_flip(h)) return 0;
  const std::array<FaceId, 2> faces{HalfEdgeMesh::face(h), HalfEdgeMesh::face(t)};
  const LatticeCoord &u = mesh.position(mesh.from(h)), &w = mesh.position(mesh.to(h)),
                     &a = mesh.position(mesh.opposite(h)), &b = mesh.position(mesh.opposite(t));
  const double added6 = double(fan_gain6(mesh, faces, b));  // six times a tetrahedron with both edges
  if (added6 > 6 * most || added6 > kSkin * length(cross(to_double(w - u), to_double(b - a)))) return 0;
  for (const Vec3d& before : {to_double(normal_of(u, w, a)), to_double(normal_of(w, u, b))}) {
    if (dot(before, to_double(normal_of(b, a, u))) <= 0 || dot(before, to_double(normal_of(a, b, w))) <= 0) return 0;
  }
  return std::min(triangle_quality(b, a, u), triangle_quality(a, b, w)) -
         std::min(quality_of(mesh, faces[0]), quality_of(mesh, faces[1]));
}

/// Flips the edge of the face whose flip gains most.
bool flip_best(ProxyEditor& editor, FaceId f, double most) {
  std::array<std::pair<double, HalfEdgeId>, 3> edges;
  for (HalfEdgeId k = 0; k < 3; ++k) edges[k] = {-gain_of_flip(editor.mesh(), 3 * f + k, most), 3 * f + k};
  std::sort(edges.begin(), edges.end());
  return std::any_of(edges.begin(), edges.end(), [&](const auto& e) { return e.first < 0 && editor.flip(e.second); });
}

}  // namespace

std::uint64_t flip_thin_faces(ProxyEditor& editor, double most) {
  const HalfEdgeMesh& mesh = editor.mesh();
  std::uint64_t all = 0, some = 1;
  for (int round = 0; round < kFlipRounds && some > 0; ++round) {
    some = 0;
    for (FaceId f = 0; f < mesh.face_capacity(); ++f) {
      if (mesh.alive(f) && quality_of(mesh, f) < kThin) some += flip_best(editor, f, most);
    }
    all += some;
  }
  return all;
}

}  // namespace bp
