#include "tools/lod/tile_build.h"

#include <fmt/format.h>

#include <cmath>

#include "io/mesh/lod_writer.h"
#include "io/store/result_store.h"
#include "io/store/scratch.h"
#include "io/tiles/tileset_file.h"
#include "io/tiles/tileset_folder.h"
#include "lib/check/counted.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/levels/lod_chain.h"
#include "lib/levels/whole_levels.h"
#include "lib/store/hex.h"
#include "tools/lod/bake_levels.h"
#include "tools/lod/choices.h"
#include "tools/lod/kept_results.h"
#include "tools/lod/leaves.h"
#include "tools/lod/lod_outputs.h"
#include "tools/lod/scene/complete_levels.h"
#include "tools/lod/scene/tileset_memory.h"
#include "tools/lod/tiles/cut_tiles.h"
#include "tools/lod/tiles/image_files.h"

namespace bp {

namespace {

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
    shop.build.note(fmt::format("--tiles {}..{}: this tileset has {}, numbered from 0: nothing is done", o.tiles->begin,
                                o.tiles->end, counted(made.plan.jobs(), "job")));
  shop.build.report.begin("measure the scene");
  const TilesetMemory limit({shop.build, made.scene, made.plan, made.held_looks.get(), cut_options(shop, made), share});
  LodOptions lod = lod_options(shop.build, made.scene, {}, share, made.plan.cut.size());
  naming_limit([&] { take_triangles(shop.build, made.scene, lod); },
               [&] { return limit(lod, *made.scene.voxels.solid); });
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
    const WaitingFile& file = made.files[std::size_t(i)];
    std::vector<std::byte> bytes;
    shop.files->get(file.content, bytes);
    folder.write(file.name, file_text(bytes));
    shop.files->drop(file.content);
  });
  for (const auto& [name, number] : made.images) {
    const std::vector<std::byte> bytes = made.scene.textures->file(number);
    tileset.images.push_back(leaf_folder(shop.options()) + "/" + name);
    folder.write(tileset.images.back(), file_text(bytes));
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
