#include "tools/common/face_notes.h"

#include <fmt/format.h>

namespace bp {

namespace {

constexpr double kClearly = 0.95;  // of the faces asked for

}  // namespace

std::string too_few_note(std::uint64_t faces, std::uint64_t asked) {
  // A collapse takes two faces at a time, so that merging ends one below an odd number.
  if (faces + 2 > asked || double(faces) >= kClearly * double(asked)) return "";
  return fmt::format(
      "{} faces instead of {}: the surface of the voxels has no more, flat regions being merged; smaller voxels, or a "
      "smaller --scale, show more of the scene",
      faces, asked);
}

}  // namespace bp
