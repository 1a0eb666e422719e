#pragma once
#include "lib/grid/stream.h"
#include "lib/pass/context.h"

/// Rules of scale fields that are measured on voxels (ShapeRule), tile by tile, out of core. Tiles, threads and memory
/// change no result.
namespace bp {

struct MeasureOptions {
  std::int32_t tile_vox = 0;  ///< 0: chosen by memory
  PassContext context;
};

/// Returns boxes with a scale each, to be applied after the rules of `before`, which tell how large scales get. There
/// are at most some thousand.
/// - Openings that stay open: their places, and the middles of the free cubes that hold them (openings.h), are in
///   boxes of one scale: half of the reach of the cubes, or the least. A voxel there that is farther from the solid, by
///   the cube, is not in the closing, with either element, whatever the rules of `before` say.
/// - Places that close: those narrower than the gap are in boxes with a scale that closes them.
/// Throws bad_argument if a scale of `before` is out of range, or the rule is so long that one would be;
/// out_of_resource if not even one tile fits in the memory. Cost: some dozen passes over the bits of the scene's box,
/// grown by the widest reach, for each of the widths, which rise by half.
[[nodiscard]] std::vector<ScaleRule> shape_rules(const StreamHeader& header, const BrickShelf& solid,
                                                 const ShapeRule& rule, const ScaleField& before,
                                                 const MeasureOptions& options);

/// Returns the plan with its rules by shape measured, each under the rules before it.
[[nodiscard]] ScalePlan measured(const ScalePlan& plan, const StreamHeader& header, const BrickShelf& solid,
                                 const MeasureOptions& options);

}  // namespace bp
