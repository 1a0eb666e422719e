#pragma once
#include <vector>

#include "lib/geometry/triangle_bvh.h"

namespace bp {

/// Answers whether triangles are near a surface. It is made for many questions about the same places: the surface found
/// near a place is kept, and proves most parts of later triangles near, without a search. Not thread-safe.
class NearSurface {
 public:
  static constexpr std::size_t kBytesPerPlace = 32;

  /// Keeps a reference to `to`, which must not be empty. `place`: edge of the cubes that share a kept result, scene
  /// units. Half of the usual limit serves well, or half of a triangle of `to` if that is larger. `places`: how many
  /// cubes are kept, kBytesPerPlace each.
  NearSurface(const TriangleBvh& to, double place, std::size_t places);

  /// Returns the distance from p to the surface. If that is at most `enough`, it returns anything from it to `enough`.
  [[nodiscard]] double distance(const Vec3d& p, double enough = 0);

  /// Returns true only if no point of `t` is farther from the surface than `limit` > 0, in floating point. It also
  /// returns false for triangles that come within about 1 % of the limit, or need thousands of parts: the search for a
  /// proof ends there. Where it ends may depend on earlier questions.
  [[nodiscard]] bool holds(const TriangleD& t, double limit);

 private:
  struct Place {
    std::uint32_t mark = 0;  // tells places that share an entry apart, mostly; 0: the entry is empty
    std::uint32_t item = 0;  // item of to_ near the place
    Vec3d point{};           // a point on that item
  };
  static_assert(sizeof(Place) == kBytesPerPlace);
  enum class Answer { yes, no, open };

  [[nodiscard]] const Place& place_at(const Vec3d& p);
  [[nodiscard]] Answer examine(const TriangleD& part, double limit);
  [[nodiscard]] bool is_beside_any(const TriangleD& part, std::uint32_t guess, double limit) const;
  [[nodiscard]] bool cut_out(const TriangleD& part, const TriangleD& nearest, double limit);

  const TriangleBvh& to_;
  double places_per_unit_;
  std::vector<Place> places_;  // by hash of their coordinates
  std::uint32_t last_ = 0;     // the item that was found last
  std::vector<TriangleD> open_;
};

}  // namespace bp
