#include "tools/notes/up_note.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace bp {

namespace {

/// Returns whether the scene begins near 0 along the axis, within a tenth of its length, as scenes do that stand on the
/// ground along their height.
bool stands_on(const Bounds3d& scene, std::size_t axis, double share = 0.1) {
  return std::abs(scene.min[axis]) <= share * (scene.max[axis] - scene.min[axis]);
}

/// Returns whether the scene ends near 0 along the axis.
bool hangs_from(const Bounds3d& scene, std::size_t axis) {
  return std::abs(scene.max[axis]) <= 0.1 * (scene.max[axis] - scene.min[axis]);
}

constexpr double kExactly = 0.02;

/// Returns whether the scene is a wall, a door or a picture: it stands on y = 0, and its middle is near z = 0. Heights
/// of a map seldom are.
bool is_upright(const Bounds3d& scene) {
  const double half = (scene.max[2] - scene.min[2]) / 2;
  return stands_on(scene, 1, kExactly) && std::abs(scene.min[2] + half) <= half / 2;
}

}  // namespace

std::string up_note(const Bounds3d& scene, bool told) {
  constexpr double kFlat = 0.25;  // height over the shorter side: rooms and most buildings are higher
  if (told || scene.empty()) return "";
  const double x = scene.max[0] - scene.min[0], y = scene.max[1] - scene.min[1], z = scene.max[2] - scene.min[2];
  const auto note = [&](const std::string& what, const char* consequence, const char* up) {
    return fmt::format(
        "the scene is {:.4g} x {:.4g} x {:.4g}, {}, and y is taken for up: if {}; say --up {}, or --up y to be sure", x,
        y, z, what, consequence, up);
  };
  if (z < kFlat * std::min(x, y) && !is_upright(scene))
    return note("flat along z", "it is a map, it will stand on edge", "z");
  if (stands_on(scene, 1) || y < kFlat * std::min(x, z)) return "";
  const std::string where =
      stands_on(scene, 2, kExactly) ? "stands on z = 0" : fmt::format("begins near z = 0 (at {:.4g})", scene.min[2]);
  if (stands_on(scene, 2)) return note(where, "z is up, it will lie on its side", "z");
  if (hangs_from(scene, 1)) return note("hangs below y = 0", "-y is up, as in LDraw, it will stand on its head", "-y");
  return "";
}

std::string up_note(const StreamHeader& header) {
  const bool ours = !header.provenance.empty() && header.provenance.front().tool == "bpvox";
  if (!ours || header.frame.up != UpAxis::y) return "";
  const bool told = header.provenance.front().options.find(kUpTold) != std::string::npos;
  const std::string note = up_note(header.bounds, told);
  return note.empty() ? "" : note + " (options of bpvox)";
}

}  // namespace bp
