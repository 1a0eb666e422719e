#include "tools/lod/tiles/cut_tiles.h"

#include <fmt/format.h>

#include <cmath>
#include <mutex>

#include "io/mesh/lod_writer.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/pass/color/vertex_colors.h"
#include "lib/pass/leaf/scene_leaf.h"
#include "tools/lod/bake_levels.h"
#include "tools/lod/choices.h"
#include "tools/lod/leaves.h"
#include "tools/lod/level_notes.h"
#include "tools/lod/lod_outputs.h"
#include "tools/lod/proportions.h"
#include "tools/lod/scene/complete_levels.h"
#include "tools/notes/estimate.h"

namespace bp {

namespace {

/// A cut level while its tiles are made.
struct LevelAtWork {
  const CutLevel& cut;
  std::string folder;  ///< of its files
  Provenance provenance;
  FoundJobs found{};
  LevelRow row{};
  std::uint64_t over_faces = 0, dense = 0;
  std::vector<std::pair<CellCoord, TreeTile>> tiles{};
};

std::string name_of(CellCoord c) {
  return fmt::format("{}_{}_{}", c.x, c.y, c.z);
}

LevelAtWork level_at_work(const BuildOptions& o, const MadeTileset& made, std::size_t number) {
  const CutLevel& cut = made.plan.cut[number];
  const std::string folder = level_name(o.name, number);
  OptionText text = option_text(o, made.scene.enclosed, cut.target, number, cut.scale_world, cut.frame);
  if (made.scene.colors != nullptr) text.add("colors", "auto");
  if (made.scene.textured) text.add("appearance", o.full() ? "full" : "texture");
  LevelAtWork level{cut, folder, make_provenance("bplod", text)};
  level.found.what = fmt::format("level {}", number);
  level.row = {folder + "/*.glb", 0, 0, 0, 0, cut.scale_world, cut.frame.voxel};
  return level;
}

/// Makes the tiles of the levels that are cut, and their files. First it takes those that are kept.
class CutTiles {
 public:
  CutTiles(const Shop& shop, const TilePyramid& pyramid, std::vector<LevelAtWork>& levels, MadeTileset& made)
      : shop_(shop), all_(pyramid.context()), levels_(levels), made_(made), jobs_(pyramid.tasks(), all_) {}

  void run() {
    if (all_.results != nullptr)  // else no looks need a hash
      parallel_for(std::int64_t(jobs_.count()), [&](std::int64_t job) { take_kept(std::size_t(job)); });
    tell_time(shop_, made_.scene.voxels, jobs_.share_left());
    const std::vector<std::size_t> left = jobs_.left();
    if (shop_.task == Task::look_up) {
      for (const std::size_t job : left) take(job, KeptTile{}, false);  // some of them may have no tile
      return;
    }
    const int at_once = jobs_.at_once();
    PassContext one = all_;
    one.pieces = all_.pieces.split(std::uint64_t(at_once));
    std::size_t next = 0;
    run_jobs<std::size_t>(
        at_once,
        [&](std::size_t& job) {
          if (next == left.size()) return false;
          job = left[next++];
          return true;
        },
        [&](const std::size_t& job) { make_beside(job, one, at_once); });
    for (const std::size_t job : alone_) make(job, all_);
  }

 private:
  [[nodiscard]] LevelAtWork& level_of(std::size_t job) const { return levels_[jobs_.task(job).number]; }

  /// Returns the colours around a cell, as far as a voxel of the closing may lie from the nearest voxel of the scene.
  [[nodiscard]] NearbyColors colors_around(const CutLevel& cut, CellCoord cell) const {
    const std::int32_t reach = std::int32_t(std::ceil(cut.scale_world / cut.frame.voxel)) + kColorCellVox;
    return made_.scene.colors->around(cut.frame, shop_.cells().box(cell), reach);
  }
  /// Returns the hash of what a tile's file shows of the scene's looks.
  [[nodiscard]] ResultKey looks_of(const CutLevel& cut, CellCoord cell) const {
    KeyHash hash("looks");
    if (made_.scene.colors != nullptr) colors_around(cut, cell).add_to(hash);
    if (made_.looks() != nullptr)
      made_.looks()->add_to(hash, texture_bounds(shop_.cells().box(cell), cut.frame, cut.scale_world));
    return hash.key();
  }
  [[nodiscard]] std::string encoded(const LevelAtWork& level, CellCoord cell, LatticeMesh mesh) const {
    const CutLevel& cut = level.cut;
    if (made_.scene.colors != nullptr) color_vertices(mesh, colors_around(cut, cell));
    mesh.provenance = {level.provenance};
    if (made_.looks() != nullptr)
      mesh.texture = level_texture(shop_.build, made_.scene, mesh, {0, 0, cut.scale_world}, *made_.looks(),
                                   texture_memory(shop_.build));
    return tile_glb({level.folder + "_" + name_of(cell), &mesh}, tile_origin(shop_.cells(), cell),
                    shop_.options().compression(), contract_of_tiles(shop_.options()));
  }

  void take_kept(std::size_t job) {
    std::optional<KeptTile> tile;
    if (jobs_.get(job, looks_of(level_of(job).cut, jobs_.cell(job)), tile)) take(job, tile, true);
  }
  /// Makes a tile beside others. If its share of the memory does not suffice, it is made after them, by itself.
  void make_beside(std::size_t job, const PassContext& share, int at_once) {
    try {
      make(job, share);
    } catch (const NeedsMemory&) {
      if (at_once == 1) throw;
      const std::lock_guard lock(mutex_);
      alone_.push_back(job);
    }
  }
  void make(std::size_t job, const PassContext& context) {
    std::optional<KeptTile> tile;
    TileMeasures measures;
    if (std::optional<LatticeMesh> mesh = jobs_.make(job, context, measures))
      tile = KeptTile{measures, encoded(level_of(job), jobs_.cell(job), *std::move(mesh))};
    jobs_.put(job, tile);
    take(job, tile, false);
  }
  void take(std::size_t job, const std::optional<KeptTile>& tile, bool is_kept) {
    const std::lock_guard lock(mutex_);
    all_.report("meshing", "tiles", ++done_, jobs_.count());
    if (!tile) return;
    LevelAtWork& level = level_of(job);
    level.found.jobs += 1;
    level.found.kept += is_kept;
    if (shop_.task == Task::tileset) add(level, jobs_.cell(job), *tile);
  }
  /// Adds a tile to a whole tileset.
  void add(LevelAtWork& level, CellCoord cell, const KeptTile& tile) {
    const TileMeasures& m = tile.measures;
    level.row.tiles += 1;
    level.row.faces += m.faces;
    level.row.bytes += tile.content.size();
    level.dense += m.faces_dense;
    level.over_faces += m.faces_asked > 0 && m.faces > m.faces_asked;
    const GridFrame& frame = level.cut.frame;
    const std::string file = level.folder + "/" + name_of(cell) + ".glb";
    TreeTile node{file, frame.world(tile_origin(shop_.cells(), cell)), {}, m.error_world};
    node.bounds.add(frame.world(m.min));
    node.bounds.add(frame.world(m.max));
    level.tiles.emplace_back(cell, std::move(node));
    made_.files.push_back({file, shop_.files->put(std::as_bytes(std::span(tile.content)))});
  }

  const Shop& shop_;
  const PassContext& all_;  // with all of the memory
  std::vector<LevelAtWork>& levels_;
  MadeTileset& made_;
  TileJobs jobs_;
  std::mutex mutex_;
  std::vector<std::size_t> alone_;  // jobs that were refused beside others
  std::size_t done_ = 0;
};

/// Finishes a level whose tiles have all been taken.
void finish(const Shop& shop, std::size_t number, LevelAtWork& level, MadeTileset& made) {
  made.found.push_back(level.found);
  if (shop.task != Task::tileset) return;
  for (auto& [cell, node] : level.tiles) made.tree->add(number, level.cut.frame, cell, std::move(node));
  level.row.more = {{"faces_dense", level.dense}, {"kept", level.found.kept}};
  made.rows.push_back(level.row);
  if (level.over_faces > 0 && !shop.options().levels.faces.empty())
    shop.build.note(
        fmt::format("level {}: {} of {} tiles have more faces than were asked for: no further edge can be merged at a "
                    "scale of {:.4g}",
                    number, level.over_faces, level.row.tiles, level.row.scale_world));
  const double asked = level.cut.target.error_world;
  if (asked > 0 && level.row.error_world > asked) shop.build.note(error_note(number, level.row.error_world, asked));
}

}  // namespace

void tell_time(const Shop& shop, const VoxelizedScene& scene, double share) {
  if (shop.tells_time || shop.task != Task::tileset) return;
  Estimate work = estimate_build(shop.options(), scene.header.bounds, scene.counts, scene.header.frame.voxel);
  work.core_seconds *= share;
  work.serial_seconds *= share;
  note_estimate(work, shop.options().common, shop.build.progress, shop.build.report);
}

void add_leaves(const Shop& shop, const std::vector<CellCoord>& cells, const GridFrame& frame, MadeTileset& made) {
  if (!shop.options().leaves || shop.task != Task::tileset) return;
  shop.build.report.begin("leaves");
  MadeLeaves leaves = make_leaves(shop.build, {frame, *made.held_looks, cells, shop.results, shop.files});
  for (auto& [cell, leaf] : leaves.places) made.tree->add_leaf(frame, cell, std::move(leaf));
  made.files.insert(made.files.end(), leaves.files.begin(), leaves.files.end());
  made.images = std::move(leaves.images);
  LevelRow row{leaf_folder(shop.options()) + "/*.glb", leaves.files.size(), leaves.triangles, leaves.bytes};
  row.error_world = leaf_error(leaf_unit(frame.voxel, shop.options().tile_vox));
  row.more = {{"kept", leaves.kept}};
  made.leaves = std::move(row);
}

CutOptions cut_options(const Shop& shop, const MadeTileset& made, const TriangleBvh* tree) {
  CutOptions cut{shop.cells(), {}, {}};
  cut.tile.mode = shop.options().proxy.mode;
  cut.tile.enclose = made.scene.enclosed;
  cut.tile.scene = tree, cut.tile.rounding = made.scene.voxels.counts.scene.rounding;
  if (shop.task == Task::some_jobs) cut.jobs = shop.options().tiles;
  return cut;
}

void make_cut(const Shop& shop, TilePyramid& pyramid, const CutOptions& cut, MadeTileset& made) {
  std::vector<LevelAtWork> levels;
  for (std::size_t i = 0; i < made.plan.cut.size(); ++i) {
    const CutLevel& level = made.plan.cut[i];
    const LevelAtWork& work = levels.emplace_back(level_at_work(shop.options(), made, i));
    shop.build.report.begin(fmt::format("close level {}", i));
    if (shop.wants(level.number, level.cells.count())) {
      if (made.scene.colors != nullptr) made.scene.colors->prepare(level.frame);
      TileParams params = tile_params(made.plan, i, cut);
      params.encoding = work.folder + " " + work.provenance.options;
      pyramid.add_level(std::move(params));
    }
    pyramid.reduce();
  }
  shop.build.report.begin("make tiles");
  CutTiles(shop, pyramid, levels, made).run();
  pyramid.drop_tasks();
  for (std::size_t i = 0; i < levels.size(); ++i) {
    finish(shop, i, levels[i], made);
    std::vector<CellCoord> cells;
    for (const auto& [cell, node] : levels[i].tiles) cells.push_back(cell);
    if (i == 0) add_leaves(shop, cells, made.plan.cut[i].frame, made);
  }
}

}  // namespace bp
