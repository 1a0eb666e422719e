#pragma once
#include <cstdint>
#include <vector>

#include "lib/core/box.h"
#include "lib/geometry/triangle_bvh.h"

/// Whether open convex solids cover a triangle together.
namespace bp {

class ConvexCover {
 public:
  /// A part is what lies below the planes of all its triangles, which face outwards.
  explicit ConvexCover(const std::vector<std::vector<TriangleD>>& parts);

  /// True only if each point of the triangle lies strictly within a part. In floating point, with bounds of all
  /// rounding: what is proved is so. Not proved is what parts cover that overlap by less than some 1e-10 of the
  /// largest coordinate, or what must be cut into more than kMostPieces to see it. Safe to call from several threads.
  [[nodiscard]] bool covers(const TriangleD& t) const;

  /// Calls f(part) for each part whose box meets `box`, until f returns true. Returns whether it did.
  template <class F>
  bool visit(const Bounds3d& box, F&& f) const {
    return boxes_.visit(box, [&](const TriangleBvh::Item& item) { return f(item.id); });
  }

 private:
  static constexpr std::size_t kMostPieces = 100'000;
  static constexpr int kMostCuts = 500;  // one after the other

  /// l(p) = n . (p - a) is above 0 beyond the plane.
  struct Plane {
    Vec3d a, n, size;  // size: the sum of what n is the difference of
    /// l(p), and how far it may be off if p is, by `off` along each axis.
    struct Height {
      double value, error;
    };
    [[nodiscard]] Height height(const Vec3d& p, double off) const;
  };
  struct Piece {
    std::vector<Vec3d> corners;
    int cuts = 0;  // made before
  };

  [[nodiscard]] bool holds(std::uint32_t part, const Vec3d& p, double off, double slack) const;
  [[nodiscard]] std::uint32_t best_part(const Piece& piece, double off) const;
  bool take_from(std::vector<Piece>& pieces, std::uint32_t part, double off) const;

  std::vector<std::vector<Plane>> parts_;
  TriangleBvh boxes_;
};

}  // namespace bp
