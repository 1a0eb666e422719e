#pragma once
#include "lib/grid/stream.h"
#include "lib/pass/context.h"

/// Rules of scale fields that are measured on voxels (ShapeRule), tile by tile, out of core. Tiles, threads and memory
/// change nothing.
namespace bp {

struct MeasureOptions {
  std::int32_t tile_vox = 0;  ///< 0: by memory
  PassContext context;
};

/// Boxes with a scale each, to be applied after the rules of `before`, which tell how large scales get. At most some
/// thousand.
/// - What stays open: each free cube that a place needs, has its middle q in a box whose scale is less than its reach
/// + 1.
///   So q is not in the closing, with either element, whatever the rules of `before` say. Scales are as large as that
///   allows, but for steps of a half.
/// - What closes: the places narrower than the gap are in boxes with a scale that closes them.
/// Throws bad_argument if a scale of `before` is out of range, out_of_resource if not even one tile fits in the memory.
[[nodiscard]] std::vector<ScaleRule> shape_rules(const StreamHeader& header, const BrickShelf& solid,
                                                 const ShapeRule& rule, const ScaleField& before,
                                                 const MeasureOptions& options);

}  // namespace bp
