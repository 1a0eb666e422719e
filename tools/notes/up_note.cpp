#include "tools/notes/up_note.h"

#include <fmt/format.h>

#include <algorithm>

namespace bp {

std::string up_note(const Bounds3d& scene, bool told) {
  constexpr double kFlat = 0.25;  // of the shorter side: rooms and most buildings are not
  if (told || scene.empty()) return "";
  const double x = scene.max[0] - scene.min[0], y = scene.max[1] - scene.min[1], z = scene.max[2] - scene.min[2];
  if (z >= kFlat * std::min(x, y)) return "";
  return fmt::format(
      "the scene is {:.4g} x {:.4g} x {:.4g}, flat along z, and y is taken for up: if it is a map, it will stand on "
      "edge; say --up z, or --up y to be sure",
      x, y, z);
}

std::string up_note(const StreamHeader& header) {
  const bool ours = !header.provenance.empty() && header.provenance.front().tool == "bpvox";
  if (!ours || header.frame.up != UpAxis::y) return "";
  const bool told = header.provenance.front().options.find(kUpTold) != std::string::npos;
  const std::string note = up_note(header.bounds, told);
  return note.empty() ? "" : note + " (options of bpvox)";
}

}  // namespace bp
