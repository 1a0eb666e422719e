#pragma once
#include <optional>
#include <string>

#include "lib/core/coords.h"

namespace bp {

/// The volume that a stream of triangles winds around, in doubles: parts that overlap count each, parts that face
/// inwards count negative.
class SignedVolume {
 public:
  /// origin: a point near the triangles, so that far scenes keep their digits.
  explicit SignedVolume(const Vec3d& origin = {}) : origin_(origin) {}
  void add(const TriangleD& t);
  void add(const SignedVolume& v);  ///< of the same origin
  /// None if the triangles leave a hole or face both ways, for then the sum depends on the point that it is taken from:
  /// their area vectors do not cancel out, but for rounding. (Some holes do, as the two ends of a tube.)
  [[nodiscard]] std::optional<double> value() const;

 private:
  Vec3d origin_;
  Vec3d two_areas_{};       ///< sum of the area vectors, doubled
  double two_area_ = 0;     ///< sum of their lengths
  double rounding_ = 0;     ///< of their sum, at most
  double six_volumes_ = 0;  ///< undivided: exact for small integers
};

/// "27", or why it is below 0, or why there is none: what bpinfo and bpcheck say.
[[nodiscard]] std::string volume_text(const std::optional<double>& volume);

}  // namespace bp
