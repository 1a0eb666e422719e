#pragma once
#include <vector>

#include "lib/core/vec3.h"
#include "lib/enclosed/contact_points.h"

namespace bp {

/// An enclosed set with fewer contact points than the whole: those that the faces of a proxy around it meet first, as
/// ContactPoints lists them. They guide all coarser proxies made from this proxy, at a fraction of the cost: a point
/// that lies under others for a small face mostly does for a larger face, too. Where it does not, allows(), which asks
/// the whole set, refuses the move that the points led to.
class FewContacts final : public Enclosed {
 public:
  /// Keeps a reference to `all`.
  FewContacts(const Enclosed& all, const HalfEdgeMesh& proxy) : all_(all) {
    const FaceTree tree(proxy);
    const ContactPoints contacts(all, proxy, tree);
    const Vec3d shift = to_double(contacts.origin());
    for (const Vec3d& p : contacts.points()) points_.push_back(p + shift);
  }

  [[nodiscard]] bool allows(std::span<const NewFace> star, std::span<const Tetrahedron> swept,
                            Blocker* blocker) const override {
    return all_.allows(star, swept, blocker);
  }
  [[nodiscard]] std::vector<Vec3d> contact_points(const LatticeCoord& origin, const LatticeBox& within) const override {
    const Vec3d shift = to_double(origin);
    std::vector<Vec3d> points;
    for (const Vec3d& p : points_) {
      const LatticeCoord at = rounded(p);
      if (within.holds({at, at})) points.push_back(p - shift);
    }
    return points;
  }
  [[nodiscard]] bool is_near(std::span<const NewFace> faces, double distance) const override {
    return all_.is_near(faces, distance);
  }
  void expect_near(double distance) const override { all_.expect_near(distance); }
  [[nodiscard]] bool is_exact() const override { return all_.is_exact(); }
  void outer_boxes(const UseBoxes& use) const override { all_.outer_boxes(use); }
  [[nodiscard]] std::uint64_t bytes() const override {
    return all_.bytes() + points_.capacity() * sizeof(Vec3d) + points_.size() * kBytesPerContactPoint;
  }

 private:
  const Enclosed& all_;
  std::vector<Vec3d> points_;  // lattice units
};

}  // namespace bp
