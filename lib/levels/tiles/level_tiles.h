#pragma once
#include <functional>
#include <span>

#include "lib/levels/tiles/tile_task.h"
#include "lib/pass/context.h"

/// Makes a level of detail in pieces: one proxy for each cell of the grid, as an independent job.
///
/// A tile is the proxy of the closing in its cell grown by one voxel, without the voxels that the closing has there for
/// other cells only. Walls close it where the cell ends. By section 2 of docs/bounding.md, the scene's part in the
/// closed cell lies in the open interior of the solid's voxels in the grown cell. So each tile strictly encloses its
/// part by itself. Neighbours overlap by two voxels, and no crack can open between them, even if a viewer draws them
/// from different levels. Tightening keeps inside, exactly, the closing, the solid or that part of the scene's
/// triangles. A job reads only the voxels and triangles around its cell and the parameters: the same input gives the
/// same bytes.
namespace bp {

/// Makes the tiles of all levels: one for each cell that holds voxels of the closing, except in cavities that the
/// closing fills. Tiles that are kept among the results come first, then the others, the large ones first; none waits
/// for another. Between the two, `left` (if given) is told which share of the dense surface is still to be made.
/// Memory: 320 bytes for each triangle of the dense surface of a tile at work. Throws out_of_resource if not even one
/// tile fits.
void make_tiles(std::span<const TileTask> tasks, const PassContext& context,
                const std::function<void(double)>& left = {});

/// Returns the limit on memory at which make_tiles() has enough for each tile of a level. 0: not known. The solid
/// stands for the closing of a level that is not closed yet. `held`: bytes that others keep of the memory of `context`.
/// `triangles`: of the scene near a cell, which its tile encloses or follows, while TileParams::scene is not there yet;
/// empty: none. Asked for after a refusal; meshes the surface of the level, brick by brick.
[[nodiscard]] std::uint64_t tiles_limit(const TileLevel& level, const TileParams& params, PassContext context,
                                        std::uint64_t held, const std::function<std::uint64_t(CellCoord)>& triangles);

}  // namespace bp
