#include "tools/notes/scale_notes.h"

#include <fmt/format.h>

namespace bp {

namespace {

bool meet(const ScaleBox& box, const Bounds3d& bounds, double margin) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (box.max[i] < bounds.min[i] - margin || box.min[i] > bounds.max[i] + margin) return false;
  }
  return true;
}

}  // namespace

std::vector<std::string> scale_notes(const ScaleField& field, const StreamHeader& header, bool inner) {
  std::vector<std::string> notes;
  const double voxel = header.frame.voxel;
  const double largest = double(field.upper_bound(header.frame)) / kScaleOne;  // voxels
  if (largest < 1) {
    notes.push_back(fmt::format(
        "a scale of {:.3g} voxels {}; use a larger scale or smaller voxels", largest,
        inner ? "takes nothing away: the opening is the input" : "closes nothing: the closing is the input"));
  }
  if (header.bounds.empty()) return notes;
  for (std::size_t i = 0; i < field.boxes.size(); ++i) {
    // One scale around the scene is as far as its dilation goes.
    if (meet(field.boxes[i], header.bounds, (largest + 1) * voxel)) continue;
    notes.push_back(fmt::format("boxes[{}] of the field is nowhere near the scene; its scale changes nothing", i));
  }
  return notes;
}

}  // namespace bp
