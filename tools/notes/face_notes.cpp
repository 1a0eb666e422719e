#include "tools/notes/face_notes.h"

#include <fmt/format.h>

#include "lib/levels/level_request.h"

namespace bp {

namespace {

constexpr double kLoose = 2;  // times the volume, or its part

/// What --scale does where there are several parts or a handle, or does to the form.
std::string scale_advice(std::uint64_t shells, std::uint64_t handles, bool inside) {
  if (shells <= 1 && handles == 0) {
    return fmt::format("a larger --scale {} makes the form simpler",
                       inside ? "takes narrow things away and" : "fills narrow gaps and");
  }
  if (inside)
    return shells > 1 ? "a larger --scale leaves narrow parts out" : "a larger --scale takes narrow bars away";
  return fmt::format("a larger --scale {}", handles == 0  ? "joins parts"
                                            : shells <= 1 ? "closes holes"
                                                          : "joins parts and closes holes");
}

}  // namespace

std::string too_few_note(std::uint64_t faces, std::uint64_t asked, MeshMode mode) {
  if (!clearly_fewer(faces, asked)) return "";
  return fmt::format(
      "{} faces instead of {}: the surface of the voxels has no more, flat regions being merged; smaller voxels, or a "
      "smaller --scale, {}",
      faces, asked, mode == MeshMode::inside ? "keep more of the inside" : "show more of the scene");
}

std::string least_volume_note(std::uint64_t faces, std::uint64_t asked) {
  if (!clearly_fewer(faces, asked)) return "";
  return fmt::format(
      "{} faces instead of {}: further ones would take next to nothing off the volume, or add to it; "
      "smaller voxels, or a smaller --scale, show more of the scene",
      faces, asked);
}

std::string merged_note(std::uint64_t faces, std::uint64_t shells, std::uint64_t handles, MeshMode mode,
                        const std::optional<std::string>& scale) {
  const bool inside = mode == MeshMode::inside;
  if (faces <= 4) return "no closed surface has fewer";
  if (shells <= 1 && handles == 0) return "no further edge can be merged; " + scale_advice(shells, handles, inside);
  const std::string advice = !scale           ? scale_advice(shells, handles, inside)
                             : scale->empty() ? "no larger --scale leaves few enough; ask for more faces"
                                              : fmt::format("bpclose --scale {} leaves few enough", *scale);
  return fmt::format("no further edge can be merged. Parts and handles are kept, here {} and {}; {}", shells, handles,
                     advice);
}

std::string loose_note(std::uint64_t faces, double ratio, std::uint64_t shells, std::uint64_t handles, MeshMode mode) {
  const bool inside = mode == MeshMode::inside;
  if (mode == MeshMode::fit || (inside ? ratio * kLoose > 1 : ratio < kLoose)) return "";
  const std::string advice =
      inside ? "more faces hide more" : "more faces make it tighter, and " + scale_advice(shells, handles, inside);
  return fmt::format("{} faces hold {:.3g} times the volume of the voxels that are meshed; {}", faces, ratio, advice);
}

}  // namespace bp
