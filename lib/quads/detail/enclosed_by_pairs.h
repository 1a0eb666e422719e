#pragma once
#include <algorithm>
#include <vector>

#include "lib/enclosed/enclosed.h"
#include "lib/exact/predicates.h"
#include "lib/quads/quads.h"

namespace bp {

/// Allows a change only if the enclosed set stays inside under either diagonal of each pair of triangles.
class EnclosedByPairs final : public Enclosed {
 public:
  EnclosedByPairs(const HalfEdgeMesh& mesh, const Enclosed& enclosed)
      : mesh_(mesh), enclosed_(enclosed), partner_(mesh.face_capacity(), kNoId) {}

  void join(FaceId f, FaceId g) {
    partner_[f] = g;
    partner_[g] = f;
  }
  void part(FaceId f, FaceId g) { partner_[f] = partner_[g] = kNoId; }
  /// Returns whether moving v to `to` keeps the enclosed set inside under the other diagonals of the pairs around v.
  [[nodiscard]] bool allows_corner(VertexId v, const LatticeCoord& to) const { return across_allows(v, to, nullptr); }
  /// Without contact points an editor is made quickly, but cannot fit.
  void give_contacts(bool on) { contacts_ = on; }
  /// A change leaves each quad at least this quality, or the one that it had.
  void set_least_quality(double quality) { least_quality_ = quality; }
  /// Flips are refused unless this is set, since they would break pairs.
  void allow_flips(bool on) { flips_ = on; }

  [[nodiscard]] bool allows(std::span<const NewFace> star, std::span<const Tetrahedron> swept,
                            Blocker* blocker) const override {
    const bool flip = star[0].ids[0] != star[1].ids[0];
    if (flip) return flips_ && enclosed_.allows(star, swept, blocker);
    return enclosed_.allows(star, swept, blocker) && across_allows(star[0].ids[0], star[0].corners[0], blocker);
  }
  [[nodiscard]] std::vector<Vec3d> contact_points(const LatticeCoord& origin, const LatticeBox& within) const override {
    return contacts_ ? enclosed_.contact_points(origin, within) : std::vector<Vec3d>{};
  }
  [[nodiscard]] std::uint64_t bytes() const override { return enclosed_.bytes(); }

 private:
  /// Tests the pairs around v with their other diagonals.
  [[nodiscard]] bool across_allows(VertexId v, const LatticeCoord& to, Blocker* blocker) const {
    std::vector<NewFace> faces;
    std::vector<Tetrahedron> swept;
    bool fine = true;
    const LatticeCoord p = mesh_.position(v);
    const auto add = [&](VertexId a, VertexId b) {
      const LatticeCoord &pa = mesh_.position(a), &pb = mesh_.position(b);
      faces.push_back({{v, a, b}, {to, pa, pb}});
      if (orient3d(p, pa, pb, to) < 0) swept.push_back({p, pa, pb, to});
    };
    mesh_.for_each_outgoing(v, [&](HalfEdgeId h) {
      const FaceId partner = partner_[HalfEdgeMesh::face(h)];
      if (partner == kNoId) return;
      std::array<VertexId, 4> quad;  // corners, beginning with v
      const HalfEdgeId beyond = mesh_.twin(HalfEdgeMesh::next(h));
      if (HalfEdgeMesh::face(mesh_.twin(h)) == partner) {  // the diagonal ends here: once for both faces
        quad = {v, mesh_.opposite(mesh_.twin(h)), mesh_.to(h), mesh_.opposite(h)};
        add(quad[1], quad[3]);
      } else if (HalfEdgeMesh::face(beyond) == partner) {
        quad = {v, mesh_.to(h), mesh_.opposite(beyond), mesh_.opposite(h)};
        add(quad[1], quad[2]);
        add(quad[2], quad[3]);
      } else {
        return;
      }
      fine = fine && keeps_shape(quad, to);
    });
    return fine && (faces.empty() || enclosed_.allows(faces, swept, blocker));
  }

  [[nodiscard]] bool keeps_shape(const std::array<VertexId, 4>& quad, const LatticeCoord& to) const {
    std::array<LatticeCoord, 4> p;
    for (std::size_t i = 0; i < 4; ++i) p[i] = mesh_.position(quad[i]);
    const double before = quad_quality(p);
    p[0] = to;
    return quad_quality(p) >= std::min(before, least_quality_);
  }

  const HalfEdgeMesh& mesh_;
  const Enclosed& enclosed_;
  std::vector<FaceId> partner_;
  double least_quality_ = kLeastQuadQuality;
  bool flips_ = false, contacts_ = true;
};

}  // namespace bp
