#pragma once
#include <string>
#include <vector>

#include "io/tiles/tileset_folder.h"
#include "tools/lod/scene/lod_scene.h"

namespace bp {

/// Returns the most triangles of a tile.
[[nodiscard]] std::uint64_t most_tile_triangles(const BuildOptions& options);

/// Makes and writes the tiles of bplod --profile 3dtiles --mode visual, with their images and tileset.json, and tells
/// notes on them. Returns a row for each depth of the octree, the deepest first. `results`: null: nothing is kept.
/// `cache_fault`: the reason why the cache keeps nothing, known after the tiles are made. Throws NeedsMemory before the
/// work if a tile or an image does not fit; bad_input if no triangle has an area.
[[nodiscard]] std::vector<LevelRow> write_visual_tiles(Build& build, const LodScene& scene, const SceneLooks& looks,
                                                       ResultStore* results, const std::string& cache_fault,
                                                       TilesetFolder& folder);

}  // namespace bp
