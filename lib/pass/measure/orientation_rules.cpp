#include "lib/pass/measure/orientation_rules.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "lib/core/error.h"
#include "lib/core/vec3.h"
#include "lib/pass/measure/orientation.h"

namespace bp {

namespace {

using Json = nlohmann::json;

[[noreturn]] void refuse(const std::string& file, const std::string& fact) {
  fail(ErrorCode::bad_input, "{}: orientation: {}", file, fact);
}

std::vector<double> numbers(const Json& json, const std::string& file, const char* what) {
  std::vector<double> list;
  for (const Json& x : json) {
    if (!x.is_number() || !std::isfinite(x.get<double>()))
      refuse(file, fmt::format("{} holds what is no number", what));
    list.push_back(x.get<double>());
  }
  return list;
}

Vec3d point(const Json& json, const std::string& file, const char* what) {
  const std::vector<double> p = json.is_array() ? numbers(json, file, what) : std::vector<double>{};
  if (p.size() != 3) refuse(file, fmt::format("{} is not a list of three numbers", what));
  return {p[0], p[1], p[2]};
}

/// Returns the axes of a cube turned by a quaternion w, x, y, z.
std::array<Vec3d, 3> turned_axes(const std::vector<double>& q, const std::string& file) {
  const double w = q[0], x = q[1], y = q[2], z = q[3], n = w * w + x * x + y * y + z * z;
  if (!(n > 0) || !std::isfinite(n)) refuse(file, "frame is a quaternion of no length");
  return {Vec3d{1 - 2 * (y * y + z * z) / n, 2 * (x * y + z * w) / n, 2 * (x * z - y * w) / n},
          Vec3d{2 * (x * y - z * w) / n, 1 - 2 * (x * x + z * z) / n, 2 * (y * z + x * w) / n},
          Vec3d{2 * (x * z + y * w) / n, 2 * (y * z - x * w) / n, 1 - 2 * (x * x + y * y) / n}};
}

/// Returns axes of which the first is along `a`. The next is the part of `b` at right angles to it.
std::array<Vec3d, 3> axes_along(Vec3d a, Vec3d b, const std::string& file) {
  const auto unit = [&](const Vec3d& v) {
    const double n = length(v);
    if (!(n > 1e-9) || !std::isfinite(n)) refuse(file, "frame has two axes that are parallel, or one of no length");
    return (1 / n) * v;
  };
  a = unit(a);
  b = unit(b);
  b = unit(b - dot(a, b) * a);
  return {a, b, cross(a, b)};
}

std::array<Vec3d, 3> frame_of(const Json& json, const std::string& file) {
  if (json.is_array() && json.size() == 4) return turned_axes(numbers(json, file, "frame"), file);
  if (!json.is_array() || json.size() != 2) refuse(file, "frame is neither a quaternion w, x, y, z nor two axes");
  return axes_along(point(json[0], file, "an axis of frame"), point(json[1], file, "an axis of frame"), file);
}

OrientationRules::Frame place_of(const Json& place, const std::string& file) {
  if (!place.is_object() || place.size() != 2 || !place.contains("at") || !place.contains("frame"))
    refuse(file, "a place has not the keys at and frame, and no others");
  return {point(place["at"], file, "at"), frame_of(place["frame"], file)};
}

}  // namespace

OrientationRules parse_orientation(const std::string& json, const std::string& file) {
  const Json value = Json::parse(json);
  OrientationRules rules;
  if (value == "auto") return rules;
  if (!value.is_array() || value.empty()) refuse(file, "is neither \"auto\" nor a list of places");
  for (const Json& place : value) rules.frames.push_back(place_of(place, file));
  return rules;
}

OrientationField make_orientation(const OrientationRules& rules, const StreamHeader& header, double scale_world,
                                  const TriangleReader& read_scene) {
  OrientationMaker maker(header, scale_world);
  for (const OrientationRules::Frame& frame : rules.frames) maker.add(frame.at, frame.axes);
  if (rules.frames.empty()) read_scene([&](const TriangleD& t) { maker.add(t); });
  return maker.make();
}

}  // namespace bp
