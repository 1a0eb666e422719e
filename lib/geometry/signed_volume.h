#pragma once
#include <optional>
#include <string>

#include "lib/core/coords.h"

namespace bp {

/// The volume that a stream of triangles winds around, in doubles. Parts that overlap count each, and parts that face
/// inwards count negative.
class SignedVolume {
 public:
  /// `origin`: a point near the triangles, so that far scenes keep their digits.
  explicit SignedVolume(const Vec3d& origin = {}) : origin_(origin) {}
  void add(const TriangleD& t);
  void add(const SignedVolume& v);  ///< needs the same origin
  /// Returns the volume. Returns nothing if the triangles leave a hole or face both ways, because the sum then depends
  /// on the origin: their area vectors do not cancel out, except for rounding. (Some holes do cancel out, such as the
  /// two ends of a tube.)
  [[nodiscard]] std::optional<double> value() const;

 private:
  Vec3d origin_;
  Vec3d two_areas_{};       ///< sum of the area vectors, doubled
  double two_area_ = 0;     ///< sum of the lengths of the area vectors, doubled
  double rounding_ = 0;     ///< bound of the rounding of two_area_
  double six_volumes_ = 0;  ///< six times the volume: exact for small integers
};

/// Returns "27", or why the volume is below 0, or why there is none, for bpinfo and bpcheck.
[[nodiscard]] std::string volume_text(const std::optional<double>& volume);

}  // namespace bp
