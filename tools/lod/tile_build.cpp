#include "tools/lod/tile_build.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "io/files/file.h"
#include "io/mesh/lod_writer.h"
#include "io/store/result_store.h"
#include "io/store/scratch.h"
#include "io/tiles/tileset_file.h"
#include "io/tiles/tileset_folder.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/levels/lod_chain.h"
#include "lib/levels/tiles/cut_levels.h"
#include "lib/levels/whole_levels.h"
#include "lib/pass/leaf/scene_leaf.h"
#include "lib/store/hex.h"
#include "tools/lod/bake_levels.h"
#include "tools/lod/choices.h"
#include "tools/lod/kept_results.h"
#include "tools/lod/leaves.h"
#include "tools/lod/lod_outputs.h"
#include "tools/lod/proportions.h"
#include "tools/lod/scene/complete_levels.h"
#include "tools/lod/scene/tileset_memory.h"
#include "tools/notes/estimate.h"

namespace bp {

namespace {

/// The purpose of a run: the whole tileset, results of some jobs, or a list of the kept results.
enum class Task { tileset, some_jobs, look_up };

/// The tools that the jobs of a tileset share.
struct Shop {
  Build& build;
  Task task;
  ResultStore* results;  ///< may be null
  Scratch* files;        ///< where files wait until all are made
  bool tells_time;       ///< the time is told before the work; false: later, when it is known how many results are kept
  [[nodiscard]] const BuildOptions& options() const { return build.options; }
  [[nodiscard]] Cells cells() const { return {build.options.tile_vox}; }
  [[nodiscard]] bool wants(std::uint64_t number, std::uint64_t count) const {
    return task != Task::some_jobs || options().tiles->meets(number, count);
  }
};

/// A file that waits to be written.
struct Waiting {
  std::string name;
  Scratch::Handle content;
};

/// A cut level while its tiles are made.
struct LevelAtWork {
  FoundJobs found{};
  LevelRow row;
  std::uint64_t over_faces = 0, dense = 0;
  std::vector<std::pair<CellCoord, TreeTile>> tiles;
};

struct MadeTileset {
  LodScene scene;
  std::unique_ptr<SceneLooks> held_looks;  ///< null: neither textures nor leaves need them
  TilesetPlan plan;
  std::vector<FoundJobs> found;
  // These members are set only for a whole tileset.
  std::vector<LevelRow> rows;
  std::optional<LevelRow> leaves;
  std::vector<Waiting> files;
  std::map<std::string, std::uint32_t> images;  ///< images that leaves use: numbers in the scene's TextureSet
  std::optional<TileTree> tree;
  std::vector<Provenance> provenance;  ///< empty: each tile has its own

  /// Returns the looks that textures are baked from; null: levels get no textures.
  [[nodiscard]] const SceneLooks* looks() const { return scene.textured ? held_looks.get() : nullptr; }
};

std::string name_of(CellCoord c) {
  return fmt::format("{}_{}_{}", c.x, c.y, c.z);
}

/// Returns how the tiles of a level become files, with their names and provenance.
CutFiles cut_files(const Build& build, const MadeTileset& made, const CutLevel& cut, std::size_t level) {
  const std::string folder = level_name(build.options.name, level);
  OptionText text = option_text(build.options, made.scene.enclosed, cut.target, level, cut.scale_world, cut.frame);
  if (made.scene.colors != nullptr) text.add("colors", "auto");
  if (made.scene.textured) text.add("appearance", build.options.full() ? "full" : "texture");
  const Provenance provenance = make_provenance("bplod", text);
  CutFiles files;
  files.encoding = folder + " " + provenance.options;
  const SceneLooks* const looks = made.looks();
  files.encode = [&build, &scene = made.scene, looks, scale = cut.scale_world, folder, provenance](
                     CellCoord cell, LatticeMesh&& mesh, LatticeCoord at) {
    mesh.provenance = {provenance};
    if (looks != nullptr)
      mesh.texture = level_texture(build, scene, mesh, {0, 0, scale}, *looks, texture_memory(build));
    return tile_glb({folder + "_" + name_of(cell), &mesh}, at, build.options.compression);
  };
  if (looks != nullptr) {
    files.add_to_key = [looks, cells = Cells{build.options.tile_vox}, frame = cut.frame, scale = cut.scale_world](
                           CellCoord cell, KeyHash& hash) {
      looks->add_to(hash, texture_bounds(cells.box(cell), frame, scale));
    };
  }
  return files;
}

/// Takes a finished tile.
void take(const Shop& shop, LevelTile&& tile, const CutLevel& cut, const std::string& folder, LevelAtWork& level,
          std::vector<Waiting>& files) {
  level.found.jobs += 1;
  level.found.kept += tile.kept;
  if (shop.task != Task::tileset) return;
  const TileMeasures& m = tile.measures;
  level.row.tiles += 1;
  level.row.faces += m.faces;
  level.row.bytes += tile.content.size();
  level.dense += m.faces_dense;
  level.over_faces += m.faces_asked > 0 && m.faces > m.faces_asked;
  const std::string file = folder + "/" + name_of(tile.cell) + ".glb";
  level.tiles.emplace_back(tile.cell, tree_tile(tile, shop.cells(), cut.frame, file));
  files.push_back({file, shop.files->put(std::as_bytes(std::span(tile.content)))});
}

/// Finishes a level whose tiles have all been taken.
void finish(const Shop& shop, std::size_t number, const CutLevel& cut, LevelAtWork& level, MadeTileset& made) {
  made.found.push_back(level.found);
  if (shop.task != Task::tileset) return;
  for (auto& [cell, node] : level.tiles) made.tree->add(number, cut.frame, cell, std::move(node));
  level.row.more = {{"faces_dense", level.dense}, {"kept", level.found.kept}};
  made.rows.push_back(level.row);
  if (level.over_faces > 0 && !shop.options().levels.faces.empty())
    shop.build.note(
        fmt::format("level {}: {} of {} tiles have more faces than were asked for: no further edge can be merged at a "
                    "scale of {:.4g}",
                    number, level.over_faces, level.row.tiles, level.row.scale_world));
  const double asked = cut.target.error_world;
  if (asked > 0 && level.row.error_world > asked) shop.build.note(error_note(number, level.row.error_world, asked));
}

/// Adds the scene's own triangles as leaves below the tiles of the finest level, which must be in the tree.
void add_leaves(const Shop& shop, const std::vector<CellCoord>& cells, const GridFrame& frame, MadeTileset& made) {
  if (!shop.options().leaves || shop.task != Task::tileset) return;
  shop.build.report.begin("leaves");
  MadeLeaves leaves = make_leaves(shop.build, {frame, *made.held_looks, cells, shop.results, shop.files});
  for (auto& [cell, leaf] : leaves.places) made.tree->add_leaf(frame, cell, std::move(leaf));
  for (LeafFile& file : leaves.files) made.files.push_back({std::move(file.name), file.content});
  made.images = std::move(leaves.images);
  LevelRow row{leaf_folder(shop.options()) + "/*.glb", leaves.files.size(), leaves.triangles, leaves.bytes};
  row.error_world = leaf_error(leaf_unit(frame.voxel, shop.options().tile_vox));
  row.more = {{"kept", leaves.kept}};
  made.leaves = std::move(row);
}

/// Tells the time that is left when the kept results are known. `share`: the part of the work that is left.
void tell_time(const Shop& shop, const VoxelizedScene& scene, double share) {
  if (shop.tells_time || shop.task != Task::tileset) return;
  Estimate work = estimate_build(shop.options(), scene.header.bounds, scene.counts, scene.header.frame.voxel);
  work.core_seconds *= share;
  work.serial_seconds *= share;
  note_estimate(work, shop.options().common, shop.build.progress, shop.build.report);
}

CutOptions cut_options(const Shop& shop, const MadeTileset& made, const TriangleBvh* tree = nullptr) {
  const BuildOptions& o = shop.options();
  CutOptions cut;
  cut.cells = shop.cells();
  cut.mode = o.proxy.mode;
  cut.enclose = made.scene.enclosed;
  cut.colors = made.scene.colors.get();
  cut.scene = tree, cut.rounding = made.scene.voxels.counts.scene.rounding;
  if (shop.task == Task::some_jobs) cut.jobs = o.tiles;
  cut.make = shop.task != Task::look_up;
  return cut;
}

/// The levels of more than one cell.
void make_cut(const Shop& shop, TilePyramid& pyramid, const CutOptions& cut, MadeTileset& made) {
  const BuildOptions& o = shop.options();
  std::vector<LevelAtWork> levels(made.plan.cut.size());
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const CutLevel& level = made.plan.cut[i];
    levels[i].found.what = fmt::format("level {}", i);
    levels[i].row = {level_name(o.name, i) + "/*.glb", 0, 0, 0, 0, level.scale_world, level.frame.voxel};
  }
  const CutSteps steps{
      [&](const std::string& name) { shop.build.report.begin(name); },
      [&](std::size_t i, const GridFrame&) { return cut_files(shop.build, made, made.plan.cut[i], i); },
      [&](std::size_t i, LevelTile&& tile) {
        take(shop, std::move(tile), made.plan.cut[i], level_name(o.name, i), levels[i], made.files);
      },
      [&](double share) { tell_time(shop, made.scene.voxels, share); }};
  make_cut_levels(pyramid, made.plan, cut, steps);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    finish(shop, i, made.plan.cut[i], levels[i], made);
    std::vector<CellCoord> cells;
    for (const auto& [cell, node] : levels[i].tiles) cells.push_back(cell);
    if (i == 0) add_leaves(shop, cells, made.plan.cut[i].frame, made);
  }
}

/// Returns the inputs of the whole levels' files that WholeInput lacks: names, provenance, looks of the scene.
std::string whole_encoding(const BuildOptions& o, const MadeTileset& made, const std::string& input_hash,
                           const GridFrame& frame) {
  std::string text =
      fmt::format("{} {} {}", o.name, input_hash, option_text(o, made.scene.enclosed, {}, 0, 0, frame).text());
  if (made.looks() != nullptr) {
    KeyHash hash("looks");
    Bounds3d everything;
    everything.add({-HUGE_VAL, -HUGE_VAL, -HUGE_VAL});
    everything.add({HUGE_VAL, HUGE_VAL, HUGE_VAL});
    made.looks()->add_to(hash, everything);
    text += " " + hex_of(hash.key().words[0], hash.key().words[1]);
  }
  return text;
}

/// Makes the levels that are one mesh each, and keeps them in the store.
WholeLevels whole_levels(const Shop& shop, const MadeTileset& made, WholeInput input, const std::string& input_hash,
                         const ResultKey& key) {
  const StreamHeader& header = input.header;
  const ChainRange range{input.request, input.first, input.count, header.bounds.diagonal()};
  LodChain chain(header, std::move(input.solid), shop.build.backends, std::move(input.lod));
  const CompleteLevels levels = make_levels(shop.build, chain, range, {made.scene, {}, made.looks(), input_hash});
  WholeLevels whole = encoded(shop.options(), levels, input.first);
  if (shop.results != nullptr) keep_levels(key, whole, *shop.results);
  return whole;
}

/// Adds the levels that are one mesh each: from the store if they are kept, else they are made.
void make_whole(const Shop& shop, TilePyramid& pyramid, LodOptions lod, const LevelRequest& request,
                MadeTileset& made) {
  Build& build = shop.build;
  const std::size_t cut = made.plan.cut.size();
  build.report.begin("levels in one mesh");
  if (cut > 0) lod.least_scale_world = TilesetPlan::kScaleVox * pyramid.header().frame.voxel;
  lod.surface = pyramid.take_surface();
  const std::string input_hash =
      cut > 0 ? "" : made.scene.voxels.counts.input_hash;  // tiles do not depend on the whole scene
  WholeInput input{pyramid.header(),
                   pyramid.take_solid(),
                   cut,
                   made.plan.whole,
                   request,
                   std::move(lod),
                   made.scene.colors.get(),
                   whole_encoding(build.options, made, input_hash, pyramid.header().frame)};
  const ResultKey key = shop.results != nullptr ? key_of(input) : ResultKey{};
  std::optional<WholeLevels> kept;
  if (shop.results != nullptr) kept = kept_levels(key, *shop.results);
  made.found.push_back({"levels in one mesh", 1, kept ? 1U : 0U});
  if (shop.task == Task::look_up) return;
  if (cut == 0 && !kept) tell_time(shop, made.scene.voxels, 1);
  const WholeLevels whole = kept ? std::move(*kept) : whole_levels(shop, made, std::move(input), input_hash, key);
  std::vector<LevelFacts> facts;
  for (const WholeLevel& level : whole.levels) facts.push_back(level.facts);
  note_levels(build, facts, cut, whole.left_out, made.scene.size);
  if (shop.task == Task::some_jobs) return;
  for (const WholeLevel& level : whole.levels) {
    const std::string file = level_name(build.options.name, made.rows.size()) + ".glb";
    made.files.push_back({file, shop.files->put(std::as_bytes(std::span(level.content)))});
    made.tree->add_whole({file, whole.origin, level.bounds, level.facts.error_world});
    made.rows.push_back(row_of(level.facts, file, level.content.size()));
  }
  if (cut == 0) made.provenance = whole.levels.front().provenance;
}

/// `held`: bytes that the scene takes at the same time. share: of the memory for work.
PyramidOptions pyramid_options(const Shop& shop, std::uint64_t held, double share) {
  PassContext context = shop.build.context(shop.results, share);
  context.memory.bytes -= std::min(context.memory.bytes, held);
  context.pieces = context.pieces.without(held);
  return {shop.cells(), {shop.options().closing.element}, std::move(context)};
}

/// Everything that comes before the levels in one mesh.
void make_tiles_and_leaves(const Shop& shop, TilePyramid& pyramid, const TriangleBvh* scene, MadeTileset& made) {
  if (!made.plan.cut.empty() || shop.options().leaves) check_outputs();  // levels in one mesh ask for themselves
  if (made.plan.cut.empty()) {
    const StreamHeader& header = made.scene.voxels.header;
    return add_leaves(shop, {cells_spanned(shop.cells(), header.bricks).first}, header.frame, made);
  }
  make_cut(shop, pyramid, cut_options(shop, made, scene), made);
}

MadeTileset make_tileset(const Shop& shop) {
  const BuildOptions& o = shop.options();
  MadeTileset made;
  made.scene = read_scene(shop.build, {o.tile_vox, shop.results, false, shop.tells_time});
  made.held_looks = hold_looks(shop.build, made.scene);
  const double share = made.held_looks ? kBesideLooks : 1;
  const StreamHeader& header = made.scene.voxels.header;
  const LevelRequest request = request_for(o, made.scene.size.triangles, header.bounds.diagonal(), header.frame.voxel);
  made.plan = plan_tileset(request, shop.cells(), header);
  made.tree.emplace(header.frame.up, shop.cells());
  if (shop.task == Task::some_jobs && o.tiles->begin >= made.plan.jobs())
    shop.build.note(fmt::format("--tiles {}..{}: there are {} jobs, numbered from 0: nothing is done", o.tiles->begin,
                                o.tiles->end, made.plan.jobs()));
  shop.build.report.begin("measure the scene");
  const TilesetMemory limit({shop.build, made.scene, made.plan, made.held_looks.get(), cut_options(shop, made), share});
  LodOptions lod = lod_options(shop.build, made.scene, {}, {share, made.plan.cut.size(), [&](const LodOptions& whole) {
                                                              return limit(whole, *made.scene.voxels.solid);
                                                            }});
  TilePyramid pyramid(header, std::move(made.scene.voxels.solid), shop.build.backends,
                      pyramid_options(shop, bytes_beside_tiles(lod.scene.size()), share));
  // After a refusal, the tasks of the pyramid are counted, which look for triangles in the tree.
  std::unique_ptr<TriangleBvh> tree;
  if (!made.plan.cut.empty() && !lod.scene.empty()) tree = std::make_unique<TriangleBvh>(lod.scene);
  naming_limit([&] { make_tiles_and_leaves(shop, pyramid, tree.get(), made); }, [&] { return limit(lod, pyramid); });
  tree.reset();
  if (made.plan.whole == 0 && shop.task == Task::tileset)
    shop.build.note(
        fmt::format("the coarsest level has {} tiles, and nothing is drawn instead of them from afar: it takes {} "
                    "levels to come to one mesh, or larger tiles",
                    made.rows.back().tiles, levels_to_one_mesh(request, shop.cells(), header)));
  if (made.plan.whole > 0 && shop.wants(made.plan.whole_number(), 1))
    make_whole(shop, pyramid, std::move(lod), request, made);
  return made;
}

/// Returns the options for the provenance of a tileset whose levels are all cut; each tile has its own provenance.
OptionText tileset_options(const MadeTileset& made, std::int32_t tile_vox) {
  OptionText text;
  text.add("levels", made.rows.size()).add("tile", tile_vox).add("voxel", made.scene.voxels.header.frame.voxel);
  return text;
}

void write_tileset(const Shop& shop, MadeTileset& made, TilesetFolder& folder) {
  shop.build.report.begin("write");
  Tileset tileset = made.tree->finish(made.scene.voxels.header.bounds.diagonal(), shop.build.placed.placement);
  for (std::size_t i = 0; i < made.rows.size(); ++i) made.rows[i].error_world = made.tree->error_of(i);
  if (made.provenance.empty())
    made.provenance = {
        make_provenance("bplod", tileset_options(made, shop.options().tile_vox), made.scene.voxels.counts.input_hash)};
  if (made.leaves) made.provenance.back().options += " leaves=scene";
  parallel_for(std::int64_t(made.files.size()), [&](std::int64_t i) {  // each waits for the disk
    const Waiting& file = made.files[std::size_t(i)];
    std::vector<std::byte> bytes;
    shop.files->get(file.content, bytes);
    folder.write(file.name, std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    shop.files->drop(file.content);
  });
  for (const auto& [name, number] : made.images) {
    const std::vector<std::byte> bytes = made.scene.textures->file(number);
    tileset.images.push_back(leaf_folder(shop.options()) + "/" + name);
    folder.write(tileset.images.back(), std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    if (made.leaves) made.leaves->bytes += bytes.size();
  }
  if (made.leaves) made.rows.insert(made.rows.begin(), *made.leaves);
  folder.write("tileset.json", tileset_text(tileset, made.provenance));
  folder.commit();
  if (!folder.complaint().empty())
    shop.build.note(folder.complaint() + "; tiles of the tileset that was there before are not known, and stay");
  finish(shop.build, made.scene.told(), made.rows, folder.bytes());
}

/// Returns the names that the levels that were asked for may have: each is one file or a folder of tiles.
std::vector<std::string> certain_names(const BuildOptions& o) {
  std::vector<std::string> names;
  if (o.leaves) names.push_back(leaf_folder(o));
  for (std::size_t i = 0; i < level_count(request_of(o)); ++i) {
    names.push_back(level_name(o.name, i));
    names.push_back(names.back() + ".glb");
  }
  return names;
}

}  // namespace

void build_tileset(const BuildOptions& o) {
  const Task task = o.tiles ? Task::some_jobs : Task::tileset;
  std::optional<TilesetFolder> folder;
  if (task == Task::tileset) folder.emplace(o.out, certain_names(o), o.common.overwrite);
  Build build(o);
  const std::unique_ptr<Scratch> files = make_scratch(build.budget.store, o.common.temp);
  const bool tells_time = !has_own_results(o);  // before this run fills the cache
  build.note(cache_note(o));
  std::string fault;  // the reason why the cache keeps nothing, known after the levels are made
  const std::unique_ptr<ResultStore> results = open_kept_results(o, fault);
  const Shop shop{build, task, results.get(), files.get(), tells_time};
  MadeTileset made = make_tileset(shop);
  build.progress.end();
  if (!fault.empty()) build.note(fault + "; what is not in the cache was made, and is not kept");
  if (folder) return write_tileset(shop, made, *folder);
  finish_jobs(build, made.scene.told(), *o.tiles, made.plan.jobs(), made.found);
}

std::vector<FoundJobs> look_up_tileset(const BuildOptions& o) {
  Build build(o);
  const std::unique_ptr<ResultStore> results = look_up_kept_results(o.cache);
  return make_tileset({build, Task::look_up, results.get(), nullptr, false}).found;
}

}  // namespace bp
