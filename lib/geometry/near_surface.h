#pragma once
#include <vector>

#include "lib/geometry/triangle_bvh.h"

namespace bp {

/// Are triangles near a surface? For many questions about the same places: what is found near a place is kept, and most
/// parts of later triangles are settled by it, without a search. Not thread-safe.
class NearSurface {
 public:
  static constexpr std::size_t kBytesPerPlace = 32;

  /// Keeps a reference to `to`, which must not be empty. `place`: edge of the cubes that share what is kept, scene
  /// units: half of the limits that are asked about serves well, or half of a triangle of `to`, if these are larger.
  /// `places`: how many are kept, kBytesPerPlace each.
  NearSurface(const TriangleBvh& to, double place, std::size_t places);

  /// Distance from p to the surface; where that is at most `enough`, anything from it to `enough`.
  [[nodiscard]] double distance(const Vec3d& p, double enough = 0);

  /// True only if no point of `t` is farther from the surface than `limit` > 0, in floating point. False also for
  /// triangles that come within about 1 % of it, or need thousands of parts: the search for a proof ends there, and
  /// where it does may depend on what was asked before.
  [[nodiscard]] bool holds(const TriangleD& t, double limit);

 private:
  struct Place {
    std::uint32_t mark = 0;  // tells places that share an entry apart, mostly; 0: none was here
    std::uint32_t item = 0;  // of to_, near the place
    Vec3d point{};           // on it
  };
  static_assert(sizeof(Place) == kBytesPerPlace);
  enum class Answer { yes, no, open };

  [[nodiscard]] const Place& place_at(const Vec3d& p);
  [[nodiscard]] Answer examine(const TriangleD& part, double limit);
  [[nodiscard]] bool is_beside_any(const TriangleD& part, std::uint32_t guess, double limit) const;
  [[nodiscard]] bool cut_out(const TriangleD& part, const TriangleD& nearest, double limit);

  const TriangleBvh& to_;
  double places_per_unit_;
  std::vector<Place> places_;  // by hash of where they are
  std::uint32_t last_ = 0;     // item that was found last
  std::vector<TriangleD> open_;
};

}  // namespace bp
