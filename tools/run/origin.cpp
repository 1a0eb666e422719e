#include "tools/run/origin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/mesh/mesh_writer.h"
#include "tools/cli/length.h"

namespace bp {

namespace {

// A scene that is farther from its origin than this many of its sides gets another origin, since floats would lose 3 of
// their 24 bits.
constexpr double kNear = 8;

/// Returns the largest size of a coordinate after `origin` is subtracted.
double reach_of(const Bounds3d& b, const Vec3d& origin) {
  double reach = 0;
  for (std::size_t i = 0; i < 3; ++i)
    reach = std::max({reach, std::abs(b.min[i] - origin[i]), std::abs(b.max[i] - origin[i])});
  return reach;
}

/// Returns the power of two in (x / 2, x].
double power_of_two_below(double x) {
  int exponent = 0;
  (void)std::frexp(x, &exponent);
  return std::ldexp(1.0, exponent - 1);
}

/// Returns a round length between a tenth of `side` and all of it. The last bit of a lattice unit is a power of two,
/// and at most side / 2^13: a voxel has at least 8 bits, and is not larger than the side. So multiples of a larger
/// power of two are exact, and so are multiples of a power of ten whose factors of two make such a power.
double round_step(double side) {
  double ten = 1, two = 1;
  for (; ten * 10 <= side; ten *= 10) two *= 2;
  return side >= 1 && two >= std::ldexp(side, -13) ? ten : power_of_two_below(side / 2);
}

}  // namespace

std::string origin_text(const Vec3d& p) {
  return fmt::format("{},{},{}", p[0], p[1], p[2]);
}

std::string OriginOption::text() const {
  switch (kind) {
    case Kind::unsaid:
      return "";
    case Kind::off:
      return "off";
    case Kind::automatic:
      return "auto";
    case Kind::point:
      return origin_text(point);
  }
  return "";
}

OriginOption parse_origin(const std::string& text) {
  if (text == "auto") return {OriginOption::Kind::automatic, {}};
  if (text == "off") return {OriginOption::Kind::off, {}};
  return {OriginOption::Kind::point, parse_point(text)};
}

Vec3d auto_origin(const Bounds3d& bounds) {
  const double side = bounds.longest_side();
  if (bounds.empty() || !(side > 0) || reach_of(bounds, {}) <= kNear * side) return {};
  const double step = round_step(side);
  Vec3d origin;
  for (std::size_t i = 0; i < 3; ++i)
    origin[i] = std::nearbyint((bounds.min[i] / 2 + bounds.max[i] / 2) / step) * step + 0.0;
  return origin;
}

Vec3d origin_of(const OriginOption& option, const GridFrame& frame, const Bounds3d& bounds) {
  if (option.kind != OriginOption::Kind::point && option.kind != OriginOption::Kind::automatic) return {};
  const Vec3d origin = option.kind == OriginOption::Kind::point ? option.point : auto_origin(bounds);
  check_origin(frame, voxel_bounds(frame, bounds), origin);
  return origin;
}

std::string origin_note(const OriginOption& option, const GridFrame& frame, const Bounds3d& bounds, bool file_tells) {
  const Vec3d origin = origin_of(option, frame, bounds);
  const double reach = reach_of(bounds, origin);
  const double step = std::ldexp(power_of_two_below(reach), 1 - std::numeric_limits<float>::digits);
  if (option.kind == OriginOption::Kind::automatic && origin != Vec3d{})
    return fmt::format("--origin auto subtracts {} from all coordinates{}", origin_text(origin),
                       file_tells ? "; bpcheck adds it back"
                                  : ", and the file cannot tell it: give bpcheck --origin=" + origin_text(origin));
  if (option.kind == OriginOption::Kind::off || step <= frame.voxel / kLatticePerVoxel) return "";
  return fmt::format(
      "coordinates of up to {:.6g} have steps of {:.2g} in programs that compute with 32-bit floats, as most engines "
      "do, and vertices may move by half of that; --origin auto writes them relative to a point nearby, --origin off "
      "keeps them without this note",
      reach, step);
}

}  // namespace bp
