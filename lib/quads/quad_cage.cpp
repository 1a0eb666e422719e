// [XLG09] also takes the boundary of voxels and smooths it. Here the boundary shrinks like a skin: each vertex moves to
// the mean of its neighbours along quads, and inwards, as far as the enclosed set allows; then all go together, and at
// last each alone, to where the solid is smallest.
#include "lib/quads/quad_cage.h"

#include <algorithm>

#include "lib/quads/detail/enclosed_by_pairs.h"
#include "lib/quads/detail/skin.h"
#include "lib/quads/quads.h"
#include "lib/tighten/proxy_editor.h"

namespace bp {

namespace {

constexpr int kSweeps = 40;
constexpr int kJointFits = 8;  // 16 change the volume by less than a hundredth
constexpr int kFits = 4;

/// Returns the mesh without erased faces. `number`: the new number of each face.
LatticeMesh left_of(const CellQuads& cage, const HalfEdgeMesh& mesh, std::vector<FaceId>& number) {
  LatticeMesh out;
  out.frame = cage.mesh.frame;
  for (VertexId v = 0; v < cage.mesh.vertices.size(); ++v) out.vertices.push_back(mesh.position(v));
  number.assign(cage.mesh.triangles.size(), kNoId);
  for (FaceId f = 0; f < number.size(); ++f) {
    if (!mesh.alive(f)) continue;
    number[f] = FaceId(out.triangles.size());
    out.triangles.push_back(cage.mesh.triangles[f]);
  }
  drop_unused_vertices(out.vertices, out.triangles);
  return out;
}

/// Returns the pairs of triangles that may stay joined, together with their mirror images. The second half of the pairs
/// mirrors the first.
std::vector<std::array<std::uint32_t, 2>> pairs_left(const CellQuads& cage, const LatticeMesh& mesh,
                                                     const std::vector<FaceId>& number, const Enclosed& enclosed) {
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (const auto& [f, g] : cage.mesh.quads) pairs.push_back({number[f], number[g]});
  const std::vector<std::array<std::uint32_t, 2>> safe = safe_pairs(mesh, pairs, QuadKeeps::enclosed, &enclosed);
  const auto is_safe = [&](std::size_t i) { return std::binary_search(safe.begin(), safe.end(), pairs[i]); };
  std::vector<std::array<std::uint32_t, 2>> left;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::size_t image = cage.mate.empty() ? i : (i + pairs.size() / 2) % pairs.size();
    if (is_safe(i) && is_safe(image)) left.push_back(pairs[i]);
  }
  return left;
}

}  // namespace

LatticeMesh shrunk_cage(const CellQuads& cage, const Enclosed& enclosed, const std::optional<MirrorPlane>& plane) {
  HalfEdgeMesh mesh(cage.mesh);
  EnclosedByPairs kept(mesh, enclosed);
  for (const auto& [f, g] : cage.mesh.quads) kept.join(f, g);
  ProxyEditor editor(mesh, kept, {});
  Skin skin(cage, mesh, editor, plane);
  for (int i = 0; i < kSweeps; ++i) skin.relax();
  for (int i = 0; i < kJointFits; ++i) skin.fit_together();
  for (int i = 0; i < kFits; ++i) skin.fit();
  editor.erase_inner_shells();
  std::vector<FaceId> number;
  LatticeMesh out = left_of(cage, mesh, number);
  out.quads = pairs_left(cage, out, number, enclosed);
  return out;
}

}  // namespace bp
