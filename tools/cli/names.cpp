#include "tools/cli/names.h"

#include <fmt/format.h>

#include <cstddef>

#include "lib/check/counted.h"
#include "lib/check/scene_words.h"

namespace bp {

const char* name_of(FillMode fill) {
  constexpr const char* kNames[] = {"flood", "winding", "none", "inside"};
  return kNames[std::size_t(fill)];
}

const char* name_of(StructuringElement element) {
  return element == StructuringElement::cube ? "cube" : "ball";
}

const char* name_of(MeshMode mode) {
  constexpr const char* kNames[] = {"bounding", "inside", "fit"};
  return kNames[std::size_t(mode)];
}

const char* name_of(CoordinateKind kind) {
  constexpr const char* kNames[] = {"mean-value", "green", "maximum-likelihood"};
  return kNames[std::size_t(kind)];
}

std::string file_name(const std::string& path) {
  return path.substr(path.rfind('/') + 1);
}

std::string skipped(const SceneCounts& c) {
  std::string text;
  const auto add = [&](std::uint64_t n, const char* what) {
    if (n > 0) text += (text.empty() ? "skipped " : ", ") + counted(n, what);
  };
  add(c.degenerate - c.kept_degenerate, "degenerate triangle");
  add(c.non_finite, "non-finite triangle");
  add(c.bad_faces, "bad face");
  if (c.differing > 0) text += (text.empty() ? "" : "; ") + held_twice(c.differing);
  if (c.posed > 0) {
    text +=
        fmt::format("{}{} morph targets, and {} as the file shows {}", text.empty() ? "" : "; ",
                    c.posed == 1 ? "1 mesh loses its skin or" : fmt::format("{} meshes lose their skins or", c.posed),
                    c.posed == 1 ? "stays" : "stay", c.posed == 1 ? "it" : "them");
  }
  if (c.unfollowed.draws_elsewhere())
    text += (text.empty() ? "" : "; ") + not_followed(c.unfollowed) +
            ": programs may draw them elsewhere than they are read here; glTF leaves nothing of that open";
  if (c.animations > 0) text += (text.empty() ? "" : "; ") + counted(c.animations, "animation") + " not followed";
  return text;
}

std::string reading_note(const SceneCounts& c, double voxel) {
  // Relative rounding of a coordinate: far more than that of doubles, and less than that of float32.
  constexpr double kSinglePrecision = 0x1p-30;
  const std::string text = skipped(c);
  if (c.rounding.share < kSinglePrecision || c.rounding.most < voxel / 256) return text;
  return fmt::format(
      "{}{}coordinates of this format are read in single precision, here to within {:.2g}: proxies keep that "
      "distance; PLY and OBJ are read in double",
      text, text.empty() ? "" : "; ", c.rounding.most);
}

}  // namespace bp
