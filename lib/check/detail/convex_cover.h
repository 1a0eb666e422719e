#pragma once
#include <cstdint>
#include <vector>

#include "lib/check/check_report.h"
#include "lib/core/box.h"
#include "lib/geometry/triangle_bvh.h"

/// Decides whether open convex solids together cover a triangle.
namespace bp {

class ConvexCover {
 public:
  /// A part is the solid below the planes of all its triangles, which face outwards.
  explicit ConvexCover(const std::vector<std::vector<TriangleD>>& parts);

  /// Decides whether each point of the triangle lies strictly within a part. In floating point, with bounds on all
  /// rounding: both `proven` and `refuted` are certain. Undecided are triangles whose parts overlap by less than some
  /// 1e-13 of their size for each of a few cuts, and triangles that would need more than kMostPieces. Coordinates are
  /// taken relative to the triangle, so that its distance from the origin does not matter. Thread-safe. `moved`: asks
  /// it of parts whose planes have moved inwards by so much along each axis. So `proven` holds wherever the triangle's
  /// corners, and the planes of the parts, lie within this distance of their places; `refuted` is about those parts.
  [[nodiscard]] Answer covers(const TriangleD& t, double moved = 0) const;

  /// Calls f(part) for each part whose box meets `box`, until f returns true. Returns whether it did.
  template <class F>
  bool visit(const Bounds3d& box, F&& f) const {
    return boxes_.visit(box, [&](const TriangleBvh::Item& item) { return f(item.id); });
  }

 private:
  static constexpr std::size_t kMostPieces = 100'000;
  static constexpr int kMostCuts = 500;  // cuts of a piece, one after the other

  /// A frame of coordinates around a triangle. Points are relative to `origin`, and off by `off` along each axis.
  struct Local {
    Vec3d origin;
    double far;    // the largest coordinate in the frame
    double moved;  // as of covers()
    double off = 0;
    [[nodiscard]] Local after(int cuts) const;  // of the corners of a piece, and of its middle
  };
  /// A plane: l(p) = n . (p - a) is above 0 beyond it.
  struct Plane {
    Vec3d a, n, size;  // size: sums of the terms of n in absolute value
    /// The height l(p), and a bound on its error.
    struct Height {
      double value, error;
    };
    [[nodiscard]] Height height(const Vec3d& p, const Local& local) const;
  };
  [[nodiscard]] static Bounds3d box_around(const Vec3d& p, const Local& local);
  struct Piece {
    std::vector<Vec3d> corners;
    int cuts = 0;  // cuts made before
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
