#pragma once
#include <cstdint>
#include <vector>

#include "lib/check/check_report.h"
#include "lib/core/box.h"
#include "lib/geometry/triangle_bvh.h"

/// Whether open convex solids cover a triangle together.
namespace bp {

class ConvexCover {
 public:
  /// A part is what lies below the planes of all its triangles, which face outwards.
  explicit ConvexCover(const std::vector<std::vector<TriangleD>>& parts);

  /// Whether each point of the triangle lies strictly within a part. In floating point, with bounds of all rounding:
  /// both `proven` and `refuted` are certain. Not decided is what parts cover that overlap by less than some 1e-13 of
  /// their size for each of a few cuts, and what must be cut into more than kMostPieces to see it. Coordinates are
  /// taken relative to the triangle, so that its distance from the origin does not matter. Safe to call from several
  /// threads. `moved`: so it is wherever the triangle's corners, and the planes of the parts, come to lie within that
  /// distance.
  [[nodiscard]] Answer covers(const TriangleD& t, double moved = 0) const;

  /// Calls f(part) for each part whose box meets `box`, until f returns true. Returns whether it did.
  template <class F>
  bool visit(const Bounds3d& box, F&& f) const {
    return boxes_.visit(box, [&](const TriangleBvh::Item& item) { return f(item.id); });
  }

 private:
  static constexpr std::size_t kMostPieces = 100'000;
  static constexpr int kMostCuts = 500;  // one after the other

  /// A frame of coordinates around a triangle. Points are relative to `origin`, and off by `off` along each axis.
  struct Local {
    Vec3d origin;
    double far;  // the largest coordinate
    double off = 0;
    [[nodiscard]] Local after(int cuts) const;  // of the corners of a piece, and of its middle
  };
  /// l(p) = n . (p - a) is above 0 beyond the plane.
  struct Plane {
    Vec3d a, n, size;  // size: the sum of what n is the difference of
    /// l(p), and how far it may be off.
    struct Height {
      double value, error;
    };
    [[nodiscard]] Height height(const Vec3d& p, const Local& local) const;
  };
  [[nodiscard]] static Bounds3d box_around(const Vec3d& p, const Local& local);
  struct Piece {
    std::vector<Vec3d> corners;
    int cuts = 0;  // made before
  };

  [[nodiscard]] bool holds(std::uint32_t part, const Vec3d& p, const Local& local, double slack) const;
  [[nodiscard]] bool misses(std::uint32_t part, const Vec3d& p, const Local& local) const;
  [[nodiscard]] bool is_bare(const Vec3d& p, const Local& local) const;
  [[nodiscard]] bool shows_bare(const Piece& piece, const Local& frame) const;
  [[nodiscard]] std::uint32_t best_part(const Piece& piece, const Local& frame) const;
  bool take_from(std::vector<Piece>& pieces, std::uint32_t part, int most_cuts, const Local& frame) const;
  [[nodiscard]] Answer covers_by(const TriangleD& t, int most_cuts, const Local& frame) const;

  std::vector<std::vector<Plane>> parts_;
  TriangleBvh boxes_;
};

}  // namespace bp
