#include "lib/levels/tiles/cut_levels.h"

#include <cmath>

#include "lib/pass/color/vertex_colors.h"

namespace bp {

namespace {

/// Returns the colours around a cell, as far as a voxel of the closing may lie from the nearest voxel of the scene.
NearbyColors colors_around(const CutOptions& options, CellCoord cell, const GridFrame& frame, double scale_world) {
  const std::int32_t reach = std::int32_t(std::ceil(scale_world / frame.voxel)) + kColorCellVox;
  return options.colors->around(frame, options.cells.box(cell), reach);
}

void add_level(TilePyramid& pyramid, const TilesetPlan& plan, std::size_t level, const CutOptions& options,
               const CutSteps& steps) {
  const CutLevel& cut = plan.cut[level];
  CutFiles files = steps.files(level, cut.frame);
  TileParams params = tile_params(plan, level, options);
  params.encoding = files.encoding;
  if (files.add_to_key) params.add_to_key = files.add_to_key;
  if (options.colors != nullptr) options.colors->prepare(cut.frame);
  const auto encode = [&options, &cut, files = std::move(files)](CellCoord cell, const LatticeMesh& mesh) {
    LatticeMesh colored = mesh;
    if (options.colors != nullptr) color_vertices(colored, colors_around(options, cell, cut.frame, cut.scale_world));
    return files.encode(cell, std::move(colored), tile_origin(options.cells, cell));
  };
  pyramid.add_level(cut.scale_world, std::move(params), encode,
                    [&steps, level](LevelTile&& tile) { steps.take(level, std::move(tile)); });
}

}  // namespace

TileParams tile_params(const TilesetPlan& plan, std::size_t level, const CutOptions& options) {
  const CutLevel& cut = plan.cut[level];
  TileParams params;
  params.mode = options.mode;
  params.enclose = options.enclose;
  params.faces = cut.target.faces;
  // The enclosed voxels reach up to a voxel's diagonal beyond the scene.
  if (const double asked = cut.target.error_world; asked > 0)
    params.error_world = std::max(asked - std::sqrt(3.0) * (cut.frame.voxel + plan.cut.front().frame.voxel), asked / 4);
  params.scene = options.scene, params.rounding = options.rounding;
  params.make = options.make;
  if (options.jobs) {
    params.wanted = [&cut, jobs = *options.jobs](CellCoord cell) { return jobs.meets(cut.number_of(cell), 1); };
  }
  if (options.colors != nullptr) {
    params.add_to_key = [&cut, &options](CellCoord cell, KeyHash& hash) {
      colors_around(options, cell, cut.frame, cut.scale_world).add_to(hash);
    };
  }
  return params;
}

LatticeCoord tile_origin(const Cells& cells, CellCoord cell) {
  const VoxelCoord first = cells.box(cell).min;
  const std::int64_t half = cells.edge_vox / 2;
  return {(first.x + half) * kLatticePerVoxel, (first.y + half) * kLatticePerVoxel,
          (first.z + half) * kLatticePerVoxel};
}

void make_cut_levels(TilePyramid& pyramid, const TilesetPlan& plan, const CutOptions& options, const CutSteps& steps) {
  for (std::size_t level = 0; level < plan.cut.size(); ++level) {
    const CutLevel& cut = plan.cut[level];
    steps.begin("close level " + std::to_string(level));
    if (!options.jobs || options.jobs->meets(cut.number, cut.cells.count()))
      add_level(pyramid, plan, level, options, steps);
    pyramid.reduce();
  }
  steps.begin("make tiles");
  pyramid.make_tiles(steps.left);
}

TreeTile tree_tile(const LevelTile& tile, const Cells& cells, const GridFrame& frame, std::string uri) {
  TreeTile node{std::move(uri), frame.world(tile_origin(cells, tile.cell)), {}, tile.measures.error_world};
  node.bounds.add(frame.world(tile.measures.min));
  node.bounds.add(frame.world(tile.measures.max));
  return node;
}

}  // namespace bp
