#include "tools/scale/orientation_rules.h"

#include <fmt/format.h>

#include <cmath>

#include "lib/core/vec3.h"
#include "lib/pass/measure/orientation_rules.h"
#include "tools/run/read_again.h"

namespace bp {

OrientationField make_orientation(const std::string& json, const std::string& file, const StreamHeader& header,
                                  const ScaleField& scale, const SceneOptions& scene) {
  const TriangleReader read_scene = [&](const auto& take) { read_again(header.scene, header.bounds, scene, take); };
  return make_orientation(parse_orientation(json, file), header, scale.base, read_scene);
}

std::string orientation_text(const FixedQuaternion& q) {
  // The rows of a matrix are the turned axes, so the matrix is the inverse.
  const Vec3d axis{double(-q.x), double(-q.y), double(-q.z)};
  const double sine = length(axis);
  if (!(sine > 0)) return "not turned";
  const double degrees = 2 * std::atan2(sine, double(q.w)) * 180 / 3.14159265358979323846;
  return fmt::format("turned by {:.3g} degrees about {:.3g},{:.3g},{:.3g}", degrees, axis[0] / sine + 0.0,
                     axis[1] / sine + 0.0, axis[2] / sine + 0.0);
}

}  // namespace bp
