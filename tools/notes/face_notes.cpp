#include "tools/notes/face_notes.h"

#include <fmt/format.h>

#include "lib/levels/level_request.h"

namespace bp {

namespace {

/// Returns the effect of a larger scale: it joins parts and closes handles, or makes the form simpler.
std::string scale_effect(std::uint64_t shells, std::uint64_t handles, bool inside) {
  if (shells <= 1 && handles == 0)
    return fmt::format("{} makes the form simpler", inside ? "takes narrow things away and" : "fills narrow gaps and");
  if (inside) return shells > 1 ? "leaves narrow parts out" : "takes narrow bars away";
  return handles == 0 ? "joins parts" : shells <= 1 ? "closes holes" : "joins parts and closes holes";
}

/// Returns "a larger bpclose --scale joins parts" or the like; for a stream that was not closed, it advises bpclose.
std::string scale_advice(std::uint64_t shells, std::uint64_t handles, const FaceAdvice& advice) {
  const std::string effect = scale_effect(shells, handles, advice.mode == MeshMode::inside);
  return (advice.scale.empty() ? "bpclose " : fmt::format("a larger {} ", advice.scale)) + effect;
}

std::string finer_advice(const FaceAdvice& advice) {
  if (advice.exact) return "";
  return fmt::format("; smaller voxels{} {}",
                     advice.scale.empty() ? "" : fmt::format(", or a smaller {},", advice.scale),
                     advice.mode == MeshMode::inside ? "keep more of the inside" : "show more of the scene");
}

}  // namespace

std::string too_few_note(std::uint64_t faces, std::uint64_t asked, const FaceAdvice& advice) {
  if (!clearly_fewer(faces, asked)) return "";
  return fmt::format("{} faces instead of {}: the surface of the voxels has no more, flat regions being merged{}",
                     faces, asked, finer_advice(advice));
}

std::string least_volume_note(std::uint64_t faces, std::uint64_t asked, const FaceAdvice& advice) {
  if (!clearly_fewer(faces, asked)) return "";
  return fmt::format("{} faces instead of {}: further ones would take next to nothing off {}, or add to it{}", faces,
                     asked, advice.exact || advice.scale.empty() ? "the volume" : "the volume of the closed scene",
                     finer_advice(advice));
}

std::string merged_note(std::uint64_t faces, std::uint64_t shells, std::uint64_t handles, const FaceAdvice& advice) {
  if (faces <= 4) return "no closed surface has fewer";
  const std::string what = scale_advice(shells, handles, advice);
  if (shells <= 1 && handles == 0) return "no further edge can be merged; " + what;
  return fmt::format("no further edge can be merged. Parts and handles are kept, here {} and {}; {}", shells, handles,
                     what);
}

std::string loose_note(std::uint64_t faces, double ratio, std::uint64_t shells, std::uint64_t handles,
                       const FaceAdvice& advice) {
  const bool inside = advice.mode == MeshMode::inside;
  if (advice.mode == MeshMode::fit || (inside ? ratio * kLoose > 1 : ratio < kLoose)) return "";
  const std::string what =
      inside ? "more faces hide more" : "more faces make it tighter, and " + scale_advice(shells, handles, advice);
  return fmt::format("{} faces hold {:.3g} times the volume of the voxels that are meshed; {}", faces, ratio, what);
}

}  // namespace bp
