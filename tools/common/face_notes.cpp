#include "tools/common/face_notes.h"

#include <fmt/format.h>

namespace bp {

namespace {

constexpr double kClearly = 0.95;  // of the faces asked for

}  // namespace

std::string too_few_note(std::uint64_t faces, std::uint64_t asked, MeshMode mode) {
  // A collapse takes two faces at a time, so that merging ends one below an odd number.
  if (faces + 2 > asked || double(faces) >= kClearly * double(asked)) return "";
  return fmt::format(
      "{} faces instead of {}: the surface of the voxels has no more, flat regions being merged; smaller voxels, or a "
      "smaller --scale, {}",
      faces, asked, mode == MeshMode::inside ? "keep more of the inside" : "show more of the scene");
}

std::string merged_note(std::uint64_t faces, std::uint64_t shells, std::uint64_t handles, MeshMode mode) {
  const bool inside = mode == MeshMode::inside;
  if (faces <= 4) return "no closed surface has fewer";
  if (shells <= 1 && handles == 0) {
    return fmt::format("no further edge can be merged; a larger --scale {} makes the form simpler",
                       inside ? "takes narrow things away and" : "fills narrow gaps and");
  }
  std::string advice;
  if (inside) {
    advice = shells > 1 ? "a larger --least-part leaves small parts out, a larger --scale narrow ones"
                        : "a larger --scale takes narrow bars away";
  } else {
    advice = fmt::format("a larger --scale {}", handles == 0  ? "joins parts"
                                                : shells <= 1 ? "closes holes"
                                                              : "joins parts and closes holes");
  }
  return fmt::format("no further edge can be merged. Parts and handles are kept, here {} and {}; {}", shells, handles,
                     advice);
}

}  // namespace bp
